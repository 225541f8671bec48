"""The project's Markdown pages: fenced blocks, links, headings, tables."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
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
