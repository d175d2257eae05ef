"""Measures seconds to a denoised picture beside Cycles; tools/bench/denoised runs it.

What counts is the time from the start of the process to a PNG whose mean FLIP against the converged picture is below a target.
Each renderer is held against its own converged picture, of many samples and without denoising, since their shading differs.
First each walks a ladder of sample counts with each quality of its denoiser, for the setting that takes the least processor time.
Then the two settings take turns, so that whatever else the machine does meanwhile slows both; medians count.
"""
import argparse
import json
import os
import statistics
import sys
import tempfile
from dataclasses import asdict, dataclass
from pathlib import Path

import flip_evaluator

import timed_process
import views

ROOT = Path(__file__).resolve().parents[2]
LADDER = [2 ** n for n in range(11)]
SIZE = "512x512"
QUICK_REFERENCE = 64  # samples
REFERENCE_SEED, SEED = 1, 0  # other noise in the converged picture than in the one that is measured


@dataclass
class Goal:
    """What is wanted of a view."""
    ratio: float  # largest ratio of Lavalight's time to Cycles'
    reference: int = 256  # samples of the converged picture


GOALS = {"WaterBottle": Goal(0.5), "FlightHelmet": Goal(0.5), "ToyCar": Goal(0.5), "SheenChair": Goal(0.5),
         "LivingRoom": Goal(0.8, 1024)}


@dataclass
class Run:
    samples: int
    quality: str
    seconds: float  # wall clock
    processor: float  # seconds of processor time, user and system
    parts: dict  # seconds by the renderer's own clock: start, load, picture
    flip: float | None = None


def run(command, report, parts_of):
    """Runs a renderer to its end; the times of it."""
    cost = timed_process.run(command)
    return cost.seconds, cost.processor, parts_of(json.loads(report.read_text()))


class Lavalight:
    name = "Lavalight"
    qualities = ["fast", "balanced", "high"]  # by rising cost

    def __init__(self, options):
        self.binary, self.threads, self.assets = options.lavalight, options.threads, options.assets

    def render(self, view, samples, quality, seed, png):
        with tempfile.TemporaryDirectory() as folder:
            report = Path(folder, "report.json")
            command = [self.binary, "render", self.assets / view.file, "--env", self.assets / view.environment, *view.options(SIZE),
                       "--spp", str(samples), "--seed", str(seed), "--threads", str(self.threads), "--tonemap", "linear",
                       "-o", png, "--report", report, "--quiet"]
            if quality != "none":
                command += ["--denoise", quality]
            return Run(samples, quality, *run(command, report, self.parts))

    @staticmethod
    def parts(report):
        seconds = report["seconds"]
        return {"start": seconds["device"], "load": seconds["load"],
                "picture": sum(seconds.get(stage, 0) for stage in ("prepare", "render", "denoise", "write"))}


class Cycles:
    name = "Cycles"
    qualities = ["FAST, FAST", "BALANCED, FAST", "HIGH, FAST", "FAST, ACCURATE", "BALANCED, ACCURATE", "HIGH, ACCURATE"]

    def __init__(self, options):
        self.threads, self.assets = options.threads, options.assets

    def render(self, view, samples, quality, seed, png):
        with tempfile.TemporaryDirectory() as folder:
            report = Path(folder, "report.json")
            command = [sys.executable, ROOT / "tools/bench/denoised_cycles.py", self.assets / view.file,
                       self.assets / view.environment, *view.options(SIZE), "--spp", str(samples), "--seed", str(seed),
                       "--threads", str(self.threads), "--out", png, "--report", report]
            denoiser, _, prefilter = quality.partition(", ")
            command += ["--quality", denoiser, *(["--prefilter", prefilter] if prefilter else [])]
            return Run(samples, quality, *run(command, report, dict))


def flip_between(reference, png):
    return float(flip_evaluator.evaluate(str(reference), str(png), "LDR")[1])


class Contestant:
    """A renderer before one scene."""

    def __init__(self, renderer, scene, options):
        self.renderer, self.scene, self.view = renderer, scene, views.VIEWS[scene]
        self.folder, self.target, self.most = options.out / "denoised", options.flip, options.most_samples
        self.folder.mkdir(parents=True, exist_ok=True)
        samples = options.reference or GOALS[scene].reference
        self.reference = self.picture(f"reference-{samples}")
        if not self.reference.exists():
            self.renderer.render(self.view, samples, "none", REFERENCE_SEED, self.reference)
        self.walked = []

    def picture(self, what):
        return self.folder / f"{self.scene}-{self.renderer.name}-{what}.png"

    def measure(self, samples, quality):
        png = self.picture(f"{samples}-{quality.replace(', ', '-')}".lower())
        measured = self.renderer.render(self.view, samples, quality, SEED, png)
        measured.flip = flip_between(self.reference, png)
        return measured

    def cheapest(self):
        """The run of least processor time that reaches the target; the first of all fills caches and does not count."""
        self.measure(1, self.renderer.qualities[0])
        best = None
        for quality in self.renderer.qualities:
            for samples in (count for count in LADDER if count <= self.most):
                if best and samples >= best.samples:  # dearer than what did it
                    break
                measured = self.measure(samples, quality)
                self.walked.append(measured)
                print(f"{self.scene}, {self.renderer.name}, {quality}, {samples} samples: FLIP {measured.flip:.4f}, "
                      f"{measured.processor:.2f} s of processor time", file=sys.stderr, flush=True)
                if best and measured.processor >= best.processor:
                    break
                if measured.flip < self.target:
                    best = measured
                    break
        if best is None:
            raise SystemExit(f"{self.scene}: {self.renderer.name} does not reach FLIP {self.target} with {self.most} samples")
        return best


