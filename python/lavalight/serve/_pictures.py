"""Pictures as bytes, in the formats that clients take."""

from __future__ import annotations

import io
import tempfile
from pathlib import Path

import numpy as np
import numpy.typing as npt
from PIL import Image as Pillow

from .._image import Image


def png_of_bytes(rgb: npt.NDArray[np.uint8]) -> bytes:
    """Rows, columns and three channels."""
    return _encoded(Pillow.fromarray(rgb, "RGB"), "PNG")


def tiff_of_floats(values: npt.NDArray[np.float32]) -> bytes:
    """One channel of 32-bit floats, without compression; infinity stays what it is."""
    return _encoded(Pillow.fromarray(np.ascontiguousarray(values, dtype=np.float32), "F"), "TIFF")


def preview(image: Image) -> tuple[str, bytes]:
    """A media type and small bytes: pictures on the way are looked at once."""
    if image.alpha is not None:
        return "image/png", image.png()
    buffer = io.BytesIO()
    Pillow.fromarray(np.ascontiguousarray(image.pixels[:, :, :3]), "RGB").save(buffer, "JPEG", quality=88)
    return "image/jpeg", buffer.getvalue()


def exr(image: Image) -> bytes:
    """The EXR that Image.save() writes."""
    with tempfile.TemporaryDirectory(prefix="lavalight-") as folder:
        path = Path(folder) / "image.exr"
        image.save(path)
        return path.read_bytes()


def _encoded(picture: Pillow.Image, kind: str) -> bytes:
    buffer = io.BytesIO()
    picture.save(buffer, kind)
    return buffer.getvalue()
