"""Measures Lavalight beside Embree, Mitsuba 3 and Cycles; tools/bench/equal_error runs it.

Time to equal error: every renderer takes more and more samples of the same scene, and what counts is when its
image is as near to the stored reference as asked: relMSE = mean((x - r)^2 / (r^2 + 0.01)) without pixels that see
a light and without the worst 0.1 % of the others. Loading and compiling are not counted. Renderers take turns, so
that whatever else the machine does meanwhile slows all of them; medians count.

glTF scenes of LAVALIGHT_ASSETS are rendered by Lavalight and Cycles. Their materials differ a little between the
programs, so each is held to a reference of its own, of many samples with another seed. One count of samples is
measured, and its error is taken to fall with the samples. The reference's own error counts as the picture's: it
adds their ratio of samples, to both renderers alike.

Processor time, and all times of glTF scenes, are differences between two counts of samples.
"""
import argparse
import json
import math
import os
import statistics
import subprocess
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

import views
from renderers import ROOT, Lavalight, cycles, mitsuba, read_rgb

REFERENCES = ROOT / "tests/references"
STORED_SCENES = ["cornell-box", "cornell-glass", "many-lights", "veach-mis"]  # scenes with a reference
# Flat, because each renderer reads smooth normals in its own way, and errors would not compare.
DENSE_SCENES = ["dense-300000-flat", "dense-3000000-flat"]
GLTF_SCENES = {"flight-helmet": views.VIEWS["FlightHelmet"], "toy-car": views.VIEWS["ToyCar"],
               "living-room": views.VIEWS["LivingRoom"], "classroom": views.VIEWS["Classroom"]}
SCENES = STORED_SCENES + DENSE_SCENES + list(GLTF_SCENES)
DENSE_SIZE = (256, 256)  # image size of scenes without a stored reference
REFERENCE_SAMPLES = 512  # a pixel, in the reference that Lavalight then makes with another seed
RAY_SCENES = ["cornell-box", "dense-300000", "dense-3000000"]
REFERENCE_SEED = 1000  # repeats have the seeds from 0 on
FIRST_SAMPLES, MOST_SAMPLES = 64, 4096
FEW_SAMPLES = 16  # what a render costs beside its samples is told by one of so many
NEAR_ENOUGH = 2  # times the target: from there on the error is taken to fall with the samples


def trimmed_error(image, reference, counted):
    errors = ((image - reference) ** 2 / (reference ** 2 + 0.01)).mean(axis=-1)[counted]
    return float(np.sort(errors)[:math.ceil(0.999 * errors.size)].mean())


@dataclass
class Run:
    seconds: float  # wall clock
    processor: float  # seconds of processor time, user and system
    error: float


def cost_of(samples, many, few):
    """The time of so many samples alone, from that of a render of them and that of one of FEW_SAMPLES."""
    return max((many - few) * samples / (samples - FEW_SAMPLES), 1e-3)


def time_to(target, points):
    """Seconds at which the error falls to `target`: log-linear between measured points (seconds, error), and by
    the law of independent samples beyond the last."""
    for (t0, e0), (t1, e1) in zip(points, points[1:]):
        if e1 <= target < e0:
            return t0 * (t1 / t0) ** (math.log(e0 / target) / math.log(e0 / e1))
    seconds, error = points[0] if points[0][1] <= target else points[-1]
    return seconds * error / target


def kept(file, make):
    """The picture in that file; it is made where there is none yet."""
    if not file.exists():
        np.save(file, make())
    return np.load(file)


def load_reference(scene, lavalight, options):
    stored = REFERENCES / f"{scene}.exr"
    if stored.exists():
        return read_rgb(stored)

    def make():
        lavalight.load(scene, DENSE_SIZE, options)
        return lavalight.render(REFERENCE_SAMPLES, REFERENCE_SEED)[0]
    return kept(options.out / f"{scene}-reference.npy", make)


