"""Renders on a Dask cluster: an image in parts, or an animation in frames.

    from dask.distributed import Client
    import lavalight.distributed

    client = Client("scheduler:8786")
    image = lavalight.distributed.render(lavalight.load("model.glb"), size=(1024, 1024), spp=1024)

Needs Dask's distributed: ``pip install lavalight[distributed]``.
"""

from __future__ import annotations

import queue
import time
import uuid
from collections import OrderedDict
from collections.abc import Callable, Generator, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import CancelledError
from contextlib import closing, suppress
from dataclasses import replace
from typing import Any

from . import _bundle, _keywords, _lavalight
from ._bar import Bar
from ._image import Image
from ._scene import Scene

try:
    import dask
    import distributed
    from distributed.scheduler import KilledWorker

    from . import _worker
except ImportError as error:
    raise ImportError(f"cannot import lavalight.distributed: {error}; try pip install \"lavalight[distributed]\"") from error

__all__ = ["bag", "frames", "progressive", "render"]

PARTS_PER_WORKER = 4  # by default: a lost worker loses a quarter of its work, and slow ones leave more to others
FEWEST_SAMPLES = 8  # of a part, by default
MOST_MODELS = 4  # that a cluster keeps for later renders
LOOK_EVERY = 0.2  # seconds, so that Ctrl-C is heard
COUNT_EVERY = 2.0  # seconds between two counts of the workers

Progress = bool | str | Callable[[float], object] | None

# Keywords that make the end of a render depend on all of its samples so far.
ENDLESS = {"time": "a time", "target_error": "an error"}


def render(scene: Scene, *, client: Any = None, parts: int | None = None, statistical: bool = False, priority: int = 0,
           retries: int = 0, progress: Progress = True, **keywords: Any) -> Image:
    """Renders an image in parts, on the workers of a Dask cluster. It has the bits of ``scene.render()``.

    client: a dask.distributed.Client; None: the one that is there. parts: how many tasks share the samples; None: by samples and
    workers. statistical: workers may be of different kinds, whose samples have equal means and not equal bits. priority, retries: as
    Client.submit() has them; parts of lost workers are rendered again without retries. progress: True shows a bar in a notebook or a
    terminal, "bar" in any case; or a function that takes the fraction done. All other keywords are those of ``scene.render()`` but
    time and target_error.

    Raises lavalight.Error as a render and merge() do. Ctrl-C and whatever progress raises end the renders on the workers.
    """
    image = None
    for image in _images(scene, client, parts, float("inf"), statistical, priority, retries, progress, keywords, "render"):
        pass
    assert image is not None
    return image


def progressive(scene: Scene, *, client: Any = None, parts: int | None = None, every: float = 0.5, statistical: bool = False,
                priority: int = 0, retries: int = 0, progress: Progress = None, **keywords: Any) -> Iterator[Image]:
    """Yields the image of all parts that have arrived, at most every so many seconds, and at last of all.

    Each is the mean of the samples that it has, in whatever order they came. The last image is that of render(). Leaving the loop, or
    close() of what this returns, ends the renders on the workers.
    """
    if not every >= 0.0:
        raise ValueError(f"every: {every!r} is not a time of 0 or more")
    return _images(scene, client, parts, every, statistical, priority, retries, progress, keywords, "progressive")


def frames(scene: Scene, numbers: range | tuple[int, int], *, fps: float = 24.0, in_order: bool = False, client: Any = None,
           priority: int = 0, retries: int = 0, progress: Progress = True, **keywords: Any) -> Iterator[tuple[int, Image]]:
    """Yields frames of an animation and their numbers, one task each, as they are done or in_order.

    Frame i shows the moment i / fps, with the bits of ``lavalight render --frames``. numbers: a range, or first and end. All other
    keywords are those of ``scene.render()``. Leaving the loop ends the renders on the workers.
    """
    words = _frame_words(scene, keywords, "frames")
    numbers = _range(numbers)
    _require_rate(fps)
    told = _Told(progress, scene.name)
    client = _client(client)
    return _frames(scene, client, words, numbers, fps, in_order, told, {"priority": priority, "retries": retries})


