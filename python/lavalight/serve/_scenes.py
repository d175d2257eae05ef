"""Scenes that clients have sent and will ask for again, from another place or in other light."""

from __future__ import annotations

import secrets
import threading
import time
from collections import OrderedDict

from .. import Error, _lavalight
from .._bundle import Origin
from .._image import Image
from .._keywords import words
from .._scene import Scene, load
from ._refusal import Refusal
from ._settings import Limits


def load_model(name: str, model: bytes, options: list[str], limits: Limits) -> Scene:
    """Reads no file: what a glTF refers to has to be inside of it. Raises Refusal for one that cannot be had."""
    try:
        scene = Scene._of(_lavalight.Scene.from_bytes(name, model, options), Origin(options, model))
    except Error as error:
        raise Refusal(400, str(error)) from None
    if scene.triangles > limits.triangles:
        raise Refusal(413, f"cannot render {scene.triangles} triangles: the limit is {limits.triangles}; "
                           "try a simpler scene, or start the server with a higher --max-triangles")
    return scene


class KeptScene:
    """A file's bytes, or a built-in scene, with the light that it was last seen in."""

    def __init__(self, name: str, model: bytes | None, limits: Limits) -> None:
        self.key = secrets.token_urlsafe(12)  # nobody guesses what others have sent
        self.name = name
        self.used = time.monotonic()
        self.picture: Image | None = None  # the last one, for downloads
        self._model = model
        self._limits = limits
        self._loaded: tuple[list[str], Scene] | None = None
        self._lock = threading.Lock()

    def scene(self, keywords: dict[str, object]) -> Scene:
        """Loaded with these keywords."""
        options = words(keywords, True, "load")
        with self._lock:
            if self._loaded is None or self._loaded[0] != options:
                self._loaded = options, self._load(options, keywords)
            return self._loaded[1]

    def _load(self, options: list[str], keywords: dict[str, object]) -> Scene:
        if self._model is None:
            return load(self.name, **keywords)
        return load_model(self.name, self._model, options, self._limits)


class Scenes:
    """The scenes of all clients: at most so many, each until nobody has asked for it for a while."""

    def __init__(self, limits: Limits) -> None:
        self._limits = limits
        self._scenes: OrderedDict[str, KeptScene] = OrderedDict()

    def __len__(self) -> int:
        return len(self._scenes)

    def keep(self, scene: KeptScene) -> None:
        """Makes room by giving up the scene that was not asked for the longest."""
        self.forget_idle()
        self._scenes[scene.key] = scene
        while len(self._scenes) > self._limits.scenes:
            self._scenes.popitem(last=False)

    def find(self, key: str) -> KeptScene:
        self.forget_idle()
        scene = self._scenes.get(key)
        if scene is None:
            raise Refusal(404, "cannot find the scene: it was given up for others, or nobody asked for it for a while; try sending it again")
        scene.used = time.monotonic()
        self._scenes.move_to_end(key)
        return scene

    def forget(self, key: str) -> None:
        self._scenes.pop(key, None)

    def forget_idle(self) -> None:
        limit = time.monotonic() - self._limits.idle
        for key in [key for key, scene in self._scenes.items() if scene.used < limit]:
            del self._scenes[key]
