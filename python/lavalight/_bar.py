"""A progress bar, in terminals and notebooks."""

from __future__ import annotations

import html
import sys
import time
from typing import Any

WIDTH = 30  # of a terminal's bar
EVERY = 0.1  # seconds between two looks


def _notebook_display() -> Any:
    """IPython's display(), where this process is a notebook's kernel; else None."""
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython is not None else None
    if shell is None or not hasattr(shell, "kernel"):
        return None
    from IPython.display import display

    return display


class Bar:
    """Shows a fraction, and a word on it, where somebody looks: a notebook, or a terminal behind stderr."""

    def __init__(self, label: str, always: bool = False) -> None:
        self._label = label
        self._start = time.monotonic()
        self._shown = 0.0
        self._handle: Any = None
        self._display = _notebook_display()
        self._isatty = sys.stderr is not None and (always or sys.stderr.isatty())

    def show(self, fraction: float, text: str) -> None:
        now = time.monotonic()
        if fraction < 1.0 and now - self._shown < EVERY:
            return
        self._shown = now
        line = f"{fraction:4.0%}  {text}{self._left(fraction, now)}"
        if self._display is not None:
            self._show_in_notebook(fraction, line)
        elif self._isatty:
            full = round(WIDTH * fraction)
            sys.stderr.write(f"\r{self._label} [{'#' * full}{'.' * (WIDTH - full)}] {line}\x1b[K")
            sys.stderr.flush()

    def close(self) -> None:
        if self._display is None and self._isatty and self._shown:
            sys.stderr.write("\n")
            sys.stderr.flush()

    def _left(self, fraction: float, now: float) -> str:
        """Seconds that the rest takes at the pace so far."""
        passed = now - self._start
        if not 0.01 < fraction < 1.0 or passed < 1.0:
            return ""
        return f", {passed * (1.0 - fraction) / fraction:.0f} s left"

    def _show_in_notebook(self, fraction: float, line: str) -> None:
        from IPython.display import HTML

        shown = HTML(f"<div>{html.escape(self._label)} <progress max='1' value='{fraction:.4f}'></progress> {html.escape(line)}</div>")
        if self._handle is None:
            self._handle = self._display(shown, display_id=True)
        else:
            self._handle.update(shown)
