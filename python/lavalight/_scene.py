"""Scenes: loaded once, rendered as often as one likes."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from typing import Any

from . import _bundle, _keywords, _lavalight
from ._build import Camera, Light, Material, Mesh, build_glb
from ._image import Image

__all__ = ["Materials", "Scene", "load"]


class Materials(Sequence[_lavalight.Material]):
    """Materials of a scene by number or name. Changes show in renders that begin later."""

    def __init__(self, materials: list[_lavalight.Material]) -> None:
        self._materials = materials

    def __getitem__(self, key: Any) -> Any:
        if not isinstance(key, str):
            return self._materials[key]
        for material in self._materials:
            if material.name == key:
                return material
        raise KeyError(f"cannot find material {key!r}; try one of {', '.join(repr(m.name) for m in self._materials)}")

    def __len__(self) -> int:
        return len(self._materials)


class Scene:
    """A scene with its light.

    ``load()`` reads one from a file. The constructor builds one from arrays:

        Scene(meshes=[Mesh(positions, triangles)], materials=[Material(base_color=(0.8, 0.2, 0.1))], camera=Camera(...))
    """

    def __init__(self, meshes: Sequence[Mesh], materials: Sequence[Material] = (), camera: Camera | None = None,
                 lights: Sequence[Light] = (), name: str = "scene", **keywords: Any) -> None:
        data = build_glb(meshes, materials, camera, lights)
        self._origin = _bundle.Origin(_keywords.words(keywords, True, "Scene"), data)
        self._scene = _lavalight.Scene.from_bytes(name, data, self._origin.words)

    @classmethod
    def _of(cls, scene: _lavalight.Scene, origin: _bundle.Origin) -> Scene:
        self = cls.__new__(cls)
        self._scene = scene
        self._origin = origin
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        return _unpickled, (_bundle.model_of(self._scene, self._origin), _bundle.choice_of(self._scene, self._origin))

    @property
    def name(self) -> str:
        """Path or built-in name."""
        return self._scene.name

    @property
    def warnings(self) -> list[str]:
        """What was not understood of the file, a line each."""
        return self._scene.warnings

    @property
    def triangles(self) -> int:
        return self._scene.triangles

    @property
    def has_own_light(self) -> bool:
        """Whether the file brings light; if not, and no env is given, a studio lights it."""
        return self._scene.has_own_light

    @property
    def bounds(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """The lowest and the highest corner, in metres of the file's world."""
        low, high = self._scene.bounds
        return tuple(low), tuple(high)

    @property
    def cameras(self) -> list[str]:
        """Names of the file's cameras."""
        return self._scene.cameras

    @property
    def variants(self) -> list[str]:
        return self._scene.variants

    @property
    def scenes(self) -> list[str]:
        return self._scene.scenes

    @property
    def animations(self) -> dict[str, float]:
        """Seconds of the last key, by name."""
        return dict(self._scene.animations)

    @property
    def materials(self) -> Materials:
        return Materials(self._scene.materials)

    def render(self, *, progress: Callable[[float], object] | None = None, **keywords: Any) -> Image:
        """Renders an image with the bits that ``lavalight render`` gives.

        progress: called about twenty times a second with the fraction done. Ctrl-C raises KeyboardInterrupt. The GIL is free
        meanwhile, so that other threads run, and may render too.
        """
        render = _lavalight.Render(self._scene, _keywords.words(keywords, False, "render"), False)
        return Image(render.advance(0.0, progress))

    def progressive(self, *, every: float = 0.5, progress: Callable[[float], object] | None = None,
                    **keywords: Any) -> Iterator[Image]:
        """Yields the image about every so many seconds, and at last when all samples are taken.

        The last image has the bits of render().
        """
        if not every > 0.0:
            raise ValueError(f"every: {every!r} is not a time above 0")
        words = _keywords.words(keywords, False, "progressive")

        def images() -> Iterator[Image]:
            render = _lavalight.Render(self._scene, words, True)
            while True:
                image = Image(render.advance(every, progress))
                yield image
                if image.complete:
                    return

        return images()

    def __repr__(self) -> str:
        return f"<lavalight.Scene {self.name}, {self.triangles} triangles>"


def load(path: str | os.PathLike[str], /, **keywords: Any) -> Scene:
    """Loads a .gltf or .glb file, or a built-in scene by its name, with its light."""
    name = os.fspath(path)
    origin = _bundle.Origin.of_file(name, _keywords.words(keywords, True, "load"))
    return Scene._of(_lavalight.Scene(name, origin.words), origin)


def _unpickled(model: _bundle.Model, choice: _bundle.Choice) -> Scene:
    return Scene._of(_bundle.load(model, choice), _bundle.Origin(list(choice.words), model=model))


if __debug__ and Scene.render.__doc__ and load.__doc__:
    Scene.render.__doc__ += "\n" + _keywords.document("render", False)
    load.__doc__ += "\n\n" + _keywords.document("load", True)
