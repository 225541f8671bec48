"""Common parts of the tools: options, seeds and processes, and the block that each writes into a page.

Import it before NumPy: linear algebra then has one thread in each process.
"""

from __future__ import annotations

import argparse
import os
import platform
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mahovik.__main__ import ONE_THREAD

for _name in ONE_THREAD:
    os.environ.setdefault(_name, "1")

ROOT = Path(__file__).resolve().parents[1]

HELP = {
    "first": "first seed",
    "jobs": "processes at once",
    "page": "write the page",
    "rows": "only rows whose line holds this text; nothing is written",
    "seconds": "limit of each run, s",
    "seeds": "number of seeds",
    "stands": "number of stands, of each row where there are rows",
    "states": "states of each stand",
    "write": "write the result into the page",
}


@dataclass(frozen=True)
class Block:
    """The part of a page between the marks `<!-- opening -->` and `<!-- end of ... -->`, which a tool writes.

    page      path from the root of the repository
    opening   words of the first mark; those before its colon are in the last mark as well
    """

    page: str
    opening: str

    @property
    def path(self) -> Path:
        """The page."""
        return ROOT / self.page

    def _split(self) -> tuple[str, str, str]:
        begin, end = f"<!-- {self.opening} -->", f"<!-- end of {self.opening.partition(':')[0]} -->"
        before, found, rest = self.path.read_text(encoding="utf-8").partition(begin)
        text, ended, after = rest.partition(end)
        if not found or not ended:
            raise SystemExit(f"{self.page}: expected {begin} and then {end}")
        return before + begin, text, end + after

    def text(self) -> str:
        """What stands between the marks, without blank lines around it. Raises SystemExit: no such marks."""
        return self._split()[1].strip("\n")

    def page_with(self, text: str) -> str:
        """The whole page with this text between the marks. Raises SystemExit: no such marks."""
        before, _, after = self._split()
        inner = text.strip("\n")
        return f"{before}\n\n{inner}\n\n{after}"

    def write(self, text: str) -> None:
        """Write the text between the marks. Raises SystemExit: no such marks."""
        self.path.write_text(self.page_with(text), encoding="utf-8", newline="\n")


def parser(about: str | None, **defaults: Any) -> argparse.ArgumentParser:
    """The parser of a tool: `about` is its docstring, and each option has a default, `stands=4` for `--stands 4`.

    An option whose default is False is a flag.
    """
    made = argparse.ArgumentParser(description=(about or "").partition("\n")[0])
    for name, default in defaults.items():
        option = f"--{name.replace('_', '-')}"
        if default is False:
            made.add_argument(option, action="store_true", help=HELP.get(name))
        else:
            made.add_argument(option, type=type(default), default=default, help=HELP.get(name))
    return made


def cores() -> int:
    """Number of processors."""
    return os.cpu_count() or 1


def seeds(first: int, count: int) -> range:
    """`count` seeds from the first."""
    return range(first, first + count)


def map_rows(function: Callable[..., Any], jobs: int, *columns: Sequence[Any]) -> Iterator[Any]:
    """Results of the function for each row of the columns, in order: in `jobs` processes, or in this one."""
    if jobs == 1:
        yield from map(function, *columns)
        return
    with ProcessPoolExecutor(jobs) as pool:
        yield from pool.map(function, *columns)


def row(*cells: object) -> str:
    """A row of a Markdown table, without an end of line."""
    return f"| {' | '.join(map(str, cells))} |"


def table(head: Sequence[object], rows: Sequence[Sequence[object]], words: int | None = 1) -> str:
    """A Markdown table: its first columns hold words, the others numbers. `words` None: all hold words."""
    first = len(head) if words is None else words
    rule = [*["---"] * first, *["---:"] * (len(head) - first)]
    return "".join(f"{row(*cells)}\n" for cells in (head, rule, *rows))


def processor() -> str:
    """Name of the processor as Linux has it; else the machine's kind."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        return platform.machine()
    return next((line.partition(":")[2].strip() for line in lines if line.startswith("model name")), platform.machine())