def bag(scene: Scene, numbers: range | tuple[int, int], *, fps: float = 24.0, **keywords: Any) -> Any:
    """The frames of frames() as a dask.bag of pairs, number and image, with a partition for each. Any scheduler of Dask's may run it.

    lavalight.distributed.bag(scene, range(48), size=(640, 360), spp=64).map(save).compute()
    """
    import dask.bag

    words = _frame_words(scene, keywords, "bag")
    _require_rate(fps)
    model = _bundle.model_of(scene._scene, scene._origin)
    sent = dask.delayed(model, traverse=False, name=f"lavalight-model-{model.key}-{uuid.uuid4().hex}")
    render_frames = dask.delayed(_worker.render_frames, pure=False)
    tasks = _frame_tasks(scene, "", words, _range(numbers), fps)
    return dask.bag.from_delayed([render_frames(dask.delayed([task], traverse=False), sent) for task in tasks.values()])


def _client(client: Any) -> Any:
    if client is not None:
        return client
    try:
        return distributed.get_client()
    except ValueError:
        raise _lavalight.Error("cannot find a Dask cluster: no client is open; try client=distributed.Client(), which starts workers on "
                               "this machine where it is given no address") from None


def _require_ends(keywords: Mapping[str, Any], function: str) -> None:
    for keyword, what in ENDLESS.items():
        if keywords.get(keyword) is not None:
            raise _lavalight.UsageError(f"{function}() cannot stop at {what}: parts of an image do not know of each other; give spp or "
                                        "samples")


# --- what the cluster keeps ---

class _Cluster:
    """What is shared by all renders of a client: models on the cluster, and the ear for progress."""

    def __init__(self, client: Any) -> None:
        self.ears: dict[str, Callable[[dict[str, Any]], None]] = {}
        self._models: OrderedDict[str, Any] = OrderedDict()
        client.subscribe_topic(_worker.TOPIC, self._hear)

    def _hear(self, event: tuple[float, Any]) -> None:
        message = event[1]
        ear = self.ears.get(message["job"])
        if ear is not None:
            ear(message)

    def model(self, client: Any, model: _bundle.Model) -> Any:
        """The future of a model. It is sent once, however many renders need it."""
        known = self._models.pop(model.key, None)
        if known is None or known.status in ("cancelled", "error"):
            with dask.config.set({"distributed.admin.large-graph-warning-threshold": "1 PiB"}):
                known = client.submit(_worker.same, model, key=f"lavalight-model-{model.key}", pure=False, priority=1)
        self._models[model.key] = known
        while len(self._models) > MOST_MODELS:
            self._models.popitem(last=False)
        return known


_clusters: dict[Any, _Cluster] = {}  # by client


def _cluster(client: Any) -> _Cluster:
    for known in [known for known in _clusters if known.status == "closed"]:
        del _clusters[known]
    if client not in _clusters:
        _clusters[client] = _Cluster(client)
    return _clusters[client]


# --- how far it is ---

class _Told:
    """Tells the caller how far a render is."""

    def __init__(self, progress: Progress, label: str) -> None:
        if isinstance(progress, str) and progress != "bar":
            raise ValueError(f"progress: {progress!r} is neither True, False, \"bar\" nor a function")
        self._call = progress if callable(progress) else None
        self._bar = Bar(label, progress == "bar") if progress is True or progress == "bar" else None
        self._most = 0.0

    def tell(self, fraction: float, text: str) -> None:
        self._most = max(self._most, fraction)  # parts of lost workers begin again
        if self._call is not None:
            self._call(self._most)
        if self._bar is not None:
            self._bar.show(self._most, text)

    def close(self) -> None:
        if self._bar is not None:
            self._bar.close()


# --- tasks ---

