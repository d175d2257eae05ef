"""Scenes on their way to other processes: bytes that hold all that a scene's files hold."""

from __future__ import annotations

import hashlib
import os
import struct
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from . import _lavalight

ENV = "--env="


@dataclass(frozen=True)
class Model:
    """What is heavy of a scene: its file and its environment map. Frames of one animation share a model."""

    name: str
    data: bytes | None = None  # of a .glb file; None: the scene is built in
    environment: tuple[str, bytes] | None = None  # ending and bytes of the map's file
    key: str = field(default="", compare=False)  # hash of all this

    @classmethod
    def of(cls, name: str, data: bytes | None, environment: tuple[str, bytes] | None) -> Model:
        content = hashlib.sha256()
        for part in (os.fsencode(name), data, *(("", b"") if environment is None else environment)):
            part = part.encode() if isinstance(part, str) else part
            content.update(b"-" if part is None else struct.pack("<Q", len(part)) + part)
        return cls(name, data, environment, content.hexdigest()[:32])


@dataclass(frozen=True)
class Choice:
    """What is light of a scene: the options that it is loaded with, and the materials that were changed since."""

    words: tuple[str, ...]
    environment: str = ""  # what headers call the map
    changes: tuple[tuple[int, str, Any], ...] = ()


@dataclass
class Origin:
    """Where a scene came from."""

    words: list[str]
    data: bytes | None = None  # of a scene from arrays
    path: Path | None = None  # of a file; None: the scene is built in
    stamp: tuple[int, int] = (0, 0)  # of the file as it was loaded
    model: Model | None = None  # of a scene that came from another process

    @classmethod
    def of_file(cls, name: str, words: list[str]) -> Origin:
        if name in _lavalight.builtin_scenes():
            return cls(words)
        path = Path(name)
        return cls(words, path=path, stamp=_stamp(path))


def _stamp(path: Path) -> tuple[int, int]:
    try:
        found = path.stat()
    except OSError:
        return (0, 0)
    return found.st_mtime_ns, found.st_size


def pack(path: str | os.PathLike[str], *, allow_external: bool = False) -> bytes:
    """The bytes of a .glb file with all that a .gltf or .glb file refers to, as ``lavalight pack`` writes it.

    allow_external: it may refer to files outside its folder. Raises Error for a file that is no scene.
    """
    return _lavalight.pack(os.fspath(path), allow_external)


def model_of(scene: _lavalight.Scene, origin: Origin) -> Model:
    """The scene's model. Raises Error where its files are not what they were."""
    if origin.model is not None:
        return origin.model
    data = origin.data
    if origin.path is not None:
        if _stamp(origin.path) != origin.stamp:
            raise _lavalight.Error(f"cannot send {scene.name}: the file has changed since it was loaded; try to load it again")
        data = pack(origin.path, allow_external="--allow-external" in origin.words)
    environment = None
    if scene.environment:
        path = Path(scene.environment)
        environment = (path.suffix.lower(), path.read_bytes())
    return Model.of(scene.name, data, environment)


def choice_of(scene: _lavalight.Scene, origin: Origin) -> Choice:
    """The scene's choice, with its materials as they are now."""
    materials = scene.materials
    changes = tuple((index, name, _plain(getattr(materials[index], name))) for index, name in scene.changes)
    return Choice(tuple(origin.words), scene.environment, changes)


def _plain(value: Any) -> Any:
    return tuple(value) if isinstance(value, Sequence) else value


def load(model: Model, choice: Choice) -> _lavalight.Scene:
    """The scene that a model and a choice are of."""
    words = [word for word in choice.words if not word.startswith(ENV)]
    own = [word for word in choice.words if word.startswith(ENV)]
    with tempfile.TemporaryDirectory(prefix="lavalight-") as folder:
        if model.environment is not None:
            ending, data = model.environment
            file = Path(folder, "map" + ending)
            file.write_bytes(data)
            own = [ENV + str(file)]
        scene = (_lavalight.Scene(model.name, words + own) if model.data is None
                 else _lavalight.Scene.from_bytes(model.name, model.data, words + own))
    if model.environment is not None:
        scene.name_environment(choice.environment)
    materials = scene.materials
    for index, name, value in choice.changes:
        setattr(materials[index], name, value)
    return scene
