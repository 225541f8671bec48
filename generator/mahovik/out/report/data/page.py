"""A page on measured data: parts in their order, in the frame of the reports of stands."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from markupsafe import Markup

from mahovik import __version__
from mahovik.core.emit.generate import describe_bodies
from mahovik.core.emit.templates import source_text, template
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand
from mahovik.out.report.plot.draw import require
from mahovik.out.report.plot.inline import charts
from mahovik.out.report.plot.panel import Panel
from mahovik.out.report.stand.markup import Cell, paragraph, table
from mahovik.out.report.stand.material import Section
from mahovik.writing import probe, write


@dataclass(frozen=True)
class Part:
    """One part of the page, in plain text: words, a table, charts, lines below them. All but the title may be empty.

    head      names of columns; those with ">" at the end are right-aligned, what follows the last comma is the unit
    notes     a list of lines
    summary   what the head of the page says of it
    failures  lines that the page shows at its top as failed
    """

    title: str
    words: str = ""
    head: tuple[str, ...] = ()
    rows: tuple[tuple[Cell, ...], ...] = ()
    panels: tuple[Panel, ...] = ()
    notes: tuple[str, ...] = ()
    summary: str = ""
    failures: tuple[str, ...] = ()


def write_data_page(
    path: Path, title: str, parts: Sequence[Part], *, stand: Stand, files: Sequence[tuple[str, str]] = ()
) -> None:
    """Write a page that opens offline in any browser, whole or not at all.

    stand   on which the data was measured
    files   kind and name of each file the page was made from, ("data", "run.csv")

    Raises UsageError: matplotlib is missing, or the file cannot be written.
    """
    require("report")
    probe(path)
    write(path, data_page(title, parts, stand, files))


def data_page(title: str, parts: Sequence[Part], stand: Stand, files: Sequence[tuple[str, str]] = ()) -> str:
    """HTML of the page. The same parts give the same bytes."""
    sections = [_section(k, part) for k, part in enumerate(parts)]
    known = identities(stand)
    return template("report.html.j2").render(
        name=title,
        uplot=source_text("uplot/uPlot.iife.min.js").partition("\n")[2],
        bodies=f"{stand.name}: {describe_bodies(stand)}",
        structure=known.structure,
        physics=known.physics,
        version=__version__,
        files=list(files),
        failures=[line for each in sections for line in each.failures],
        summaries=[each for each in sections if each.summary],
        sections=sections,
    )


def _section(number: int, part: Part) -> Section:
    html = paragraph(part.words) if part.words else Markup("")
    if part.head:
        html += table(part.head, [part.rows])
    if part.panels:
        html += charts(part.panels)
    if part.notes:
        lines = Markup("").join(Markup("<li>{}</li>\n").format(note) for note in part.notes)
        html += Markup("<ul>\n{}</ul>\n").format(lines)
    return Section(f"part-{number + 1}", part.title, html, part.failures, part.summary)
