"""Renderers that tools/bench/equal_error measures: Lavalight, a process a picture; Mitsuba and Cycles, which stay.

All have load(), which takes a built-in scene's name or a View of the assets, and render(), which gives a picture and its Cost.
"""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import OpenEXR

import gltf_to_mitsuba
import timed_process
from timed_process import Cost
from views import View

ROOT = Path(__file__).resolve().parents[2]
MAX_BOUNCES = 64  # of all renderers, as in the references


def read_rgb(path):
    channels = OpenEXR.File(str(path), separate_channels=True).channels()
    return np.stack([channels[c].pixels for c in "RGB"], axis=-1).astype(float)


def scene_file(scene, options):
    """Path and environment of a built-in scene for other renderers; procedural ones are exported."""
    stored = ROOT / f"assets/{scene}.gltf"
    if stored.exists():
        return {"load": str(stored), "environment": [0, 0, 0]}
    exported = options.out / f"{scene}.glb"
    if not exported.exists():
        subprocess.run([options.exporter, scene, exported], check=True)
    document = gltf_to_mitsuba.Gltf(exported).json
    return {"load": str(exported), "environment": document["scenes"][0]["extras"]["environment"]}


class Lavalight:
    """One set of options of the program. Its seconds are those of its own clock, without loading and compiling; processor time is
    the whole process's."""
    program = "Lavalight"

    def __init__(self, binary, name, threads, options=()):
        self.binary, self.name, self.options = binary, name, ["--threads", str(threads), *options]

    def load(self, scene, size, options):
        text = f"{size[0]}x{size[1]}"
        if not isinstance(scene, View):
            self.input = [scene, "--size", text]
            return
        file, *environment = scene.files(options.assets)
        self.input = [file, *(f"--env={picture}" for picture in environment), *scene.options(text)]

    def render(self, samples, seed, bounces=MAX_BOUNCES):
        with tempfile.TemporaryDirectory() as folder:
            exr, report = Path(folder, "image.exr"), Path(folder, "report.json")
            used = timed_process.run([self.binary, "render", *self.input, "--spp", str(samples), "--seed", str(seed),
                                      "--max-bounces", str(bounces), "-o", exr, "--report", report, "--quiet", *self.options])
            return read_rgb(exr), Cost(json.loads(report.read_text())["seconds"]["render"], used.processor)


class Served:
    """A renderer in a process of its own, asked by lines of JSON. Its costs are those of the call that renders."""

    def __init__(self, program, name, command):
        self.program, self.name = program, name
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def ask(self, **request):
        print(json.dumps(request), file=self.process.stdin, flush=True)
        answer = self.process.stdout.readline()
        if not answer:
            raise SystemExit(f"{self.name} ended; its message is above")
        return json.loads(answer)

    def load(self, scene, size, options):
        if isinstance(scene, View):
            what = {"view": scene.description(options.assets, size)}
        else:
            what = {**scene_file(scene, options), "size": size}
        with tempfile.TemporaryDirectory() as folder:
            self.ask(**what, file=str(Path(folder, "image.exr")))

    def render(self, samples, seed):
        with tempfile.TemporaryDirectory() as folder:
            file = str(Path(folder, "image.exr"))
            cost = Cost(**self.ask(samples=samples, seed=seed, file=file))
            return read_rgb(file), cost


def mitsuba(variant, threads):
    """drjit keeps one thread pool for all variants: each has its process."""
    return Served("Mitsuba", f"Mitsuba {variant}",
                  [sys.executable, str(ROOT / "tools/bench/bench_mitsuba.py"), "--variant", variant, "--threads", str(threads),
                   "--bounces", str(MAX_BOUNCES)])


def cycles(python, threads):
    return Served("Cycles", "Cycles", [python, str(ROOT / "tools/bench/bench_cycles.py"), "--threads", str(threads),
                                       "--bounces", str(MAX_BOUNCES)])
