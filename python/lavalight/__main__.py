"""The command `lavalight`, also `python -m lavalight`."""

from __future__ import annotations

import sys

from . import _lavalight


def main() -> int:
    """Runs the command line of this process."""
    return _lavalight.run_command(["lavalight", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
