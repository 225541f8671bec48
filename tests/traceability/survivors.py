"""Why mutants are not noticed: those that change no result, and those that other checks have."""

from __future__ import annotations

REASONS: dict[tuple[str, str], str] = {
    ("sincos_each", "number times 1.5: const _real r_tail"): "the third part of pi/2 acts below what these tests "
    "resolve; `sincos`, the same text, is held to 0.9 ulp in `tests/routines/test_sincos.py`",
}
"""By function and the beginning of what the mutant does."""


def reason(function: str, what: str) -> str:
    """The reason of a survivor; empty where none is known."""
    return next((why for (name, begin), why in REASONS.items() if name == function and what.startswith(begin)), "")
