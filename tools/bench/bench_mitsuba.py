"""Renders glTF scenes with Mitsuba 3 for tools/bench/equal_error: answers requests on stdin, as Cycles' end in bench_cycles.py
does. Lights are weighted by their power."""
import argparse
import json
import sys
import tempfile
import time

import drjit as dr
import mitsuba as mi
import numpy as np

import gltf_to_mitsuba

ROULETTE_DEPTH = 5  # Mitsuba's default


def load(request, bounces):
    with tempfile.TemporaryDirectory() as folder:
        description = gltf_to_mitsuba.load(mi, request["load"], request["size"], folder, environment=request["environment"])
        description["integrator"] = {"type": "path", "max_depth": bounces + 1, "rr_depth": ROULETTE_DEPTH}
        return mi.load_dict(description)


def render(scene, request):
    start, processor = time.perf_counter(), time.process_time()
    image = np.array(mi.render(scene, spp=request["samples"], seed=request["seed"]))
    cost = {"seconds": time.perf_counter() - start, "processor": time.process_time() - processor}
    mi.Bitmap(image).write(request["file"])
    return cost


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--variant", required=True)
    parser.add_argument("--threads", type=int, required=True)
    parser.add_argument("--bounces", type=int, required=True)
    options = parser.parse_args()
    mi.set_variant(options.variant)
    dr.set_thread_count(options.threads)
    scene = None
    for line in sys.stdin:
        request = json.loads(line)
        answer = {}
        if "load" in request:
            scene = load(request, options.bounces)
        else:
            answer = render(scene, request)
        print(json.dumps(answer), flush=True)


if __name__ == "__main__":
    main()
