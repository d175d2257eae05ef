#!/usr/bin/env python3
"""Renders the reference images of this folder with Mitsuba 3; README.md says how to run it.

    python3 -m venv venv && venv/bin/pip install mitsuba OpenEXR numpy
    venv/bin/python tests/references/make_references.py [NAME...]
"""
import argparse
import dataclasses
import sys
import tempfile
import time
from pathlib import Path

import drjit as dr
import mitsuba as mi
import numpy as np
import OpenEXR

FOLDER = Path(__file__).resolve().parent
ROOT = FOLDER.parents[1]
sys.path.insert(0, str(ROOT / "tools"))

import gltf_to_mitsuba  # noqa: E402

MAX_BOUNCES = 64  # scattering vertices, Lavalight's --max-bounces; Mitsuba's max_depth counts one more
ROULETTE_DEPTH = 8


@dataclasses.dataclass
class Reference:
    """How an image is made; `spp` counts the samples a pixel of each pass."""
    size: tuple = (128, 128)
    passes: int = 256
    spp: int = 128
    environment: tuple = None


# The images of this folder by their scenes in assets/.
REFERENCES = {
    "cornell-box": Reference(),
    "cornell-glass": Reference(spp=64),
    "veach-mis": Reference(size=(128, 96)),
    "many-lights": Reference(spp=32),
}


def render_passes(scene, passes, spp):
    """Mean and variance of the mean of each pixel and channel, from passes with the seeds 0, 1, 2, ..."""
    mean = None
    squares = None
    for seed in range(passes):
        image = np.array(mi.render(scene, spp=spp, seed=seed), dtype=np.float64)
        if not np.isfinite(image).all():
            raise SystemExit(f"pass {seed} holds values that are not finite")
        if mean is None:
            mean, squares = np.zeros_like(image), np.zeros_like(image)
        delta = image - mean
        mean += delta / (seed + 1)  # Welford 1962
        squares += delta * (image - mean)
        if sys.stderr.isatty():
            print(f"\rpass {seed + 1}/{passes}", end="", file=sys.stderr)
    return mean, squares / (passes - 1) / passes


def write_exr(path, mean, variance, samples, notes):
    channels = {}
    for i, c in enumerate("RGB"):
        channels[c] = np.ascontiguousarray(mean[..., i], dtype=np.float32)
        channels[f"variance.{c}"] = np.ascontiguousarray(variance[..., i], dtype=np.float32)
    channels["samples"] = np.full(mean.shape[:2], samples, dtype=np.uint32)
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage, **notes}
    OpenEXR.File(header, channels).write(str(path))


def describe_errors(mean, variance):
    """Relative standard errors, channels together: quantiles over pixels that are not black; the image's."""
    value, squares = mean.mean(axis=-1), variance.mean(axis=-1)
    lit = value > 0
    median, most = np.quantile(np.sqrt(squares[lit]) / value[lit], (0.5, 0.99))
    whole = np.sqrt(squares.sum()) / value.sum()
    return f"standard error of a pixel {median:.2%} (median), {most:.2%} (99 %), of the image {whole:.3%}"


def make(source, target, reference):
    size, passes, spp = reference.size, reference.passes, reference.spp
    with tempfile.TemporaryDirectory() as folder:
        description = gltf_to_mitsuba.load(mi, source, size, folder, reference.environment)
        description["integrator"] = {"type": "path", "max_depth": MAX_BOUNCES + 1, "rr_depth": ROULETTE_DEPTH}
        scene = mi.load_dict(description)
    start = time.process_time()
    mean, variance = render_passes(scene, passes, spp)
    notes = {"renderer": f"Mitsuba {mi.__version__} {mi.variant()}", "scene": Path(source).name,
             "settings": f"path, {MAX_BOUNCES} bounces, box filter, independent sampler, "
                         f"seeds 0 to {passes - 1} with {spp} samples each"}
    write_exr(target, mean, variance, passes * spp, notes)
    print(f"{target}: {size[0]}x{size[1]}, {passes * spp} samples a pixel, mean {mean.mean(axis=(0, 1))}, "
          f"{describe_errors(mean, variance)}, {time.process_time() - start:.0f} s CPU")


def main():
    parser = argparse.ArgumentParser(description="Renders reference images with Mitsuba 3.")
    parser.add_argument("names", nargs="*", metavar="NAME",
                        help=f"images of this folder (default: all): {', '.join(REFERENCES)}")
    parser.add_argument("--scene", help="another glTF file instead; needs --output")
    parser.add_argument("--output")
    parser.add_argument("--size", type=int, nargs=2, metavar=("WIDTH", "HEIGHT"))
    parser.add_argument("--passes", type=int)
    parser.add_argument("--spp", type=int, help="samples a pixel and pass")
    parser.add_argument("--environment", type=float, nargs=3, metavar=("R", "G", "B"))
    parser.add_argument("--threads", type=int, help="default: one a processor")
    parser.add_argument("--variant", default="llvm_ad_rgb", help="scalar_rgb needs no LLVM but far more time")
    options = parser.parse_args()
    if bool(options.scene) != bool(options.output) or (options.scene and options.names):
        parser.error("--scene and --output belong together, without NAME")
    if unknown := set(options.names) - set(REFERENCES):
        parser.error(f"no such image: {', '.join(sorted(unknown))}")
    mi.set_variant(options.variant)
    if options.threads:
        dr.set_thread_count(options.threads)
    given = {field: value for field in ("size", "passes", "spp", "environment")
             if (value := getattr(options, field)) is not None}
    if options.scene:
        make(options.scene, options.output, Reference(**given))
        return
    for name in options.names or REFERENCES:
        make(ROOT / f"assets/{name}.gltf", FOLDER / f"{name}.exr",
             dataclasses.replace(REFERENCES[name], **given))


if __name__ == "__main__":
    main()
