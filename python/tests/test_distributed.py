"""Renders on Dask's workers: processes of this machine."""
import base64
import ctypes
import io
import json
import os
import signal
import subprocess
import sys
import time
import types

import lavalight
import numpy as np
import pytest

pytest.importorskip("distributed", reason="Dask's distributed is not installed; tools/setup --python installs it")

import distributed
import lavalight.distributed as on_cluster
from lavalight import _bar, _worker

from conftest import REPOSITORY
from test_merge import EVERYTHING, assert_same_bits, header

MANY = {"size": (256, 256), "spp": 20000}  # more than any test waits for


@pytest.fixture(scope="module")
def client():
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=":0") as cluster, \
            distributed.Client(cluster, set_as_default=False) as found:
        found.register_plugin(Talkative())
        yield found


class Talkative(distributed.WorkerPlugin):
    """Workers that tell how far they are more often, so that renders here may be short."""

    def setup(self, worker):
        _worker.TELL_EVERY = 0.02


def busy():
    return _worker._process._lock.locked()


def wait_until(condition, seconds=10.0):
    """Seconds until the condition holds."""
    start = time.monotonic()
    while not condition():
        assert time.monotonic() - start < seconds
        time.sleep(0.02)
    return time.monotonic() - start


def assert_idle_soon(client):
    assert wait_until(lambda: not any(client.run(busy).values())) < 3.0


def test_two_parts_have_the_bits_of_one_render(client, box, tmp_path):
    image = on_cluster.render(box, client=client, parts=2, spp=8, **EVERYTHING)
    assert_same_bits(image, box.render(spp=8, **EVERYTHING), tmp_path)


def test_an_image_without_its_film_is_saved_as_one_render_saves_it(client, box, tmp_path):
    image = on_cluster.render(box, client=client, parts=3, size=(24, 16), spp=10)
    assert_same_bits(image, box.render(size=(24, 16), spp=10), tmp_path)


def test_the_joined_image_is_denoised(client, box, tmp_path):
    options = {"size": (32, 24), "denoise": "fast", "layers": ["albedo"]}
    try:
        expected = box.render(spp=4, **options)
    except lavalight.Error as error:
        pytest.skip(str(error).splitlines()[0])
    assert_same_bits(on_cluster.render(box, client=client, parts=2, spp=4, **options), expected, tmp_path)
    expected = box.render(samples=(0, 4), **options)
    parts = [box.render(samples=samples, **options) for samples in ((0, 2), (2, 4))]
    assert_same_bits(lavalight.merge(parts, denoise="fast"), expected, tmp_path)
    assert_same_bits(on_cluster.render(box, client=client, parts=2, samples=(0, 4), **options), expected, tmp_path)


def test_what_parts_leave_of_a_range_is_what_was_asked_for(client, box, tmp_path):
    image = on_cluster.render(box, client=client, parts=2, size=(24, 16), samples=(3, 8))
    assert_same_bits(image, box.render(size=(24, 16), samples=(3, 8)), tmp_path)


def test_progressive_images_are_those_of_the_samples_that_arrived(client, box):
    images = list(on_cluster.progressive(box, client=client, parts=6, every=0.0, size=(16, 16), spp=12))
    assert images[-1].complete and not any(image.complete for image in images[:-1])
    totals = [image.report["samples"]["total"] for image in images]
    assert totals == sorted(set(totals)) and totals[-1] == 12 * 256
    for image in images:
        parts = [tuple(map(int, text.split(":"))) for text in image.report["ranges"].split(",")]
        expected = lavalight.merge(box.render(size=(16, 16), samples=samples) for samples in parts)
        assert (image.rgb == expected.rgb).all() and (image.pixels == expected.pixels).all()


def test_changed_materials_and_maps_travel(client, tmp_path):
    square = lavalight.Mesh([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], [[0, 1, 2], [0, 2, 3]], material=0)
    lavalight.load("cornell-box").render(size=(16, 8), spp=1).save(tmp_path / "map.exr")
    scene = lavalight.Scene([square], [lavalight.Material((0.8, 0.2, 0.1))], lavalight.Camera((0, 0, 4)), env=tmp_path / "map.exr")
    before = on_cluster.render(scene, client=client, parts=2, size=(16, 16), spp=4)
    scene.materials[0].base_color = (0.0, 1.0, 0.0)
    image = on_cluster.render(scene, client=client, parts=2, size=(16, 16), spp=4)
    assert (image.rgb != before.rgb).any()
    assert_same_bits(image, scene.render(size=(16, 16), spp=4), tmp_path)


