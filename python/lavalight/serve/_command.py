"""The command `lavalight serve`."""

from __future__ import annotations

import argparse
import asyncio
import dataclasses
import importlib.util
import ipaddress
import logging
import os
import re
import secrets
import socket
import sys
from collections.abc import Sequence
from pathlib import Path
from types import FrameType

from ._settings import Limits, Settings

NEEDED = {"starlette": "starlette", "uvicorn": "uvicorn", "python_multipart": "python-multipart", "PIL": "pillow"}
TOKEN_VARIABLE = "LAVALIGHT_TOKEN"


class UsageError(ValueError):
    """What the command was asked to do makes no sense."""


def main(words: Sequence[str]) -> int:
    """Serves until it is interrupted. Returns the exit code: 0 ended, 1 failed, 2 for words that make no sense."""
    arguments = _parser().parse_args(words)
    missing = [package for module, package in NEEDED.items() if importlib.util.find_spec(module) is None]
    try:
        settings = settings_of(arguments)
        if missing:
            raise RuntimeError(f"cannot serve: {', '.join(missing)} {'is' if len(missing) == 1 else 'are'} not installed; "
                               f"try pip install {' '.join(missing)}, or install lavalight[serve]")
        return _run(settings)
    except UsageError as error:
        print(f"lavalight: {error}", file=sys.stderr)
        return 2
    except (OSError, RuntimeError) as error:
        print(f"lavalight: {error}", file=sys.stderr)
        return 1


def _parser() -> argparse.ArgumentParser:
    limits = Limits()
    parser = argparse.ArgumentParser(prog="lavalight serve", description="Serves a page that shows models, and renders for Drake and others over HTTP.",
                                     epilog="docs/serve.md is the manual.")
    parser.add_argument("--bind", default="127.0.0.1:8000", metavar="HOST:PORT",
                        help="where to listen (default: %(default)s); an address that others reach needs a token, and makes one if there is none")
    parser.add_argument("--token-file", type=Path, metavar="FILE",
                        help=f"a file with the token that every request has to bring; default: the variable {TOKEN_VARIABLE}")
    parser.add_argument("--name", action="append", default=[], metavar="NAME", help="another name of this machine that requests may call it by; may be repeated")
    parser.add_argument("--spp", type=int, default=64, metavar="N", help="samples of a pixel of Drake's colour images (default: %(default)s)")
    parser.add_argument("--env", metavar="studio|sky|white|R,G,B|FILE", help="environment of Drake's colour images; default: a studio, where the scene has no light")
    parser.add_argument("--denoise", action="store_true", help="denoise Drake's colour images")
    group = parser.add_argument_group("limits")
    group.add_argument("--renders", type=int, default=limits.renders, metavar="N", help="renders at once (default: %(default)s)")
    group.add_argument("--max-waiting", type=int, default=limits.waiting, metavar="N", help="requests that may wait behind them (default: %(default)s)")
    group.add_argument("--max-bytes", type=_bytes, default=limits.bytes, metavar="N[K|M|G]", help="bytes of a request (default: 64M)")
    group.add_argument("--max-pixels", type=int, default=limits.pixels, metavar="N", help="pixels of an image (default: %(default)s)")
    group.add_argument("--max-samples", type=int, default=limits.samples, metavar="N", help="samples of a pixel (default: %(default)s)")
    group.add_argument("--max-seconds", type=float, default=limits.seconds, metavar="S", help="seconds of a render, loading included (default: %(default)g)")
    group.add_argument("--max-triangles", type=int, default=limits.triangles, metavar="N", help="triangles of a scene (default: %(default)s)")
    group.add_argument("--max-scenes", type=int, default=limits.scenes, metavar="N", help="scenes that are kept for the page (default: %(default)s)")
    return parser


def _bytes(text: str) -> int:
    match = re.fullmatch(r"([0-9]{1,12})([KMG]?)", text.upper())
    if not match:
        raise argparse.ArgumentTypeError(f"{text!r} is not a number of bytes, such as 64M")
    return int(match[1]) << {"": 0, "K": 10, "M": 20, "G": 30}[match[2]]


