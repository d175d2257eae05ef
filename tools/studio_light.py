"""A photographer's studio as an environment map: grey walls, one large lamp over the camera's shoulder, a small one behind.

A constant environment shows a white model on white, without a highlight; this shows shape, gloss and colour alike. The
lamps suit the camera of scenes that bring none, which looks from the front (+z) and the right (+x).
"""
import math
from pathlib import Path

WIDTH, HEIGHT = 128, 64
FLOOR, HORIZON, CEILING = 0.10, 0.25, 0.45  # radiances
# Towards the lamp, half its angle in degrees, its radiance: together about pi of irradiance on what faces the camera.
LAMPS = (((-0.5, 0.9, 0.9), 24.0, (6.0, 5.8, 5.5)), ((0.6, 0.5, -0.9), 10.0, (6.0, 6.5, 7.0)))


def direction(row, column):
    """The direction of a pixel's centre: the map's middle is +x, its right half holds +z, its top row is +y."""
    polar = math.pi * (row + 0.5) / HEIGHT
    azimuth = 2.0 * math.pi * ((column + 0.5) / WIDTH - 0.5)
    return math.sin(polar) * math.cos(azimuth), math.cos(polar), math.sin(polar) * math.sin(azimuth)


def radiance(towards):
    for lamp, half_angle, colour in LAMPS:
        cosine = sum(a * b for a, b in zip(towards, lamp)) / math.hypot(*lamp)
        if cosine > math.cos(math.radians(half_angle)):
            return colour
    up = towards[1]
    return (HORIZON + (CEILING - HORIZON) * up if up > 0.0 else HORIZON + (HORIZON - FLOOR) * up,) * 3


def rgbe(colour):
    """Three mantissas and the exponent that they share (Ward, Real Pixels, 1991)."""
    exponent = math.frexp(max(colour))[1]
    return bytes([int(value * 2.0 ** (8 - exponent)) for value in colour] + [exponent + 128])


def write_studio(path):
    """Writes the map as an uncompressed Radiance file."""
    pixels = b"".join(rgbe(radiance(direction(row, column))) for row in range(HEIGHT) for column in range(WIDTH))
    header = f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {HEIGHT} +X {WIDTH}\n"
    Path(path).write_bytes(header.encode("ascii") + pixels)
