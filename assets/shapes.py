"""Shapes about the origin: quads as lists of four corners, curved bodies as (points, corners, normals)."""
import math

# A unit box on the floor without its bottom, which would lie in the floor.
OPEN_BOX = [
    [(-.5, 1, .5), (.5, 1, .5), (.5, 1, -.5), (-.5, 1, -.5)],
    [(-.5, 0, .5), (.5, 0, .5), (.5, 1, .5), (-.5, 1, .5)],
    [(.5, 0, -.5), (-.5, 0, -.5), (-.5, 1, -.5), (.5, 1, -.5)],
    [(-.5, 0, -.5), (-.5, 0, .5), (-.5, 1, .5), (-.5, 1, -.5)],
    [(.5, 0, .5), (.5, 0, -.5), (.5, 1, -.5), (.5, 1, .5)],
]

# One metre wide, in the plane y = 0, its front downwards.
DOWNWARD_QUAD = [(-.5, 0, -.5), (.5, 0, -.5), (.5, 0, .5), (-.5, 0, .5)]

# The right angles of a golden rectangle's corners make an icosahedron's twelve vertices.
GOLDEN = (1 + math.sqrt(5)) / 2
ICOSAHEDRON = [(-1, GOLDEN, 0), (1, GOLDEN, 0), (-1, -GOLDEN, 0), (1, -GOLDEN, 0),
               (0, -1, GOLDEN), (0, 1, GOLDEN), (0, -1, -GOLDEN), (0, 1, -GOLDEN),
               (GOLDEN, 0, -1), (GOLDEN, 0, 1), (-GOLDEN, 0, -1), (-GOLDEN, 0, 1)]
ICOSAHEDRON_FACES = [
    (0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2), (10, 7, 6),
    (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10),
    (8, 6, 7), (9, 8, 1)]


def normalized(v):
    length = math.sqrt(sum(c * c for c in v))
    return tuple(c / length for c in v)


def icosphere(levels):
    """The unit sphere by 20 * 4^levels triangles; each level splits every triangle into four."""
    points = [normalized(p) for p in ICOSAHEDRON]
    faces = ICOSAHEDRON_FACES
    for _ in range(levels):
        middles = {}

        def middle(a, b):
            key = (min(a, b), max(a, b))
            if key not in middles:
                middles[key] = len(points)
                points.append(normalized([p + q for p, q in zip(points[a], points[b])]))
            return middles[key]

        split = []
        for a, b, c in faces:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            split += [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
        faces = split
    return points, [corner for face in faces for corner in face], points


def torus(radius, tube, around, across):
    """A ring about the y axis: `radius` to the middle of the tube, which is `tube` thick from its middle."""
    points, corners, normals = [], [], []
    for i in range(around):
        phi = 2 * math.pi * i / around
        for j in range(across):
            theta = 2 * math.pi * j / across
            normal = (math.cos(theta) * math.cos(phi), math.sin(theta), math.cos(theta) * math.sin(phi))
            normals.append(normal)
            points.append((radius * math.cos(phi) + tube * normal[0], tube * normal[1],
                           radius * math.sin(phi) + tube * normal[2]))
            here, up = i * across + j, i * across + (j + 1) % across
            there, both = (i + 1) % around * across + j, (i + 1) % around * across + (j + 1) % across
            corners += [here, up, both, here, both, there]
    return points, corners, normals


def revolved(around, *arcs):
    """The surface that profiles leave as they turn about the y axis. Each is a row of points (r, y) with its own normals; it
    goes up where its outside is away from the axis. Neighbours meet in creases."""
    points, corners, normals = [], [], []
    for arc in arcs:
        first = len(points)
        for k, (r, y) in enumerate(arc):
            before, after = arc[max(k - 1, 0)], arc[min(k + 1, len(arc) - 1)]
            nr, ny = after[1] - before[1], before[0] - after[0]
            for i in range(around):
                phi = 2 * math.pi * i / around
                points.append((r * math.cos(phi), y, -r * math.sin(phi)))
                normals.append(normalized((nr * math.cos(phi), ny, -nr * math.sin(phi))))
        for k in range(len(arc) - 1):
            for i in range(around):
                here, there = first + k * around + i, first + k * around + (i + 1) % around
                if arc[k][0] > 0:
                    corners += [here, there, there + around]
                if arc[k + 1][0] > 0:
                    corners += [here, there + around, here + around]
    return points, corners, normals


def hash01(*key):
    """A number in [0, 1) from whole numbers by the 32-bit mixing function "lowbias32" (Wellons, 2018)."""
    x = 0
    for part in key:
        x = (x + part + 0x9E3779B9) & 0xFFFFFFFF
        x = ((x ^ (x >> 16)) * 0x7FEB352D) & 0xFFFFFFFF
        x = ((x ^ (x >> 15)) * 0x846CA68B) & 0xFFFFFFFF
        x ^= x >> 16
    return x / 2**32
