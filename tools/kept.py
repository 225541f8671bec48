"""Results of campaigns as they are kept, `docs/results/NAME.json`, and the pages that are rendered from them.

A campaign measures and keeps its figures here; its part of a page is rendered from the kept figures alone, under a
line that says how they were measured, and whether by the code as it is now. `python tools/results.py` renders all.
"""

from __future__ import annotations

import json
import math
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from random import Random
from typing import Any

import campaign
from code_hash import code_hash

Figures = dict[str, Any]
Rows = Sequence[Mapping[str, Any]]

UNKNOWN = "unknown"
"""Instead of a hash: measured before hashes were kept."""

NOT_SAMPLED = {
    "python": "wall-clock times of one machine",
    "tables": "wall-clock times of one machine",
    "measured-speed": "wall-clock times of one machine",
    "campaign-speed": "times of one machine",
    "campaigns": "wall-clock times of one machine",
    "campaign-faults": "some minutes of faults at moments that no seed repeats; tests have faults of every kind",
    "generation": "wall-clock times of one machine",
    "start": "wall-clock times of one machine",
    "profile": "wall-clock times of one machine",
    "install": "times of one machine and its network",
    "jitter-sweep": "wall-clock times of one machine",
    "identification": "minutes of the literal reference; tests identify two flywheels from its data",
    "fuzzing": "its inputs grow from campaign to campaign; `make fuzz-quick` runs the same harnesses",
    "benchmarks": "times of one machine beside those of peers; `make bench-gate` counts our instructions again",
    "proofs": "a quarter of an hour of Frama-C; `make proofs-quick` repeats some",
}
"""Results that no test measures again, and why."""


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
class Measured:
    """A figure that was measured again. `factor`: how many times larger or smaller than the kept one it may be."""

    name: str
    kept: Any
    now: Any
    factor: float = 1.0

    @property
    def good(self) -> bool:
        """Whether it is inside its spread."""
        if self.kept == self.now:
            return True
        numbers = all(isinstance(x, int | float) and not isinstance(x, bool) for x in (self.kept, self.now))
        if not numbers or min(self.kept, self.now) <= 0.0 or not math.isfinite(self.now):
            return False
        return bool(max(self.kept, self.now) <= self.factor * min(self.kept, self.now))


@dataclass(frozen=True)
class Result:
    """The figures to keep: figures, and how they were measured.

    command   the command line
    seed      first seed of what was drawn; None: nothing is drawn, or always the same
    code      hash of the code that it depends on, or UNKNOWN
    """

    command: str
    seed: int | None
    code: str
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
    """A campaign: the name of its file, its part of a page, and the code that its figures depend on.

    page     the text of the block from the figures
    code     parts of the package or of tools/ besides those that all depend on, see `code_hash`
    sample   measures some of the kept figures again; None where NOT_SAMPLED says why
    also     other blocks that are rendered from the same figures, without the line on top
    """

    name: str
    block: campaign.Block
    page: Callable[[Figures], str]
    code: tuple[str, ...]
    sample: Callable[[Figures, Random], Iterator[Measured]] | None = None
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

    def keep(
        self, figures: Figures, seed: int | None = None, *, code: str | None = None, command: str | None = None
    ) -> None:
        """Keep figures that were measured just now by the command that runs, and render them.

        `code`: the hash of older code that a part of them is of. `command`: where it is no file of tools/.
        """
        words = command or " ".join(["python", f"tools/{Path(sys.argv[0]).name}", *sys.argv[1:]])
        result = Result(words, seed, code or code_hash(self.code), plain(figures))
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
        """Command, seed, code, and whether tests measure it again."""
        seed = "" if result.seed is None else f" Seeds from {result.seed}."
        again = (
            "A sample is measured again by the tests."
            if self.sample
            else f"No test measures it again: {NOT_SAMPLED.get(self.name, 'no reason is given')}."
        )
        return f"Command: `{result.command}`.{seed} {self.age(result)} {again}"

    def is_current(self, result: Result) -> bool:
        """Whether the code that it depends on is the same as when it was measured."""
        return result.code == code_hash(self.code)

    def age(self, result: Result) -> str:
        """Whether the result is current, as a sentence."""
        if self.is_current(result):
            return "Measured with the code as it is now."
        which = "" if result.code == UNKNOWN else f" ({result.code[:8]})"
        return f"**Measured with older code{which}**."


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
