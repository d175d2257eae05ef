"""Scenes about picking and sampling lights: Veach's plates, many lights, a large and a small light."""
import math

from gltf_writer import WHITE, Builder, camera_node, document, lambert, light, metal, node, perspective, turn
from shapes import DOWNWARD_QUAD, OPEN_BOX, hash01, icosphere, normalized


def rounded(values):
    return [round(v, 6) for v in values]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


# After Veach, "Robust Monte Carlo Methods for Light Transport Simulation", 1997, figure 9.2; with numbers
# of our own.
VEACH_EYE = (0.0, 5.2, 14.0)
VEACH_LAMPS_HEIGHT = 4.2  # of the row of lamps, which hangs over z = 0
VEACH_PLATES = [  # middle (y, z) and alpha: the smooth plate on top, at the back
    (1.95, -0.25, 0.005), (1.2, 0.75, 0.02), (0.7, 1.95, 0.05), (0.4, 3.25, 0.1)]
VEACH_PLATE_SIZE = (7.2, 1.0)
VEACH_LAMPS = [  # x, radius, tint; all of the same power
    (-3.6, 0.05, [1.0, 0.55, 0.45]), (-1.8, 0.13, [1.0, 0.9, 0.5]), (0.3, 0.32, [0.55, 1.0, 0.55]),
    (3.0, 0.8, [0.55, 0.7, 1.0])]
VEACH_LAMP_STRENGTH = 1.0  # times the radius squared: radiance * m^2


def plate(y, z):
    """A quad turned so that its middle mirrors the row of lamps to the eye."""
    to_eye = normalized((0.0, VEACH_EYE[1] - y, VEACH_EYE[2] - z))
    to_lamps = normalized((0.0, VEACH_LAMPS_HEIGHT - y, -z))
    normal = normalized([a + b for a, b in zip(to_eye, to_lamps)])
    right = (1.0, 0.0, 0.0)
    back = cross(normal, right)
    width, depth = (s / 2 for s in VEACH_PLATE_SIZE)
    middle = (0.0, y, z)
    return [tuple(m + s * width * r + t * depth * k for m, r, k in zip(middle, right, back))
            for s, t in ((-1, -1), (1, -1), (1, 1), (-1, 1))]


def veach_mis():
    b = Builder()
    floor = [(-14, 0, 14), (14, 0, 14), (14, 0, -2), (-14, 0, -2)]
    wall = [(-14, 0, -2), (14, 0, -2), (14, 12, -2), (-14, 12, -2)]
    first_plate, first_lamp = 2, 2 + len(VEACH_PLATES)
    materials = [lambert("room", [0.4, 0.4, 0.4]), light("dim light", [1.0, 1.0, 1.0], 1.0)]
    meshes = [("room", [b.quads(0, floor, wall)]), ("dim light", [b.quads(1, DOWNWARD_QUAD)])]
    nodes = [node("room", 0), node("dim light", 1, translation=[0.0, 11.0, 10.0], scale=[6.0, 1.0, 6.0])]
    for i, (y, z, alpha) in enumerate(VEACH_PLATES):
        materials.append(metal(f"metal, alpha {alpha}", [0.35, 0.38, 0.42], alpha))
        meshes.append((f"plate {i}", [b.quads(first_plate + i, plate(y, z))]))
        nodes.append(node(f"plate {i}", len(meshes) - 1))
    points, corners, _ = icosphere(2)
    ball = b.triangles(first_lamp, points, corners)
    for i, (x, radius, tint) in enumerate(VEACH_LAMPS):
        strength = VEACH_LAMP_STRENGTH / (radius * radius * sum(tint) / 3)
        materials.append(light(f"lamp {i}", tint, round(strength, 6)))
        meshes.append((f"lamp {i}", [{**ball, "material": first_lamp + i}]))
        nodes.append(node(f"lamp {i}", len(meshes) - 1, translation=[x, VEACH_LAMPS_HEIGHT, 0.0],
                          scale=[radius] * 3))
    nodes.append(camera_node(list(VEACH_EYE), -13.5))
    return document("veach-mis", b, nodes, perspective(0.48, 4 / 3), materials, meshes)


# A closed room: x from -2 to 2, y from 0 to 2.5, z from -2.5 to 2.5.
LIGHT_GAP = 0.01  # from a light's back to its wall
LIGHT_COUNT = 200
LIGHT_DECADES = 4  # powers are spread evenly in their logarithm over so many powers of ten
LIGHT_MOST_POWER = 1.5  # W, mean of the channels
LIGHT_TINTS = [[1.0, 0.9, 0.75], [1.0, 0.7, 0.5], [0.7, 0.85, 1.0]]


