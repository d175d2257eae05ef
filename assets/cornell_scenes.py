"""The Cornell box, and the same room with a glass and a metal ball.

The proportions of Cornell University's box (556 by 549 by 559 mm) rounded to a room 2 m wide, high, deep:
x to the right, y up, z towards the camera, origin in the middle of the floor.
"""
from gltf_writer import (WHITE, Builder, camera_node, document, glass, lambert, light, metal, node,
                         perspective, turn)
from shapes import OPEN_BOX, icosphere

RED = [0.65, 0.05, 0.05]
GREEN = [0.12, 0.45, 0.15]
LIGHT_COLOR = [1.0, 0.85, 0.6]
LIGHT_STRENGTH = 25.0
LIGHT_HALF_WIDTH, LIGHT_HALF_DEPTH = 0.235, 0.19
LIGHT_HEIGHT = 1.995  # a gap to the ceiling, so that the two do not compete for the same hits
CAMERA_POSITION = [0.0, 1.0, 3.88]
CAMERA_YFOV = 0.686

GOLD = [1.0, 0.78, 0.34]
BALL_RADIUS = 0.38
BALL_GAP = 0.002  # to the floor: no point belongs to two surfaces


def room(b):
    """The primitives of the walls, of materials 0, 1 and 2 of cornell_materials."""
    floor = [(-1, 0, 1), (1, 0, 1), (1, 0, -1), (-1, 0, -1)]
    ceiling = [(-1, 2, -1), (1, 2, -1), (1, 2, 1), (-1, 2, 1)]
    back = [(-1, 0, -1), (1, 0, -1), (1, 2, -1), (-1, 2, -1)]
    left = [(-1, 0, 1), (-1, 0, -1), (-1, 2, -1), (-1, 2, 1)]
    right = [(1, 0, -1), (1, 0, 1), (1, 2, 1), (1, 2, -1)]
    return [b.quads(0, floor, ceiling, back), b.quads(1, left), b.quads(2, right)]


def lamp(b):
    """The primitive of the light, material 3 of cornell_materials."""
    w, h, d = LIGHT_HALF_WIDTH, LIGHT_HEIGHT, LIGHT_HALF_DEPTH
    return [b.quads(3, [(-w, h, -d), (w, h, -d), (w, h, d), (-w, h, d)])]


def cornell_materials():
    return [lambert("white", WHITE), lambert("red", RED), lambert("green", GREEN),
            light("light", LIGHT_COLOR, LIGHT_STRENGTH, WHITE)]


def cornell_box():
    b = Builder()
    meshes = [("room", room(b)), ("box", [b.quads(0, *OPEN_BOX)]), ("light", lamp(b))]
    nodes = [
        node("room", 0),
        node("short box", 1, translation=[0.33, 0.0, 0.39], rotation=turn(-16.7), scale=[0.6, 0.6, 0.6]),
        node("tall box", 1, translation=[-0.33, 0.0, -0.26], rotation=turn(17.2), scale=[0.6, 1.2, 0.6]),
        node("light", 2),
        camera_node(CAMERA_POSITION),
    ]
    return document("cornell-box", b, nodes, perspective(CAMERA_YFOV), cornell_materials(), meshes)


def cornell_glass():
    """The gold is slightly glossy (alpha 0.04): it mirrors the room, and light samples find its lobe."""
    b = Builder()
    walls, lights = room(b), lamp(b)
    ball = b.triangles(4, *icosphere(4))
    meshes = [("room", walls), ("light", lights), ("glass ball", [ball]),
              ("metal ball", [{**ball, "material": 5}])]
    height, scale = BALL_RADIUS + BALL_GAP, [BALL_RADIUS] * 3
    nodes = [
        node("room", 0),
        node("light", 1),
        node("glass ball", 2, translation=[0.42, height, 0.36], scale=scale),
        node("metal ball", 3, translation=[-0.42, height, -0.38], scale=scale),
        camera_node(CAMERA_POSITION),
    ]
    materials = cornell_materials() + [glass("glass", 2.0), metal("gold", GOLD, 0.04)]
    return document("cornell-glass", b, nodes, perspective(CAMERA_YFOV), materials, meshes)
