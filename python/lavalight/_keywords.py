"""Keywords as options: every option of ``lavalight render`` that decides a picture is a keyword of the same name."""

from __future__ import annotations

import difflib
import functools
import numbers
import os
from collections.abc import Iterable, Mapping

import numpy as np

from . import _lavalight

# What a scene is loaded with; everything else belongs to a render.
SCENE_OPTIONS = frozenset({"at", "animation", "scene", "variant", "allow-external", "env", "env-rotation", "env-intensity",
                           "sun-elevation", "sun-azimuth", "turbidity"})
RENAMED = {"layers": "aov"}


@functools.cache
def options() -> dict[str, tuple[bool, str, str]]:
    """Name (without dashes) -> whether it is a flag, what it takes, help."""
    return {name: (is_flag, value, text) for name, is_flag, value, text in _lavalight.picture_options()}


def names(of_scene: bool) -> list[str]:
    """Keywords of load() or of render()."""
    chosen = [name for name in options() if (name in SCENE_OPTIONS) == of_scene]
    keywords = [next((key for key, option in RENAMED.items() if option == name), name) for name in chosen]
    return [keyword.replace("-", "_") for keyword in keywords]


def _number(value: object) -> str:
    if isinstance(value, numbers.Integral):
        return str(int(value))
    return repr(float(value)) if isinstance(value, numbers.Real) else str(value)


def _plain(value: object) -> object:
    """Numbers and truths of NumPy as Python's."""
    return value.item() if isinstance(value, np.generic) or (isinstance(value, np.ndarray) and value.ndim == 0) else value


def _text(name: str, value: object) -> str:
    if isinstance(value, bool):
        return "on" if value else "off"
    if isinstance(value, (str, os.PathLike)):
        return os.fspath(value)
    if isinstance(value, Iterable):
        parts = list(value)
        if name == "size":
            return "x".join(_number(part) for part in parts)
        if name == "samples":
            return ":".join(_number(part) for part in parts)
        if name == "crop" and len(parts) == 4:
            return f"{parts[0]},{parts[1]},{parts[2]}x{parts[3]}"
        return ",".join(part if isinstance(part, str) else _number(part) for part in parts)
    return _number(value)


def words(keywords: Mapping[str, object], of_scene: bool, function: str) -> list[str]:
    """What a shell would pass. Raises TypeError for a keyword that `function` does not have."""
    known = options()
    result: list[str] = []
    for keyword, given in keywords.items():
        value = _plain(given)
        name = RENAMED.get(keyword, keyword.replace("_", "-"))
        if name not in known or (name in SCENE_OPTIONS) != of_scene or keyword in RENAMED.values():
            raise TypeError(_unknown(keyword, name, of_scene, function))
        if value is None or (name == "aov" and not value):
            continue
        is_flag = known[name][0]
        if name == "denoise" and isinstance(value, bool):
            is_flag = True
        if is_flag:
            if not isinstance(value, bool):
                raise TypeError(f"{function}() keyword {keyword!r} is True or False, not {value!r}")
            result += [f"--{name}"] if value else []
        else:
            result.append(f"--{name}={_text(name, value)}")
    return result


def _unknown(keyword: str, name: str, of_scene: bool, function: str) -> str:
    message = f"{function}() got an unexpected keyword argument {keyword!r}"
    if name in options() and keyword not in RENAMED.values():
        return f"{message}: give it to {'render' if of_scene else 'load'}()"
    close = difflib.get_close_matches(keyword, names(of_scene), n=1)
    return f"{message}. Did you mean {close[0]!r}?" if close else message


def document(function: str, of_scene: bool) -> str:
    """The list of keywords for a docstring."""
    lines = []
    for keyword in names(of_scene):
        name = RENAMED.get(keyword, keyword.replace("_", "-"))
        is_flag, value, text = options()[name]
        lines.append(f"    {keyword}: {'bool' if is_flag else value or 'value'}\n        {text}")
    return f"Keywords of {function}():\n\n" + "\n".join(lines)