def own_reference(scene, renderer, options):
    """A glTF scene as the renderer's program shows it, which has loaded it."""
    width, height = options.size
    name = f"{scene}-{renderer.program.lower()}-{width}x{height}-{options.reference_samples}-reference.npy"
    return kept(options.out / name, lambda: renderer.render(options.reference_samples, REFERENCE_SEED)[0])


def load_all(scene, size, renderers, options):
    """Has every renderer load the scene and compile for it. Returns which pixels count: those that see no light."""
    for renderer in renderers:
        renderer.load(scene, size, options)
        renderer.render(FEW_SAMPLES, 0)
    lights, _ = renderers[0].render(64, 0, bounces=0)
    return lights.sum(axis=-1) == 0


def point(samples, runs):
    """A count of samples on a renderer's curve."""
    return {"samples": samples, **{key: statistics.median(getattr(run, key) for run in runs) for key in asdict(runs[0])},
            "runs": [asdict(run) for run in runs]}


def bench_scene(scene, renderers, options):
    """Curves of a built-in scene, and its pixels."""
    reference = load_reference(scene, renderers[0], options)
    size = (reference.shape[1], reference.shape[0])
    counted = load_all(scene, size, renderers, options)
    few = {renderer.name: statistics.median(renderer.render(FEW_SAMPLES, seed)[1].processor for seed in range(3))
           for renderer in renderers}
    curves = {renderer.name: [] for renderer in renderers}
    unfinished = list(renderers)
    samples = FIRST_SAMPLES
    while unfinished and samples <= MOST_SAMPLES:
        runs = {renderer.name: [] for renderer in unfinished}
        for repeat in range(options.repeats):
            for renderer in unfinished:
                image, cost = renderer.render(samples, repeat)
                runs[renderer.name].append(Run(cost.seconds, cost_of(samples, cost.processor, few[renderer.name]),
                                               trimmed_error(image, reference, counted)))
        for renderer in list(unfinished):
            curves[renderer.name].append(point(samples, runs[renderer.name]))
            if curves[renderer.name][-1]["error"] <= NEAR_ENOUGH * options.target:
                unfinished.remove(renderer)
        samples *= 4
    return curves, int(np.prod(size))


def bench_gltf_scene(scene, renderers, options):
    """Curves of a glTF scene, a point for each renderer that reads such files, and its pixels."""
    renderers = [renderer for renderer in renderers if renderer.program != "Mitsuba"]
    counted = load_all(GLTF_SCENES[scene], options.size, renderers, options)
    references = {}
    for renderer in renderers:
        if renderer.program not in references:
            references[renderer.program] = own_reference(scene, renderer, options)
    runs = {renderer.name: [] for renderer in renderers}
    for repeat in range(options.repeats):
        for renderer in renderers:
            few = renderer.render(FEW_SAMPLES, repeat)[1]
            image, many = renderer.render(options.samples, repeat)
            runs[renderer.name].append(Run(cost_of(options.samples, many.seconds, few.seconds),
                                           cost_of(options.samples, many.processor, few.processor),
                                           trimmed_error(image, references[renderer.program], counted)))
    return {name: [point(options.samples, own)] for name, own in runs.items()}, int(np.prod(options.size))


def times_to(target, curve, clock):
    """The times of the repeats to reach the target, by "seconds" or "processor"."""
    return [time_to(target, [(p["runs"][repeat][clock], p["runs"][repeat]["error"]) for p in curve])
            for repeat in range(len(curve[0]["runs"]))]


