"""Images: numpy arrays that view the render's memory."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _keywords, _lavalight

Floats = npt.NDArray[np.float32]


class Layers(Mapping[str, npt.NDArray[Any]]):
    """Layers of an image by name: read-only arrays of rows, columns and, where there are several, channels."""

    def __init__(self, image: _lavalight.Image) -> None:
        self._image = image
        self._names = image.layer_names

    def __getitem__(self, name: str) -> npt.NDArray[Any]:
        return self._image.layer(name)

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    def __repr__(self) -> str:
        return f"Layers({', '.join(self._names)})"


class Comparison(Mapping[str, Any]):
    """What ``lavalight compare`` finds: a mapping of its JSON, which is true where the images may pass for equal."""

    def __init__(self, values: dict[str, Any]) -> None:
        self._values = values

    @property
    def equal(self) -> bool:
        """Whether all criteria are met."""
        return bool(self._values["equal"])

    def __bool__(self) -> bool:
        return self.equal

    def __getitem__(self, name: str) -> Any:
        return self._values[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def __repr__(self) -> str:
        return f"Comparison(equal={self.equal}, relMSE={self._values['relMse']:.3g})"


class Image:
    """A rendered image. Arrays are views without copies; they are read-only and keep the image alive."""

    def __init__(self, image: _lavalight.Image) -> None:
        self._image = image

    @property
    def width(self) -> int:
        return self._image.width

    @property
    def height(self) -> int:
        return self._image.height

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns."""
        return self.height, self.width

    @property
    def rgb(self) -> Floats:
        """Radiance, linear Rec. 709: rows from the top, columns, channels."""
        return self._image.layer("color")

    @property
    def variance(self) -> Floats | None:
        """Variance of each pixel's mean; 0 where a pixel has fewer than two samples."""
        return self._image.layer_variance("color")

    @property
    def alpha(self) -> Floats | None:
        """Coverage; None unless the background is transparent."""
        return self._image.layer("coverage") if "coverage" in self._image.layer_names else None

    @property
    def denoised(self) -> Floats | None:
        """Radiance without noise; None unless the render was asked to denoise."""
        return self._image.layer("denoised") if "denoised" in self._image.layer_names else None

    @property
    def layers(self) -> Layers:
        """All layers by name."""
        return Layers(self._image)

    def layer_variance(self, name: str) -> Floats | None:
        """Variance of a layer's means, or None where it has none. Raises KeyError for a layer that there is not."""
        return self._image.layer_variance(name)

    @property
    def samples(self) -> npt.NDArray[np.uint32]:
        """Samples of each pixel."""
        return self._image.samples

    @property
    def pixels(self) -> npt.NDArray[np.uint8]:
        """What a display shows, after exposure and tone curve: sRGB and straight alpha."""
        return self._image.pixels

    @property
    def complete(self) -> bool:
        """Whether all samples that were asked for are taken."""
        return self._image.complete

    @property
    def report(self) -> dict[str, Any]:
        """The JSON report of ``lavalight render --report``."""
        return dict(json.loads(self._image.report_json))

    @property
    def ledger(self) -> dict[str, str]:
        """The bias ledger: what in this image is not the unbiased answer. Empty: nothing."""
        return {entry["cause"]: entry["detail"] for entry in self.report["ledger"]}

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes .exr (radiance and layers), .png (to look at) or .json (the report), by the ending."""
        self._image.save(os.fspath(path))

    def png(self) -> bytes:
        """The bytes of the PNG that save() would write."""
        return self._image.png()

    def film_bytes(self) -> bytes:
        """The exact film, for merge(). An image has it where it was rendered with samples=(first, end) or merged.

        Raises Error for any other.
        """
        return self._image.film_bytes()

    def __reduce__(self) -> tuple[Any, ...]:
        return _unpickled, (self._image.pack(),)

    def _repr_png_(self) -> bytes:
        return self.png()

    def __array__(self, dtype: npt.DTypeLike | None = None, copy: bool | None = None) -> npt.NDArray[Any]:
        return np.array(self.rgb, dtype=dtype, copy=copy is not False)

    def compare(self, reference: Image | str | os.PathLike[str], *, relmse: float | None = None, flip: float | None = None,
                significance: float | None = None) -> Comparison:
        """Compares with another image or an EXR file, by the criteria of ``lavalight compare``.

        relmse, flip: at most this. significance: of the Z-test, which explains differences by noise. With none given, the Z-test
        where both have variances, else relMSE.
        """
        other: object = reference._image if isinstance(reference, Image) else os.fspath(reference)
        return Comparison(json.loads(self._image.compare(other, relmse, flip, significance)))

    def __repr__(self) -> str:
        state = "" if self.complete else ", not complete"
        return f"<lavalight.Image {self.width} x {self.height}, layers {', '.join(self._image.layer_names)}{state}>"


def _unpickled(data: bytes) -> Image:
    return Image(_lavalight.Image.unpack(data))


# What merge() takes of the options of render(): how the picture is shown.
SHOWN = frozenset({"tonemap", "exposure", "background", "denoise"})


def merge(parts: Iterable[Image | bytes | str | os.PathLike[str]], *, statistical: bool = False, **keywords: Any) -> Image:
    """Joins parts of one image, and gives it with the bits that one render of all samples has.

    Parts are images, the bytes of film_bytes(), or EXR files; they were rendered with samples=(first, end), and hold different
    samples or different parts of the image. statistical: parts of different devices and processors are joined, too, whose means are
    equal and whose bits are not. tonemap, exposure, background and denoise are those of render(). Raises Error where
    parts do not fit together. What a part cannot tell is not in the report: stages, kernels, memory.
    """
    for keyword in keywords:
        if keyword not in SHOWN:
            raise TypeError(f"merge() got an unexpected keyword argument {keyword!r}; it takes {', '.join(sorted(SHOWN))}")
    words = _keywords.words(keywords, False, "merge")
    film: _lavalight.Film | None = None
    for number, part in enumerate(parts, 1):
        more = _film_of(part, f"part {number}")
        if film is None:
            film = more
        else:
            film.add(more, statistical)
    if film is None:
        raise ValueError("merge() needs parts, and there are none")
    return Image(film.develop(words, True, True))


def _film_of(part: Image | bytes | str | os.PathLike[str], name: str) -> _lavalight.Film:
    if isinstance(part, (str, os.PathLike)):
        return _lavalight.Film.read(os.fspath(part))
    return _lavalight.Film.from_bytes(part.film_bytes() if isinstance(part, Image) else bytes(part), name)
