"""Markup of tables and figures of the report: numbers to a few digits, text escaped."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping, Sequence

from markupsafe import Markup, escape

from mahovik.out.report.derivation import mathml
from mahovik.out.report.derivation.parse import parse

Cell = str | Markup

DIGITS = 5
"""Significant digits of a figure, where nothing else is said."""

LEAST, MOST = -4, 7
"""Powers of ten of the first digit between which a figure is printed without a power."""


def figure(value: float, digits: int = DIGITS) -> Markup:
    """A number to some significant digits as one prints it: minus sign, thousands apart, powers of ten; NaN as "–"."""
    if not math.isfinite(value):
        return Markup("–") if math.isnan(value) else Markup("−∞" if value < 0 else "∞")
    text, _, exponent = f"{abs(value):.{digits - 1}e}".partition("e")
    power = int(exponent)
    sign = "−" if value < 0 else ""
    if LEAST <= power < MOST or value == 0.0:
        return Markup(sign + _apart(_short(f"{abs(value):.{max(0, digits - 1 - power)}f}")))
    return Markup(f"{sign}{_short(text)}·10<sup>{str(power).replace('-', '−')}</sup>")


def figures(values: Sequence[float], digits: int = DIGITS) -> list[Markup]:
    """Numbers of one column: with the same decimals where they are of like size, so that their points align."""
    given = [abs(x) for x in values if math.isfinite(x) and x != 0.0]
    low, high = (math.floor(math.log10(end(given))) if given else 0 for end in (min, max))
    if low < LEAST or high >= MOST or high - low >= digits or not given:
        return [figure(x, digits) for x in values]
    printed = [f"{abs(x):.{max(0, digits - 1 - high)}f}" for x in values if math.isfinite(x)]
    decimals = max((len(_short(text).partition(".")[2]) for text in printed), default=0)
    return [
        Markup(("−" if x < 0 else "") + _apart(f"{abs(x):.{decimals}f}")) if math.isfinite(x) else figure(x)
        for x in values
    ]


def sentence(words: str) -> str:
    """With a capital letter."""
    return words[:1].upper() + words[1:]


def _short(text: str) -> str:
    """Without zeros at the end of decimals."""
    return text.rstrip("0").rstrip(".") if "." in text else text


def _apart(text: str) -> str:
    """Five digits and more before the point in threes, with thin spaces."""
    whole, point, decimals = text.partition(".")
    grouped = f"{int(whole):,}".replace(",", "\u202f") if len(whole) > 4 else whole
    return grouped + point + decimals


def share(value: float) -> Markup:
    """A relative difference to two digits; a plain zero where there is none."""
    return figure(value, 2) if value else Markup("0")


def math_text(notation: str, display: bool = False) -> Markup:
    """Notation of docs/model.md (report/derivation/parse) as MathML."""
    return Markup(mathml.mathml(parse(notation), display))


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
    right = [name.endswith(">") for name in head]
    names = [_heading(name) for name in head]
    lines = [Markup('<div class="scroll" tabindex="0"><table class="{}">\n').format(kind)]
    if caption:
        lines.append(Markup("<caption>{}</caption>\n").format(caption))
    tops = Markup("").join(_cell("th", name, r, ' scope="col"') for name, r in zip(names, right, strict=True))
    lines.append(Markup("<thead><tr>{}</tr></thead>\n").format(tops))
    for rows in groups:
        lines.append(Markup("<tbody>\n"))
        lines += [_row(row, right) for row in rows]
        lines.append(Markup("</tbody>\n"))
    if foot:
        lines += [Markup("<tfoot>\n"), _row(foot, right), Markup("</tfoot>\n")]
    return Markup("").join([*lines, Markup("</table></div>\n")])


def definitions(pairs: Mapping[str, Cell]) -> Markup:
    """Terms and what is said of them."""
    found = Markup("").join(Markup("<dt>{}</dt><dd>{}</dd>\n").format(term, words) for term, words in pairs.items())
    return Markup("<dl>\n{}</dl>\n").format(found)


def verdict(words: str, style: str) -> Markup:
    """A verdict: style good, bad, warn or muted."""
    return Markup('<span class="verdict {}">{}</span>').format(style, words)


def _heading(name: Cell) -> Markup:
    """The name of a column, its unit on a line of its own."""
    text = escape(name).removesuffix("&gt;").removesuffix(">")
    what, comma, unit = text.rpartition(", ")
    return Markup('{}<br><span class="unit">{}</span>').format(Markup(what), Markup(unit)) if comma else Markup(text)


def _row(row: Sequence[Cell], right: Sequence[bool]) -> Markup:
    cells = [
        _cell("td" if i else "th", cell, r, "" if i else ' scope="row"')
        for i, (cell, r) in enumerate(zip(row, right, strict=True))
    ]
    return Markup("<tr>{}</tr>\n").format(Markup("").join(cells))


def _cell(tag: str, content: Cell, right: bool, more: str) -> Markup:
    kind = ' class="right"' if right else ""
    return Markup(f"<{tag}{kind}{more}>{{}}</{tag}>").format(content)


def vector_cell(numbers: Sequence[float], unit: str, nothing: str) -> Markup:
    """Numbers of a vector with their unit; `nothing` where all are zero."""
    if not any(numbers):
        return Markup(nothing)
    return Markup("({}) {}").format(Markup(", ").join(figure(x) for x in numbers), unit)
