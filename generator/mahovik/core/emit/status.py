"""The statuses in words, for header and README."""

from __future__ import annotations

from collections.abc import Iterator

from mahovik.contract.status import STATUSES
from mahovik.core.emit.names import Names
from mahovik.core.lower.layout import Layout
from mahovik.core.lower.thresholds import thresholds


def statuses(names: Names, layout: Layout) -> list[tuple[str, int, str]]:
    """Name in C, number and meaning of each for this stand."""
    decided = thresholds(layout.precision)
    words = {
        "unreachable": _power(decided.unreachable),
        "rank": _power(decided.rank),
        "lengths": ", ".join(_lengths(layout)),
    }
    return [(names.constant(each.name), each.value, each.meaning.format(**words)) for each in STATUSES]


def _lengths(layout: Layout) -> Iterator[str]:
    """Words for the parts of this stand whose length may be refused."""
    yield "quaternion off unit length"
    if layout.sine_input:
        yield "sine and cosine likewise"
    yield from (law.invalid for law in layout.law_tables if law.invalid)
    if layout.structure.stream_stations:
        yield "depth outside of the stream's profile"


def _power(number: float) -> str:
    """1e-9, not 1e-09."""
    return f"{number:.0e}".replace("e-0", "e-")
