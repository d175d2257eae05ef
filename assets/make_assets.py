#!/usr/bin/env python3
"""Writes the scenes of this folder, the same bytes each time; run by hand, needs Python 3 alone."""
from pathlib import Path

from body_scenes import furnace, glass_caustic, nested_glass
from cornell_scenes import cornell_box, cornell_glass
from gltf_writer import write
from light_scenes import large_small_light, many_lights, veach_mis

FOLDER = Path(__file__).resolve().parent

if __name__ == "__main__":
    for scene in (cornell_box, cornell_glass, veach_mis, many_lights, furnace, large_small_light,
                  glass_caustic, nested_glass):
        write(FOLDER, scene())
