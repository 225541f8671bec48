"""Pages: one HTML file that opens offline and prints, made of parts: words, tables, pictures of matplotlib."""

from __future__ import annotations

import hashlib
import io
import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from markupsafe import Markup, escape

from mahovik import __version__
from mahovik.out.plots import STYLE, Panel, make_figure, require
from mahovik.out.result import STYLES, Result

if TYPE_CHECKING:
    from mahovik.core.stand.model import Stand

LONG = 30
"""Letters of a cell that may break into lines."""


@dataclass(frozen=True)
class Part:
    """One part of a page, in plain text; all but the title may be empty. Words between backticks are code.

    tables    results of which the page has the columns
    panels    pictures, one below the other
    html      more, whose text is escaped already
    notes     a list of lines
    summary   what the head of the page says of it
    failures  lines that the page shows at its top as failed
    """

    title: str
    words: str = ""
    tables: tuple[Result, ...] = ()
    panels: tuple[Panel, ...] = ()
    html: str = ""
    notes: tuple[str, ...] = ()
    summary: str = ""
    failures: tuple[str, ...] = ()

    @property
    def markup(self) -> Markup:
        """All of it but the title."""
        rows = Markup("").join(map(table, self.tables))
        drawn = picture(self.panels) if self.panels else Markup("")
        notes = Markup("").join(map(Markup("<li>{}</li>").format, self.notes))
        words = paragraph(self.words) if self.words else Markup("")
        return words + Markup(self.html) + rows + drawn + (Markup("<ul>{}</ul>").format(notes) if notes else "")


def page(title: str, parts: Sequence[Part], stand: Stand, files: Sequence[tuple[str, str]] = ()) -> str:
    """HTML of a page on a stand. The same parts give the same bytes.

    files   kind and name of each file that the page was made from, ("data", "run.csv")
    """
    from mahovik.core.emit.generate import describe_bodies
    from mahovik.core.emit.templates import template
    from mahovik.core.stand.structure import identities

    return template("page.html.j2").render(
        title=title,
        bodies=f"{stand.name}: {describe_bodies(stand)}",
        identity=identities(stand),
        version=__version__,
        files=files,
        failures=[line for part in parts for line in part.failures],
        parts=parts,
    )


def picture(panels: Sequence[Panel]) -> Markup:
    """Panels as one picture in the page."""
    matplotlib, figures = require()
    with matplotlib.rc_context({**STYLE, "svg.fonttype": "none"}):
        return inline(make_figure(figures.Figure, "", panels)[0], ", ".join(panel.quantity for panel in panels))


def inline(drawn: Any, label: str) -> Markup:
    """A figure of matplotlib as SVG in the page, whose style turns its colours where it is dark."""
    matplotlib, _ = require()
    stream = io.StringIO()
    with matplotlib.rc_context({**STYLE, "svg.fonttype": "none"}):
        drawn.savefig(stream, format="svg", transparent=True, metadata={"Date": None, "Creator": None})
    svg = stream.getvalue()
    svg = re.sub(r"<metadata>.*?</metadata>", "", svg[svg.index("<svg") :], flags=re.DOTALL)
    # a hundredth of a point is enough; texts between the tags stay as they are
    svg = re.sub("<[^>]+>", lambda tag: re.sub(r"(\d\.\d\d)\d+", r"\1", tag[0]), svg)
    svg = svg.replace('<g id="', '<g data-id="')  # groups that nothing refers to
    salt = hashlib.sha256(svg.encode()).hexdigest()[:8]  # no other picture of the page has these names
    svg = re.sub(r'( id="|"#|url\(#)', rf"\g<1>{salt}", svg)
    return Markup('<figure role="img" aria-label="{}">{}</figure>\n').format(label, Markup(svg))


def paragraph(text: str) -> Markup:
    """Running text; what is between backticks is code."""
    pieces = (Markup("<code>{}</code>").format(x) if i % 2 else escape(x) for i, x in enumerate(text.split("`")))
    return Markup("<p>{}</p>\n").format(Markup("").join(pieces))


def table(result: Result) -> Markup:
    """The columns of a result as its text has them; numbers stand at the right, and what failed is red."""
    heads, rows, numbers = result.cells()
    red = Markup('<span class="bad">{}</span>')
    cells = [[red.format(cell) if "red" in STYLES.get(cell, "") else cell for cell in row] for row in rows]
    return table_of(heads, cells, numbers, result.title)


def table_of(heads: Sequence[str], rows: Sequence[Sequence[str]], numbers: Sequence[bool], caption: str) -> Markup:
    """A table that scrolls where it is too wide; `numbers`: the columns that stand at the right."""
    longest = [max(map(len, column), default=0) for column in zip(*rows, strict=True)] or [0] * len(heads)
    kinds = ["number" if number else "words" if n > LONG else "" for number, n in zip(numbers, longest, strict=True)]
    sides = [Markup(' class="{}"').format(kind) if kind else "" for kind in kinds]

    def line(kind: str, cells: Sequence[str]) -> Markup:
        inside = Markup("").join(
            Markup("<{0}{1}>{2}</{0}>").format(kind, *pair) for pair in zip(sides, cells, strict=True)
        )
        return Markup("<tr>{}</tr>\n").format(inside)

    words = Markup("<caption>{}</caption>").format(caption) if caption else ""
    body = Markup("").join(line("td", row) for row in rows)
    return Markup('<div class="scroll"><table>{}<thead>{}</thead>\n<tbody>{}</tbody></table></div>\n').format(
        words, line("th", heads), body
    )