def print_curves(scene, curves, pixels, options):
    """Ratios are Lavalight's time over the other's, of runs that took turns: their median and their range."""
    first = next(iter(curves.values()))
    print(f"\n{scene}: seconds to relMSE {options.target} ({options.repeats} runs each, alternated), of wall and of processor time")
    print(f"{'':28}{'wall':>9}{'ratio of ours':>15}{'range':>13}{'ns a path':>11}{'processor':>11}{'ratio':>7}{'range':>13}"
          f"{'ns a path':>11}{'error at ' + str(first[0]['samples']):>15}")
    for name, curve in curves.items():
        cells = ""
        for clock, widths in (("seconds", (9, 15)), ("processor", (11, 7))):
            ours, theirs = times_to(options.target, first, clock), times_to(options.target, curve, clock)
            ratios = [a / b for a, b in zip(ours, theirs)]
            cost = 1e9 * curve[-1][clock] / curve[-1]["samples"] / pixels
            cells += (f"{statistics.median(theirs):{widths[0]}.2f}{statistics.median(ratios):{widths[1]}.2f}"
                      f"{f'{min(ratios):.2f}-{max(ratios):.2f}':>13}{cost:11.0f}")
        print(f"{name:28}{cells}{curve[0]['error']:15.4f}", flush=True)


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


def size_of(text):
    width, height = (int(number) for number in text.split("x"))
    return width, height


def parse_options():
    parser = argparse.ArgumentParser(
        prog="tools/bench/equal_error", description="Speed beside Embree, Mitsuba 3 and Cycles.",
        epilog=f"{', '.join(GLTF_SCENES)} are glTF scenes of LAVALIGHT_ASSETS, rendered by Lavalight and Cycles. Each program is held "
               "to a reference of its own, since their materials differ a little. References are kept in --out: delete them there "
               "once pictures have changed.")
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
    parser.add_argument("--size", type=size_of, default=(256, 256), metavar="WxH", help="of glTF scenes' pictures; default: 256x256")
    parser.add_argument("--samples", type=int, default=128, help="a pixel of glTF scenes; default: 128")
    parser.add_argument("--reference-samples", type=int, default=2048, help="a pixel of glTF scenes' references; default: 2048")
    parser.add_argument("--out", type=Path, default=Path("out/bench"))
    options = parser.parse_args()
    if options.samples <= FEW_SAMPLES:
        parser.error(f"cannot measure {options.samples} samples: they are compared with {FEW_SAMPLES}; try more")
    options.lavalight = str(Path(options.lavalight).resolve())
    options.assets = views.assets_folder()
    return options


def scenes_at_hand(options):
    """The scenes asked for, without those whose assets are nowhere."""
    gltf = [scene for scene in options.scenes if scene in GLTF_SCENES]
    if gltf and options.assets is None:
        print(f"{', '.join(gltf)}: left out, since LAVALIGHT_ASSETS is not set; tools/assets says which files belong in the folder",
              flush=True)
        return [scene for scene in options.scenes if scene not in gltf]
    for file in (file for scene in gltf for file in GLTF_SCENES[scene].files(options.assets)):
        if not file.is_file():
            raise SystemExit(f"tools/bench/equal_error: cannot read {file}: no such file; try tools/assets {options.assets}")
    return options.scenes


def write_results(rays, results, options):
    (options.out / "bench.json").write_text(json.dumps(
        {"threads": options.threads, "target": options.target, "repeats": options.repeats, "rays": rays,
         "scenes": results}, indent=2) + "\n")


def main():
    options = parse_options()
    options.out.mkdir(parents=True, exist_ok=True)
    scenes = scenes_at_hand(options)
    rays = bench_rays(options)
    renderers = [Lavalight(options.lavalight, f"Lavalight, {schedule}", options.threads, ["--schedule", schedule])
                 for schedule in options.schedules]
    renderers += [mitsuba(variant, options.threads) for variant in options.variants]
    if options.cycles:
        renderers.append(cycles(options.cycles, options.threads))
    results = {}
    write_results(rays, results, options)
    for scene in scenes:
        bench = bench_gltf_scene if scene in GLTF_SCENES else bench_scene
        curves, pixels = bench(scene, renderers, options)
        print_curves(scene, curves, pixels, options)
        results[scene] = curves
        write_results(rays, results, options)
    if results:
        plot(results, options.out / "bench.svg", options.target)


if __name__ == "__main__":
    main()