def settings_of(arguments: argparse.Namespace) -> Settings:
    """Raises UsageError."""
    host, port = _address(arguments.bind)
    limits = dataclasses.replace(Limits(), bytes=arguments.max_bytes, pixels=arguments.max_pixels, samples=arguments.max_samples,
                                 seconds=arguments.max_seconds, triangles=arguments.max_triangles, renders=arguments.renders,
                                 waiting=arguments.max_waiting, scenes=arguments.max_scenes)
    for name, value in dataclasses.asdict(limits).items():
        if not value > 0 and name != "waiting" or value < 0 or value == float("inf"):
            raise UsageError(f"the limit of {name} is not a number above 0")
    if not 1 <= arguments.spp <= limits.samples:
        raise UsageError(f"--spp: {arguments.spp} is not from 1 to --max-samples, {limits.samples}")
    token = _token(arguments.token_file)
    if token is None and not _is_loopback(host):
        token = secrets.token_urlsafe(24)
    return Settings(host, port, token, tuple(arguments.name), arguments.spp, arguments.env, arguments.denoise, limits)


def _address(text: str) -> tuple[str, int]:
    match = re.fullmatch(r"(\[[0-9a-fA-F:.]+\]|[A-Za-z0-9._-]+):([0-9]{1,5})", text)
    if not match or int(match[2]) > 65535:
        raise UsageError(f"--bind: {text!r} is not HOST:PORT, such as 127.0.0.1:8000")
    return match[1].strip("[]"), int(match[2])


def _is_loopback(host: str) -> bool:
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return host == "localhost"


def _token(file: Path | None) -> str | None:
    token = os.environ.get(TOKEN_VARIABLE) or None
    if file is not None:
        try:
            token = file.read_text(encoding="ascii").strip()
        except (OSError, UnicodeDecodeError) as error:
            raise UsageError(f"--token-file: cannot read {file}: {error}") from None
    if token is not None and not re.fullmatch(r"[A-Za-z0-9_-]{16,128}", token):
        raise UsageError("the token is not 16 to 128 letters, digits, - and _; try: python3 -c 'import secrets; print(secrets.token_urlsafe(24))'")
    return token


def _listen(host: str, port: int) -> socket.socket:
    try:
        family, kind, protocol, _, address = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE)[0]
        listening = socket.socket(family, kind, protocol)
        listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listening.bind(address)
    except OSError as error:
        raise RuntimeError(f"cannot listen at {host}:{port}: {error.strerror}; try another --bind") from None
    return listening


def _run(settings: Settings) -> int:
    import uvicorn

    from ._app import Server, make_app
    from ._connection import Connection

    class Uvicorn(uvicorn.Server):
        """Says where it listens once it does, and ends renders as soon as it is interrupted."""

        def __init__(self, config: uvicorn.Config, server: Server) -> None:
            super().__init__(config)
            self._server = server

        async def startup(self, sockets: list[socket.socket] | None = None) -> None:
            self._loop = asyncio.get_running_loop()
            await super().startup(sockets)
            print(f"lavalight: serving at {address}; Ctrl-C ends it", flush=True)

        def handle_exit(self, sig: int, frame: FrameType | None) -> None:
            self._loop.call_soon_threadsafe(self._server.renders.close)
            super().handle_exit(sig, frame)

    logging.basicConfig(format="%(message)s", level=logging.WARNING)
    logging.getLogger("lavalight").setLevel(logging.ERROR)  # what is odd of a scene is its sender's business
    logging.getLogger("lavalight.serve").setLevel(logging.INFO)
    app, server = make_app(settings)
    config = uvicorn.Config(app, settings.host, settings.port, http=Connection, ws="none", lifespan="on", log_config=None, access_log=False,
                            server_header=False, proxy_headers=False, limit_concurrency=settings.limits.connections, timeout_keep_alive=5,
                            timeout_graceful_shutdown=10, h11_max_incomplete_event_size=32 << 10)
    listening = _listen(settings.host, settings.port)
    port = listening.getsockname()[1]
    host = f"[{settings.host}]" if ":" in settings.host else settings.host
    address = f"http://{host}:{port}/{f'{settings.token}/' if settings.token else ''}"
    try:
        Uvicorn(config, server).run([listening])
    except KeyboardInterrupt:  # uvicorn passes it on once all has ended
        pass
    return 0
