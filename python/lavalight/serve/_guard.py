"""Who may ask, and how much a request may send: the first of the application's layers."""

from __future__ import annotations

import asyncio
import hmac
import ipaddress
import re
from collections.abc import Awaitable, Callable, MutableMapping
from typing import Any

from ._refusal import ClientGone, Refusal
from ._settings import Limits, Settings

Scope = MutableMapping[str, Any]
Message = MutableMapping[str, Any]
Receive = Callable[[], Awaitable[Message]]
Send = Callable[[Message], Awaitable[None]]
App = Callable[[Scope, Receive, Send], Awaitable[None]]

# Scripts, styles and connections come from this server alone, and nothing frames the page. A token in the path stays out of Referer.
SECURITY_HEADERS = {
    "Content-Security-Policy": "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; connect-src 'self'; "
                               "base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Cache-Control": "no-store",
}

_HOST = re.compile(r"(?P<name>\[[0-9a-fA-F:.]+\]|[A-Za-z0-9._-]+)(?::[0-9]{1,5})?")


def header(scope: Scope, name: str) -> str | None:
    """The value of a header, or None. Raises Refusal where it is given twice."""
    values = [value for key, value in scope["headers"] if key == name.encode("ascii")]
    if len(values) > 1:
        raise Refusal(400, f"cannot read the request: it has {len(values)} headers {name.title()}")
    return values[0].decode("latin-1") if values else None


def _address(name: str) -> ipaddress.IPv4Address | ipaddress.IPv6Address | None:
    try:
        return ipaddress.ip_address(name.strip("[]"))
    except ValueError:
        return None


class Guard:
    """Lets requests through that come from where they may, in a size and time that they may have."""

    def __init__(self, app: App, settings: Settings) -> None:
        self._app = app
        self._settings = settings
        self._names = {"localhost", *(name.lower() for name in settings.names)}
        bound = _address(settings.host)
        self._is_loopback = bound is not None and bound.is_loopback or settings.host == "localhost"
        if bound is None:
            self._names.add(settings.host.lower())

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return

        async def send_safely(message: Message) -> None:
            if message["type"] == "http.response.start":
                message["headers"] = [*message["headers"], *((key.lower().encode(), value.encode()) for key, value in SECURITY_HEADERS.items())]
            await send(message)

        try:
            self._check_host(scope)
            self._check_origin(scope)
            admitted = self._check_token(scope)
            body = Body(admitted, receive, self._settings.limits)
        except Refusal as refusal:
            await answer(refusal, send_safely)
            return
        try:
            await self._app(admitted, body.receive, send_safely)
        except ClientGone:
            pass

    def _is_own_name(self, name: str) -> bool:
        # A page from elsewhere whose name was made to lead here (DNS rebinding) has that name for a Host. Addresses cannot be made to.
        if name.lower() in self._names:
            return True
        address = _address(name)
        return address is not None and (address.is_loopback or not self._is_loopback)

    def _check_host(self, scope: Scope) -> None:
        host = header(scope, "host")
        match = _HOST.fullmatch(host or "")
        if not match:
            raise Refusal(400, "cannot read the request: it has no valid header Host")
        if not self._is_own_name(match["name"]):
            raise Refusal(421, f"cannot answer for {match['name']}: this server does not have that name; "
                               "try its address, or start it with --name")

    @staticmethod
    def _check_origin(scope: Scope) -> None:
        origin = header(scope, "origin")
        if origin is None:
            return
        if origin.lower() not in {f"{scheme}://{header(scope, 'host') or ''}".lower() for scheme in ("http", "https")}:
            raise Refusal(403, "cannot answer: the request comes from a page of another origin")

    def _check_token(self, scope: Scope) -> Scope:
        """The scope without the token in its path. Both comparisons take the same time whatever the token."""
        token = self._settings.token
        if token is None:
            return scope
        path = str(scope["path"])
        first, _, rest = path.lstrip("/").partition("/")
        if hmac.compare_digest(first.encode(), token.encode()):
            if path.count("/") == 1:  # so that the page's own addresses lead below the token
                raise Refusal(307, "the page is at the address with a slash at its end", {"Location": f"/{token}/"})
            return {**scope, "path": f"/{rest}", "raw_path": f"/{rest}".encode(), "root_path": ""}
        bearer = (header(scope, "authorization") or "").removeprefix("Bearer ")
        if hmac.compare_digest(bearer.encode(), token.encode()):
            return scope
        raise Refusal(401, "cannot answer without the token: give it as the first part of the path, or in the header "
                           "\"Authorization: Bearer TOKEN\"", {"WWW-Authenticate": "Bearer"})


class Body:
    """A request's body as it arrives: no longer and no slower than it may be."""

    def __init__(self, scope: Scope, receive: Receive, limits: Limits) -> None:
        self._receive = receive
        self._limits = limits
        self._bytes = 0
        self._is_whole = False
        self._end = asyncio.get_running_loop().time() + limits.body
        length = header(scope, "content-length")
        if length is not None and (not length.isdigit() or int(length[:20]) > limits.bytes):
            raise self._too_large()

    def _too_large(self) -> Refusal:
        return Refusal(413, f"cannot take the request: it has more than {self._limits.bytes} bytes; "
                            "try smaller textures, or start the server with a higher --max-bytes")

    async def receive(self) -> Message:
        if self._is_whole:
            return await self._receive()  # waits until the client goes
        left = self._end - asyncio.get_running_loop().time()
        try:
            message = await asyncio.wait_for(self._receive(), max(0.0, min(left, self._limits.silence)))
        except asyncio.TimeoutError:
            raise Refusal(408, "cannot take the request: it arrives too slowly", {"Connection": "close"}) from None
        if message["type"] == "http.disconnect":
            raise ClientGone
        self._bytes += len(message.get("body", b""))
        self._is_whole = not message.get("more_body", False)
        if self._bytes > self._limits.bytes:
            raise self._too_large()
        return message


async def answer(refusal: Refusal, send: Send) -> None:
    """Sends a refusal as text."""
    body = f"{refusal.message}\n".encode()
    headers = {"Content-Type": "text/plain; charset=utf-8", "Content-Length": str(len(body)), **refusal.headers}
    await send({"type": "http.response.start", "status": refusal.status,
                "headers": [(key.lower().encode(), value.encode()) for key, value in headers.items()]})
    await send({"type": "http.response.body", "body": body})
