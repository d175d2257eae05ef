"""Turns a Lambert-only glTF file into a Mitsuba 3 scene, read by the rules Lavalight reads glTF by.

A module for scripts that make reference images (tests/references/make_references.py). It reads what such
scenes need: .gltf with data-URI or external buffers, .glb, the node hierarchy, indexed and plain triangles,
the material factors of a pure Lambert surface, emission, perspective cameras. Anything else is refused.
"""
import base64
import json
import math
import struct
from pathlib import Path

import numpy as np

COMPONENTS = {5120: np.int8, 5121: np.uint8, 5122: np.int16, 5123: np.uint16, 5125: np.uint32,
              5126: np.float32}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
KNOWN_EXTENSIONS = {"KHR_materials_emissive_strength", "KHR_materials_specular"}


class Unsupported(Exception):
    """The file holds something this converter cannot express."""


class Gltf:
    """A glTF document and its buffers."""

    def __init__(self, path):
        data = Path(path).read_bytes()
        binary = None
        if data[:4] == b"glTF":
            length = struct.unpack_from("<I", data, 12)[0]
            binary = data[20 + length + 8:]
            data = data[20:20 + length]
        self.json = json.loads(data)
        unknown = set(self.json.get("extensionsUsed", [])) - KNOWN_EXTENSIONS
        if unknown:
            raise Unsupported(f"{path}: extensions {sorted(unknown)}")
        self.buffers = [self._buffer(b, Path(path).parent, binary) for b in self.json["buffers"]]

    @staticmethod
    def _buffer(buffer, folder, binary):
        uri = buffer.get("uri")
        if uri is None:
            return binary
        if uri.startswith("data:"):
            return base64.b64decode(uri.split(",", 1)[1])
        return (folder / uri).read_bytes()

    def accessor(self, index):
        """The accessor's elements, one row each."""
        a = self.json["accessors"][index]
        if "sparse" in a or "bufferView" not in a or a["type"] not in WIDTHS:
            raise Unsupported(f"accessor {index}")
        view = self.json["bufferViews"][a["bufferView"]]
        dtype = np.dtype(COMPONENTS[a["componentType"]]).newbyteorder("<")
        width = WIDTHS[a["type"]]
        start = view.get("byteOffset", 0) + a.get("byteOffset", 0)
        stride = view.get("byteStride", width * dtype.itemsize)
        buffer = self.buffers[view["buffer"]]
        return np.ndarray((a["count"], width), dtype, buffer, start, (stride, dtype.itemsize))

    def placed_nodes(self):
        """Every node of the default scene with its matrix to world space."""
        todo = [(i, np.eye(4)) for i in self.json["scenes"][self.json.get("scene", 0)]["nodes"]]
        while todo:
            index, parent = todo.pop()
            node = self.json["nodes"][index]
            world = parent @ local_matrix(node)
            yield node, world
            todo += [(child, world) for child in node.get("children", [])]