def test_a_scene_is_sent_once(client, monkeypatch):
    scene = lavalight.load(REPOSITORY / "assets/veach-mis.gltf")
    sent = []
    submit = client.submit
    monkeypatch.setattr(client, "submit", lambda *words, **more: sent.append(more["key"]) or submit(*words, **more))
    for seed in range(3):
        on_cluster.render(scene, client=client, parts=2, size=(16, 16), spp=2, seed=seed)
    assert len(sent) == 1


def test_leaving_the_loop_ends_renders_on_workers(client, box):
    for image in on_cluster.progressive(box, client=client, parts=64, every=0.0, size=(64, 64), spp=6400):
        assert image.samples.max() > 0 and not image.complete
        break
    del image
    assert_idle_soon(client)


def test_a_part_that_is_under_way_is_ended(client, box):
    def stop(fraction):
        raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        on_cluster.render(box, client=client, parts=2, progress=stop, **MANY)
    assert_idle_soon(client)


def test_progress_is_told_before_parts_are_there(client, box):
    fractions = []
    on_cluster.render(box, client=client, parts=2, size=(64, 64), spp=600, progress=fractions.append)
    assert fractions == sorted(fractions) and fractions[-1] == 1.0
    assert any(0.0 < fraction < 0.45 for fraction in fractions)


def test_progress_does_not_fall_where_a_part_begins_again():
    fractions = []
    told = on_cluster._Told(fractions.append, "box")
    for fraction in (0.5, 0.2, 0.7):
        told.tell(fraction, "")
    assert fractions == [0.5, 0.5, 0.7]


def test_what_a_worker_says_is_raised(client, box):
    with pytest.raises(lavalight.Error, match="nowhere"):
        on_cluster.render(box, client=client, parts=2, device="nowhere", size=(16, 16), spp=4)
    assert on_cluster.render(box, client=client, parts=2, size=(16, 16), spp=4).complete


@pytest.mark.parametrize("keywords, error, message", [
    ({"time": 1.0}, lavalight.UsageError, "cannot stop at a time"), ({"target_error": 0.1}, lavalight.UsageError, "cannot stop at an error"),
    ({"parts": 0}, ValueError, "parts: 0"), ({"spp": -1}, lavalight.UsageError, "spp"), ({"nothing": 1}, TypeError, "unexpected keyword"),
    ({"progress": "line"}, ValueError, "neither True")])
def test_what_cannot_be_had_is_refused_before_it_begins(client, box, keywords, error, message):
    with pytest.raises(error, match=message):
        on_cluster.progressive(box, client=client, **keywords)


def test_without_a_cluster_one_is_told_how_to_get_one(box):
    with pytest.raises(lavalight.Error, match="no client is open; try client="):
        on_cluster.render(box)


def test_a_lost_worker_costs_no_bit(client, box):
    workers = client.run(os.getpid)
    killed = []

    def kill(fraction):
        if fraction > 0.1 and not killed:
            killed.append(client.run(busy))
            os.kill(next(iter(workers.values())), signal.SIGKILL)

    image = on_cluster.render(box, client=client, parts=4, size=(64, 64), spp=400, progress=kill)
    assert any(killed[0].values())
    assert (image.rgb == box.render(size=(64, 64), spp=400).rgb).all()
    client.wait_for_workers(2)


def write_moving(path):
    """A triangle that moves, without a camera: what frames it is the first frame's."""
    numbers = np.array([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 2, 0.5, 0.3], np.float32)  # positions; times; translations
    uri = "data:application/octet-stream;base64," + base64.b64encode(numbers.tobytes()).decode()
    views = [(0, 36), (36, 8), (44, 24)]
    path.write_text(json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], "buffers": [{"uri": uri, "byteLength": numbers.nbytes}],
        "bufferViews": [{"buffer": 0, "byteOffset": first, "byteLength": length} for first, length in views],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
                      {"bufferView": 1, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]},
                      {"bufferView": 2, "componentType": 5126, "count": 2, "type": "VEC3"}],
        "animations": [{"channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}],
                        "samplers": [{"input": 1, "output": 2}]}]}), encoding="utf-8")


