"""Lavalight: a physically based path tracer for glTF 2.0.

    import lavalight
    scene = lavalight.load("model.glb", env="studio")
    image = scene.render(size=(512, 512), spp=64)
    image.save("model.png")
"""

from __future__ import annotations

import atexit
import ctypes
import importlib
import json
import os
from typing import Any

from . import _lavalight
from ._build import Camera, Light, Material, Mesh
from ._bundle import pack
from ._image import Comparison, Image, Layers, merge
from ._lab import Table, experiments, lab
from ._lavalight import Error, UsageError
from ._scene import Materials, Scene, load

__all__ = ["Camera", "Comparison", "Error", "Image", "Layers", "Light", "Material", "Materials", "Mesh", "Scene", "Table",
           "UsageError", "builtin_scenes", "devices", "experiments", "lab", "load", "merge", "pack", "presets", "__version__"]

__version__ = _lavalight.__version__



def _bring_driver() -> None:
    """Uses the driver of the package lavalight-lavapipe, unless the user has named another."""
    if any(os.environ.get(name) for name in ("VK_DRIVER_FILES", "VK_ICD_FILENAMES", "LAVALIGHT_DRIVER")):
        return
    try:
        package = importlib.import_module("lavalight_lavapipe")
    except ImportError:
        return
    try:
        ctypes.CDLL("libvulkan.so.1")  # the system's loader, where it has one
    except OSError:
        ctypes.CDLL(str(package.loader()))  # found by its name from now on
    _lavalight.use_driver(str(package.driver()))


def _after_fork() -> None:
    """The driver's threads do not come along into a forked child."""
    _lavalight.forbid_renders("cannot render in a forked process: the driver's threads stayed in the parent; "
                              "try multiprocessing's method \"spawn\"")


_bring_driver()
os.register_at_fork(after_in_child=_after_fork)
atexit.register(_lavalight.close)  # before the drivers end with the process


def builtin_scenes() -> list[str]:
    """Names that load() knows without a file."""
    return _lavalight.builtin_scenes()


def presets() -> dict[str, str]:
    """What each preset sets, by its name."""
    return dict(_lavalight.presets())


def devices() -> list[dict[str, Any]]:
    """The Vulkan devices of this machine; "refusals" says why one cannot render."""
    return list(json.loads(_lavalight.devices_json()))
