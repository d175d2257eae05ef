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
import weakref
from collections import OrderedDict
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import CancelledError
from contextlib import suppress
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

__all__ = ["progressive", "render"]

PARTS_PER_WORKER = 4  # by default: a lost worker loses a quarter of its work, and slow ones leave more to others
FEWEST_SAMPLES = 8  # of a part, by default
MOST_MODELS = 4  # that a cluster keeps for later renders
LOOK_EVERY = 0.2  # seconds, so that Ctrl-C is heard

Progress = bool | str | Callable[[float], object] | None

# Keywords that make the end of a render depend on all of its samples so far.
ENDLESS = {"time": "a time", "target_error": "an error"}


def render(scene: Scene, *, client: Any = None, parts: int | None = None, priority: int = 0, retries: int = 0,
           progress: Progress = True, **keywords: Any) -> Image:
    """Renders an image in parts, on the workers of a Dask cluster. It has the bits of ``scene.render()``.

    client: a dask.distributed.Client; None: the one that is there. parts: of how many samples each are taken is up to it; None: by
    samples and workers. priority, retries: as Client.submit() has them; parts of lost workers are rendered again without retries.
    progress: True shows a bar in a notebook or a terminal, "bar" in any case; or a function that takes the fraction done. All other
    keywords are those of ``scene.render()`` but time and target_error.

    Raises lavalight.Error as a render and merge() do. Ctrl-C and whatever progress raises end the renders on the workers.
    """
    image = None
    for image in _images(scene, client, parts, priority, retries, progress, float("inf"), keywords, "render"):
        pass
    assert image is not None
    return image


def progressive(scene: Scene, *, client: Any = None, parts: int | None = None, every: float = 0.5, priority: int = 0, retries: int = 0,
                progress: Progress = None, **keywords: Any) -> Iterator[Image]:
    """Yields the image of all parts that have arrived, at most every so many seconds, and at last of all.

    Each is the mean of the samples that it has, in whatever order they came. The last image is that of render(). Leaving the loop, or
    close() of what this returns, ends the renders on the workers.
    """
    if not every >= 0.0:
        raise ValueError(f"every: {every!r} is not a time of 0 or more")
    return _images(scene, client, parts, priority, retries, progress, every, keywords, "progressive")


def _client(client: Any) -> Any:
    if client is not None:
        return client
    try:
        return distributed.get_client()
    except ValueError:
        raise _lavalight.Error("cannot find a Dask cluster: there is no client; try client=distributed.Client(), which starts workers on "
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


_clusters: weakref.WeakKeyDictionary[Any, _Cluster] = weakref.WeakKeyDictionary()


def _cluster(client: Any) -> _Cluster:
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

    def __init__(self, words: list[str], holds_film: bool) -> None:
        self._words = words
        self._holds_film = holds_film
        self._film: _lavalight.Film | None = None
        self._first: _worker.Part | None = None

    def add(self, samples: Range, part: _worker.Part) -> None:
        film = _lavalight.Film.from_bytes(part.film, f"{_name(samples)} of {part.worker}")
        if self._film is None or self._first is None:
            self._film, self._first = film, part
            return
        _require_alike(self._first, part)
        self._film.add(film)

    def image(self, complete: bool) -> Image:
        assert self._film is not None
        return Image(self._film.develop(self._words, self._holds_film, complete))


def _require_alike(first: _worker.Part, part: _worker.Part) -> None:
    """What films do not say of where they were rendered, and their bits may depend on."""
    if first.processor != part.processor:
        raise _lavalight.Error(f"cannot merge parts of {first.worker} and {part.worker}: their processors differ ({first.processor}; "
                               f"{part.processor}), and so may bits of the image; try workers of one kind")


def _result(future: Any, name: str) -> Any:
    """What a task gave. Raises what it raised, and Error where it was lost."""
    try:
        return future.result()
    except KilledWorker as error:
        raise _lavalight.Error(f"cannot render {name}: {error.allowed_failures + 1} workers died of it, the last {error.last_worker.address}; "
                               "try workers with more memory, and look into their logs") from error
    except CancelledError as error:
        raise _lavalight.Error(f"cannot render {name}: the task was cancelled by somebody else, or the cluster has ended") from error


def _images(scene: Scene, client: Any, parts: int | None, priority: int, retries: int, progress: Progress, every: float,
            keywords: Mapping[str, Any], function: str) -> Iterator[Image]:
    _require_ends(keywords, function)
    words = _keywords.words(keywords, False, function)
    first, count = _lavalight.sample_range(scene.name, words)
    told = _Told(progress, scene.name)
    client = _client(client)
    ranges = _split(first, count, _parts_of(parts, count, client))
    holds_film = any(keywords.get(keyword) is not None for keyword in ("samples", "crop"))
    return _arrivals(scene, client, words, ranges, _Sum(words, holds_film), told, every, {"priority": priority, "retries": retries})


def _is_of_whole(word: str) -> bool:
    """Whether an option is of the merged image, and not of its parts."""
    return word.split("=")[0] in ("--spp", "--samples", "--denoise")


def _arrivals(scene: Scene, client: Any, words: list[str], ranges: Sequence[Range], total: _Sum, told: _Told, every: float,
              how: Mapping[str, Any]) -> Iterator[Image]:
    cluster = _cluster(client)
    job = uuid.uuid4().hex
    events: queue.SimpleQueue[Any] = queue.SimpleQueue()
    cluster.ears[job] = events.put
    guides = any(word.split("=")[0] == "--denoise" for word in words)
    part_words = tuple(word for word in words if not _is_of_whole(word))
    tasks = [_worker.Task(job, part_words, guides, samples) for samples in ranges]
    model = cluster.model(client, _bundle.model_of(scene._scene, scene._origin))
    choice = _bundle.choice_of(scene._scene, scene._origin)
    futures = client.map(_worker.render_part, tasks, model=model, choice=choice, pure=False,
                         key=[f"lavalight-part-{job}-{first}:{end}" for first, end in ranges], **how)
    samples_of = dict(zip(futures, ranges))
    try:
        for future in futures:
            future.add_done_callback(events.put)
        fractions = dict.fromkeys(ranges, 0.0)
        arrived = 0
        last = time.monotonic()
        while arrived < len(ranges):
            try:
                event = events.get(timeout=LOOK_EVERY)
            except queue.Empty:
                continue
            if isinstance(event, dict):
                fractions[tuple(event["task"])] = event["fraction"]
            else:
                samples = samples_of[event]
                total.add(samples, _result(event, _name(samples)))
                event.release()
                fractions[samples] = 1.0
                arrived += 1
            told.tell(_done(fractions), f"{arrived} of {len(ranges)} parts, {len(client.nthreads())} workers")
            is_complete = arrived == len(ranges)
            if is_complete or (not isinstance(event, dict) and time.monotonic() - last >= every and events.empty()):
                yield total.image(is_complete)
                last = time.monotonic()
    finally:
        del cluster.ears[job]
        told.close()
        with suppress(Exception):  # the cluster may be gone
            client.cancel([future for future in futures if not future.done()], reason="lavalight: nobody waits for it")


def _done(fractions: Mapping[Range, float]) -> float:
    total = sum(end - first for first, end in fractions)
    return sum((end - first) * fraction for (first, end), fraction in fractions.items()) / total
