"""Single bodies: a white one for furnaces, and a glass ring with its caustic."""
from gltf_writer import Builder, camera_node, document, glass, lambert, light, node, perspective, turn
from shapes import DOWNWARD_QUAD, icosphere, torus

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
