"""The statuses in words, for header and README."""

from __future__ import annotations

from collections.abc import Iterator

from mahovik.contract.quantities import short
from mahovik.contract.status import STATUS_VALUES, STATUSES
from mahovik.core.emit.names import Names
from mahovik.core.lower.layout import Layout
from mahovik.core.lower.limits import thresholds
from mahovik.core.program.function import Program

_ALWAYS = ("OK", "NOT_FINITE", "RANGE", "BAD_ARGUMENT")
"""Statuses of the header of a part as well: what is exported to stand beside it returns them too."""


def statuses(names: Names, layout: Layout, part: Program | None) -> list[tuple[str, int, str]]:
    """Name in C, number and meaning of each for this stand; of a part of its functions, of those that may occur."""
    functions = part.functions if part else ()
    occurring = {*_ALWAYS, *(status for f in functions if f.public for status in f.statuses)} if part else STATUS_VALUES
    decided = thresholds(layout.precision)
    words = {
        "unreachable": short(decided.unreachable),
        "rank": short(decided.rank),
        "lengths": ", ".join(_lengths(layout)),
    }
    result = [s for s in STATUSES if s.name in occurring]
    return [(names.constant(s.name), s.value, s.meaning.format(**words)) for s in result]


def _lengths(layout: Layout) -> Iterator[str]:
    """Words for the parts of this stand whose length may be refused."""
    yield "quaternion off unit length"
    if layout.sine_input:
        yield "sine and cosine likewise"
    yield from (law.invalid for law in layout.law_tables if law.invalid)
    if layout.structure.stream_stations:
        yield "depth outside of the stream's profile"
