"""The command `lavalight`, also `python -m lavalight`."""

from __future__ import annotations

import sys

from . import _lavalight


def main() -> int:
    """Runs the command line of this process. `serve` is Python's; all else is the program's."""
    words = sys.argv[1:]
    if words[:1] == ["serve"]:
        from .serve import main as serve

        return serve(words[1:])
    return _lavalight.run_command(["lavalight", *words])


if __name__ == "__main__":
    sys.exit(main())
