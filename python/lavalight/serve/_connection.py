"""A client's connection. Uvicorn waits for the first bytes of a request, and for clients that do not read, as long as it takes."""

from __future__ import annotations

import asyncio
from typing import cast

from uvicorn.protocols.http.h11_impl import H11Protocol


class Connection(H11Protocol):
    """Ends where a request's head takes too long to come, or an answer too long to be taken."""

    HEAD_SECONDS = 10.0
    TAKING_SECONDS = 30.0
    PARTING_SECONDS = 2.0

    _head_timer: asyncio.TimerHandle | None = None
    _taking_timer: asyncio.TimerHandle | None = None
    _is_over = False  # what still comes is thrown away

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        super().connection_made(cast(asyncio.Transport, transport))
        self._watch_head()

    def data_received(self, data: bytes) -> None:
        if not self._is_over:
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
        self._part("400 Bad Request", "cannot read the request: it is not HTTP")

    def _watch_head(self) -> None:
        """One timer for a whole head, however many bytes come now and then."""
        waits = self.cycle is None or self.cycle.response_complete
        if not waits:
            self._stop(self._head_timer)
            self._head_timer = None
        elif self._head_timer is None and not self._is_over and not self.transport.is_closing():
            self._head_timer = self.loop.call_later(self.HEAD_SECONDS, self._end_waiting)

    def _end_waiting(self) -> None:
        if self.conn.trailing_data[0]:  # some of a head
            self._part("408 Request Timeout", "cannot take the request: it arrives too slowly")
        else:
            self.transport.abort()

    def _part(self, status: str, text: str) -> None:
        """Says so, where no answer has begun, and ends. Closed at once, a connection with bytes on their way would lose the answer."""
        if self._is_over or self.transport.is_closing():
            return
        self._is_over = True
        is_answering = self.cycle is not None and self.cycle.response_started and not self.cycle.response_complete
        if self.cycle is not None and not self.cycle.response_complete:
            self.cycle.disconnected = True
            self.cycle.message_event.set()
        if not is_answering:
            head = f"HTTP/1.1 {status}\r\nContent-Type: text/plain\r\nConnection: close\r\nContent-Length: {len(text) + 1}\r\n\r\n"
            self.transport.write(f"{head}{text}\n".encode("ascii"))
        try:
            self.transport.write_eof()
        except OSError:  # the client has gone
            self.transport.abort()
            return
        self.transport.resume_reading()
        self.loop.call_later(self.PARTING_SECONDS, self.transport.abort)

    @staticmethod
    def _stop(timer: asyncio.TimerHandle | None) -> None:
        if timer is not None:
            timer.cancel()
