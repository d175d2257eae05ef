"""What a client is told when it does not get a picture."""

from __future__ import annotations


class Refusal(Exception):
    """A status of HTTP and one line for people. Messages of statuses from 500 on are the server's own business."""

    def __init__(self, status: int, message: str, headers: dict[str, str] | None = None) -> None:
        super().__init__(message)
        self.status = status
        self.message = message
        self.headers = headers or {}


class ClientGone(Exception):
    """Nobody is there to be answered."""
