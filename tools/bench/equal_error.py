"""Measures Lavalight beside Embree, Mitsuba 3 and Cycles; tools/bench/equal_error runs it.

Time to equal error: every renderer takes more and more samples of the same scene, and what counts is when its
image is as near to the stored reference as asked: relMSE = mean((x - r)^2 / (r^2 + 0.01)) without pixels that see
a light and without the worst 0.1 % of the others. Loading and compiling are not counted. Renderers take turns, so
that whatever else the machine does meanwhile slows all of them; medians count.
"""
import argparse
import json
import math
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import OpenEXR

import gltf_to_mitsuba

ROOT = Path(__file__).resolve().parents[2]
REFERENCES = ROOT / "tests/references"
STORED_SCENES = ["cornell-box", "cornell-glass", "many-lights", "veach-mis"]  # scenes with a reference
# Flat, because each renderer reads smooth normals in its own way, and errors would not compare.
DENSE_SCENES = ["dense-300000-flat", "dense-3000000-flat"]
SCENES = STORED_SCENES + DENSE_SCENES
DENSE_SIZE = (256, 256)  # image size of scenes without a stored reference
REFERENCE_SAMPLES = 512  # a pixel, in the reference that Lavalight then makes with another seed
RAY_SCENES = ["cornell-box", "dense-300000", "dense-3000000"]
MOST_SAMPLES = 4096
MAX_BOUNCES = 64  # both renderers', as in the references
ROULETTE_DEPTH = 5  # Mitsuba's default
NEAR_ENOUGH = 2  # times the target: from there on the error is taken to fall with the samples


def read_rgb(path):
    channels = OpenEXR.File(str(path), separate_channels=True).channels()
    return np.stack([channels[c].pixels for c in "RGB"], axis=-1).astype(float)


def trimmed_error(image, reference, counted):
    errors = ((image - reference) ** 2 / (reference ** 2 + 0.01)).mean(axis=-1)[counted]
    return float(np.sort(errors)[:math.ceil(0.999 * errors.size)].mean())


def scene_file(scene, options):
    """Path and environment of a scene for other renderers; procedural ones are exported."""
    stored = ROOT / f"assets/{scene}.gltf"
    if stored.exists():
        return {"load": str(stored), "environment": [0, 0, 0]}
    exported = options.out / f"{scene}.glb"
    if not exported.exists():
        subprocess.run([options.exporter, scene, exported], check=True)
    document = gltf_to_mitsuba.Gltf(exported).json
    return {"load": str(exported), "environment": document["scenes"][0]["extras"]["environment"]}


class Lavalight:
    """One set of options of the program."""

    def __init__(self, binary, name, options=()):
        self.binary, self.name, self.options = binary, name, list(options)

    def load(self, scene, size, _):
        self.scene, self.size = scene, f"{size[0]}x{size[1]}"

    def render(self, samples, seed, bounces=MAX_BOUNCES):
        with tempfile.TemporaryDirectory() as folder:
            exr, report = Path(folder, "image.exr"), Path(folder, "report.json")
            subprocess.run([self.binary, "render", self.scene, "--size", self.size, "--spp", str(samples), "--seed",
                            str(seed), "--max-bounces", str(bounces), "-o", exr, "--report", report, "--quiet",
                            *self.options], check=True)
            return read_rgb(exr), json.loads(report.read_text())["seconds"]["render"]


class Served:
    """A renderer in a process of its own, asked by lines of JSON."""

    def __init__(self, name, command):
        self.name = name
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def ask(self, **request):
        print(json.dumps(request), file=self.process.stdin, flush=True)
        answer = self.process.stdout.readline()
        if not answer:
            raise SystemExit(f"{self.name} ended; its message is above")
        return json.loads(answer)

    def load(self, scene, size, options):
        with tempfile.TemporaryDirectory() as folder:
            self.ask(**scene_file(scene, options), size=size, file=str(Path(folder, "image.exr")))

    def render(self, samples, seed):
        with tempfile.TemporaryDirectory() as folder:
            file = str(Path(folder, "image.exr"))
            seconds = self.ask(samples=samples, seed=seed, file=file)["seconds"]
            return read_rgb(file), seconds


