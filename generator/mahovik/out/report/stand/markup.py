"""Markup of tables and figures of the report: numbers to a few digits, text escaped."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from markupsafe import Markup, escape

from mahovik.core.emit.templates import template
from mahovik.out.report.derivation.parse import parse

Cell = str | Markup

DIGITS = 5
"""Significant digits of a figure, where nothing else is said."""

LEAST, MOST = -4, 7
"""Powers of ten of the first digit between which a figure is printed without a power."""


POINT_SPACE, DIGIT_SPACE = "\u2008", "\u2007"
"""Spaces as wide as a point and as a digit."""

_NUMBER = re.compile(r"−?[\d\u202f]+(\.\d+)?")


def figure(value: float, digits: int = DIGITS) -> Markup:
    """A number to some significant digits as one prints it: minus sign, thousands apart, powers of ten; NaN as "–"."""
    if not math.isfinite(value):
        return Markup("–") if math.isnan(value) else Markup("−∞" if value < 0 else "∞")
    text, _, exponent = f"{abs(value):.{digits - 1}e}".partition("e")
    power = int(exponent)
    sign = "−" if value < 0 else ""
    if LEAST <= power < MOST or value == 0.0:
        return Markup(sign + _grouped_digits(_short(f"{abs(value):.{max(0, digits - 1 - power)}f}")))
    return Markup(f"{sign}{_short(text)}·10<sup>{str(power).replace('-', '−')}</sup>")


def figures(values: Sequence[float], digits: int = DIGITS) -> list[Markup]:
    """Numbers of one column, each to its own significant digits, with room after them so that their points align."""
    return align([figure(x, digits) for x in values])


def align(cells: Sequence[Cell]) -> list[Markup]:
    """Cells of a right-aligned column: room after numbers without a power of ten, so that their points align."""
    found = [_NUMBER.fullmatch(str(cell)) for cell in cells]
    most = max((len(number[1] or "") for number in found if number), default=0)
    return [
        escape(cell) + _room(number[1] or "", most) if number else escape(cell)
        for cell, number in zip(cells, found, strict=True)
    ]


def _room(decimals: str, most: int) -> str:
    """Spaces as wide as the point and the digits that a number does not have; `decimals` with their point."""
    return ("" if decimals or not most else POINT_SPACE) + DIGIT_SPACE * (most - max(len(decimals), 1 if most else 0))


def sentence(words: str) -> str:
    """With a capital letter."""
    return words[:1].upper() + words[1:]


def _short(text: str) -> str:
    """Without zeros at the end of decimals."""
    return text.rstrip("0").rstrip(".") if "." in text else text


def _grouped_digits(text: str) -> str:
    """Five digits and more before the point in threes, with thin spaces."""
    whole, point, decimals = text.partition(".")
    grouped = f"{int(whole):,}".replace(",", "\u202f") if len(whole) > 4 else whole
    return grouped + point + decimals


def share(value: float) -> Markup:
    """A relative difference to two digits; a plain zero where there is none."""
    return figure(value, 2) if value else Markup("0")


def math_text(notation: str, display: bool = False) -> Markup:
    """Notation of docs/model.md (report/derivation/parse) as MathML."""
    return Markup(parse(notation).math(display))


def markup_of(name: str, **values: Any) -> Markup:
    """Text of the template `report_NAME` for values; it may call the functions of this module that print."""
    printers = {"math_text": math_text, "paragraph": paragraph, "table": table, "verdict": verdict}
    return Markup(template(f"report_{name}.html.j2").render(**printers, **values))


def paragraph(text: str) -> Markup:
    """Running text; notation between backticks, words of a command between double backticks."""
    found = []
    for i, part in enumerate(re.split(r"``([^`]*)``", text)):
        if i % 2:
            found.append(Markup("<code>{}</code>").format(part))
            continue
        pieces = enumerate(re.split(r"`([^`]*)`", part))
        found += [math_text(piece) if k % 2 else escape(piece) for k, piece in pieces]
    return Markup("<p>{}</p>\n").format(Markup("").join(found))


def message(error: Exception) -> str:
    """The words of an error for `paragraph`: what is between backticks there is a command, no notation."""
    return str(error).replace("`", "``")


def table(
    head: Sequence[Cell],
    groups: Iterable[Sequence[Sequence[Cell]]],
    caption: str = "",
    foot: Sequence[Cell] = (),
    kind: str = "",
) -> Markup:
    """A table that scrolls where it is too wide; columns whose name ends in ">" are right-aligned, what follows the
    last comma of a name is its unit.

    `groups`: rows, group by group. The first cell of a row is its heading.
    """
    names = [_heading(name) for name in head]
    sides = [Markup(' class="right"') if name.endswith(">") else "" for name in head]
    bodies = [[list(row) for row in rows] for rows in groups]
    last = [list(foot)] if foot else []
    _align_columns([row for rows in (*bodies, last) for row in rows], [name.endswith(">") for name in head])
    parts = [("tbody", rows) for rows in bodies] + ([("tfoot", last)] if foot else [])
    return markup_of("table", caption=caption, names=names, sides=sides, parts=parts, kind=kind)


def _align_columns(rows: list[list[Cell]], numeric: Sequence[bool]) -> None:
    """Align the points of the numbers in numeric columns, in place."""
    for k, is_numeric in enumerate(numeric):
        if is_numeric:
            having = [row for row in rows if len(row) > k]
            for row, cell in zip(having, align([row[k] for row in having]), strict=True):
                row[k] = cell


def definitions(pairs: Mapping[str, Cell]) -> Markup:
    """Terms and what is said of them."""
    found = Markup("").join(Markup("<dt>{}</dt><dd>{}</dd>\n").format(term, words) for term, words in pairs.items())
    return Markup("<dl>\n{}</dl>\n").format(found)


def side_by_side(blocks: Sequence[Markup]) -> Markup:
    """Parts of a section, beside one another where the window is wide; empty ones are left out."""
    inner = Markup("").join(Markup("<div>\n{}</div>\n").format(block) for block in blocks if block)
    return Markup('<div class="blocks">\n{}</div>\n').format(inner)


def verdict(words: str, style: str) -> Markup:
    """A verdict: style good, bad, warn or muted."""
    return Markup('<span class="verdict {}">{}</span>').format(style, words)


def _heading(name: Cell) -> tuple[Markup, Markup]:
    """The name of a column, and its unit."""
    text = escape(name).removesuffix("&gt;").removesuffix(">")
    what, comma, unit = text.rpartition(", ")
    return (Markup(what), Markup(unit)) if comma else (Markup(text), Markup(""))


def vector_cell(numbers: Sequence[float], unit: str, nothing: str) -> Markup:
    """Numbers of a vector with their unit; `nothing` where all are zero."""
    if not any(numbers):
        return Markup(nothing)
    return Markup("({}) {}").format(Markup(", ").join(figure(x) for x in numbers), unit)
