"""Scenes from arrays, as glTF in memory: whatever a file may hold is checked as a file is."""

from __future__ import annotations

import json
import math
import os
import struct
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

Vector = Sequence[float]


@dataclass
class Mesh:
    """Triangles. positions: (n, 3) metres; triangles: (m, 3) indices, counter-clockwise as seen from the front.

    normals: (n, 3), smooth shading; uvs: (n, 2); colors: (n, 3) or (n, 4), linear, multiply the base colour. material: index into
    the scene's materials, or none. transform: 4x4, to the world.
    """

    positions: npt.ArrayLike
    triangles: npt.ArrayLike | None = None
    normals: npt.ArrayLike | None = None
    uvs: npt.ArrayLike | None = None
    colors: npt.ArrayLike | None = None
    material: int | None = None
    transform: npt.ArrayLike | None = None
    name: str = ""


@dataclass
class Material:
    """Factors of glTF's metallic-roughness model; emission is radiance in W/(sr m^2) per channel.

    texture: path of a PNG, JPEG, WebP or KTX2 file for the base colour, or its bytes. extensions: glTF's extensions of materials as
    they stand in a file, for example {"KHR_materials_clearcoat": {"clearcoatFactor": 1.0}}.
    """

    base_color: Vector = (1.0, 1.0, 1.0)
    metallic: float = 0.0
    roughness: float = 0.5
    emission: Vector = (0.0, 0.0, 0.0)
    alpha: float = 1.0
    double_sided: bool = False
    transmission: float = 0.0
    ior: float = 1.5
    texture: str | os.PathLike[str] | bytes | None = None
    name: str = ""
    extensions: dict[str, Any] = field(default_factory=dict)


@dataclass
class Camera:
    """A perspective camera. fov: the height, in degrees."""

    look_from: Vector = (0.0, 0.0, 5.0)
    look_at: Vector = (0.0, 0.0, 0.0)
    up: Vector = (0.0, 1.0, 0.0)
    fov: float = 45.0


@dataclass
class Light:
    """A light without size. kind: "point" or "spot" (candela), "directional" (lux); color: linear."""

    kind: str = "point"
    position: Vector = (0.0, 0.0, 0.0)
    direction: Vector = (0.0, -1.0, 0.0)
    color: Vector = (1.0, 1.0, 1.0)
    intensity: float = 1.0
    cone: float = 45.0  # of a spot: from its axis to its edge, degrees


class _Writer:
    """A .glb under construction."""

    def __init__(self) -> None:
        self.json: dict[str, Any] = {"asset": {"version": "2.0", "generator": "lavalight"}, "scene": 0,
                                     "scenes": [{"nodes": []}], "nodes": []}
        self.binary = bytearray()

    def add(self, section: str, value: dict[str, Any]) -> int:
        values: list[Any] = self.json.setdefault(section, [])
        values.append(value)
        return len(values) - 1

    def view(self, data: bytes) -> int:
        self.binary += b"\0" * (-len(self.binary) % 4)
        start = len(self.binary)
        self.binary += data
        return self.add("bufferViews", {"buffer": 0, "byteOffset": start, "byteLength": len(data)})

    def accessor(self, what: str, values: npt.ArrayLike, columns: tuple[int, ...], dtype: type[np.generic], component: int) -> int:
        array = np.ascontiguousarray(values, dtype=dtype)
        if array.ndim != 2 or array.shape[1] not in columns:
            shapes = " or ".join(f"(n, {c})" for c in columns)
            raise ValueError(f"{what}: has the shape {array.shape}, and {shapes} is wanted")
        kind = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}[array.shape[1]]
        return self.add("accessors", {"bufferView": self.view(array.tobytes()), "componentType": component, "count": len(array),
                                      "type": kind})

    def node(self, value: dict[str, Any]) -> None:
        self.json["scenes"][0]["nodes"].append(self.add("nodes", value))

    def use(self, extension: str) -> None:
        used: list[str] = self.json.setdefault("extensionsUsed", [])
        if extension not in used:
            used.append(extension)

    def bytes(self) -> bytes:
        if "bufferViews" in self.json:
            self.binary += b"\0" * (4 if not self.binary else 0)
            self.json["buffers"] = [{"byteLength": len(self.binary)}]
        text = json.dumps(self.json, separators=(",", ":"), allow_nan=False).encode()
        text += b" " * (-len(text) % 4)
        binary = bytes(self.binary) + b"\0" * (-len(self.binary) % 4)
        chunks = struct.pack("<I", len(text)) + b"JSON" + text
        if binary:
            chunks += struct.pack("<I", len(binary)) + b"BIN\0" + binary
        return b"glTF" + struct.pack("<II", 2, 12 + len(chunks)) + chunks


