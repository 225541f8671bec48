"""Reports of example stands, a page as its reader has it, and pieces of evidence that say what a test wants."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from html.parser import HTMLParser
from pathlib import Path

from mahovik.core.stand import load
from mahovik.proof.evidence import Outcome, Piece, collect
from mahovik.stands import path

VOID = {"meta", "link", "br", "img", "input", "hr", "source", "path", "circle", "line", "rect", "polygon", "polyline"}
"""Elements without an end; those of SVG may have one."""


APART = {"td", "th", "tr", "p", "dt", "dd", "li", "div", "caption", "figcaption", "h1", "h2", "h3", "button", "title"}
"""Elements whose text does not run on into what follows."""


@dataclass
class Page:
    """Content of a page: text by section, attributes by element, faults of its structure."""

    text: str = ""
    sections: list[str] = field(default_factory=list)
    attributes: list[tuple[str, str, str]] = field(default_factory=list)
    wrong: list[str] = field(default_factory=list)


class Reader(HTMLParser):
    """Reads a page; every element must end where it has to, ids must be there once."""

    def __init__(self) -> None:
        super().__init__(convert_charrefs=True)
        self.seen = Page()
        self.open: list[str] = []
        self.ids: set[str] = set()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        for name, value in attrs:
            self.seen.attributes.append((tag, name, value or ""))
            if name == "id":
                if value in self.ids:
                    self.seen.wrong.append(f"id {value} twice")
                self.ids.add(str(value))
                if tag == "section":
                    self.seen.sections.append(str(value))
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.handle_starttag(tag, attrs)
        if tag not in VOID:
            self.open.pop()

    def handle_endtag(self, tag: str) -> None:
        if tag in APART:
            self.seen.text += " "
        if tag in VOID:
            return
        if not self.open or self.open[-1] != tag:
            self.seen.wrong.append(f"</{tag}> where {self.open[-1:]} is open")
        else:
            self.open.pop()

    def handle_data(self, data: str) -> None:
        if self.open[-1:] not in (["style"], ["script"]):
            self.seen.text += data


def read(page: str) -> Page:
    """A page, read."""
    reader = Reader()
    reader.feed(page)
    reader.close()
    reader.seen.wrong += [f"<{tag}> is not closed" for tag in reader.open]
    return reader.seen


def words(page: str) -> str:
    """The text of a page with single spaces."""
    return re.sub(r"[ \t\n]+", " ", read(page).text).strip()


DEMO3 = str(path("demo3"))


def piece(name: str, command: str, *needs: str, **more: object) -> Piece:
    """A piece that is this command of the shell."""
    return Piece(name, f"Title of {name}", "shows `that`", "not this", lambda _: command, needs, **more)  # type: ignore[arg-type]  # what a test gives by name is not typed


GOOD = piece("good", "echo a figure", "gcc")
BAD = piece("bad", "echo again a-difference; false")
ABLE = piece("able", "exit 1", "no-such-tool")


def collected(folder: Path, pieces: Sequence[Piece], **options: object) -> list[Outcome]:
    """The evidence of demo3."""
    return collect(load(DEMO3), Path(DEMO3).read_bytes(), folder, pieces, **options)  # type: ignore[arg-type]  # what a test gives by name is not typed
