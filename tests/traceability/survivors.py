"""Why mutants are not noticed: those that change no result, and those that other checks have."""

from __future__ import annotations

REASONS: dict[tuple[str, str], str] = {
    (
        "external",
        "loop one turn short: for (int i = 0; i < 18",
    ): "no change: the last number is a flywheel's moment about "
    "another axis than its own, which nothing reads: `tests/lower/test_undefined.py` puts NaN there",
    ("rotation_vector", "number times 1.5: _real ratio = 2.0"): "no change: of a quaternion of unit length one of the "
    "two branches sets it again",
    ("orthogonalise", "loop one turn short: for (int sweep"): "the last sweep is a reserve: these matrices are "
    "orthogonal to rounding before it",
    ("translation_block", "and / or exchanged: if (!(A[0] > 0.0"): "a second fence: added masses that are not positive "
    "semidefinite have been refused by `check_added_mass` before",
    ("allocate", "number times 1.5: share[s] = 1.0"): "no change: all shares get the same factor, which cancels",
}
"""Reasons by function and the beginning of the mutant's description."""


def reason(function: str, what: str) -> str:
    """The reason of a survivor; empty where none is known."""
    return next((why for (name, begin), why in REASONS.items() if name == function and what.startswith(begin)), "")
