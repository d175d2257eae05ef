"""What the tests share: small scenes, the command, the repository."""
import os
import subprocess
from pathlib import Path

import lavalight
import pytest

REPOSITORY = Path(__file__).resolve().parents[2]
SMALL = {"size": (16, 16), "spp": 2}


@pytest.fixture(scope="session")
def box():
    return lavalight.load("cornell-box")


@pytest.fixture(scope="session")
def triangle():
    return lavalight.Scene([lavalight.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]])], camera=lavalight.Camera((0.3, 0.3, 3), (0.3, 0.3, 0)))


@pytest.fixture(scope="session")
def command():
    """Runs the command; skips where it is not beside the module."""
    program = Path(os.environ.get("LAVALIGHT_COMMAND", REPOSITORY / "build/release/lavalight"))
    if not program.is_file():
        pytest.skip("the command is not built")

    def run(*words, **more):
        return subprocess.run([str(program), *map(str, words)], check=True, capture_output=True, text=True, **more)

    return run
