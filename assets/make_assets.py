#!/usr/bin/env python3
"""Writes the scenes of this folder, the same bytes each time; run by hand, needs Python 3 alone."""
import base64
import json
import math
import struct
from pathlib import Path

FOLDER = Path(__file__).resolve().parent

# The proportions of Cornell University's box (556 by 549 by 559 mm) rounded to a room 2 m wide, high, deep:
# x to the right, y up, z towards the camera, origin in the middle of the floor.
WHITE = [0.73, 0.73, 0.73]
RED = [0.65, 0.05, 0.05]
GREEN = [0.12, 0.45, 0.15]
LIGHT_COLOR = [1.0, 0.85, 0.6]
LIGHT_STRENGTH = 25.0
LIGHT_HALF_WIDTH, LIGHT_HALF_DEPTH = 0.235, 0.19
LIGHT_HEIGHT = 1.995  # a gap to the ceiling, so that the two do not compete for the same hits
CAMERA_POSITION = [0.0, 1.0, 3.88]
CAMERA_YFOV = 0.686


def lambert(name, color, extensions=None, **more):
    """A material without any specular reflection."""
    factors = {"baseColorFactor": color + [1.0], "metallicFactor": 0.0, "roughnessFactor": 1.0}
    return {"name": name, "pbrMetallicRoughness": factors,
            "extensions": {"KHR_materials_specular": {"specularFactor": 0.0}, **(extensions or {})}, **more}


class Builder:
    """Collects quads into one buffer and hands out accessor indices."""

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

    def quads(self, material, *corners):
        """A primitive of quads; the corners of each turn counter-clockwise seen from its front:

            3---2
            | / |    triangles 0 1 2 and 0 2 3
            0---1
        """
        points = [point for quad in corners for point in quad]
        indices = [4 * i + k for i in range(len(corners)) for k in (0, 1, 2, 0, 2, 3)]
        rounded = [struct.unpack("<3f", struct.pack("<3f", *p)) for p in points]
        position = self.add(b"".join(struct.pack("<3f", *p) for p in points), 34962, componentType=5126,
                            count=len(points), type="VEC3", min=[min(c) for c in zip(*rounded)],
                            max=[max(c) for c in zip(*rounded)])
        index = self.add(struct.pack(f"<{len(indices)}H", *indices), 34963, componentType=5123,
                         count=len(indices), type="SCALAR")
        return {"attributes": {"POSITION": position}, "indices": index, "material": material}


def turn(degrees):
    """The quaternion of a turn about y."""
    half = math.radians(degrees) / 2
    return [0.0, round(math.sin(half), 7), 0.0, round(math.cos(half), 7)]


def cornell_box():
    b = Builder()
    floor = [(-1, 0, 1), (1, 0, 1), (1, 0, -1), (-1, 0, -1)]
    ceiling = [(-1, 2, -1), (1, 2, -1), (1, 2, 1), (-1, 2, 1)]
    back = [(-1, 0, -1), (1, 0, -1), (1, 2, -1), (-1, 2, -1)]
    left = [(-1, 0, 1), (-1, 0, -1), (-1, 2, -1), (-1, 2, 1)]
    right = [(1, 0, -1), (1, 0, 1), (1, 2, 1), (1, 2, -1)]
    w, h, d = LIGHT_HALF_WIDTH, LIGHT_HEIGHT, LIGHT_HALF_DEPTH
    lamp = [(-w, h, -d), (w, h, -d), (w, h, d), (-w, h, d)]
    # A unit box without its bottom, which would lie in the floor.
    box = [
        [(-.5, 1, .5), (.5, 1, .5), (.5, 1, -.5), (-.5, 1, -.5)],
        [(-.5, 0, .5), (.5, 0, .5), (.5, 1, .5), (-.5, 1, .5)],
        [(.5, 0, -.5), (-.5, 0, -.5), (-.5, 1, -.5), (.5, 1, -.5)],
        [(-.5, 0, -.5), (-.5, 0, .5), (-.5, 1, .5), (-.5, 1, -.5)],
        [(.5, 0, .5), (.5, 0, -.5), (.5, 1, -.5), (.5, 1, .5)],
    ]
    white, red, green, light = range(4)
    meshes = [
        {"name": "room", "primitives": [b.quads(white, floor, ceiling, back), b.quads(red, left),
                                        b.quads(green, right)]},
        {"name": "box", "primitives": [b.quads(white, *box)]},
        {"name": "light", "primitives": [b.quads(light, lamp)]},
    ]
    strength = {"KHR_materials_emissive_strength": {"emissiveStrength": LIGHT_STRENGTH}}
    return {
        "asset": {"version": "2.0", "generator": "assets/make_assets.py",
                  "copyright": "CC0-1.0, the Lavalight authors"},
        "extensionsUsed": ["KHR_materials_emissive_strength", "KHR_materials_specular"],
        "scene": 0,
        "scenes": [{"name": "cornell-box", "nodes": [0, 1, 2, 3, 4]}],
        "nodes": [
            {"name": "room", "mesh": 0},
            {"name": "short box", "mesh": 1, "translation": [0.33, 0.0, 0.39], "rotation": turn(-16.7),
             "scale": [0.6, 0.6, 0.6]},
            {"name": "tall box", "mesh": 1, "translation": [-0.33, 0.0, -0.26], "rotation": turn(17.2),
             "scale": [0.6, 1.2, 0.6]},
            {"name": "light", "mesh": 2},
            {"name": "camera", "camera": 0, "translation": CAMERA_POSITION},
        ],
        "cameras": [{"name": "camera", "type": "perspective",
                     "perspective": {"aspectRatio": 1.0, "yfov": CAMERA_YFOV, "znear": 0.01}}],
        "materials": [
            lambert("white", WHITE), lambert("red", RED), lambert("green", GREEN),
            lambert("light", WHITE, emissiveFactor=LIGHT_COLOR, extensions=strength),
        ],
        "meshes": meshes,
        "accessors": b.accessors,
        "bufferViews": b.views,
        "buffers": [{"byteLength": len(b.bytes), "uri": "data:application/octet-stream;base64,"
                     + base64.b64encode(bytes(b.bytes)).decode("ascii")}],
    }


def write(name, gltf):
    (FOLDER / name).write_text(json.dumps(gltf, indent=1) + "\n", encoding="utf-8")
    triangles = sum(gltf["accessors"][p["indices"]]["count"] // 3 for n in gltf["nodes"] if "mesh" in n
                    for p in gltf["meshes"][n["mesh"]]["primitives"])
    print(f"{name}: {triangles} triangles")


if __name__ == "__main__":
    write("cornell-box.gltf", cornell_box())
