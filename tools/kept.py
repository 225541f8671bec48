"""Results of campaigns as they are kept, `docs/results/NAME.json`, and the pages that are rendered from them.

A campaign measures and keeps its figures here; its part of a page is rendered from the kept figures alone, under a
line that says by which command, of which commit, when and on which processor they were measured.
`python tools/results.py` renders all.
"""

from __future__ import annotations

import json
import math
import subprocess
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import campaign

Figures = dict[str, Any]
Rows = Sequence[Mapping[str, Any]]


@dataclass(frozen=True)
class Columns:
    """Columns of a table and their formats: a row is a mapping by title, or a sequence that `rows` makes one of.

    forms   format of each column by its title; a cell that is a list fills several fields; None is an empty cell
    words   number of columns of words, the rest are numbers; None: all are words
    """

    forms: Mapping[str, str | Callable[[Any], str]]
    words: int | None = 1

    def rows(self, lines: Iterable[Sequence[Any]]) -> list[dict[str, Any]]:
        """Rows by title."""
        return [dict(zip(self.forms, line, strict=True)) for line in lines]

    def line(self, row: Mapping[str, Any]) -> list[str]:
        """The cells of a row as text."""
        return [cell_text(row[title], form) for title, form in self.forms.items()]

    def text(self, rows: Rows) -> str:
        """The Markdown table."""
        return campaign.table(list(self.forms), [self.line(row) for row in rows], self.words)


def cell_text(value: Any, form: str | Callable[[Any], str]) -> str:
    """A cell as text."""
    if value is None:
        return ""
    if callable(form):
        return form(value)
    return form.format(*value) if isinstance(value, list | tuple) else form.format(value)


@dataclass(frozen=True)
class Result:
    """The figures to keep: figures, and how they were measured.

    command    the command line
    seed       first seed of what was drawn; None: nothing is drawn, or always the same
    commit     short hash of the commit that was measured
    date       day of the measurement, YYYY-MM-DD
    processor  name of the processor; empty: not kept
    """

    command: str
    seed: int | None
    commit: str
    date: str
    processor: str
    figures: Figures

    def text(self) -> str:
        """The file: each row of a table on a line."""
        return _lines(vars(self), 0) + "\n"


def _lines(value: Any, depth: int) -> str:
    """JSON in which what holds no table stands on a line."""
    if not isinstance(value, dict | list) or not _has_rows(value):
        return json.dumps(value, ensure_ascii=False, allow_nan=False)
    pad = "  " * (depth + 1)
    inner = (
        [f"{pad}{json.dumps(key, ensure_ascii=False)}: {_lines(each, depth + 1)}" for key, each in value.items()]
        if isinstance(value, dict)
        else [pad + _lines(each, depth + 1) for each in value]
    )
    marks = "{}" if isinstance(value, dict) else "[]"
    return f"{marks[0]}\n" + ",\n".join(inner) + f"\n{'  ' * depth}{marks[1]}"


def _has_rows(value: Any) -> bool:
    inside = value.values() if isinstance(value, dict) else value
    if isinstance(value, list):
        return any(isinstance(each, dict | list) for each in inside)
    return any(isinstance(each, dict) or (isinstance(each, list) and _has_rows(each)) for each in inside)


@dataclass(frozen=True)
class Campaign:
    """A campaign: the name of its file and its part of a page.

    page     the text of the block from the figures
    also     other blocks that are rendered from the same figures, without the line on top
    """

    name: str
    block: campaign.Block
    page: Callable[[Figures], str]
    also: tuple[tuple[campaign.Block, Callable[[Figures], str]], ...] = ()

    @property
    def path(self) -> Path:
        """The file of its figures."""
        return campaign.ROOT / "docs" / "results" / f"{self.name}.json"

    def result(self) -> Result:
        """The figures to keep. Raises SystemExit: no file."""
        if not self.path.is_file():
            raise SystemExit(f"docs/results/{self.name}.json: not there; expected the figures of {self.block.page}")
        return Result(**json.loads(self.path.read_text(encoding="utf-8")))

    def figures(self) -> Figures:
        """The kept figures."""
        return self.result().figures

    def keep(self, figures: Figures, seed: int | None = None, *, command: str | None = None) -> None:
        """Keep figures that were measured just now by the command that runs, and render them.

        `command`: where it is no file of tools/.
        """
        words = command or " ".join(["python", f"tools/{Path(sys.argv[0]).name}", *sys.argv[1:]])
        today = datetime.now(UTC).date().isoformat()
        result = Result(words, seed, _commit(), today, campaign.processor(), plain(figures))
        self.path.write_text(result.text(), encoding="utf-8", newline="\n")
        self.render()

    def text(self) -> str:
        """The block as the kept figures say."""
        result = self.result()
        return f"{self.provenance(result)}\n\n{self.page(result.figures)}"

    def render(self) -> None:
        """Write the blocks."""
        self.block.write(self.text())
        for block, page in self.also:
            block.write(page(self.figures()))

    def provenance(self, result: Result) -> str:
        """Command, seed, commit, date and processor, as sentences."""
        seed = "" if result.seed is None else f" Seeds from {result.seed}."
        processor = f", {result.processor}" if result.processor else ""
        return f"Command: `{result.command}`.{seed} Measured {result.date}, commit {result.commit}{processor}."


def _commit() -> str:
    words = ["git", "rev-parse", "--short=8", "HEAD"]
    return subprocess.run(words, cwd=campaign.ROOT, capture_output=True, text=True, check=True).stdout.strip()


def plain(value: Any) -> Any:
    """The value in what JSON has: no tuples, no types of NumPy, no numbers that are not finite."""
    if isinstance(value, Mapping):
        return {str(key): plain(each) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [plain(each) for each in value]
    if value is None or isinstance(value, str | bool | int):
        return value
    number = value.item() if hasattr(value, "item") else value
    return number if isinstance(number, int) or math.isfinite(number) else None
