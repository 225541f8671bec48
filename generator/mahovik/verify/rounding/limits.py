"""What is promised of rounding: ulp of the natural scale, by element type; and how far tolerances stand above it."""

from __future__ import annotations

from collections.abc import Mapping

ULPS: Mapping[str, Mapping[tuple[str, str], float]] = {
    "double": {("forward", "V_dot"): 50.0},
    "float": {("forward", "V_dot"): 50.0},
}
"""Largest accepted error of a quantity by element type, in ulp of its natural scale; elsewhere the tolerance counts."""

MARGIN = 3.0
"""A tolerance of `verify` is at least so many times the worst error over the example stands (docs/rounding.md)."""


def accepted(real: str, want: str, quantity: str) -> float | None:
    """Accepted error in ulp; None where nothing is promised but the tolerance of `verify`."""
    return ULPS[real].get((want, quantity))
