"""Campaigns: each module measures the rows of one or more tables of docs/results.md. `tools/campaign.py` runs them.

A module has OPTIONS, their defaults by name, and TABLES by name. Linear algebra has one thread in each process.
"""

from __future__ import annotations

import os
import sys
from argparse import Namespace
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mahovik.__main__ import ONE_THREAD

for _name in ONE_THREAD:  # before NumPy is loaded
    os.environ.setdefault(_name, "1")

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "tests"))  # published cases and models of others stand there
REALS = ("double", "float")
CORES = os.cpu_count() or 1

Row = Mapping[str, Any]
Rows = Sequence[Row]
Cell = str | Callable[[Any], str]


@dataclass(frozen=True)
class Table:
    """A table of a campaign.

    measure  the rows for the campaign's options, in the order of the columns
    columns  format of each column by its title
    claim    what kept rows show, in a sentence
    good     whether a row is as promised; without it nothing is promised
    note     what stands above the table
    shown    rows that the page shows, made of those that are kept; without it all
    hidden   columns that the page does not show
    """

    measure: Callable[[Namespace], Iterable[Sequence[Any]]]
    columns: Mapping[str, Cell]
    claim: Callable[[Rows], str]
    good: Callable[[Row], bool] = lambda row: True
    note: str = ""
    shown: Callable[[Rows], Rows] = lambda rows: rows
    hidden: tuple[str, ...] = ()

    def rows(self, lines: Iterable[Sequence[Any]]) -> Iterator[Row]:
        """Rows by title."""
        return (dict(zip(self.columns, line, strict=True)) for line in lines)

    def text(self, rows: Rows) -> str:
        """The Markdown table of the rows that are shown: numbers to the right."""
        kept = self.shown(rows)
        titles = [title for title in kept[0] if title not in self.hidden]
        cells = [[cell(row[title], self.columns.get(title, usual_text)) for title in titles] for row in kept]
        numbers = [all(isinstance(row[title], int | float | None) for row in kept) for title in titles]
        rule = ["---:" if number else "---" for number in numbers]
        return "".join(f"| {' | '.join(line)} |\n" for line in (titles, rule, *cells))


def usual_text(value: Any) -> str:
    """A cell of a column without a format."""
    return f"{value:,.0f}" if isinstance(value, float) else str(value)


def cell(value: Any, form: Cell) -> str:
    """A cell as text; nothing for None."""
    if value is None:
        return ""
    return form(value) if callable(form) else form.format(value)


def at_most(value: str, limit: str) -> Callable[[Row], bool]:
    """Whether the figure of one column is at most that of another; without a limit nothing is promised."""
    return lambda row: row[limit] is None or row[value] <= row[limit]


def side_by_side(function: Callable[..., Any], jobs: int, *columns: Sequence[Any]) -> Iterator[Any]:
    """Results of the function for each row of the columns, in order: in `jobs` processes, or in this one."""
    if jobs == 1:
        yield from map(function, *columns)
        return
    with ProcessPoolExecutor(jobs) as pool:
        yield from pool.map(function, *columns)
