"""The project's Markdown pages: fenced blocks, links, headings, tables; and the pages executed.

Each page is one session in an empty folder, its blocks one after the other.

* A block of `sh` is run by bash, which stops at the first command that fails; `# exit status 1` in it says how its
  last command has to end.
* A block of `python` is run as a script; names of the blocks before it on the page are there.
* A block of `text` that comes next, under the same heading, is what the block before prints: all of it, or all that its
  last command prints. A line `...` stands for any lines, `...` inside a line for any text.
* A block with a second word after the fence (```c main.c) is a file of that name, and only that. Files of docs/held
  that the page links to are there too.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import zip_longest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGES = (*sorted(ROOT.glob("*.md")), *sorted((ROOT / "docs").rglob("*.md")))


@dataclass(frozen=True)
class Block:
    """A fenced block: language (the first word after the fence), text, its number on the page, the name of the file
    that it is (the second word), how many headings stand before it."""

    page: Path
    number: int
    language: str
    text: str
    file: str = ""
    section: int = 0

    @property
    def name(self) -> str:
        return f"{self.page.name}-{self.number}"


def blocks(page: Path) -> list[Block]:
    """Fenced blocks of a page, in order."""
    fences: list[Block] = []
    text, end, section = page.read_text(encoding="utf-8"), 0, 0
    for fence in re.finditer(r"^```([^\n]*)\n(.*?)^```$", text, re.DOTALL | re.MULTILINE):
        section += len(re.findall(r"^#", text[end : fence.start()], re.MULTILINE))
        fences.append(Block(page, len(fences), _word(fence[1], 0), fence[2], _word(fence[1], 1), section))
        end = fence.end()
    return fences


def _word(head: str, number: int) -> str:
    """Language or file of a fence; a directive, `{name} argument`, has neither."""
    words = [] if head.startswith("{") else head.split()
    return words[number] if number < len(words) else ""


def prose(page: Path) -> str:
    """A page without its fenced blocks."""
    return re.sub(r"^```.*?^```$", "", page.read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)


def links(page: Path) -> list[str]:
    """Targets of links and images."""
    return re.findall(r"\]\(([^)\s]+)\)", prose(page))


def anchors(page: Path) -> set[str]:
    """Anchors that GitHub makes of the headings."""
    heads = re.findall(r"^#+ (.*)$", prose(page), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", head.lower()).strip().replace(" ", "-") for head in heads}


def tables(page: Path) -> Iterator[list[str]]:
    """Every table as its lines."""
    table: list[str] = []
    for line in (*prose(page).splitlines(), ""):
        if line.startswith("|"):
            table.append(line)
        elif table:
            yield table
            table = []


def cells(line: str) -> list[str]:
    """Cells of a table line; a pipe behind a backslash is text."""
    return [cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]]


def rows(page: Path, first: str) -> list[list[str]]:
    """Rows of all tables whose head begins with the cell `first`."""
    return [cells(line) for table in tables(page) if cells(table[0])[0] == first for line in table[2:]]


COMMANDS = ("sh", "python")
"""Languages of blocks that are run."""

MARK = "\0"
"""Bash prints it before every command: so the output of the last one is known."""


@dataclass(frozen=True)
class Step:
    """A block that is run, what it must print (None: not shown), and how its last command must end."""

    block: Block
    shown: str | None
    status: int


def steps(page: Path) -> Iterator[Step]:
    """All blocks of a page that are to be run, in order."""
    fences = blocks(page)
    for block, following in zip_longest(fences, fences[1:]):
        if block.language in COMMANDS and not block.file:
            shows = following is not None and (following.language, following.section) == ("text", block.section)
            shown = following.text if shows else None
            status = re.search(r"# exit status (\d+)", block.text)
            yield Step(block, shown, int(status[1]) if status else 0)


def files(page: Path, folder: Path) -> None:
    """Write the files that a page shows or links to; `main.c` also where a whole program has no name."""
    for held in re.findall(r"\]\((?:\.\./)?held/([\w/.]+)\)", page.read_text(encoding="utf-8")):
        (folder / held).parent.mkdir(exist_ok=True)
        shutil.copyfile(ROOT / "docs" / "held" / held, folder / held)
    for block in blocks(page):
        if block.file or (block.language == "c" and "int main(" in block.text):
            (folder / (block.file or "main.c")).write_text(block.text, encoding="utf-8")


class Session:
    """Runs blocks of one page in a folder; `outputs` are those of the commands of the last block."""

    def __init__(self, page: Path, folder: Path) -> None:
        self.folder = folder
        self.outputs: list[str] = []
        self.before: list[str] = []
        files(page, folder)

    def run(self, step: Step) -> None:
        """Runs a block; asserts how it ends and what it prints."""
        status = self._python(step.block.text) if step.block.language == "python" else self._shell(step.block.text)
        printed = "".join(self.outputs)
        assert status == step.status, f"{step.block.name}: exit status {status}\n{step.block.text}\n{printed}"
        if step.shown is not None:
            whole, last = matches(step.shown, printed), matches(step.shown, self.outputs[-1])
            assert whole or last, f"{step.block.name} shows\n{step.shown}\nbut prints\n{printed}"

    def _shell(self, text: str) -> int:
        commands = text.replace(".venv/bin/mahovik", "mahovik")
        script = f"exec 2>&1\nset -e\ntrap 'printf \"\\0\"' DEBUG\n{commands}"
        done = self._process(["bash"], script)
        self.outputs = done.stdout.split(MARK)[1:] or [""]
        return done.returncode

    def _python(self, text: str) -> int:
        again = "import contextlib as _c, io as _io\nwith _c.redirect_stdout(_io.StringIO()):\n    exec({!r})\n"
        done = self._process([sys.executable, "-"], "".join(again.format(b) for b in self.before) + text)
        self.before.append(text)
        self.outputs = [done.stdout]
        return done.returncode

    def _process(self, command: list[str], text: str) -> subprocess.CompletedProcess[str]:
        path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
        return subprocess.run(
            command,
            input=text,
            cwd=self.folder,
            env={**os.environ, "PATH": path, "LC_ALL": "C.UTF-8", "NO_COLOR": "1", "PYTHONUNBUFFERED": "1"},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            check=False,
        )


def matches(shown: str, printed: str) -> bool:
    """Is this what was printed? Spaces at the ends of lines and empty lines at both ends do not count."""
    return re.fullmatch(pattern(shown), lines(printed)) is not None


def lines(text: str) -> str:
    """Text without spaces at the ends of its lines, every line ended, no empty lines at the ends."""
    return "\n".join(line.rstrip() for line in text.splitlines()).strip("\n") + "\n"


def pattern(shown: str) -> str:
    """Regular expression for what is shown, with its elisions."""
    parts = []
    for line in lines(shown).splitlines():
        if line.strip() == "...":
            parts.append(r"(?:.*\n)*?")
        else:
            parts.append(".*?".join(map(re.escape, line.split("..."))) + r"\n")
    return "".join(parts)


def name(page: Path) -> str:
    """A page as it is called in reports."""
    return page.relative_to(ROOT).as_posix()
