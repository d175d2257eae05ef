"""Which address does what."""

from __future__ import annotations

import asyncio
import functools
import importlib.resources
import json
import logging
import time
from collections.abc import AsyncIterator, Awaitable, Callable, Coroutine
from contextlib import asynccontextmanager
from typing import Any, TypeVar

from starlette.applications import Starlette
from starlette.datastructures import UploadFile
from starlette.exceptions import HTTPException
from starlette.middleware import Middleware
from starlette.requests import Request
from starlette.responses import JSONResponse, PlainTextResponse, Response, StreamingResponse
from starlette.routing import Route

from .. import Error, UsageError, __version__, load
from . import _drake, _preview
from ._guard import Guard, header
from ._refusal import ClientGone, Refusal
from ._renders import Job, Renders
from ._scenes import KeptScene, Scenes
from ._settings import Settings

Result = TypeVar("Result")

PAGE = {"": ("index.html", "text/html; charset=utf-8"), "page.css": ("page.css", "text/css; charset=utf-8"),
        "page.js": ("page.js", "text/javascript; charset=utf-8"), "orbit.js": ("orbit.js", "text/javascript; charset=utf-8"),
        "icon.svg": ("icon.svg", "image/svg+xml")}

log = logging.getLogger("lavalight.serve")


class Server:
    """The application's state: the queue, the scenes, and whether pictures can be denoised."""

    def __init__(self, settings: Settings) -> None:
        self.settings = settings
        self.renders = Renders(settings.limits)
        self.scenes = Scenes(settings.limits)
        self.can_denoise = False

    async def warm_up(self) -> None:
        """Compiles kernels before the first client waits for them, and finds out whether the denoiser is there."""
        def try_denoising(job: Job) -> bool:
            scene = load("cornell-box")
            scene.render(size=(8, 8), spp=1, progress=job.go_on)
            try:
                scene.render(size=(8, 8), spp=1, denoise=True, progress=job.go_on)
            except Error:
                return False
            return True

        try:
            self.can_denoise = await self.renders.run(try_denoising)
        except (Error, Refusal) as error:
            log.warning("cannot render a first picture: %s", error)


async def until_gone(request: Request, work: Coroutine[Any, Any, Result]) -> Result:
    """The work's result. Raises ClientGone, and cancels the work, when nobody waits for it any more."""
    task = asyncio.ensure_future(work)
    gone = asyncio.ensure_future(_gone(request))
    try:
        await asyncio.wait({task, gone}, return_when=asyncio.FIRST_COMPLETED)
        if not task.done():
            raise ClientGone
        return task.result()
    finally:
        gone.cancel()
        task.cancel()


async def _gone(request: Request) -> None:
    while (await request.receive())["type"] != "http.disconnect":
        pass


def _told(error: Exception) -> Refusal:
    """What is said of a failure of the engine. The client's option is to blame for one of usage."""
    if isinstance(error, Refusal):
        return error
    if isinstance(error, Error):
        return Refusal(400 if isinstance(error, UsageError) else 500, str(error))
    log.error("a request failed", exc_info=error)
    return Refusal(500, "cannot render: an error of the server, which its log tells of")


def _refused(request: Request, refusal: Exception) -> Response:
    del request
    assert isinstance(refusal, Refusal)
    return PlainTextResponse(f"{refusal.message}\n", refusal.status, refusal.headers)


def _http_error(request: Request, error: Exception) -> Response:
    assert isinstance(error, HTTPException)
    text = {404: f"cannot find {request.url.path!r}", 405: f"cannot {request.method} this address"}.get(error.status_code, f"cannot read the request: {error.detail}")
    return PlainTextResponse(f"{text}\n", error.status_code, error.headers)


Endpoint = Callable[[Server, Request], Awaitable[Response]]


def _endpoint(server: Server, function: Endpoint) -> Callable[[Request], Awaitable[Response]]:
    @functools.wraps(function)
    async def endpoint(request: Request) -> Response:
        start = time.monotonic()
        status = 499  # the client has gone
        try:
            try:
                response = await function(server, request)
            except (ClientGone, HTTPException):
                raise
            except Exception as error:
                response = _refused(request, _told(error))
            status = response.status_code
            return response
        except HTTPException as error:
            status = error.status_code
            raise
        finally:
            log.info("%s %r: %d after %.2f s", request.method, request.url.path[:200], status, time.monotonic() - start)

    return endpoint


async def render(server: Server, request: Request) -> Response:
    """POST /render: Drake's form, or JSON."""
    kind = (header(request.scope, "content-type") or "").partition(";")[0].strip().lower()
    if kind == "multipart/form-data":
        return await _render_form(server, request)
    if kind == "application/json":
        return await _render_json(server, request)
    raise Refusal(415, "cannot read the request: it is neither multipart/form-data, as Drake sends it, nor application/json")


async def _render_form(server: Server, request: Request) -> Response:
    async with request.form(max_files=1, max_fields=32, max_part_size=4096) as form:
        fields = dict(form)
        if len(fields) != len(form.multi_items()):
            raise Refusal(400, "cannot read the form: a field is given twice")
        wanted = _drake.read_request(fields, server.settings)
        upload = fields.get("scene")
        if not isinstance(upload, UploadFile):
            raise Refusal(400, "cannot read the form: the file scene is missing")

        def work(job: Job) -> tuple[str, bytes]:
            model = upload.file.read()  # it waited on the disk
            return _drake.render(wanted, model, server.settings, job)

        kind, data = await until_gone(request, server.renders.run(work))
    return Response(data, media_type=kind)


