"""Bodies: a white one for furnaces, a glass ring with its caustic, and a drink."""
import math

from gltf_writer import Builder, camera_node, document, glass, lambert, light, node, perspective, turn
from shapes import DOWNWARD_QUAD, icosphere, revolved, torus

RING_RADIUS, RING_TUBE = 0.5, 0.16
RING_GAP = 0.002  # to the floor: no point belongs to two surfaces


def furnace():
    """White and flat shaded, so that a constant environment makes it vanish; it holds no light of its own."""
    b = Builder()
    points, corners, _ = icosphere(2)
    meshes = [("ball", [b.triangles(0, points, corners)])]
    nodes = [node("ball", 0), camera_node([0.0, 0.0, 4.0])]
    return document("furnace", b, nodes, perspective(0.6), [lambert("white", [1.0, 1.0, 1.0])], meshes)


def glass_caustic():
    b = Builder()
    floor = [(-3, 0, 3), (3, 0, 3), (3, 0, -3), (-3, 0, -3)]
    materials = [lambert("floor", [0.73, 0.73, 0.73]), glass("glass", 2 * RING_TUBE),
                 light("light", [1.0, 0.95, 0.85], 120.0)]
    meshes = [("floor", [b.quads(0, floor)]), ("light", [b.quads(2, DOWNWARD_QUAD)]),
              ("ring", [b.triangles(1, *torus(RING_RADIUS, RING_TUBE, 96, 40))])]
    nodes = [
        node("floor", 0),
        node("ring", 2, translation=[0.0, RING_TUBE + RING_GAP, 0.0]),
        node("light", 1, translation=[-1.2, 1.8, -0.9], rotation=turn(35, 2), scale=[0.3, 1.0, 0.3]),
        camera_node([0.0, 2.2, 3.2], -36.0),
    ]
    return document("glass-caustic", b, nodes, perspective(0.5, 4 / 3), materials, meshes)


# The drink, in decimetres: the liquid reaches a little into the glass, as is the custom where one body wets another. Where they
# overlap the smaller one fills the place: the liquid.
TUMBLER = {"radius": 0.4, "wall": 0.04, "bottom": 0.1, "height": 1.0}
LIQUID_LEVEL, LIQUID_OVERLAP = 0.72, 0.004


def rounded(r0, y0, r1, y1, steps=8):
    """A quarter of an ellipse from one point to another, which starts along y."""
    return [(r0 + (r1 - r0) * (1 - math.cos(t)), y0 + (y1 - y0) * math.sin(t))
            for t in (math.pi / 2 * k / steps for k in range(steps + 1))]


def tumbler():
    r, w, b, h = (TUMBLER[key] for key in ("radius", "wall", "bottom", "height"))
    outside = [(0, 0), (r - 0.04, 0)], rounded(r, 0.04, r - 0.04, 0)[::-1] + [(r, h - w / 2)]
    rim = rounded(r, h - w / 2, r - w / 2, h) + rounded(r - w, h - w / 2, r - w / 2, h)[-2::-1]
    inside = [(r - w, h - w / 2), (r - w, b + 0.06)] + rounded(r - w, b + 0.06, r - w - 0.06, b)[1:]
    return revolved(64, *outside, rim, inside, [(r - w - 0.06, b), (0, b)])


def liquid():
    r = TUMBLER["radius"] - TUMBLER["wall"] + LIQUID_OVERLAP
    b = TUMBLER["bottom"] - LIQUID_OVERLAP
    side = rounded(r, b + 0.06, r - 0.06, b)[::-1] + [(r, LIQUID_LEVEL)]
    return revolved(64, [(0, b), (r - 0.06, b)], side, [(r, LIQUID_LEVEL), (0, LIQUID_LEVEL)])


def nested_glass():
    """A marble and a berry in a drink in a glass: three bodies within each other, before a bright wall."""
    b = Builder()
    floor = [(-3, 0, 3), (3, 0, 3), (3, 0, -3), (-3, 0, -3)]
    panel = [(-1, 0, 0), (1, 0, 0), (1, 2, 0), (-1, 2, 0)]
    materials = [
        lambert("floor", [0.73, 0.73, 0.73]), light("light", [1.0, 0.95, 0.85], 12.0), light("wall", [0.6, 0.8, 1.0], 1.0),
        glass("glass", 0.04), glass("drink", 0.6, 1.33, attenuationColor=[0.9, 0.5, 0.15], attenuationDistance=0.5),
        glass("marble", 0.2, 1.6, attenuationColor=[0.3, 0.9, 0.6], attenuationDistance=0.2),
        lambert("berry", [0.7, 0.05, 0.08])]
    ball = icosphere(3)
    meshes = [("floor", [b.quads(0, floor)]), ("light", [b.quads(1, DOWNWARD_QUAD)]), ("wall", [b.quads(2, panel)]),
              ("tumbler", [b.triangles(3, *tumbler())]), ("drink", [b.triangles(4, *liquid())]),
              ("marble", [b.triangles(5, *ball)]), ("berry", [b.triangles(6, *ball)])]
    nodes = [
        node("floor", 0), node("light", 1, translation=[0.8, 2.2, 0.6], scale=[0.8, 1.0, 0.8]),
        node("wall", 2, translation=[0.0, 0.001, -1.2]),
        node("tumbler", 3, translation=[0.0, 0.002, 0.0]), node("drink", 4, translation=[0.0, 0.002, 0.0]),
        node("marble", 5, translation=[-0.12, 0.24, 0.08], scale=[0.12, 0.12, 0.12]),
        node("berry", 6, translation=[0.14, 0.45, 0.0], scale=[0.1, 0.1, 0.1]),
        camera_node([0.0, 0.85, 2.6], -8.0),
    ]
    return document("nested-glass", b, nodes, perspective(0.5), materials, meshes)