def bench_scene(scene, renderers, options):
    contestants = [Contestant(renderer, scene, options) for renderer in renderers]
    choices = [contestant.cheapest() for contestant in contestants]
    runs = [[] for _ in contestants]
    for _ in range(options.runs):
        for contestant, choice, kept in zip(contestants, choices, runs):
            kept.append(contestant.measure(choice.samples, choice.quality))
    return {contestant.renderer.name: {"runs": [asdict(one) for one in kept], "walked": [asdict(one) for one in contestant.walked]}
            for contestant, kept in zip(contestants, runs)}


def median_of(runs, key):
    return statistics.median(one[key] for one in runs)


def ratio(ours, theirs, key):
    """The median of the ratios of runs that took turns."""
    return statistics.median(a[key] / b[key] for a, b in zip(ours, theirs))


def print_times(results, options):
    print(f"\nSeconds to mean FLIP {options.flip}, {SIZE}, {options.threads} threads, medians of {options.runs} alternated runs; in "
          "brackets processor seconds\n")
    print("| scene | Lavalight | Cycles | ratio | target | samples and denoiser of Lavalight | of Cycles |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    for scene, result in results.items():
        ours, theirs = result["Lavalight"]["runs"], result["Cycles"]["runs"]
        times = [f"{median_of(runs, 'seconds'):.2f} ({median_of(runs, 'processor'):.2f})" for runs in (ours, theirs)]
        settings = [f"{runs[0]['samples']}, {runs[0]['quality']}: {runs[0]['flip']:.3f}" for runs in (ours, theirs)]
        print(f"| {scene} | {times[0]} | {times[1]} | {ratio(ours, theirs, 'seconds'):.2f} "
              f"({ratio(ours, theirs, 'processor'):.2f}) | {GOALS[scene].ratio} | {settings[0]} | {settings[1]} |")


def print_parts(results):
    print("\nSeconds by each program's own clock: start (device or imports), reading the scene, and the picture (from the scene "
          "to the PNG)\n")
    print("| scene | Lavalight: start | scene | picture | Cycles: start | scene | picture | ratio of pictures |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- |")
    for scene, result in results.items():
        parts = [[one["parts"] for one in result[name]["runs"]] for name in ("Lavalight", "Cycles")]
        cells = [f"{median_of(runs, part):.2f}" for runs in parts for part in ("start", "load", "picture")]
        print(f"| {scene} | {' | '.join(cells)} | {ratio(*parts, 'picture'):.2f} |")


def parse_options():
    parser = argparse.ArgumentParser(prog="tools/bench/denoised", description="Seconds to a denoised picture beside Cycles.")
    parser.add_argument("--lavalight", default="build/release/lavalight", help="the binary to measure")
    parser.add_argument("--scenes", nargs="+", default=list(GOALS), choices=list(GOALS))
    parser.add_argument("--runs", type=int, default=3, help="of each renderer, alternated")
    parser.add_argument("--threads", type=int, default=os.cpu_count(), help="of both renderers")
    parser.add_argument("--flip", type=float, default=0.05, help="largest mean FLIP")
    parser.add_argument("--reference", type=int, help="samples of the converged pictures; default: by the scene")
    parser.add_argument("--most-samples", type=int, default=256, help="where the ladder ends")
    parser.add_argument("--quick", action="store_true", help=f"one run of the first scene, converged pictures of {QUICK_REFERENCE} samples")
    parser.add_argument("--out", type=Path, default=Path("out/bench"))
    options = parser.parse_args()
    if options.quick:
        options.scenes, options.runs, options.reference = options.scenes[:1], 1, QUICK_REFERENCE
    options.assets = views.assets_folder()
    if options.assets is None:
        raise SystemExit("tools/bench/denoised: LAVALIGHT_ASSETS is not set; tools/assets says which files belong in the folder")
    options.lavalight = Path(options.lavalight).resolve()
    return options


def main():
    options = parse_options()
    options.out.mkdir(parents=True, exist_ok=True)
    renderers = [Lavalight(options), Cycles(options)]
    results = {}
    for scene in options.scenes:
        results[scene] = bench_scene(scene, renderers, options)
        (options.out / "denoised.json").write_text(json.dumps(
            {"threads": options.threads, "flip": options.flip, "scenes": results}, indent=2) + "\n")
    print_times(results, options)
    print_parts(results)


if __name__ == "__main__":
    main()