def _number(what: str, value: object) -> float:
    number = float(value)  # type: ignore[arg-type]  # whatever NumPy has for a number
    if not math.isfinite(number):
        raise ValueError(f"{what}: {number} is not finite")
    return number


def _numbers(what: str, values: Vector) -> list[float]:
    return [_number(what, value) for value in values]


def _matrix(what: str, values: npt.ArrayLike) -> list[float]:
    """A 4x4 matrix by columns."""
    matrix = np.asarray(values, dtype=float)
    if matrix.shape != (4, 4):
        raise ValueError(f"{what}: has the shape {matrix.shape}, and (4, 4) is wanted")
    return _numbers(what, [float(value) for value in matrix.T.ravel()])


def _unit(vector: npt.NDArray[np.float64], what: str) -> npt.NDArray[np.float64]:
    length = float(np.linalg.norm(vector))
    if not length > 0.0 or not math.isfinite(length):
        raise ValueError(f"{what}: {vector.tolist()} is not a direction; try one with a length")
    return vector / length


def _facing(position: Vector, forward: npt.NDArray[np.float64], up: Vector) -> list[float]:
    """The matrix of a node that looks along `forward` with its -z, by columns."""
    back = -_unit(forward, "look_at or direction")
    side = np.cross(np.asarray(up, dtype=float), back)
    if np.linalg.norm(side) < 1e-9:  # it looks along its up
        side = np.cross([1.0, 0.0, 0.0] if abs(back[0]) < 0.9 else [0.0, 0.0, 1.0], back)
    right = _unit(side, "up")
    matrix = np.eye(4)
    matrix[:3, 0], matrix[:3, 1], matrix[:3, 2], matrix[:3, 3] = right, np.cross(back, right), back, position
    return _matrix("look_from or position", matrix)


def _add_mesh(writer: _Writer, mesh: Mesh, index: int, materials: int) -> None:
    what = f"mesh {index}"
    count = len(np.asarray(mesh.positions))
    attributes = {"POSITION": writer.accessor(f"{what}, positions", mesh.positions, (3,), np.float32, 5126)}
    for attribute, values, name, columns in (("NORMAL", mesh.normals, "normals", (3,)), ("TEXCOORD_0", mesh.uvs, "uvs", (2,)),
                                             ("COLOR_0", mesh.colors, "colors", (3, 4))):
        if values is None:
            continue
        if len(np.asarray(values)) != count:
            raise ValueError(f"{what}, {name}: {len(np.asarray(values))} for {count} positions")
        attributes[attribute] = writer.accessor(f"{what}, {name}", values, columns, np.float32, 5126)
    primitive: dict[str, Any] = {"attributes": attributes}
    if mesh.triangles is not None:
        triangles = np.asarray(mesh.triangles)
        if triangles.size and not np.issubdtype(triangles.dtype, np.integer):
            raise ValueError(f"{what}, triangles: indices are whole numbers, and these are {triangles.dtype}")
        if triangles.ndim != 2 or triangles.shape[1] != 3:
            raise ValueError(f"{what}, triangles: has the shape {triangles.shape}, and (m, 3) is wanted")
        if triangles.size and (triangles.min() < 0 or triangles.max() >= count):
            raise ValueError(f"{what}, triangles: an index is not one of {count} positions")
        primitive["indices"] = writer.accessor(what, triangles.reshape(-1, 1), (1,), np.uint32, 5125)
    if mesh.material is not None:
        if not 0 <= mesh.material < materials:
            raise ValueError(f"{what}: has material {mesh.material}, and the scene has {materials}")
        primitive["material"] = int(mesh.material)
    node: dict[str, Any] = {"mesh": writer.add("meshes", {"name": mesh.name, "primitives": [primitive]}), "name": mesh.name}
    if mesh.transform is not None:
        node["matrix"] = _matrix(f"{what}, transform", mesh.transform)
    writer.node(node)


