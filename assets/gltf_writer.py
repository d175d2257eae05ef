"""Writes glTF: meshes into one embedded buffer, materials, cameras, and the document around them."""
import base64
import json
import math
import struct

WHITE = [0.73, 0.73, 0.73]


def lambert(name, color, extensions=None, **more):
    """A material without any specular reflection."""
    factors = {"baseColorFactor": color + [1.0], "metallicFactor": 0.0, "roughnessFactor": 1.0}
    return {"name": name, "pbrMetallicRoughness": factors,
            "extensions": {"KHR_materials_specular": {"specularFactor": 0.0}, **(extensions or {})}, **more}


def light(name, color, strength, reflectance=None):
    """A Lambert surface, black if not told otherwise; its front emits strength * color, W/(sr m^2)."""
    extensions = {"KHR_materials_emissive_strength": {"emissiveStrength": strength}}
    return lambert(name, reflectance or [0.0, 0.0, 0.0], extensions, emissiveFactor=color)


def metal(name, color, alpha):
    """alpha is the GGX parameter, the square of glTF's roughness."""
    factors = {"baseColorFactor": color + [1.0], "metallicFactor": 1.0,
               "roughnessFactor": round(math.sqrt(alpha), 7)}
    return {"name": name, "pbrMetallicRoughness": factors}


def glass(name, thickness, ior=1.5, **volume):
    """Smooth; a thickness (of the mesh, before the node's scale) above 0 marks a solid body. volume: what it absorbs."""
    factors = {"baseColorFactor": [1.0] * 4, "metallicFactor": 0.0, "roughnessFactor": 0.0}
    return {"name": name, "pbrMetallicRoughness": factors,
            "extensions": {"KHR_materials_ior": {"ior": ior},
                           "KHR_materials_transmission": {"transmissionFactor": 1.0},
                           "KHR_materials_volume": {"thicknessFactor": thickness, **volume}}}


class Builder:
    """Collects meshes into one buffer and hands out accessor indices."""

    def __init__(self):
        self.bytes = bytearray()
        self.views = []
        self.accessors = []

    def add(self, data, target, **accessor):
        self.views.append({"buffer": 0, "byteOffset": len(self.bytes), "byteLength": len(data),
                           "target": target})
        self.accessors.append({"bufferView": len(self.views) - 1, **accessor})
        self.bytes += data + bytes(-len(data) % 4)
        return len(self.accessors) - 1

    def triangles(self, material, points, corners, normals=None):
        """A primitive of shared vertices; three corners a triangle, counter-clockwise seen from its front.
        Without normals it is flat shaded."""
        assert len(points) <= 65535
        rounded = [struct.unpack("<3f", struct.pack("<3f", *p)) for p in points]
        attributes = {"POSITION": self.add(
            b"".join(struct.pack("<3f", *p) for p in points), 34962, componentType=5126, count=len(points),
            type="VEC3", min=[min(c) for c in zip(*rounded)], max=[max(c) for c in zip(*rounded)])}
        if normals:
            attributes["NORMAL"] = self.add(b"".join(struct.pack("<3f", *n) for n in normals), 34962,
                                            componentType=5126, count=len(normals), type="VEC3")
        index = self.add(struct.pack(f"<{len(corners)}H", *corners), 34963, componentType=5123,
                         count=len(corners), type="SCALAR")
        return {"attributes": attributes, "indices": index, "material": material}

    def quads(self, material, *corners):
        """A primitive of quads; the corners of each turn counter-clockwise seen from its front:

            3---2
            | / |    triangles 0 1 2 and 0 2 3
            0---1
        """
        points = [point for quad in corners for point in quad]
        indices = [4 * i + k for i in range(len(corners)) for k in (0, 1, 2, 0, 2, 3)]
        return self.triangles(material, points, indices)


def turn(degrees, axis=1):
    """The quaternion of a turn about x, y or z (axis 0, 1, 2)."""
    half = math.radians(degrees) / 2
    quaternion = [0.0, 0.0, 0.0, round(math.cos(half), 7)]
    quaternion[axis] = round(math.sin(half), 7)
    return quaternion


def perspective(yfov, aspect=1.0):
    """yfov: the full vertical angle in radians."""
    return {"name": "camera", "type": "perspective",
            "perspective": {"aspectRatio": aspect, "yfov": yfov, "znear": 0.01}}


def node(name, mesh, **placement):
    return {"name": name, "mesh": mesh, **placement}


def camera_node(position, pitch=0.0):
    """Looks along -z, turned upwards by `pitch` degrees."""
    placed = {"name": "camera", "camera": 0, "translation": position}
    return {**placed, "rotation": turn(pitch, 0)} if pitch else placed


def document(name, builder, nodes, camera, materials, meshes):
    """The file's content; `meshes` are pairs of a name and primitives."""
    extensions = {e for m in materials for e in m.get("extensions", {})}
    return {
        "asset": {"version": "2.0", "generator": "assets/make_assets.py",
                  "copyright": "CC0-1.0, the Lavalight authors"},
        "extensionsUsed": sorted(extensions),
        "scene": 0,
        "scenes": [{"name": name, "nodes": list(range(len(nodes)))}],
        "nodes": nodes,
        "cameras": [camera],
        "materials": materials,
        "meshes": [{"name": mesh, "primitives": primitives} for mesh, primitives in meshes],
        "accessors": builder.accessors,
        "bufferViews": builder.views,
        "buffers": [{"byteLength": len(builder.bytes), "uri": "data:application/octet-stream;base64,"
                     + base64.b64encode(bytes(builder.bytes)).decode("ascii")}],
    }


def write(folder, gltf):
    """Writes NAME.gltf after the scene's name; 1 MB is the most a built-in scene may take."""
    name = gltf["scenes"][0]["name"] + ".gltf"
    text = json.dumps(gltf, indent=1) + "\n"
    assert len(text) < 1_000_000, name
    (folder / name).write_text(text, encoding="utf-8")
    triangles = sum(gltf["accessors"][p["indices"]]["count"] // 3 for n in gltf["nodes"] if "mesh" in n
                    for p in gltf["meshes"][n["mesh"]]["primitives"])
    print(f"{name}: {triangles} triangles, {len(text)} bytes")
