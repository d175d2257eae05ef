"""POST /render in JSON: a scene, and keywords of lavalight.Scene.render(), those that read no file."""

from __future__ import annotations

import base64
import binascii
import json
import math
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from .. import _lavalight, builtin_scenes
from .._image import Image
from .._keywords import words
from . import _pictures
from ._refusal import Refusal
from ._renders import Job
from ._scenes import KeptScene, Scenes
from ._settings import Limits, Settings

# The keywords of load() and render() that decide a picture without reading a file.
SCENE_KEYWORDS = frozenset({"at", "animation", "variant", "env", "env_rotation", "env_intensity", "sun_elevation", "sun_azimuth",
                            "turbidity"})
RENDER_KEYWORDS = frozenset({"size", "spp", "seed", "max_bounces", "camera", "look_from", "look_at", "up", "view", "fov", "intrinsics",
                             "aperture", "focus", "panorama", "clip", "no_clip", "background", "ground", "exposure", "tonemap", "filter",
                             "filter_radius", "denoise", "layers"})
OWN_KEYWORDS = frozenset({"scene", "model", "builtin", "format", "every"})
FORMATS = {"png": "image/png", "exr": "image/x-exr", "jpeg": "image/jpeg"}
ENVIRONMENTS = ("studio", "sky", "white")

Sent = Callable[[str, dict[str, object]], None]


@dataclass(frozen=True)
class Preview:
    """A request, checked as far as the engine does not check it."""

    scene: KeptScene
    format: str
    every: float
    size: tuple[int, int]
    spp: int
    scene_keywords: dict[str, object] = field(default_factory=dict)
    render_keywords: dict[str, object] = field(default_factory=dict)


def read_json(body: bytes) -> dict[str, Any]:
    """Raises Refusal for what is not an object."""
    try:
        value = json.loads(body, parse_constant=_no_constant)
    except (ValueError, RecursionError):
        raise Refusal(400, "cannot read the request: it is not JSON") from None
    if not isinstance(value, dict):
        raise Refusal(400, "cannot read the request: it is not a JSON object")
    return value


def _no_constant(name: str) -> float:
    raise ValueError(name)


def _whole(value: object, name: str, least: int, most: int, status: int) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or value < least:
        raise Refusal(400, f"cannot read the request: {name} is not a whole number from {least} on")
    if value > most:
        raise Refusal(status, f"cannot render with a {name} of {value}: the limit is {most}; try less, or start the server with a higher limit")
    return value


def _size(value: object, limits: Limits) -> tuple[int, int]:
    if not isinstance(value, list) or len(value) != 2:
        raise Refusal(400, "cannot read the request: size is not [width, height]")
    width = _whole(value[0], "width", 1, limits.pixels, 413)
    height = _whole(value[1], "height", 1, limits.pixels, 413)
    if width * height > limits.pixels:
        raise Refusal(413, f"cannot render {width} x {height} pixels: the limit is {limits.pixels}; "
                           "try a smaller size, or start the server with a higher --max-pixels")
    return width, height


def _plain(name: str, value: object) -> object:
    """Texts, numbers and lists of them are what keywords take."""
    items = value if isinstance(value, list) else [value]
    if len(items) > 64 or not all(isinstance(item, (str, int, float, bool)) and len(str(item)) <= 256 for item in items):
        raise Refusal(400, f"cannot read the request: {name} is neither a text, a number nor a list of them")
    return value


def _environment(value: object) -> object:
    is_name = isinstance(value, str) and value in ENVIRONMENTS
    is_color = isinstance(value, list) and len(value) == 3 and all(type(channel) in (int, float) for channel in value)
    if not is_name and not is_color:
        raise Refusal(400, f"cannot read the request: env is neither {', '.join(ENVIRONMENTS)} nor [red, green, blue]")
    return value


def _scene(request: dict[str, Any], scenes: Scenes, limits: Limits) -> KeptScene:
    given = [name for name in ("scene", "model", "builtin") if name in request]
    if len(given) != 1:
        raise Refusal(400, "cannot read the request: give one of scene (a key), model (glTF, or a GLB as base64) and builtin (a name)")
    value = request[given[0]]
    if given[0] == "model" and isinstance(value, dict):
        return KeptScene("model", json.dumps(value).encode(), limits)
    if not isinstance(value, str):
        raise Refusal(400, f"cannot read the request: {given[0]} is not a text")
    if given[0] == "scene":
        return scenes.find(value)
    if given[0] == "builtin":
        return builtin(value, limits)
    try:
        return KeptScene("model", base64.b64decode(value, validate=True), limits)
    except (binascii.Error, ValueError):
        raise Refusal(400, "cannot read the request: model is not base64") from None


def builtin_names() -> list[str]:
    """Without those that stand for many, such as dense-N: load() would look for a file of that name."""
    return [name for name in builtin_scenes() if "-N" not in name]


