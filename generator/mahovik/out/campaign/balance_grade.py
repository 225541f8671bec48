"""Permissible residual unbalance of a rotor by its balance quality grade, ISO 21940-11."""

from __future__ import annotations

import re

from mahovik.core.stand.units import QuantityError, show

_GRADE = re.compile(r"G\s*(\d+\.?\d*|\.\d+)")


def grade_of(raw: object) -> float:
    """The velocity of a grade in m/s: "G 2.5" is 2.5 mm/s. Raises QuantityError."""
    found = _GRADE.fullmatch(raw.strip()) if isinstance(raw, str) else None
    if found is None or float(found[1]) <= 0.0:
        raise QuantityError(f'expected a balance quality grade, such as "G 2.5", found {show(raw)}')
    return float(found[1]) / 1000.0


def permissible_unbalance(grade: float, speed: float, mass: float) -> float:
    """Permissible residual static unbalance, kg m: U_per = m e_per with e_per omega = G.

    grade  m/s
    speed  highest speed in service, rad/s
    mass   of the rotor, kg
    """
    return mass * grade / abs(speed)