def mitsuba(variant, threads):
    """drjit keeps one thread pool for all variants: each has its process."""
    return Served(f"Mitsuba {variant}", [sys.executable, __file__, "--serve", variant, "--threads", str(threads)])


def cycles(python, threads):
    return Served("Cycles", [python, str(ROOT / "tools/bench/bench_cycles.py"), "--threads", str(threads),
                             "--bounces", str(MAX_BOUNCES)])


def serve(variant, threads):
    """The other end of Mitsuba: renders what it is told on stdin. Lights are weighted by their power."""
    import drjit as dr
    import mitsuba as mi
    mi.set_variant(variant)
    dr.set_thread_count(threads)
    scene = None
    for line in sys.stdin:
        request = json.loads(line)
        if "load" in request:
            with tempfile.TemporaryDirectory() as folder:
                description = gltf_to_mitsuba.load(mi, request["load"], request["size"], folder,
                                                   environment=request["environment"])
                description["integrator"] = {"type": "path", "max_depth": MAX_BOUNCES + 1, "rr_depth": ROULETTE_DEPTH}
                scene = mi.load_dict(description)
            print("{}", flush=True)
            continue
        start = time.perf_counter()
        image = np.array(mi.render(scene, spp=request["samples"], seed=request["seed"]))
        seconds = time.perf_counter() - start
        mi.Bitmap(image).write(request["file"])
        print(json.dumps({"seconds": seconds}), flush=True)


def time_to(target, points):
    """Seconds at which the error falls to `target`: log-linear between measured points (seconds, error), and by
    the law of independent samples beyond the last."""
    for (t0, e0), (t1, e1) in zip(points, points[1:]):
        if e1 <= target < e0:
            return t0 * (t1 / t0) ** (math.log(e0 / target) / math.log(e0 / e1))
    seconds, error = points[0] if points[0][1] <= target else points[-1]
    return seconds * error / target


def load_reference(scene, lavalight, options):
    stored = REFERENCES / f"{scene}.exr"
    if stored.exists():
        return read_rgb(stored)
    made = options.out / f"{scene}-reference.npy"
    if not made.exists():
        lavalight.load(scene, DENSE_SIZE, options)
        np.save(made, lavalight.render(REFERENCE_SAMPLES, 1000)[0])
    return np.load(made)


def bench_scene(scene, renderers, options):
    reference = load_reference(scene, renderers[0], options)
    size = (reference.shape[1], reference.shape[0])
    for renderer in renderers:
        renderer.load(scene, size, options)
        renderer.render(16, 0)  # compiles
    lights, _ = renderers[0].render(64, 0, bounces=0)
    counted = lights.sum(axis=-1) == 0
    curves = {renderer.name: [] for renderer in renderers}
    unfinished = list(renderers)
    samples = 64
    while unfinished and samples <= MOST_SAMPLES:
        runs = {renderer.name: [] for renderer in unfinished}
        for repeat in range(options.repeats):
            for renderer in unfinished:
                image, seconds = renderer.render(samples, repeat)
                runs[renderer.name].append((seconds, trimmed_error(image, reference, counted)))
        for renderer in list(unfinished):
            seconds, errors = zip(*runs[renderer.name])
            curves[renderer.name].append({"samples": samples, "seconds": statistics.median(seconds),
                                          "error": statistics.median(errors), "runs": runs[renderer.name]})
            if curves[renderer.name][-1]["error"] <= NEAR_ENOUGH * options.target:
                unfinished.remove(renderer)
        samples *= 4
    return curves, int(np.prod(size))


def times_to(target, curve):
    """The times of the repeats to reach the target."""
    return [time_to(target, [p["runs"][repeat] for p in curve]) for repeat in range(len(curve[0]["runs"]))]


def print_curves(scene, curves, pixels, options):
    """Ratios are Lavalight's time over the other's, of runs that took turns: their median and their range."""
    print(f"\n{scene}: seconds to relMSE {options.target} ({options.repeats} runs each, alternated)")
    print(f"{'':28}{'seconds':>9}{'ratio of ours':>15}{'range':>13}{'ns a path':>11}{'error at 64':>13}")
    ours = times_to(options.target, next(iter(curves.values())))
    for name, curve in curves.items():
        seconds = times_to(options.target, curve)
        ratios = [a / b for a, b in zip(ours, seconds)]
        cost = 1e9 * curve[-1]["seconds"] / curve[-1]["samples"] / pixels
        print(f"{name:28}{statistics.median(seconds):9.2f}{statistics.median(ratios):15.2f}"
              f"{min(ratios):7.2f}-{max(ratios):.2f}{cost:12.0f}{curve[0]['error']:13.4f}", flush=True)


