"""POST /render as Drake's glTF client sends it (RenderEngineGltfClient), a form with a glTF and a camera's intrinsics.

Protocol: Drake's documentation, "glTF Render Client-Server API", geometry/render_gltf_client.
"""

from __future__ import annotations

import hashlib
import json
import math
import re
import struct
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from .._image import Image
from .._keywords import words
from .._scene import Scene
from . import _pictures
from ._refusal import Refusal
from ._renders import Job
from ._scenes import load_model
from ._settings import Settings

IMAGE_TYPES = ("color", "depth", "label")

_NUMBER = re.compile(r"[+-]?(\d{1,30}(\.\d{0,30})?|\.\d{1,30})([eE][+-]?\d{1,3})?")

# Drake's world has z up, and its files keep it so; light from above comes along +y. Exact, so that no vertex is rounded anew.
_Z_UP = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]


@dataclass(frozen=True)
class DrakeRequest:
    """A form's fields, checked. Lengths are metres."""

    image_type: str
    width: int
    height: int
    near: float
    far: float
    focal: tuple[float, float]
    center: tuple[float, float]
    depths: tuple[float, float] = (0.0, math.inf)  # what the sensor measures
    sha256: str | None = None


def _text(fields: Mapping[str, Any], name: str) -> str:
    value = fields.get(name)
    if not isinstance(value, str):
        raise Refusal(400, f"cannot read the form: the field {name} is missing")
    return value.strip()


def _number(fields: Mapping[str, Any], name: str) -> float:
    text = _text(fields, name)
    value = float(text) if _NUMBER.fullmatch(text) else math.nan
    if not math.isfinite(value):
        raise Refusal(400, f"cannot read the form: the field {name} is not a number")
    return value


def _positive(fields: Mapping[str, Any], name: str) -> float:
    value = _number(fields, name)
    if value <= 0.0:
        raise Refusal(400, f"cannot read the form: the field {name} is not above 0")
    return value


def _whole(fields: Mapping[str, Any], name: str) -> int:
    text = _text(fields, name)
    if not re.fullmatch(r"[0-9]{1,9}", text) or int(text) == 0:
        raise Refusal(400, f"cannot read the form: the field {name} is not a whole number above 0")
    return int(text)


def read_request(fields: Mapping[str, Any], settings: Settings) -> DrakeRequest:
    """Raises Refusal for a field that is missing or makes no sense. Fields that this server does not know are left alone."""
    image_type = _text(fields, "image_type")
    if image_type not in IMAGE_TYPES:
        raise Refusal(400, "cannot read the form: the field image_type is not color, depth or label")
    width, height = _whole(fields, "width"), _whole(fields, "height")
    if width * height > settings.limits.pixels:
        raise Refusal(413, f"cannot render {width} x {height} pixels: the limit is {settings.limits.pixels}; "
                           "try a smaller image, or start the server with a higher --max-pixels")
    near, far = _positive(fields, "near"), _positive(fields, "far")
    if near >= far:
        raise Refusal(400, "cannot read the form: the field near is not below far")
    depths = (0.0, math.inf)
    if image_type == "depth":
        depths = (_number(fields, "min_depth"), _positive(fields, "max_depth"))
        if not 0.0 <= depths[0] < depths[1]:
            raise Refusal(400, "cannot read the form: the field min_depth is not from 0 to below max_depth")
    focal = (_positive(fields, "focal_x"), _positive(fields, "focal_y"))
    center = (_number(fields, "center_x"), _number(fields, "center_y"))
    for name in ("fov_x", "fov_y"):
        _positive(fields, name)  # says what the focal lengths say
    return DrakeRequest(image_type, width, height, near, far, focal, center, depths,
                        _text(fields, "scene_sha256").lower() if "scene_sha256" in fields else None)


def render(request: DrakeRequest, model: bytes, settings: Settings, job: Job) -> tuple[str, bytes]:
    """A media type and the picture's bytes."""
    if request.sha256 is not None and hashlib.sha256(model).hexdigest() != request.sha256:
        raise Refusal(400, "cannot take the scene: its bytes do not have the sum that scene_sha256 says")
    model = without_nulls(model)
    if request.image_type == "color":
        return "image/png", _color(request, with_y_up(model), settings, job)
    scene = _load(model, settings, {})
    job.go_on()
    if request.image_type == "depth":
        return "image/tiff", _pictures.tiff_of_floats(_depth(request, scene, job))
    return "image/png", _pictures.png_of_bytes(_labels(request, scene, job))