def _add_material(writer: _Writer, material: Material, index: int) -> None:
    what = f"material {index}, "
    alpha = _number(what + "alpha", material.alpha)
    emission = _numbers(what + "emission", material.emission)
    rough: dict[str, Any] = {"baseColorFactor": [*_numbers(what + "base_color", material.base_color), alpha],
                             "metallicFactor": _number(what + "metallic", material.metallic),
                             "roughnessFactor": _number(what + "roughness", material.roughness)}
    if material.texture is not None:
        data = material.texture
        if not isinstance(data, bytes):
            with open(data, "rb") as file:
                data = file.read()
        image = writer.add("images", {"bufferView": writer.view(data)})
        rough["baseColorTexture"] = {"index": writer.add("textures", {"source": image})}
    extensions = dict(material.extensions)
    if material.transmission:
        extensions.setdefault("KHR_materials_transmission",
                              {"transmissionFactor": _number(what + "transmission", material.transmission)})
    if material.ior != 1.5:
        extensions.setdefault("KHR_materials_ior", {"ior": _number(what + "ior", material.ior)})
    strength = max([1.0, *emission])  # glTF's factor ends at 1
    if strength > 1.0:
        extensions["KHR_materials_emissive_strength"] = {"emissiveStrength": strength}
    for extension in extensions:
        writer.use(extension)
    writer.add("materials", {"name": material.name, "pbrMetallicRoughness": rough, "doubleSided": bool(material.double_sided),
                             "emissiveFactor": [value / strength for value in emission],
                             "alphaMode": "OPAQUE" if alpha == 1.0 else "BLEND", "extensions": extensions})


def _add_light(writer: _Writer, light: Light) -> None:
    extension = "KHR_lights_punctual"
    writer.use(extension)
    value: dict[str, Any] = {"type": light.kind, "color": _numbers("a light's color", light.color),
                             "intensity": _number("a light's intensity", light.intensity)}
    if light.kind == "spot":
        value["spot"] = {"outerConeAngle": math.radians(light.cone)}
    elif light.kind not in ("point", "directional"):
        raise ValueError(f"a light's kind is {light.kind!r}, and point, spot and directional are known")
    lights: list[Any] = writer.json.setdefault("extensions", {}).setdefault(extension, {"lights": []})["lights"]
    lights.append(value)
    writer.node({"matrix": _facing(light.position, np.asarray(light.direction, dtype=float), (0.0, 1.0, 0.0)),
                 "extensions": {extension: {"light": len(lights) - 1}}})


def build_glb(meshes: Sequence[Mesh], materials: Sequence[Material], camera: Camera | None, lights: Sequence[Light]) -> bytes:
    """The bytes of a .glb file. Raises ValueError for arrays of another shape and indices of what is not there."""
    writer = _Writer()
    for index, material in enumerate(materials):
        _add_material(writer, material, index)
    for index, mesh in enumerate(meshes):
        _add_mesh(writer, mesh, index, len(materials))
    if camera is not None:
        writer.add("cameras", {"type": "perspective", "perspective": {"yfov": math.radians(camera.fov), "znear": 1e-6}})
        forward = np.asarray(camera.look_at, dtype=float) - np.asarray(camera.look_from, dtype=float)
        writer.node({"camera": 0, "matrix": _facing(camera.look_from, forward, camera.up)})
    for light in lights:
        _add_light(writer, light)
    return writer.bytes()
