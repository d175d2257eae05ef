"""Turns a glTF file into a Mitsuba 3 scene, read by the rules Lavalight reads glTF by.

A module for scripts that make reference images (tests/references/make_references.py). It reads what such
scenes need: .gltf with data-URI or external buffers, .glb, the node hierarchy, indexed and plain triangles,
flat or with vertex normals, perspective cameras, emission, and the material factors of pure Lambert surfaces,
metals, and glass (solid or thin-walled). Anything else is refused, so that a reference is exact or absent.
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
KNOWN_EXTENSIONS = {"KHR_materials_emissive_strength", "KHR_materials_ior", "KHR_materials_specular",
                    "KHR_materials_transmission", "KHR_materials_volume"}
# Lavalight's mirror threshold for alpha; Mitsuba's principled lobe is never narrower.
SMOOTH_ALPHA = 1e-3
# Distance between the two halves of a light that emits from both sides, as a share of its extent: above the
# distance that Mitsuba keeps rays off surfaces, below what a reference could show.
TWO_SIDED_GAP = 1e-3


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
    """Corner positions in world space, (count, 3, 3), fronts counter-clockwise, and the corners' unit normals
    or None."""
    if primitive.get("mode", 4) != 4:
        raise Unsupported("a primitive that is not a triangle list")
    order = [0, 2, 1] if np.linalg.det(world[:3, :3]) < 0 else [0, 1, 2]

    def corners(name, matrix):
        rows = gltf.accessor(primitive["attributes"][name]) @ matrix.T
        if "indices" in primitive:
            rows = rows[gltf.accessor(primitive["indices"]).ravel()]
        return rows.reshape(-1, 3, 3)[:, order]

    points = corners("POSITION", world[:3, :3]) + world[:3, 3]
    if "NORMAL" not in primitive["attributes"]:
        return points, None
    normals = corners("NORMAL", np.linalg.inv(world[:3, :3]).T)
    return points, normals / np.linalg.norm(normals, axis=-1, keepdims=True)


def write_ply(path, corners, normals):
    """Unshared corners; without normals Mitsuba is to shade each triangle flat."""
    count = len(corners)
    axes = ["x", "y", "z"] if normals is None else ["x", "y", "z", "nx", "ny", "nz"]
    header = (f"ply\nformat binary_little_endian 1.0\nelement vertex {3 * count}\n"
              + "".join(f"property float {axis}\n" for axis in axes)
              + f"element face {count}\nproperty list uchar int vertex_indices\nend_header\n")
    faces = np.zeros(count, np.dtype([("size", "u1"), ("corner", "<i4", 3)]))
    faces["size"] = 3
    faces["corner"] = np.arange(3 * count).reshape(-1, 3)
    vertices = corners if normals is None else np.concatenate([corners, normals], axis=2)
    path.write_bytes(header.encode() + vertices.astype("<f4").tobytes() + faces.tobytes())


def rgb(color):
    return {"type": "rgb", "value": list(color)}


def metal(name, color, alpha):
    """GGX with Schlick's Fresnel, F0 = color. Mitsuba's masking is separable where Lavalight's is
    height-correlated; for alpha up to 0.1 and angles up to 70 degrees they agree within 0.1 %."""
    if alpha >= SMOOTH_ALPHA:
        return {"type": "principled", "metallic": 1.0, "base_color": rgb(color),
                "roughness": math.sqrt(alpha)}
    if min(color) < 1:
        raise Unsupported(f"{name}: a coloured mirror (alpha below {SMOOTH_ALPHA})")
    return {"type": "conductor", "material": "none"}


def glass(name, extensions, color, alpha):
    """A solid's boundary, or a thin wall: Mitsuba's is a pane, whose two faces mirror each other's light."""
    ior = {"int_ior": extensions.get("KHR_materials_ior", {}).get("ior", 1.5), "ext_ior": 1.0,
           "specular_transmittance": rgb(color)}
    volume = extensions.get("KHR_materials_volume", {})
    if "attenuationDistance" in volume:
        raise Unsupported(f"{name}: attenuation")
    smooth = alpha < SMOOTH_ALPHA
    if volume.get("thicknessFactor", 0) > 0:
        rough = {"type": "roughdielectric", "distribution": "ggx", "alpha": alpha}
        return {**({"type": "dielectric"} if smooth else rough), **ior}
    if not smooth:
        raise Unsupported(f"{name}: a rough thin wall")
    return {"type": "thindielectric", **ior}


