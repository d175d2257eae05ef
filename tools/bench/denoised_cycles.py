"""Renders one picture with Cycles for tools/bench/denoised, as a process of its own, and writes where its seconds went.

Settings are Blender's, as installed, but for a fixed count of samples. Their bounces and clamps spare work that Lavalight does.
"""
import time

START = time.perf_counter()

import argparse
import json
import os
from pathlib import Path

import bpy

import cycles_scene


def set_estimator(scene, options):
    scene.render.engine = "CYCLES"
    scene.render.threads_mode, scene.render.threads = "FIXED", options.threads
    scene.cycles.device = "CPU"
    scene.cycles.samples, scene.cycles.seed = options.spp, options.seed
    scene.cycles.use_adaptive_sampling = False


def set_denoiser(cycles, options):
    cycles.use_denoising = options.quality != "none"
    if cycles.use_denoising:
        cycles.denoiser, cycles.denoising_use_gpu = "OPENIMAGEDENOISE", False
        cycles.denoising_input_passes = "RGB_ALBEDO_NORMAL"
        cycles.denoising_quality, cycles.denoising_prefilter = options.quality, options.prefilter


def set_output(scene, options):
    scene.view_settings.view_transform = "Standard"  # clamped sRGB
    scene.render.dither_intensity = 0
    settings = scene.render.image_settings
    settings.file_format, settings.color_depth, settings.color_mode = "PNG", "8", "RGB"
    scene.render.filepath = str(options.out.resolve())


def main():
    imported = time.perf_counter()
    parser = argparse.ArgumentParser()
    cycles_scene.declare_view(parser)
    parser.add_argument("--spp", type=int, required=True)
    parser.add_argument("--seed", type=int, required=True)
    parser.add_argument("--threads", type=int, required=True)
    parser.add_argument("--quality", choices=["none", "HIGH", "BALANCED", "FAST"], required=True)
    parser.add_argument("--prefilter", choices=["ACCURATE", "FAST"], default="ACCURATE")
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--report", type=Path, required=True)
    options = parser.parse_args()
    scene = cycles_scene.load(options)
    set_estimator(scene, options)
    set_denoiser(scene.cycles, options)
    set_output(scene, options)
    loaded = time.perf_counter()
    bpy.ops.render.render(write_still=True)
    options.report.write_text(json.dumps({"start": imported - START, "load": loaded - imported,
                                          "picture": time.perf_counter() - loaded}))
    os._exit(0)  # what Blender tidies up after its picture does not count


if __name__ == "__main__":
    main()
