"""What runs on Dask's workers: parts of images, and frames."""

from __future__ import annotations

import atexit
import os
import threading
import time
from collections import OrderedDict
from dataclasses import dataclass
from typing import Any

from distributed import Reschedule, Status, get_worker

from . import _lavalight
from ._bundle import Choice, Model, load
from ._image import Image

TOPIC = "lavalight-progress"
MOST_SCENES = 3  # that a process keeps loaded: of a frame, the next one and the first one
TELL_EVERY = 0.5  # seconds between two words on progress
PATIENCE = 2.0  # seconds that a task waits for its process before it asks for another one

@dataclass(frozen=True)
class Part:
    """A film's bytes, and where it was rendered."""

    film: bytes
    worker: str


@dataclass(frozen=True)
class PartTask:
    """A part as it is asked for."""

    job: str
    words: tuple[str, ...]
    guides: bool  # whether its film has what denoising reads
    samples: tuple[int, int]


@dataclass(frozen=True)
class FrameTask:
    """A frame of an animation as it is asked for."""

    job: str
    words: tuple[str, ...]
    number: int
    first: Choice  # of the animation's first frame, which decides where the camera is
    choice: Choice
    next: Choice | None  # of the frame that follows, where the layer of motion is asked for


class _Watch:
    """Asked about twenty times a second while a task renders: tells how far it is, and ends it where nobody waits for it."""

    def __init__(self, job: str, name: Any) -> None:
        try:
            self._worker: Any = get_worker()
        except ValueError:  # another scheduler of Dask's runs the task, which cannot be cancelled
            self._worker = None
        else:
            self._key = self._worker.get_current_task()
        self._job = job
        self._name = name
        self._told = time.monotonic()

    def __call__(self, fraction: float) -> None:
        self.require_wanted()
        now = time.monotonic()
        if now - self._told >= TELL_EVERY:
            self._told = now
            if self._worker is not None:
                self._worker.log_event(TOPIC, {"job": self._job, "task": self._name, "fraction": fraction})

    @property
    def threads(self) -> int:
        """How many threads the worker may use."""
        every = os.cpu_count() or 1
        return every if self._worker is None else min(every, self._worker.state.nthreads)

    @property
    def can_wait_elsewhere(self) -> bool:
        return self._worker is not None

    def require_wanted(self) -> None:
        """Raises Reschedule where the task was cancelled, or the worker closes. A cancelled task is not run again."""
        if self._worker is None:
            return
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
            if watch.can_wait_elsewhere and time.monotonic() - start > PATIENCE:
                raise Reschedule
        if not self._is_limited and watch.threads < (os.cpu_count() or 1):
            _lavalight.limit_threads(watch.threads)
        self._is_limited = True

    def forget_render(self) -> None:
        self._render = None

    def give_back(self) -> None:
        self._lock.release()

    def scene(self, model: Model, choice: Choice) -> _lavalight.Scene:
        key = (model.key, choice)
        if key not in self._scenes:
            while len(self._scenes) >= MOST_SCENES:
                self._scenes.popitem(last=False)
            self._scenes[key] = load(model, choice)
        self._scenes.move_to_end(key)
        return self._scenes[key]

    def render(self, model: Model, choice: Choice, task: PartTask) -> _lavalight.Render:
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


def render_part(task: PartTask, model: Model, choice: Choice) -> Part:
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
    return Part(film, get_worker().address)


def render_frame(task: FrameTask, model: Model) -> tuple[int, Image]:
    """A task of Dask's: a frame and its number."""
    watch = _Watch(task.job, task.number)
    _process.take(watch)
    try:
        _process.forget_render()
        first = _process.scene(model, task.first)
        following = _process.scene(model, task.next) if task.next is not None else None
        render = _lavalight.Render.of_frame(first, _process.scene(model, task.choice), following, list(task.words))
        return task.number, Image(render.advance(0.0, watch))
    finally:
        _process.give_back()


def render_frames(tasks: list[FrameTask], model: Model) -> list[tuple[int, Image]]:
    """A task of Dask's: a partition of a bag."""
    return [render_frame(task, model) for task in tasks]


def same(model: Model) -> Model:
    """A task of Dask's: brings a model to the workers. Unlike scattered data, it comes again where workers are lost."""
    return model
