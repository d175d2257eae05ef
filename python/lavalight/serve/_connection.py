"""A client's connection. Uvicorn waits for the first bytes of a request, and for clients that do not read, as long as it takes."""

from __future__ import annotations

import asyncio
from typing import cast

import h11
from uvicorn.protocols.http.h11_impl import H11Protocol


class Connection(H11Protocol):
    """Ends where a request's head takes too long to come, or an answer too long to be taken."""

    HEAD_SECONDS = 10.0
    TAKING_SECONDS = 30.0

    _head_timer: asyncio.TimerHandle | None = None
    _taking_timer: asyncio.TimerHandle | None = None

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        super().connection_made(cast(asyncio.Transport, transport))
        self._watch_head()

    def data_received(self, data: bytes) -> None:
        super().data_received(data)
        self._watch_head()

    def on_response_complete(self) -> None:
        super().on_response_complete()
        self._watch_head()

    def pause_writing(self) -> None:
        super().pause_writing()
        self._taking_timer = self.loop.call_later(self.TAKING_SECONDS, self.transport.abort)

    def resume_writing(self) -> None:
        super().resume_writing()
        self._stop(self._taking_timer)

    def connection_lost(self, exc: Exception | None) -> None:
        self._stop(self._head_timer)
        self._stop(self._taking_timer)
        super().connection_lost(exc)

    def send_400_response(self, msg: str) -> None:
        try:
            super().send_400_response(msg)
        except h11.LocalProtocolError:  # an answer has begun already
            self.transport.close()

    def _watch_head(self) -> None:
        """One timer for a whole head, however many bytes come now and then."""
        waits = self.cycle is None or self.cycle.response_complete
        if not waits:
            self._stop(self._head_timer)
            self._head_timer = None
        elif self._head_timer is None and not self.transport.is_closing():
            self._head_timer = self.loop.call_later(self.HEAD_SECONDS, self._end_waiting)

    def _end_waiting(self) -> None:
        if self.transport.is_closing():
            return
        if self.conn.trailing_data[0]:  # some of a head
            text = b"cannot take the request: it arrives too slowly\n"
            self.transport.write(b"HTTP/1.1 408 Request Timeout\r\nContent-Type: text/plain\r\nConnection: close\r\nContent-Length: %d\r\n\r\n%s" % (len(text), text))
        self.transport.close()
        self.loop.call_later(1.0, self.transport.abort)  # a client that does not read keeps it open otherwise

    @staticmethod
    def _stop(timer: asyncio.TimerHandle | None) -> None:
        if timer is not None:
            timer.cancel()
