"""The queue: so many renders at once, so many behind them, and none for clients that have gone."""

from __future__ import annotations

import asyncio
import threading
import time
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from typing import TypeVar

from ._refusal import ClientGone, Refusal
from ._settings import Limits

Result = TypeVar("Result")


class Job:
    """A render under way. `go_on` is for the engine, which asks it between waves of samples."""

    def __init__(self, seconds: float) -> None:
        self._end = time.monotonic() + seconds
        self._seconds = seconds
        self._reason: Exception | None = None

    def stop(self, reason: Exception) -> None:
        """Ends the render soon, from any thread."""
        if self._reason is None:
            self._reason = reason

    def go_on(self, fraction: float = 0.0) -> None:
        """Raises where the render has to end."""
        del fraction
        if self._reason is not None:
            raise self._reason
        if time.monotonic() > self._end:
            raise self.too_long()

    def too_long(self) -> Refusal:
        return Refusal(504, f"cannot render this within {self._seconds:g} seconds; try fewer samples or pixels, "
                            "or start the server with a higher --max-seconds")


class Renders:
    """Runs work in threads, in the order that it was asked for."""

    # What loading may take beyond the limit before the client is told: a file cannot be loaded by halves.
    GRACE = 5.0

    def __init__(self, limits: Limits) -> None:
        self._limits = limits
        self._pool = ThreadPoolExecutor(limits.renders, thread_name_prefix="render")
        self._slots = asyncio.Semaphore(limits.renders)
        self._jobs: set[Job] = set()
        self._lock = threading.Lock()
        self._is_closed = False
        self.count = 0  # running and waiting

    @property
    def ahead(self) -> int:
        """Requests that a new one would wait for."""
        return max(0, self.count - self._limits.renders + 1)

    def close(self) -> None:
        """Ends all renders, and takes no more."""
        self._is_closed = True
        with self._lock:
            for job in self._jobs:
                job.stop(self._closed())

    @staticmethod
    def _closed() -> Refusal:
        return Refusal(503, "cannot render: the server is stopping")

    async def run(self, work: Callable[[Job], Result]) -> Result:
        """The work's result. If the caller is cancelled, so is the work, whose place is free once its thread has noticed."""
        if self._is_closed:
            raise self._closed()
        if self.count >= self._limits.renders + self._limits.waiting:
            raise Refusal(503, f"cannot render now: {self.count} requests are before this one; try again later", {"Retry-After": "5"})
        self.count += 1
        try:
            await self._slots.acquire()
        except BaseException:
            self.count -= 1
            raise
        job = Job(self._limits.seconds)
        with self._lock:
            self._jobs.add(job)
        if self._is_closed:
            job.stop(self._closed())
        loop = asyncio.get_running_loop()
        running: Future[Result] = self._pool.submit(self._start, job, work)
        running.add_done_callback(lambda _: self._release(loop, job))
        try:
            return await asyncio.wait_for(asyncio.wrap_future(running), self._limits.seconds + self.GRACE)
        except asyncio.TimeoutError:
            job.stop(job.too_long())
            raise job.too_long() from None
        except asyncio.CancelledError:
            job.stop(ClientGone())
            raise

    @staticmethod
    def _start(job: Job, work: Callable[[Job], Result]) -> Result:
        job.go_on()
        return work(job)

    def _release(self, loop: asyncio.AbstractEventLoop, job: Job) -> None:
        with self._lock:
            self._jobs.discard(job)

        def release() -> None:
            self.count -= 1
            self._slots.release()

        try:
            loop.call_soon_threadsafe(release)
        except RuntimeError:
            pass  # the loop has ended, and nobody waits for the place
