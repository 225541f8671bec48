"""The statuses in words, for header and README."""

from __future__ import annotations

from mahovik.emit.names import Names
from mahovik.lower.thresholds import thresholds
from mahovik.program.function import STATUS_VALUES
from mahovik.program.types import Precision

_MEANING = {
    "OK": "good",
    "NEAR_SINGULAR": "least singular value below `near` of the largest",
    "DAMPED": "damping was applied",
    "LIMITED": "a limit was reached; the mask says whose",
    "UNREACHABLE": "least squares: residual above {unreachable} of the demand",
    "RANK_DEFICIENT": "fewer than min(6, N) singular values above {rank} of the largest",
    "NOT_FINITE": "an input is NaN or infinite",
    "RANGE": "out of range, quaternion off unit length, leg of no length",
    "NOT_POSITIVE_DEFINITE": "no mass, no spin inertia, or a pivot failed",
    "SINGULAR_ATTITUDE": "attitude angles within 1e-6 of their singularity",
    "BAD_ARGUMENT": "a null pointer, a count, an index, a step or an option",
}


def statuses(names: Names, precision: Precision) -> list[tuple[str, int, str]]:
    """Name in C, number and meaning of each."""
    decided = thresholds(precision)
    numbers = {"unreachable": _power(decided.unreachable), "rank": _power(decided.rank)}
    return [(names.constant(n), v, _MEANING[n].format(**numbers)) for n, v in STATUS_VALUES.items()]


def _power(number: float) -> str:
    """1e-9, not 1e-09."""
    return f"{number:.0e}".replace("e-0", "e-")