def _load(model: bytes, settings: Settings, keywords: dict[str, object]) -> Scene:
    scene = load_model("scene", model, words(keywords, True, "load"), settings.limits)
    if not scene.cameras:
        raise Refusal(400, "cannot render the scene: it has no camera")
    return scene


def _view(request: DrakeRequest) -> dict[str, object]:
    # Drake's own engines, VTK and GL, count the principal point from the image's corner, as Lavalight does; measured, since
    # Drake's documentation and its default of half the width less 0.5 suggest the middle of the first pixel.
    return {"size": (request.width, request.height), "intrinsics": (*request.focal, *request.center), "clip": (request.near, request.far)}


def _color(request: DrakeRequest, model: bytes, settings: Settings, job: Job) -> bytes:
    scene = _load(model, settings, {} if settings.environment is None else {"env": settings.environment})
    job.go_on()
    image = scene.render(**_view(request), spp=settings.samples, denoise=settings.denoise, progress=job.go_on)
    return image.png()


def _first_surface(request: DrakeRequest, scene: Scene, layer: str, job: Job) -> Image:
    """What the ray through the middle of each pixel meets. Paths end there."""
    return scene.render(**_view(request), spp=1, filter="point", max_bounces=0, nee=False, layers=[layer], progress=job.go_on)


def _depth(request: DrakeRequest, scene: Scene, job: Job) -> npt.NDArray[np.float32]:
    """Metres along the view: 0 for what is nearer than the sensor measures, infinity for what is farther or nowhere."""
    image = _first_surface(request, scene, "depth", job)
    depth = np.where(image.layers["hits"] > 0, image.layers["depth"], np.inf)
    depth = np.where(depth < request.depths[0], 0.0, depth)
    return np.where(depth > request.depths[1], np.inf, depth).astype(np.float32)


def _labels(request: DrakeRequest, scene: Scene, job: Job) -> npt.NDArray[np.uint8]:
    """The base colour of what is seen, whose bytes are the label; white where nothing is."""
    ids = _first_surface(request, scene, "material-id", job).layers["material-id"]
    colors = [[1.0, 1.0, 1.0], *([*material.base_color] for material in scene.materials)]
    labels: npt.NDArray[np.uint8] = np.rint(np.array(colors) * 255.0).astype(np.uint8)[ids]
    return labels


def with_y_up(model: bytes) -> bytes:
    """The scene with its z turned to y, cameras and all, so that light comes from above."""
    return _edited(model, _turn)


def without_nulls(model: bytes) -> bytes:
    """Drake writes `"images": null` where a model that it merged has no pictures."""
    return _edited(model, _drop_nulls) if b"null" in model else model


def _edited(model: bytes, edit: Callable[[dict[str, Any]], None]) -> bytes:
    """With other JSON. A file that is not understood stays as it is: the loader says what is wrong with it."""
    try:
        if model[:4] != b"glTF":
            gltf = json.loads(model)
            edit(gltf)
            return json.dumps(gltf).encode()
        length = struct.unpack_from("<I", model, 12)[0]
        gltf = json.loads(model[20:20 + length])
        edit(gltf)
        text = json.dumps(gltf).encode()
        text += b" " * (-len(text) % 4)
        body = struct.pack("<I4s", len(text), b"JSON") + text + model[20 + length:]
        return struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body
    except (ValueError, TypeError, LookupError, AttributeError, RecursionError, struct.error):
        return model


def _turn(gltf: dict[str, Any]) -> None:
    nodes = gltf["nodes"]
    shown = gltf["scenes"][gltf.get("scene", 0)]  # the others may share its nodes, which have one parent at most
    nodes.append({"matrix": _Z_UP, "children": shown["nodes"]})
    shown["nodes"] = [len(nodes) - 1]


def _drop_nulls(gltf: dict[str, Any]) -> None:
    for name in [name for name, value in gltf.items() if value is None]:
        del gltf[name]