def scattering(material):
    """Mitsuba's bsdf. Single-sided surfaces scatter from both sides too."""
    pbr = material.get("pbrMetallicRoughness", {})
    extensions = material.get("extensions", {})
    name = material.get("name", "unnamed material")
    color = pbr.get("baseColorFactor", [1, 1, 1, 1])[:3]
    alpha = pbr.get("roughnessFactor", 1) ** 2
    metallic = pbr.get("metallicFactor", 1)
    transmission = extensions.get("KHR_materials_transmission", {}).get("transmissionFactor", 0)
    specular = extensions.get("KHR_materials_specular", {})
    if metallic == 1:
        return {"type": "twosided", "bsdf": metal(name, color, alpha)}
    if metallic == 0 and transmission == 1 and not specular:
        return glass(name, extensions, color, alpha)
    if metallic == 0 and transmission == 0 and specular.get("specularFactor", 1) == 0:
        return {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": rgb(color)}}
    raise Unsupported(f"{name}: neither a Lambert surface (metallicFactor 0, specularFactor 0), nor a metal, "
                      "nor clear glass")


def emission(material):
    """Radiance per channel, towards the front."""
    extensions = material.get("extensions", {})
    strength = extensions.get("KHR_materials_emissive_strength", {}).get("emissiveStrength", 1.0)
    return [strength * e for e in material.get("emissiveFactor", [0, 0, 0])]


def refuse_maps(material):
    pbr = material.get("pbrMetallicRoughness", {})
    textured = any("Texture" in key for key in [*material, *pbr, *sum(map(list, material.get(
        "extensions", {}).values()), [])])
    if textured or material.get("alphaMode", "OPAQUE") != "OPAQUE":
        raise Unsupported(f"{material.get('name', 'unnamed material')}: textures or alpha")


def cross_edges(corners):
    """Along each triangle's normal, twice its area long."""
    return np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])


def both_sides(corners):
    """Two flat shells back to back, each a little off the plane of its triangles towards its own front."""
    normals = cross_edges(corners)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    step = 0.5 * TWO_SIDED_GAP * np.ptp(corners.reshape(-1, 3), axis=0).max() * normals[:, None]
    return np.concatenate([corners + step, corners[:, [0, 2, 1]] - step])


def shape(material, corners, normals, file):
    """Mitsuba's shape; the mesh goes into `file`. A light's weight in Mitsuba's picking is its power."""
    refuse_maps(material)
    radiance = emission(material)
    parts = {}
    if any(radiance):
        if material.get("doubleSided", False):
            corners, normals = both_sides(corners), None
        area = 0.5 * np.linalg.norm(cross_edges(corners), axis=1).sum()
        parts["emitter"] = {"type": "area", "radiance": rgb(radiance),
                            "sampling_weight": float(area * math.pi * sum(radiance) / 3)}
    write_ply(file, corners, normals)
    return {"type": "ply", "filename": str(file), "face_normals": normals is None,
            "bsdf": scattering(material), **parts}


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


def load(mi, path, size, folder, environment=None):
    """The scene of a glTF file as a dictionary for `mi.load_dict`, without an integrator; `size` is (width,
    height), `folder` receives the meshes and must outlive the load. The first camera is the sensor;
    `environment` is the constant radiance, three channels, from every direction that hits nothing."""
    gltf = Gltf(path)
    scene = {"type": "scene"}
    if environment:
        scene["environment"] = {"type": "constant", "radiance": rgb(environment)}
    for node, world in gltf.placed_nodes():
        if "camera" in node and "sensor" not in scene:
            scene["sensor"] = sensor(mi, gltf.json["cameras"][node["camera"]], world, size)
        if "mesh" not in node:
            continue
        for primitive in gltf.json["meshes"][node["mesh"]]["primitives"]:
            name = f"shape{len(scene)}"
            file = Path(folder) / f"{name}.ply"
            corners, normals = triangles(gltf, primitive, world)
            scene[name] = shape(gltf.json["materials"][primitive["material"]], corners, normals, file)
    if "sensor" not in scene:
        raise Unsupported(f"{path}: no camera")
    return scene