def many_lights_room(b):
    floor = [(-2, 0, 2.5), (2, 0, 2.5), (2, 0, -2.5), (-2, 0, -2.5)]
    ceiling = [(-2, 2.5, -2.5), (2, 2.5, -2.5), (2, 2.5, 2.5), (-2, 2.5, 2.5)]
    back = [(-2, 0, -2.5), (2, 0, -2.5), (2, 2.5, -2.5), (-2, 2.5, -2.5)]
    front = [(2, 0, 2.5), (-2, 0, 2.5), (-2, 2.5, 2.5), (2, 2.5, 2.5)]
    left = [(-2, 0, 2.5), (-2, 0, -2.5), (-2, 2.5, -2.5), (-2, 2.5, 2.5)]
    right = [(2, 0, -2.5), (2, 0, 2.5), (2, 2.5, 2.5), (2, 2.5, -2.5)]
    return [b.quads(0, floor, ceiling, back, front), b.quads(1, left), b.quads(2, right)]


def wall_place(wall, s, t):
    """Where a light hangs and how it is turned; s goes along the wall, t up or towards the camera, 0 to 1."""
    along = 5.0 * s - 2.5
    if wall == 0:
        return [4.0 * s - 2.0, 2.5 - LIGHT_GAP, 5.0 * t - 2.5], None
    if wall == 1:
        return [4.0 * s - 2.0, 2.5 * t, -2.5 + LIGHT_GAP], turn(-90, 0)
    if wall == 2:
        return [-2.0 + LIGHT_GAP, 2.5 * t, along], turn(90, 2)
    return [2.0 - LIGHT_GAP, 2.5 * t, along], turn(-90, 2)


def many_lights_lamp(i):
    """Material and placement of a light: ten by five cells on the ceiling and on each of three walls."""
    wall, cell = divmod(i, LIGHT_COUNT // 4)
    column, row = divmod(cell, 5)
    s = (column + 0.3 + 0.4 * hash01(i, 0)) / 10  # the jitter keeps the widest light within its cell
    t = (row + 0.3 + 0.4 * hash01(i, 1)) / 5
    width, depth = (0.04 + 0.16 * hash01(i, k) ** 2 for k in (2, 3))
    power = LIGHT_MOST_POWER * 10 ** (-LIGHT_DECADES * hash01(i, 4))
    tint = LIGHT_TINTS[int(len(LIGHT_TINTS) * hash01(i, 5))]
    width, depth = round(width, 4), round(depth, 4)
    strength = power / (math.pi * width * depth * sum(tint) / 3)
    place, rotation = wall_place(wall, s, t)
    placement = {"translation": rounded(place), "scale": [width, 1.0, depth]}
    if rotation:
        placement["rotation"] = rotation
    return light(f"light {i}", tint, float(f"{strength:.6g}")), placement


def many_lights():
    b = Builder()
    materials = [lambert("white", WHITE), lambert("blue", [0.25, 0.35, 0.6]),
                 lambert("ochre", [0.6, 0.45, 0.2])]
    meshes = [("room", many_lights_room(b)), ("box", [b.quads(0, *OPEN_BOX)])]
    nodes = [
        node("room", 0),
        node("low box", 1, translation=[0.8, 0.0, -0.6], rotation=turn(-20), scale=[0.8, 0.6, 0.8]),
        node("tall box", 1, translation=[-0.8, 0.0, -1.3], rotation=turn(25), scale=[0.8, 1.5, 0.7]),
        node("small box", 1, translation=[-0.3, 0.0, 0.1], rotation=turn(40), scale=[0.35, 0.35, 0.35]),
    ]
    quad = b.quads(len(materials), DOWNWARD_QUAD)
    for i in range(LIGHT_COUNT):
        material, placement = many_lights_lamp(i)
        meshes.append((f"light {i}", [{**quad, "material": len(materials)}]))
        nodes.append(node(f"light {i}", len(meshes) - 1, **placement))
        materials.append(material)
    nodes.append(camera_node([0.0, 1.3, 2.45], -4.0))
    return document("many-lights", b, nodes, perspective(1.0), materials, meshes)


def large_small_light():
    """Two panels that lean over a floor towards the camera: 4 m^2 that emit 2.5, and 0.01 m^2 that emit 200, a
    fifth of the large one's power."""
    b = Builder()
    floor = [(-4, 0, 4), (4, 0, 4), (4, 0, -4), (-4, 0, -4)]
    materials = [lambert("floor", WHITE), light("large dim light", [1.0, 1.0, 1.0], 2.5),
                 light("small bright light", [1.0, 1.0, 1.0], 200.0)]
    panel = b.quads(1, DOWNWARD_QUAD)
    meshes = [("floor", [b.quads(0, floor)]), ("large light", [panel]),
              ("small light", [{**panel, "material": 2}])]
    nodes = [
        node("floor", 0),
        node("large light", 1, translation=[-1.3, 1.6, -1.0], rotation=turn(-40, 0), scale=[2.0, 1.0, 2.0]),
        node("small light", 2, translation=[1.5, 1.0, -0.4], rotation=turn(-40, 0), scale=[0.1, 1.0, 0.1]),
        camera_node([0.0, 2.2, 6.0], -14.0),
    ]
    return document("large-small-light", b, nodes, perspective(0.6, 4 / 3), materials, meshes)
