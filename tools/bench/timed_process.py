"""A process, run to its end, and what it took."""
import os
import subprocess
import time
from dataclasses import dataclass


@dataclass
class Cost:
    seconds: float  # wall clock
    processor: float  # seconds of processor time, user and system


def run(command):
    start = time.perf_counter()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    _, status, used = os.wait4(process.pid, 0)
    seconds = time.perf_counter() - start
    process.returncode = os.waitstatus_to_exitcode(status)  # so that Popen does not wait for it
    if process.returncode != 0:
        raise SystemExit(f"{' '.join(map(str, command))} ended with {process.returncode}; its message is above")
    return Cost(seconds, used.ru_utime + used.ru_stime)
