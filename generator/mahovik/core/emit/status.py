"""The statuses in words, for header and README."""

from __future__ import annotations

from collections.abc import Iterator

from mahovik.core.emit.names import Names
from mahovik.core.lower.layout import Layout
from mahovik.core.lower.thresholds import thresholds
from mahovik.core.program.function import STATUS_VALUES

_MEANING = {
    "OK": "good",
    "NEAR_SINGULAR": "least singular value below `near` of the largest",
    "DAMPED": "damping was applied",
    "LIMITED": "a limit was reached; the mask says whose",
    "UNREACHABLE": "least squares: residual above {unreachable} of the demand",
    "RANK_DEFICIENT": "fewer than min(6, N) singular values above {rank} of the largest",
    "NOT_FINITE": "an input is NaN or infinite",
    "RANGE": "out of range, {lengths}",
    "NOT_POSITIVE_DEFINITE": "no mass, no spin inertia, or a pivot failed",
    "SINGULAR_ATTITUDE": "attitude angles within 1e-6 of their singularity",
    "BAD_ARGUMENT": "a null pointer, a count, an index, a step or an option",
}


def statuses(names: Names, layout: Layout) -> list[tuple[str, int, str]]:
    """Name in C, number and meaning of each for this stand."""
    decided = thresholds(layout.precision)
    words = {
        "unreachable": _power(decided.unreachable),
        "rank": _power(decided.rank),
        "lengths": ", ".join(_lengths(layout)),
    }
    return [(names.constant(n), v, _MEANING[n].format(**words)) for n, v in STATUS_VALUES.items()]


def _lengths(layout: Layout) -> Iterator[str]:
    """What of this stand may have a length that it must not have."""
    yield "quaternion off unit length"
    if layout.sine_input:
        yield "sine and cosine likewise"
    yield from (law.invalid for law in layout.law_tables if law.invalid)


def _power(number: float) -> str:
    """1e-9, not 1e-09."""
    return f"{number:.0e}".replace("e-0", "e-")