class _Run:
    """Tasks on a cluster: their results as they come, and how far they are."""

    def __init__(self, scene: Scene, client: Any, job: str, told: _Told, weights: Mapping[Any, float], what: str) -> None:
        self._scene = scene
        self._client = client
        self._job = job
        self._told = told
        self._weights = weights  # of each task in the fraction that is done
        self._fractions: dict[Any, float] = dict.fromkeys(weights, 0.0)
        self._what = what
        self._count = 0  # of workers
        self._counted = float("-inf")

    def results(self, function: Callable[..., Any], tasks: Mapping[Any, Any], name: Callable[[Any], str],
                **how: Any) -> Generator[tuple[Any, Any, bool], None, None]:
        """Each task's key and result, and whether no other has arrived meanwhile. Ends the tasks when it is left."""
        events: queue.SimpleQueue[Any] = queue.SimpleQueue()
        cluster = _cluster(self._client)
        model = cluster.model(self._client, _bundle.model_of(self._scene._scene, self._scene._origin))
        cluster.ears[self._job] = events.put
        futures = self._client.map(function, list(tasks.values()), model=model, pure=False,
                                   key=[f"lavalight-{self._job}-{name(key).replace(' ', '-')}" for key in tasks], **how)
        waiting = dict(zip(futures, tasks))
        try:
            for future in futures:
                future.add_done_callback(events.put)
            while waiting:
                try:
                    event = events.get(timeout=LOOK_EVERY)
                except queue.Empty:
                    continue
                if isinstance(event, dict):
                    self._hear(event["task"], event["fraction"], len(waiting))
                    continue
                key = waiting.pop(event)
                result = _result(event, name(key))
                event.release()  # its memory on the cluster
                self._hear(key, 1.0, len(waiting))
                yield key, result, events.empty()
        finally:
            del cluster.ears[self._job]
            self._told.close()
            with suppress(Exception):  # the cluster may be gone
                self._client.cancel(list(waiting))

    def _hear(self, key: Any, fraction: float, waiting: int) -> None:
        self._fractions[tuple(key) if isinstance(key, list) else key] = fraction
        done = sum(self._weights[each] * part for each, part in self._fractions.items()) / sum(self._weights.values())
        self._told.tell(done, f"{len(self._weights) - waiting} of {len(self._weights)} {self._what}, {self._workers()} workers")

    def _workers(self) -> int:
        """How many there are, asked of the scheduler once in a while."""
        now = time.monotonic()
        if now - self._counted >= COUNT_EVERY:
            self._counted = now
            with suppress(OSError, TimeoutError):
                self._count = len(self._client.nthreads())
        return self._count


# --- parts ---

Range = tuple[int, int]