def local_matrix(node):
    if "matrix" in node:
        return np.array(node["matrix"], float).reshape(4, 4).T
    x, y, z, w = node.get("rotation", (0, 0, 0, 1))
    matrix = np.eye(4)
    matrix[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                      [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                      [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    matrix[:3, :3] *= np.array(node.get("scale", (1, 1, 1)))
    matrix[:3, 3] = node.get("translation", (0, 0, 0))
    return matrix


def triangles(gltf, primitive, world):
    """Corner positions in world space, (count, 3, 3), fronts counter-clockwise."""
    if primitive.get("mode", 4) != 4:
        raise Unsupported("a primitive that is not a triangle list")
    points = gltf.accessor(primitive["attributes"]["POSITION"]) @ world[:3, :3].T + world[:3, 3]
    if "indices" in primitive:
        points = points[gltf.accessor(primitive["indices"]).ravel()]
    corners = points.reshape(-1, 3, 3)
    return corners[:, [0, 2, 1]] if np.linalg.det(world[:3, :3]) < 0 else corners


def write_ply(path, corners):
    """Unshared corners, so that Mitsuba shades each triangle flat."""
    count = len(corners)
    header = (f"ply\nformat binary_little_endian 1.0\nelement vertex {3 * count}\nproperty float x\n"
              f"property float y\nproperty float z\n"
              f"element face {count}\nproperty list uchar int vertex_indices\nend_header\n")
    faces = np.zeros(count, np.dtype([("size", "u1"), ("corner", "<i4", 3)]))
    faces["size"] = 3
    faces["corner"] = np.arange(3 * count).reshape(-1, 3)
    path.write_bytes(header.encode() + corners.astype("<f4").tobytes() + faces.tobytes())


def surface(material):
    """Mitsuba's bsdf and emitter for a material. Single-sided surfaces scatter from both sides too."""
    pbr = material.get("pbrMetallicRoughness", {})
    extensions = material.get("extensions", {})
    name = material.get("name", "unnamed material")
    specular = extensions.get("KHR_materials_specular", {}).get("specularFactor", 1)
    if pbr.get("metallicFactor", 1) != 0 or specular != 0:
        raise Unsupported(f"{name}: not a Lambert surface (metallicFactor 0, specularFactor 0)")
    textured = "baseColorTexture" in pbr or "emissiveTexture" in material
    if textured or material.get("alphaMode", "OPAQUE") != "OPAQUE":
        raise Unsupported(f"{name}: textures or alpha")
    color = pbr.get("baseColorFactor", [1, 1, 1, 1])[:3]
    parts = {"bsdf": {"type": "twosided", "bsdf": {"type": "diffuse",
                                                   "reflectance": {"type": "rgb", "value": color}}}}
    strength = extensions.get("KHR_materials_emissive_strength", {}).get("emissiveStrength", 1.0)
    emission = [strength * e for e in material.get("emissiveFactor", [0, 0, 0])]
    if any(emission):
        if material.get("doubleSided", False):
            raise Unsupported(f"{name}: emission from both sides")
        parts["emitter"] = {"type": "area", "radiance": {"type": "rgb", "value": emission}}
    return parts


def sensor(mi, camera, world, size):
    """The file's vertical field of view, whatever the image's shape; box filter: pixels are independent."""
    if camera["type"] != "perspective":
        raise Unsupported("a camera that is not perspective")
    origin = world[:3, 3]
    return {
        "type": "perspective", "fov_axis": "y", "fov": math.degrees(camera["perspective"]["yfov"]),
        "near_clip": 1e-3, "far_clip": 1e4,
        "to_world": mi.ScalarTransform4f().look_at(origin.tolist(), (origin - world[:3, 2]).tolist(),
                                                   world[:3, 1].tolist()),
        "film": {"type": "hdrfilm", "width": size[0], "height": size[1], "pixel_format": "rgb",
                 "component_format": "float32", "rfilter": {"type": "box"}},
        "sampler": {"type": "independent"},
    }


def load(mi, path, size, folder):
    """The scene of a glTF file as a dictionary for `mi.load_dict`, without an integrator; `size` is (width,
    height), `folder` receives the meshes and must outlive the load. The first camera is the sensor."""
    gltf = Gltf(path)
    scene = {"type": "scene"}
    for node, world in gltf.placed_nodes():
        if "camera" in node and "sensor" not in scene:
            scene["sensor"] = sensor(mi, gltf.json["cameras"][node["camera"]], world, size)
        if "mesh" not in node:
            continue
        for primitive in gltf.json["meshes"][node["mesh"]]["primitives"]:
            name = f"shape{len(scene)}"
            file = Path(folder) / f"{name}.ply"
            write_ply(file, triangles(gltf, primitive, world))
            scene[name] = {"type": "ply", "filename": str(file), "face_normals": True,
                           **surface(gltf.json["materials"][primitive["material"]])}
    if "sensor" not in scene:
        raise Unsupported(f"{path}: no camera")
    return scene