async def _render_json(server: Server, request: Request) -> Response:
    preview = _preview.read_preview(_preview.read_json(await request.body()), server.scenes, server.settings)
    if "text/event-stream" in (header(request.scope, "accept") or ""):
        return StreamingResponse(_events(server, request, preview), media_type="text/event-stream", headers={"X-Accel-Buffering": "no"})
    kind, data = await until_gone(request, server.renders.run(functools.partial(_preview.render, preview)))
    return Response(data, media_type=kind)


def _event(name: str, data: dict[str, object]) -> str:
    return f"event: {name}\ndata: {json.dumps(data)}\n\n"


async def _events(server: Server, request: Request, preview: _preview.Preview) -> AsyncIterator[str]:
    """A render's pictures as server-sent events. Comments in between show a client that goes."""
    loop = asyncio.get_running_loop()
    wake = asyncio.Event()

    def wake_up() -> None:
        loop.call_soon_threadsafe(wake.set)

    latest = _preview.Latest(wake_up)
    if server.renders.ahead:
        yield _event("queued", {"ahead": server.renders.ahead})
    work = asyncio.ensure_future(until_gone(request, server.renders.run(functools.partial(_preview.render_events, preview, latest.send))))
    work.add_done_callback(lambda _: wake.set())
    try:
        while not work.done():
            try:
                await asyncio.wait_for(wake.wait(), 5.0)
            except asyncio.TimeoutError:
                yield ": wait\n\n"
            wake.clear()
            for name, data in latest.take():
                yield _event(name, data)
        error = work.exception()
        for name, data in latest.take():
            yield _event(name, data)
        if error is not None and not isinstance(error, ClientGone):
            refusal = _told(error) if isinstance(error, Exception) else Refusal(500, "cannot render")
            yield _event("error", {"status": refusal.status, "message": refusal.message})
    finally:
        work.cancel()


async def add_scene(server: Server, request: Request) -> Response:
    """POST /scenes: a .glb or .gltf to keep, or {"builtin": name}."""
    body = await request.body()
    kind = (header(request.scope, "content-type") or "").partition(";")[0].strip().lower()
    if kind == "application/json":
        name = _preview.read_json(body).get("builtin")
        kept = _preview.builtin(name if isinstance(name, str) else "", server.settings.limits)
    else:
        kept = KeptScene("model", body, server.settings.limits)

    def work(job: Job) -> dict[str, object]:
        description = _preview.describe(kept)
        job.go_on()
        return description

    description = await until_gone(request, server.renders.run(work))
    server.scenes.keep(kept)
    return JSONResponse(description, 201)


async def forget_scene(server: Server, request: Request) -> Response:
    """DELETE /scenes/{key}."""
    server.scenes.forget(request.path_params["key"])
    return Response(status_code=204)


async def picture(server: Server, request: Request) -> Response:
    """GET /scenes/{key}/picture.png or .exr: the last picture of a scene, as far as it came."""
    image = server.scenes.find(request.path_params["key"]).picture
    kind = request.path_params["format"]
    if kind not in ("png", "exr"):
        raise Refusal(404, "cannot find the picture: it can be had as .png and .exr")
    if image is None:
        raise Refusal(404, "cannot find the picture: the scene has not been rendered yet")
    media, data = await asyncio.get_running_loop().run_in_executor(None, _preview.encoded, image, kind)
    return Response(data, media_type=media, headers={"Content-Disposition": f'attachment; filename="lavalight.{kind}"'})


async def about(server: Server, request: Request) -> Response:
    """GET /about: what the page has to know, and whether the server is well."""
    del request
    limits = server.settings.limits
    return JSONResponse({"version": __version__, "builtin": _preview.builtin_names(), "denoise": server.can_denoise, "requests": server.renders.count,
                         "scenes": len(server.scenes),
                         "limits": {"bytes": limits.bytes, "pixels": limits.pixels, "samples": limits.samples, "seconds": limits.seconds,
                                    "waiting": limits.waiting, "renders": limits.renders, "triangles": limits.triangles}})


async def page(server: Server, request: Request) -> Response:
    """GET /: the page and its parts."""
    del server
    name, kind = PAGE[request.url.path.lstrip("/")]
    return Response((importlib.resources.files(__package__) / "page" / name).read_bytes(), media_type=kind)


def make_app(settings: Settings) -> tuple[Starlette, Server]:
    """The application, and its state for whoever has to end it."""
    server = Server(settings)

    @asynccontextmanager
    async def lifespan(app: Starlette) -> AsyncIterator[None]:
        del app
        warming = asyncio.ensure_future(server.warm_up())
        yield
        server.renders.close()
        warming.cancel()

    def route(path: str, function: Endpoint, method: str) -> Route:
        return Route(path, _endpoint(server, function), methods=[method])

    routes = [route("/render", render, "POST"), route("/scenes", add_scene, "POST"), route("/scenes/{key}", forget_scene, "DELETE"),
              route("/scenes/{key}/picture.{format}", picture, "GET"), route("/about", about, "GET"),
              *(route(f"/{name}", page, "GET") for name in PAGE)]
    app = Starlette(routes=routes, lifespan=lifespan, middleware=[Middleware(Guard, settings)],
                    exception_handlers={Refusal: _refused, HTTPException: _http_error})
    return app, server
