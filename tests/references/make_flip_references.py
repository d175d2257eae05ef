#!/usr/bin/env python3
"""Makes the image pairs of tests/references/flip and their FLIP by the authors' own program; README.md says how to run it.

    python3 -m venv venv && venv/bin/pip install flip-evaluator==1.7 OpenEXR==3.5.3 numpy pillow
    venv/bin/python tests/references/make_flip_references.py [--lavalight build/release/lavalight]
"""
import argparse
import json
import subprocess
import tempfile
from pathlib import Path

import flip_evaluator
import numpy as np
import OpenEXR
from PIL import Image

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "tests/references/flip"


def write_exr(path, channels):
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    OpenEXR.File(header, channels).write(str(path))


def read_rgb(path):
    return OpenEXR.File(str(path)).channels()["RGB"].pixels


def render(lavalight, scene, size, spp, seed):
    """Radiance, rounded to half floats: what the stored file will hold."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "image.exr"
        subprocess.run([lavalight, "render", scene, "--size", size, "--spp", str(spp), "--seed", str(seed), "-o", path,
                        "--quiet"], check=True)
        return read_rgb(path).astype(np.float16)


def display(radiance):
    """8-bit sRGB."""
    x = np.clip(radiance.astype(np.float64), 0.0, 1.0)
    signal = np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)
    return (255.0 * signal + 0.5).astype(np.uint8)


def chart():
    """Colours of the whole cube in patches, thin lines and dots, and the same a little darker, greener and moved."""
    width, height = 97, 61
    y, x = np.mgrid[0:height, 0:width]
    patch = (x // 12) + 8 * (y // 12)
    reference = np.stack([(patch * 53) % 256, (patch * 101) % 256, (patch * 197) % 256], axis=-1).astype(np.int32)
    reference[y % 12 == 6] = 255
    reference[(x % 12 == 3) & (y % 6 == 2)] = 0
    image = np.roll(reference, 1, axis=1)
    image[:, 48:] = reference[:, 48:] * 9 // 10
    image[30:, :24, 1] += 20
    return np.clip(image, 0, 255).astype(np.uint8), reference.astype(np.uint8)


def store_ldr(name, image, reference):
    Image.fromarray(image).save(FOLDER / f"{name}-image.png", optimize=True)
    Image.fromarray(reference).save(FOLDER / f"{name}-reference.png", optimize=True)
    return store_flip(name, image.astype(np.float32) / 255, reference.astype(np.float32) / 255, "LDR")


def store_hdr(name, image, reference):
    write_exr(FOLDER / f"{name}-image.exr", {"RGB": image})
    write_exr(FOLDER / f"{name}-reference.exr", {"RGB": reference})
    return store_flip(name, image.astype(np.float32), reference.astype(np.float32), "HDR")


def store_flip(name, image, reference, dynamic_range):
    errors, mean, parameters = flip_evaluator.evaluate(reference, image, dynamic_range, applyMagma=False)
    write_exr(FOLDER / f"{name}-flip.exr", {"Y": errors[..., 0].astype(np.float16)})
    value = {"range": dynamic_range, "mean": float(mean), "max": float(errors.max())}
    if dynamic_range == "HDR":
        value |= {"startExposure": parameters["startExposure"], "stopExposure": parameters["stopExposure"],
                  "exposures": parameters["numExposures"]}
    return value


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--lavalight", default=ROOT / "build/release/lavalight")
    lavalight = parser.parse_args().lavalight
    FOLDER.mkdir(exist_ok=True)
    noisy, clean = (render(lavalight, "cornell-glass", "80x80", spp, 1) for spp in (8, 256))
    bright = render(lavalight, "veach-mis", "80x60", 64, 1)
    changed = bright.copy()
    changed[20:40, 20:60] = (changed[20:40, 20:60] * np.array([1.1, 1.0, 0.8])).astype(np.float16)
    values = {
        "chart": store_ldr("chart", *chart()),
        "noise": store_ldr("noise", display(noisy), display(clean)),
        "noise-radiance": store_hdr("noise-radiance", noisy, clean),
        "tint-radiance": store_hdr("tint-radiance", changed, bright),
    }
    (FOLDER / "values.json").write_text(json.dumps(values, indent=2) + "\n")


if __name__ == "__main__":
    main()