def test_frames_have_the_bits_of_the_command(client, command, tmp_path):
    file = tmp_path / "moving.gltf"
    write_moving(file)
    scene = lavalight.load(file)
    options = {"size": (24, 16), "spp": 2, "layers": ["motion"]}
    command("render", file, "--frames", "1:4", "--fps", "8", "--size", "24x16", "--spp", "2", "--aov", "motion", "--quiet",
            "-o", tmp_path / "out.exr")
    found = dict(on_cluster.frames(scene, range(1, 4), fps=8, client=client, **options))
    assert sorted(found) == [1, 2, 3]
    for number, image in found.items():
        image.save(tmp_path / "image.exr")
        found_header, expected = header(tmp_path / "image.exr")[0], header(tmp_path / f"out_{number:04}.exr")[0]
        assert {name for name in expected if found_header.get(name) != expected[name]} <= {"lavalight:render-seconds"}
        result = image.compare(tmp_path / f"out_{number:04}.exr", relmse=0.0)
        assert result.equal, result
    in_order = [number for number, _ in on_cluster.frames(scene, (1, 4), fps=8, in_order=True, client=client, **options)]
    assert in_order == [1, 2, 3]
    bag = on_cluster.bag(scene, range(1, 3), fps=8, **options)
    for number, image in bag.compute(scheduler="synchronous"):
        assert (image.rgb == found[number].rgb).all()


def test_frames_that_come_before_their_turn_are_held_back():
    arrived = iter([(3, "c"), (1, "a"), (7, "e"), (5, "d")])
    in_order = on_cluster._in_order(arrived, range(1, 9, 2))
    assert next(in_order) == (1, "a") and next(arrived) == (7, "e")
    assert list(on_cluster._in_order([(3, "c"), (1, "a"), (5, "d")], range(1, 7, 2))) == [(1, "a"), (3, "c"), (5, "d")]


def test_frames_of_nothing_are_refused(box, client):
    with pytest.raises(ValueError, match="frames are numbers"):
        on_cluster.frames(box, range(0), client=client)
    with pytest.raises(ValueError, match="fps"):
        on_cluster.bag(box, range(2), fps=0)


def threads_of_the_driver():
    read = ctypes.CDLL(None).getenv
    read.restype = ctypes.c_char_p
    return read(b"LP_NUM_THREADS")


def test_a_worker_has_its_own_threads_alone(client, box):
    on_cluster.render(box, client=client, parts=4, size=(16, 16), spp=4)
    limits = set(client.run(threads_of_the_driver).values())
    assert limits <= {b"1", None} and (os.cpu_count() == 1 or b"1" in limits)


def test_renders_of_one_process_come_one_after_another():
    watch = types.SimpleNamespace(require_wanted=lambda: None, can_wait_elsewhere=True, threads=os.cpu_count())
    process = _worker._Process()
    process.take(watch)
    start = time.monotonic()
    with pytest.raises(distributed.Reschedule):
        process.take(watch)
    assert time.monotonic() - start >= _worker.PATIENCE
    process.give_back()
    process.take(watch)


class Terminal(io.StringIO):
    def isatty(self):
        return True


def test_a_terminal_shows_a_bar_and_a_file_does_not(monkeypatch):
    for stream, always, expected in ((Terminal(), False, True), (io.StringIO(), False, False), (io.StringIO(), True, True)):
        monkeypatch.setattr(sys, "stderr", stream)
        bar = _bar.Bar("box", always)
        bar.show(0.5, "1 of 2 parts")
        bar.close()
        assert ("50%" in stream.getvalue() and stream.getvalue().endswith("\n")) == expected


def test_a_notebook_shows_a_bar_that_grows(monkeypatch):
    shown = []
    handle = types.SimpleNamespace(update=shown.append)
    display = types.ModuleType("IPython.display")
    display.display = lambda value, display_id: shown.append(value) or handle
    display.HTML = str
    shell = types.ModuleType("IPython")
    shell.get_ipython = lambda: types.SimpleNamespace(kernel=True)
    monkeypatch.setitem(sys.modules, "IPython", shell)
    monkeypatch.setitem(sys.modules, "IPython.display", display)
    bar = _bar.Bar("<box>")
    bar.show(1.0, "half")
    bar.show(1.0, "all")
    assert len(shown) == 2 and "<progress max='1' value='1.0000'>" in shown[1] and "&lt;box&gt;" in shown[0]


def test_importing_lavalight_imports_no_dask():
    code = "import sys, lavalight; print([name for name in ('dask', 'distributed') if name in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"