def builtin(name: str, limits: Limits) -> KeptScene:
    if name not in builtin_names():
        raise Refusal(404, f"cannot find a built-in scene of that name; there are {', '.join(builtin_names())}")
    return KeptScene(name, None, limits)


def read_preview(request: dict[str, Any], scenes: Scenes, settings: Settings) -> Preview:
    """Raises Refusal for a keyword that there is not, and for more than the limits allow."""
    for name in request:
        if name not in SCENE_KEYWORDS | RENDER_KEYWORDS | OWN_KEYWORDS:
            raise Refusal(400, f"cannot read the request: {name[:64]!r} is not a keyword")
    wanted = request.get("format", "png")
    if wanted not in FORMATS:
        raise Refusal(400, "cannot read the request: format is not png, jpeg or exr")
    every = request.get("every", 0.5)
    if isinstance(every, bool) or not isinstance(every, (int, float)) or not 0.05 <= every <= 60.0:
        raise Refusal(400, "cannot read the request: every is not a number of seconds from 0.05 to 60")
    values = {name: _environment(value) if name == "env" else _plain(name, value)
              for name, value in request.items() if name not in OWN_KEYWORDS and value is not None}
    try:
        words({name: value for name, value in values.items() if name in SCENE_KEYWORDS}, True, "render")
        words({name: value for name, value in values.items() if name in RENDER_KEYWORDS}, False, "render")
    except (TypeError, ValueError) as error:
        raise Refusal(400, f"cannot read the request: {error}") from None
    size = _size(values.pop("size", [512, 512]), settings.limits)
    spp = _whole(values.pop("spp", 64), "spp", 1, settings.limits.samples, 413)
    return Preview(_scene(request, scenes, settings.limits), wanted, float(every), size, spp,
                   {name: value for name, value in values.items() if name in SCENE_KEYWORDS},
                   {name: value for name, value in values.items() if name in RENDER_KEYWORDS})


def render(preview: Preview, job: Job) -> tuple[str, bytes]:
    """A media type and the picture's bytes."""
    scene = preview.scene.scene(preview.scene_keywords)
    job.go_on()
    image = scene.render(size=preview.size, spp=preview.spp, progress=job.go_on, **preview.render_keywords)
    preview.scene.picture = image
    return encoded(image, preview.format)


def encoded(image: Image, name: str) -> tuple[str, bytes]:
    """A media type and an image's bytes in a format."""
    if name == "exr":
        return FORMATS[name], _pictures.exr(image)
    return _pictures.preview(image) if name == "jpeg" else (FORMATS[name], image.png())


def render_events(preview: Preview, send: Sent, job: Job) -> None:
    """Sends the picture as it gets better, and then what can be said of it."""
    scene = preview.scene.scene(preview.scene_keywords)
    job.go_on()
    start = time.monotonic()
    options = words({"size": preview.size, "spp": preview.spp, **preview.render_keywords}, False, "render")
    running = _lavalight.Render(scene._scene, options, True)
    seconds = preview.every
    while True:
        began = time.monotonic()
        image = Image(running.advance(seconds, job.go_on))
        preview.scene.picture = image
        kind, data = (FORMATS["png"], image.png()) if image.complete else _pictures.preview(image)
        send("picture", {"type": kind, "data": base64.b64encode(data).decode(), "width": image.width, "height": image.height,
                         "samples": math.floor(float(image.samples.mean()) * 10) / 10, "of": preview.spp,
                         "seconds": round(time.monotonic() - start, 2)})
        job.go_on()
        if image.complete:
            break
        # Denoising and encoding take a quarter of the time at most.
        seconds = max(preview.every, 3.0 * (time.monotonic() - began - seconds))
    send("done", {"ledger": image.ledger})


class Latest:
    """Events on their way to a client, of which pictures replace each other: a slow client gets fewer."""

    def __init__(self, wake: Callable[[], None]) -> None:
        self._events: list[tuple[str, dict[str, object]]] = []
        self._lock = threading.Lock()
        self._wake = wake

    def send(self, name: str, data: dict[str, object]) -> None:
        with self._lock:
            if name == "picture":
                self._events = [event for event in self._events if event[0] != "picture"]
            self._events.append((name, data))
        self._wake()

    def take(self) -> list[tuple[str, dict[str, object]]]:
        with self._lock:
            events, self._events = self._events, []
        return events


def describe(kept: KeptScene) -> dict[str, object]:
    """What the page has to know of a scene: where it is, and which camera looks at it."""
    scene = kept.scene({})
    return {"scene": kept.key, "name": kept.name, "triangles": scene.triangles, "bounds": scene.bounds, "variants": scene.variants,
            "warnings": scene.warnings[:20], "has_own_light": scene.has_own_light,
            "cameras": [{"name": name, "look_from": place, "forward": forward, "up": up, "fov": fov}
                        for name, place, forward, up, fov in scene._scene.perspective_cameras]}
