"""Columns of figures in a unit that fits them: 5e-08 kg m reads 50 mg mm."""

from __future__ import annotations

from collections.abc import Sequence

FIRST, LAST = 0.1, 1e5
"""A unit fits if the largest figure of a column is at least the first, and below the last."""

UNITS: dict[str, tuple[tuple[str, float], ...]] = {
    "kg": (("kg", 1.0), ("g", 1e-3)),
    "kg m2": (("kg m2", 1.0), ("kg cm2", 1e-4), ("g cm2", 1e-7), ("g mm2", 1e-9)),
    "kg m": (("g mm", 1e-6), ("mg mm", 1e-9), ("kg mm", 1e-3), ("kg m", 1.0)),
    "dynamic": (("g mm2", 1e-9), ("mg mm2", 1e-12), ("kg mm2", 1e-6), ("kg m2", 1.0)),
    "N": (("N", 1.0), ("mN", 1e-3), ("uN", 1e-6), ("kN", 1e3)),
    "N m": (("N m", 1.0), ("mN m", 1e-3), ("uN m", 1e-6), ("kN m", 1e3)),
    "N m s": (("N m s", 1.0), ("mN m s", 1e-3), ("uN m s", 1e-6), ("kN m s", 1e3)),
    "m/s": (("mm/s", 1e-3), ("um/s", 1e-6), ("m/s", 1.0)),
}
"""Units of a quantity and their size, the preferred one first; "dynamic" is a product of inertia or a difference."""


def fitting_unit(values: Sequence[float | None], quantity: str) -> tuple[str, float]:
    """Name and size of the unit for figures: the preferred one if it fits or all are zero, else the nearest that fits.

    `values` are in the unit of size 1; None is left out.
    """
    units = UNITS[quantity]
    largest = max((abs(x) for x in values if x is not None), default=0.0)
    if largest == 0.0:
        return units[0]
    fits = [unit for unit in units if FIRST <= largest / unit[1] < LAST]
    if fits:
        return fits[0]
    return min(units, key=lambda unit: unit[1]) if largest < units[0][1] else max(units, key=lambda unit: unit[1])


def column_that_fits(title: str, values: Sequence[float | None], quantity: str) -> tuple[str, list[str]]:
    """Title of a right-aligned column with its unit, and its figures; "-" for None."""
    unit, size = fitting_unit(values, quantity)
    return f"{title}, {unit}>", ["-" if x is None else f"{x / size:.5g}" for x in values]
