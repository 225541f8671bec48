"""What is promised of rounding: ulp of the natural scale; and how far the tolerances of `verify` stand above it."""

from __future__ import annotations

from collections.abc import Mapping

ULPS: Mapping[str, float | None] = {"double": 50.0, "float": None}
"""Largest accepted error of every quantity in ulp of its natural scale, by element type.

None for float: the tolerances of `verify` are stricter there. In double 1e-12 is 4500 ulp, so that an error of 1e-12
in one number would pass by the tolerance alone.
"""

MARGIN = 3.0
"""A tolerance of `verify` is at least so many times what C and judge may differ by (docs/results/rounding.md)."""
