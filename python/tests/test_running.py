"""Renders under way: progress, threads, Ctrl-C, memory, start-up."""
import os
import signal
import subprocess
import sys
import threading
import time

import lavalight
import numpy as np
import pytest

from conftest import SMALL


def test_progressive_images_get_better_and_end_with_the_bits_of_render(box):
    images = list(box.progressive(size=(64, 64), spp=64, every=0.01))
    assert len(images) > 1
    counts = [int(image.samples.sum()) for image in images]
    assert counts == sorted(counts) and counts[-1] == 64 * 64 * 64
    assert not images[0].complete and images[-1].complete
    assert (images[-1].rgb == box.render(size=(64, 64), spp=64).rgb).all()


def test_seconds_of_rendering_add_up(box):
    images = list(box.progressive(size=(128, 128), spp=64, every=0.05))
    rates = [image.report["samples"]["total"] / image.report["samples"]["perSecond"] for image in images]
    assert rates == sorted(rates) and rates[-1] > 0.05


def test_progressive_may_be_left_early(box):
    for image in box.progressive(size=(64, 64), spp=100000, every=0.05):
        assert image.samples.max() > 0
        break
    assert box.render(**SMALL).complete


def test_progressive_refuses_at_once(box):
    with pytest.raises(ValueError, match="every"):
        box.progressive(every=0.0)
    with pytest.raises(TypeError, match="unexpected keyword"):
        box.progressive(nothing=1)


def test_progress_is_told(box):
    fractions = []
    box.render(size=(128, 128), spp=256, progress=fractions.append)
    assert fractions == sorted(fractions) and all(0.0 <= fraction <= 1.0 for fraction in fractions)
    assert fractions


def test_what_progress_raises_ends_the_render(box):
    def stop(fraction):
        raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        box.render(size=(256, 256), spp=100000, progress=stop)
    assert box.render(**SMALL).complete


def test_time_stops_a_render(box):
    image = box.render(size=(64, 64), time=0.3)
    assert image.report["stoppedBy"] == "time"


def test_two_renders_at_once_have_the_bits_of_one_after_another(box):
    expected = [box.render(size=(48, 48), spp=16, seed=seed).rgb for seed in range(4)]
    found = [None] * 4

    def work(seed):
        found[seed] = box.render(size=(48, 48), spp=16, seed=seed).rgb

    threads = [threading.Thread(target=work, args=(seed,)) for seed in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for a, b in zip(expected, found):
        assert (a == b).all()


def test_the_lock_is_free_while_rendering(box):
    counted, done = 0, threading.Event()

    def work():
        box.render(size=(256, 256), spp=64)
        done.set()

    thread = threading.Thread(target=work)
    thread.start()
    while not done.is_set():
        counted += 1
        time.sleep(0.001)
    thread.join()
    assert counted > 20


def test_materials_may_change_while_another_thread_renders():
    scene = lavalight.Scene([lavalight.Mesh([[-1, -1, 0], [1, -1, 0], [0, 1, 0]], material=0)],
                            [lavalight.Material(base_color=(0, 0, 0), emission=(1, 1, 1))], lavalight.Camera((0, 0, 3)))
    images = []
    thread = threading.Thread(target=lambda: images.append(scene.render(size=(128, 128), spp=256)))
    thread.start()
    for value in np.linspace(2.0, 3.0, 50):
        scene.materials[0].emission = (value, value, value)
    thread.join()
    assert len(np.unique(images[0].rgb[64, 64])) == 1  # one emission, whichever it was


def run(code, **more):
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=120, **more)


@pytest.mark.parametrize("work", ["scene.render(size=(512, 512), spp=100000)",
                                  "lavalight.lab('mis', samples=2**16)"])
def test_ctrl_c_raises_keyboard_interrupt_soon(work):
    code = ("import lavalight, sys\nscene = lavalight.load('cornell-box')\nscene.render(size=(8, 8), spp=1)\nprint('ready', flush=True)\n"
            f"try:\n    {work}\nexcept KeyboardInterrupt:\n    print('interrupted', flush=True)\n"
            "print(scene.render(size=(8, 8), spp=1).complete)")
    process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "ready\n"
    time.sleep(0.5)
    process.send_signal(signal.SIGINT)
    start = time.monotonic()
    assert process.stdout.readline() == "interrupted\n"
    assert time.monotonic() - start < 5.0
    assert process.stdout.readline() == "True\n"
    assert process.wait(60) == 0


def test_the_interpreter_ends_in_peace():
    done = run("import lavalight; lavalight.load('cornell-box').render(size=(8, 8), spp=1)")
    assert done.returncode == 0 and done.stderr == ""


def test_a_render_that_is_left_open_ends_with_the_interpreter():
    done = run("import lavalight; images = lavalight.load('cornell-box').progressive(size=(64, 64), spp=10000, every=0.05); next(images)")
    assert done.returncode == 0, done.stderr


def test_importing_is_quick_and_opens_no_device():
    code = "import time, numpy; start = time.perf_counter(); import lavalight; print(time.perf_counter() - start)"
    seconds = min(float(run(code).stdout) for _ in range(3))
    assert seconds < 0.15


def memory():
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def test_memory_does_not_grow_over_many_renders(box):
    count = int(os.environ.get("LAVALIGHT_TEST_RENDERS", "60"))
    for _ in range(20):
        box.render(size=(16, 16), spp=1)
    before = memory()
    for seed in range(count):
        box.render(size=(16, 16), spp=1, seed=seed)
    assert memory() - before < 8e6 + 20e3 * count


@pytest.mark.parametrize("work", ["scene.render(size=(8, 8), spp=1)", "lavalight.lab('dice')"])
def test_a_forked_child_of_a_process_that_rendered_is_told_why_it_cannot(work):
    code = ("import lavalight, os\nscene = lavalight.load('cornell-box')\nscene.render(size=(8, 8), spp=1)\nchild = os.fork()\n"
            f"if child == 0:\n    try:\n        {work}\n    except lavalight.Error as error:\n"
            "        print(error, flush=True)\n    os._exit(0)\nos.waitpid(child, 0)\nprint(scene.render(size=(8, 8), spp=1).complete)")
    done = run(code)
    assert "spawn" in done.stdout and done.stdout.endswith("True\n"), done.stdout + done.stderr


def test_the_interpreter_ends_while_a_daemon_thread_renders():
    code = ("import lavalight, threading, time\nscene = lavalight.load('cornell-box')\n"
            "threading.Thread(target=lambda: scene.render(size=(256, 256), spp=4000), daemon=True).start()\ntime.sleep(1.0)")
    for _ in range(3):
        run(code)  # which raises where it takes longer than the limit


def test_a_driver_that_is_not_there_is_an_error():
    environment = {**os.environ, "VK_ICD_FILENAMES": "/nowhere.json", "VK_DRIVER_FILES": "/nowhere.json"}
    code = "import lavalight\ntry:\n    lavalight.load('cornell-box').render(spp=1)\nexcept lavalight.Error as error:\n    print('error:', error)"
    done = run(code, env=environment)
    assert done.returncode == 0 and done.stdout.startswith("error:"), done.stderr
