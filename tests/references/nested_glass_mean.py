#!/usr/bin/env python3
"""The mean of nested-glass by Mitsuba 3, which wants each interface as a surface of its own; run by hand.

Lavalight is given bodies that overlap and finds the interfaces itself. Here they are made by construction: glass against air,
liquid against glass, liquid against air, and the ring where the liquid's level meets the glass. Flat shaded.

    pip install mitsuba numpy; tests/references/nested_glass_mean.py [RENDERS]

Prints mean and standard error of 48 x 48 pixels; tests/image/nested_glass_test.cpp holds them.
"""
import math
import sys
from pathlib import Path

import mitsuba as mi
import numpy as np

mi.set_variant("scalar_rgb")
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "assets"))
from body_scenes import LIQUID_LEVEL, LIQUID_OVERLAP, TUMBLER, rounded  # noqa: E402
from shapes import DOWNWARD_QUAD, icosphere, revolved  # noqa: E402

SIDE, SAMPLES = 48, 512
LIFT = (0.0, 0.002, 0.0)  # of the glass off the floor


def mesh(surface, bsdf, offset=(0.0, 0.0, 0.0), scale=1.0, **more):
    points, corners = surface[0], surface[1]
    properties = mi.Properties()
    properties["bsdf"] = bsdf
    properties["face_normals"] = True
    for name, value in more.items():
        properties[name] = value
    shape = mi.Mesh("mesh", len(points), len(corners) // 3, props=properties)
    parameters = mi.traverse(shape)
    positions = np.array(points, dtype=np.float32) * np.float32(scale) + np.array(offset, dtype=np.float32)
    parameters["vertex_positions"] = positions.ravel()
    parameters["faces"] = np.array(corners, dtype=np.uint32)
    parameters.update()
    return shape


def rgb(color):
    return {"type": "rgb", "value": list(color)}


def diffuse(*color):
    return mi.load_dict({"type": "diffuse", "reflectance": rgb(color)})


def interface(inside, outside):
    return mi.load_dict({"type": "dielectric", "int_ior": inside, "ext_ior": outside})


def medium(color, distance):
    sigma = [-math.log(c) / distance for c in color]
    return mi.load_dict({"type": "homogeneous", "albedo": rgb([0, 0, 0]), "scale": max(sigma),
                         "sigma_t": rgb(s / max(sigma) for s in sigma)})


def emitter(*radiance):
    return mi.load_dict({"type": "area", "radiance": rgb(radiance)})


def quad(*points):
    return points, [0, 1, 2, 0, 2, 3]


def interfaces(drink):
    r, w, b, h = (TUMBLER[key] for key in ("radius", "wall", "bottom", "height"))
    wet, low = r - w + LIQUID_OVERLAP, b - LIQUID_OVERLAP
    rim = rounded(r, h - w / 2, r - w / 2, h) + rounded(r - w, h - w / 2, r - w / 2, h)[-2::-1]
    dry = revolved(64, [(0, 0), (r - 0.04, 0)], rounded(r, 0.04, r - 0.04, 0)[::-1] + [(r, h - w / 2)], rim,
                   [(r - w, h - w / 2), (r - w, LIQUID_LEVEL)])
    side = rounded(wet, low + 0.06, wet - 0.06, low)[::-1] + [(wet, LIQUID_LEVEL)]
    return {
        "glass to air": mesh(dry, interface(1.5, 1.0), LIFT),
        "liquid to glass": mesh(revolved(64, [(0, low), (wet - 0.06, low)], side), interface(1.33, 1.5), LIFT,
                                interior=drink),
        "liquid to air": mesh(revolved(64, [(r - w, LIQUID_LEVEL), (0, LIQUID_LEVEL)]), interface(1.33, 1.0),
                              LIFT, interior=drink),
        "ring": mesh(revolved(64, [(wet, LIQUID_LEVEL), (r - w, LIQUID_LEVEL)]), interface(1.33, 1.5), LIFT,
                     interior=drink),
    }


def scene():
    drink = medium([0.9, 0.5, 0.15], 0.5)
    ball = icosphere(3)
    lamp = quad(*[(0.8 * x + 0.8, 2.2, 0.8 * z + 0.6) for x, _, z in DOWNWARD_QUAD])
    wall = quad((-1, 0.001, -1.2), (1, 0.001, -1.2), (1, 2.001, -1.2), (-1, 2.001, -1.2))
    pitch = math.radians(-8.0)
    return mi.load_dict({
        "type": "scene",
        "floor": mesh(quad((-3, 0, 3), (3, 0, 3), (3, 0, -3), (-3, 0, -3)), diffuse(0.73, 0.73, 0.73)),
        "light": mesh(lamp, diffuse(0, 0, 0), emitter=emitter(12.0, 11.4, 10.2)),
        "wall": mesh(wall, diffuse(0, 0, 0), emitter=emitter(0.6, 0.8, 1.0)),
        **interfaces(drink),
        "marble": mesh(ball, interface(1.6, 1.33), (-0.12, 0.24, 0.08), 0.12,
                       interior=medium([0.3, 0.9, 0.6], 0.2), exterior=drink),
        "berry": mesh(ball, diffuse(0.7, 0.05, 0.08), (0.14, 0.45, 0.0), 0.1, exterior=drink),
        "sensor": {"type": "perspective", "fov": math.degrees(0.5), "fov_axis": "y",
                   "to_world": mi.ScalarTransform4f().look_at(
                       origin=[0, 0.85, 2.6], target=[0, 0.85 + math.sin(pitch), 2.6 - math.cos(pitch)],
                       up=[0, 1, 0]),
                   "film": {"type": "hdrfilm", "width": SIDE, "height": SIDE, "pixel_format": "rgb",
                            "rfilter": {"type": "box"}},
                   "sampler": {"type": "independent"}},
        "integrator": {"type": "volpath", "max_depth": 65, "rr_depth": 1000},
    })


def main():
    renders = int(sys.argv[1]) if len(sys.argv) > 1 else 16
    drink = scene()
    means = np.array([np.array(mi.render(drink, spp=SAMPLES, seed=seed)).mean(axis=(0, 1)) for seed in range(renders)])
    print("mean", means.mean(axis=0), "standard error", means.std(axis=0, ddof=1) / math.sqrt(renders))


if __name__ == "__main__":
    main()
