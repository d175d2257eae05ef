"""The lectures' experiments as tables."""

from __future__ import annotations

import html
import json
from typing import Any

from . import _lavalight


class Table:
    """Rows of one estimate: a list of dictionaries, one a row, by the columns' keys."""

    def __init__(self, values: dict[str, Any]) -> None:
        self.name: str = values["name"]
        self.title: str = values["title"]
        self.columns: dict[str, str] = {column["key"]: column["heading"] for column in values["columns"]}
        self.rows: list[dict[str, Any]] = values["rows"]
        self.notes: list[str] = values["notes"]
        self._text: str = values["text"]

    def column(self, key: str) -> list[Any]:
        """The cells of a column. Raises KeyError for one that there is not."""
        if key not in self.columns:
            raise KeyError(f"cannot find column {key!r}; try one of {', '.join(self.columns)}")
        return [row.get(key) for row in self.rows]

    def __str__(self) -> str:
        return self._text

    def __repr__(self) -> str:
        return f"<lavalight.Table {self.name}, {len(self.rows)} rows>"

    def _repr_html_(self) -> str:
        head = "".join(f"<th>{html.escape(heading)}</th>" for heading in self.columns.values())
        rows = "".join("<tr>" + "".join(f"<td>{html.escape(_shown(row.get(key)))}</td>" for key in self.columns) + "</tr>"
                       for row in self.rows)
        notes = "".join(f"<p>{html.escape(note)}</p>" for note in self.notes)
        return f"<h4>{html.escape(self.title)}</h4><table><tr>{head}</tr>{rows}</table>{notes}"


def _shown(cell: object) -> str:
    if cell is None:
        return ""
    return f"{cell:.6g}" if isinstance(cell, float) else str(cell)


def lab(experiment: str, *, samples: int = 0, seed: int = 0) -> list[Table]:
    """Runs an experiment of ``lavalight lab``: "dice", "strata", "mis", ... (see experiments())."""
    return [Table(values) for values in json.loads(_lavalight.lab_json(experiment, samples, seed))]


def experiments() -> dict[str, str]:
    """The question of each experiment, by its name."""
    return dict(_lavalight.experiments())