def _split(first: int, count: int, parts: int) -> list[Range]:
    """Ranges of samples that differ by one in length."""
    ends = [first + count * part // parts for part in range(parts + 1)]
    return list(zip(ends, ends[1:]))


def _parts_of(parts: int | None, count: int, client: Any) -> int:
    if parts is None:
        workers = max(1, len(client.nthreads()))
        return max(1, min(PARTS_PER_WORKER * workers, count // FEWEST_SAMPLES))
    if isinstance(parts, bool) or not isinstance(parts, int) or parts < 1:
        raise ValueError(f"parts: {parts!r} is not a number of 1 or more")
    return min(parts, count)


def _name(samples: Range) -> str:
    return f"samples {samples[0]}:{samples[1]}"


class _Sum:
    """The parts that have arrived, as one film: memory does not grow with their number."""

    def __init__(self, words: list[str], holds_film: bool, statistical: bool) -> None:
        self._words = words
        self._holds_film = holds_film
        self._statistical = statistical
        self._film: _lavalight.Film | None = None

    def add(self, samples: Range, part: _worker.Part) -> None:
        film = _lavalight.Film.from_bytes(part.film, f"{_name(samples)} of {part.worker}")
        if self._film is None:
            self._film = film
        else:
            self._film.add(film, self._statistical)

    def image(self, complete: bool) -> Image:
        assert self._film is not None
        return Image(self._film.develop(self._words, self._holds_film, complete))


def _result(future: Any, name: str) -> Any:
    """What a task gave. Raises what it raised, and Error where it was lost."""
    try:
        return future.result()
    except KilledWorker as error:
        raise _lavalight.Error(f"cannot render {name}: {error.allowed_failures + 1} workers died of it, the last "
                               f"{error.last_worker.address}; try workers with more memory, and look into their logs") from error
    except CancelledError as error:
        raise _lavalight.Error(f"cannot render {name}: the task was cancelled by somebody else, or the cluster has ended") from error


def _images(scene: Scene, client: Any, parts: int | None, every: float, statistical: bool, priority: int, retries: int, progress: Progress,
            keywords: Mapping[str, Any], function: str) -> Iterator[Image]:
    _require_ends(keywords, function)
    words = _keywords.words(keywords, False, function)
    first, count = _lavalight.sample_range(scene.name, words)
    told = _Told(progress, scene.name)
    client = _client(client)
    ranges = _split(first, count, _parts_of(parts, count, client))
    holds_film = any(keywords.get(keyword) is not None for keyword in ("samples", "crop"))
    how = {"priority": priority, "retries": retries}
    return _images_of_parts(scene, client, words, ranges, _Sum(words, holds_film, statistical), told, every, how)


def _is_of_whole(word: str) -> bool:
    """Whether an option is of the merged image, and not of its parts."""
    return word.split("=")[0] in ("--spp", "--samples", "--denoise")


def _images_of_parts(scene: Scene, client: Any, words: list[str], ranges: Sequence[Range], total: _Sum, told: _Told, every: float,
                     how: Mapping[str, Any]) -> Iterator[Image]:
    job = uuid.uuid4().hex
    guides = any(word.split("=")[0] == "--denoise" for word in words)
    part_words = tuple(word for word in words if not _is_of_whole(word))
    tasks = {samples: _worker.PartTask(job, part_words, guides, samples) for samples in ranges}
    choice = _bundle.choice_of(scene._scene, scene._origin)
    arrived = 0
    last = time.monotonic()
    run = _Run(scene, client, job, told, {samples: samples[1] - samples[0] for samples in ranges}, "parts")
    with closing(run.results(_worker.render_part, tasks, _name, choice=choice, **how)) as results:
        for samples, part, is_last in results:
            total.add(samples, part)
            arrived += 1
            is_complete = arrived == len(ranges)
            if is_complete or (is_last and time.monotonic() - last >= every):
                yield total.image(is_complete)
                last = time.monotonic()


# --- frames ---

def _range(numbers: range | tuple[int, int]) -> range:
    if not isinstance(numbers, range):
        numbers = range(*numbers)
    if not numbers or min(numbers) < 0:
        raise ValueError(f"frames are numbers from 0 on, and {numbers!r} has none; try range(first, end)")
    return numbers


def _require_rate(fps: float) -> None:
    if not 0.0 < fps < float("inf"):
        raise ValueError(f"fps: {fps!r} is not a rate above 0")


def _frame_words(scene: Scene, keywords: Mapping[str, Any], function: str) -> list[str]:
    words = _keywords.words(keywords, False, function)
    _lavalight.sample_range(scene.name, words)  # refuses here what a worker would refuse
    if any(word.startswith("--at=") for word in scene._origin.words):
        raise _lavalight.UsageError(f"{function}() cannot show frames of a scene at one time; load() it without at")
    return words


def _frame_tasks(scene: Scene, job: str, words: Sequence[str], numbers: range, fps: float) -> dict[int, _worker.FrameTask]:
    choice = _bundle.choice_of(scene._scene, scene._origin)

    def at(number: int) -> _bundle.Choice:
        return replace(choice, words=(*choice.words, f"--at={number / fps!r}"))

    moves = any(word.startswith("--aov=") and "motion" in word for word in words)
    return {number: _worker.FrameTask(job, tuple(words), number, at(numbers[0]), at(number), at(number + 1) if moves else None)
            for number in numbers}


def _frames(scene: Scene, client: Any, words: Sequence[str], numbers: range, fps: float, in_order: bool, told: _Told,
            how: Mapping[str, Any]) -> Iterator[tuple[int, Image]]:
    job = uuid.uuid4().hex
    tasks = _frame_tasks(scene, job, words, numbers, fps)
    run = _Run(scene, client, job, told, dict.fromkeys(numbers, 1.0), "frames")
    with closing(run.results(_worker.render_frame, tasks, lambda number: f"frame {number}", **how)) as results:
        arrived = ((number, image) for number, (_, image), _ in results)
        yield from _in_order(arrived, numbers) if in_order else arrived


def _in_order(arrived: Iterable[tuple[int, Image]], numbers: range) -> Iterator[tuple[int, Image]]:
    """Holds back what comes before its turn."""
    kept: dict[int, Image] = {}
    due = iter(numbers)
    following = next(due, None)
    for number, image in arrived:
        kept[number] = image
        while following is not None and following in kept:
            yield following, kept.pop(following)
            following = next(due, None)
