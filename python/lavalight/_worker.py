"""What runs on Dask's workers: parts of images, and frames."""

from __future__ import annotations

import atexit
import os
import platform
import threading
import time
from collections import OrderedDict
from dataclasses import dataclass
from typing import Any

from distributed import Reschedule, Status, get_worker

from . import _lavalight
from ._bundle import Choice, Model, load

TOPIC = "lavalight-progress"
MOST_SCENES = 2  # that a process keeps loaded
TELL_EVERY = 0.5  # seconds between two words on progress
PATIENCE = 2.0  # seconds that a task waits for its process before it asks for another one

# What a processor can do that compilers and libraries choose code by.
ABILITIES = frozenset({"sse4_1", "sse4_2", "avx", "avx2", "fma", "f16c", "bmi2", "avx512f", "avx512bw", "avx512dq", "avx512vl",
                       "asimd", "sve", "sve2"})


@dataclass(frozen=True)
class Part:
    """A film's bytes, and where it was rendered."""

    film: bytes
    worker: str
    processor: str


@dataclass(frozen=True)
class Task:
    """A part as it is asked for."""

    job: str
    words: tuple[str, ...]
    guides: bool  # whether its film has what denoising reads
    samples: tuple[int, int]


def processor() -> str:
    """Who made this processor, and what of ABILITIES it has."""
    maker, flags = "", set[str]()
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            for line in file:
                name, _, value = line.partition(":")
                if name.strip() in ("vendor_id", "CPU implementer"):
                    maker = value.strip()
                elif name.strip() in ("flags", "Features"):
                    flags = set(value.split())
                if not line.strip():
                    break
    except OSError:
        pass
    return " ".join([platform.machine(), maker, *sorted(flags & ABILITIES)])


class _Watch:
    """Asked about twenty times a second while a task renders: tells how far it is, and ends it where nobody waits for it."""

    def __init__(self, job: str, name: Any) -> None:
        self._worker = get_worker()
        self._key = self._worker.get_current_task()
        self._job = job
        self._name = name
        self._told = time.monotonic()

    def __call__(self, fraction: float) -> None:
        self.require_wanted()
        now = time.monotonic()
        if now - self._told >= TELL_EVERY:
            self._told = now
            self._worker.log_event(TOPIC, {"job": self._job, "task": self._name, "fraction": fraction})

    def require_wanted(self) -> None:
        """Raises Reschedule where the task was cancelled, or the worker closes. A cancelled task is not run again."""
        task = self._worker.state.tasks.get(self._key)
        is_wanted = task is not None and task.state in ("executing", "long-running")
        if not is_wanted or self._worker.status in (Status.closing, Status.closed, Status.failed):
            raise Reschedule


class _Process:
    """What a worker's process keeps from task to task. One task at a time has it, with all threads of the worker."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._scenes: OrderedDict[tuple[str, Choice], _lavalight.Scene] = OrderedDict()
        self._render: _lavalight.Render | None = None
        self._rendered: tuple[Any, ...] = ()  # what the render is of, but for its samples
        self._is_limited = False

    def take(self, watch: _Watch) -> None:
        """Waits for the process. Raises Reschedule where that takes long: another worker may be free."""
        start = time.monotonic()
        while not self._lock.acquire(timeout=0.1):
            watch.require_wanted()
            if time.monotonic() - start > PATIENCE:
                raise Reschedule
        self._limit_threads()

    def forget_render(self) -> None:
        self._render = None

    def give_back(self) -> None:
        self._lock.release()

    def _limit_threads(self) -> None:
        threads = get_worker().state.nthreads
        if not self._is_limited and threads < (os.cpu_count() or 1):
            _lavalight.limit_threads(threads)
        self._is_limited = True

    def scene(self, model: Model, choice: Choice) -> _lavalight.Scene:
        key = (model.key, choice)
        if key not in self._scenes:
            while len(self._scenes) >= MOST_SCENES:
                self._scenes.popitem(last=False)
            self._scenes[key] = load(model, choice)
        self._scenes.move_to_end(key)
        return self._scenes[key]

    def render(self, model: Model, choice: Choice, task: Task) -> _lavalight.Render:
        """The render of the task before where only samples differ: its scene is on the device."""
        wanted = (model.key, choice, task.words, task.guides)
        render, self._render = self._render, None
        if render is None or self._rendered != wanted:
            del render  # its memory goes before the next one needs it
            first, end = task.samples
            words = [*task.words, f"--samples={first}:{end}"]
            return self.keep(wanted, _lavalight.Render.of_part(self.scene(model, choice), words, task.guides))
        render.take(*task.samples)
        return self.keep(wanted, render)

    def keep(self, wanted: tuple[Any, ...], render: _lavalight.Render) -> _lavalight.Render:
        self._rendered, self._render = wanted, render
        return render


_process = _Process()
atexit.register(_process.forget_render)  # before the drivers end with the process


def render_part(task: Task, model: Model, choice: Choice) -> Part:
    """A task of Dask's: the film of some samples."""
    watch = _Watch(task.job, task.samples)
    _process.take(watch)
    try:
        film = _process.render(model, choice, task).film(watch)
    except Reschedule:
        raise
    except BaseException:
        _process.forget_render()
        raise
    finally:
        _process.give_back()
    return Part(film, get_worker().address, processor())


def same(model: Model) -> Model:
    """A task of Dask's: brings a model to the workers. Unlike scattered data, it comes again where workers are lost."""
    return model