def bench_rays(options):
    rows = []
    print(f"{'rays, one thread':28}{'Mrays/s':>9}{'Embree':>9}{'ratio':>7}{'nodes':>7}{'triangles':>11}")
    for scene in options.ray_scenes:
        answer = subprocess.run([options.lavalight, "bench", "rays", scene, "--json", "--repeats", str(options.repeats)],
                                check=True, capture_output=True, text=True).stdout
        for kind in json.loads(answer)["rays"]:
            rows.append({"scene": scene, **kind})
            print(f"{scene + ' ' + kind['kind']:28}{kind['megaraysPerSecond']:9.2f}"
                  f"{kind['embreeMegaraysPerSecond']:9.2f}{kind['ratio']:7.2f}"
                  f"{kind['nodesPerRay']:7.1f}{kind['trianglesPerRay']:11.1f}", flush=True)
    return rows


def plot(results, path, target):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(1, len(results), figsize=(4 * len(results), 3.6), squeeze=False)
    for axis, (scene, curves) in zip(axes[0], results.items()):
        for name, curve in curves.items():
            axis.loglog([p["seconds"] for p in curve], [p["error"] for p in curve], marker="o", label=name)
        axis.axhline(target, color="grey", linewidth=0.7)
        axis.set(title=scene, xlabel="seconds", ylabel="relMSE")
    axes[0][0].legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(path)


def parse_options():
    parser = argparse.ArgumentParser(prog="tools/bench/equal_error", description="Speed beside Embree, Mitsuba 3 and Cycles.")
    parser.add_argument("--lavalight", default="build/release/lavalight", help="the binary to measure")
    parser.add_argument("--exporter", default="build/release/export_scene", help="the program export_scene")
    parser.add_argument("--cycles", help="a Python that has bpy; without it, Cycles is left out")
    parser.add_argument("--scenes", nargs="*", default=SCENES, choices=SCENES, help="for time to equal error")
    parser.add_argument("--ray-scenes", nargs="*", default=RAY_SCENES, help="for rays per second")
    parser.add_argument("--variants", nargs="*", default=["llvm_ad_rgb", "scalar_rgb"], help="of Mitsuba")
    parser.add_argument("--schedules", nargs="+", default=["hosted", "fused", "wavefront"], choices=["hosted", "fused", "wavefront"],
                        help="of Lavalight; ratios are those of the first")
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--target", type=float, default=0.003, help="relMSE")
    parser.add_argument("--threads", type=int, default=os.cpu_count(), help="of every renderer")
    parser.add_argument("--out", type=Path, default=Path("out/bench"))
    parser.add_argument("--serve", help=argparse.SUPPRESS)
    return parser.parse_args()


def main():
    options = parse_options()
    if options.serve:
        serve(options.serve, options.threads)
        return
    options.lavalight = str(Path(options.lavalight).resolve())
    options.out.mkdir(parents=True, exist_ok=True)
    rays = bench_rays(options)
    os.environ["LP_NUM_THREADS"] = str(options.threads)
    renderers = [Lavalight(options.lavalight, f"Lavalight, {schedule}", ["--schedule", schedule])
                 for schedule in options.schedules]
    renderers += [mitsuba(variant, options.threads) for variant in options.variants]
    if options.cycles:
        renderers.append(cycles(options.cycles, options.threads))
    results = {}
    for scene in options.scenes:
        curves, pixels = bench_scene(scene, renderers, options)
        print_curves(scene, curves, pixels, options)
        results[scene] = curves
    (options.out / "bench.json").write_text(json.dumps(
        {"threads": options.threads, "target": options.target, "repeats": options.repeats, "rays": rays,
         "scenes": results}, indent=2) + "\n")
    if results:
        plot(results, options.out / "bench.svg", options.target)


if __name__ == "__main__":
    main()
