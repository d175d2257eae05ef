"""Renders one view of a glTF file with Lavalight and with Cycles and compares the pictures; see tools/bench/compare_cycles."""
import argparse
import json
import subprocess
from pathlib import Path

import bpy
import flip_evaluator
import numpy as np
import OpenEXR

import cycles_scene


def render_with_cycles(options, out):
    scene = cycles_scene.load(options)
    cycles_scene.set_estimator(scene, options.bounces)
    scene.cycles.samples, scene.cycles.seed = options.spp, 1
    scene.render.filepath = str(out.resolve())
    bpy.ops.render.render(write_still=True)


def render_with_lavalight(options, out):
    width, height = options.size
    subprocess.run(
        [options.lavalight, "render", options.scene, "--env", options.environment, "--size", f"{width}x{height}",
         "--look-from", options.look_from, "--look-at", options.look_at, "--fov", str(options.fov),
         "--spp", str(options.spp), "--max-bounces", str(options.bounces), "-o", str(out), "--quiet"], check=True)


def pixels(path):
    with OpenEXR.File(str(path), separate_channels=True) as file:
        channels = file.channels()
        return np.stack([channels[name].pixels for name in "RGB"], axis=-1).astype(np.float32)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--lavalight", required=True)
    cycles_scene.declare_view(parser)
    parser.add_argument("--spp", type=int, default=256)
    parser.add_argument("--bounces", type=int, default=16)
    parser.add_argument("--out", type=Path, default=Path("out/compare-cycles"))
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    ours, theirs = options.out / "lavalight.exr", options.out / "cycles.exr"
    render_with_lavalight(options, ours)
    render_with_cycles(options, theirs)
    a, b = pixels(ours), pixels(theirs)
    error_map, flip, _ = flip_evaluator.evaluate(b, a, "HDR")
    OpenEXR.File({"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage},
                 {"RGB": np.ascontiguousarray(error_map.astype(np.float32))}).write(str(options.out / "flip.exr"))
    means = {"lavalight": a.mean(axis=(0, 1)), "cycles": b.mean(axis=(0, 1))}
    print(json.dumps({"means": {name: [round(float(x), 5) for x in mean] for name, mean in means.items()},
                      "apart": [round(float(x), 4) for x in means["lavalight"] / means["cycles"] - 1],
                      "flip": round(float(flip), 4)}))


if __name__ == "__main__":
    main()
