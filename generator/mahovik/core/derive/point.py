"""Motion of a point fixed on the carrier: readings of a sensor there."""

from __future__ import annotations

import sympy as sp

from mahovik.core.derive.screw import cross
from mahovik.core.derive.symbols import vector


def specific_force(weight: bool) -> sp.Matrix:
    """v* + omega x (v + omega x O) + omega* x O - g in E1: acceleration minus gravity.

    `velocity` = v + omega x O stands for itself. What an accelerometer reads, before it is turned to its own axes.
    """
    omega, omega_dot = vector("omega"), vector("omega_dot")
    found = vector("v_dot") + cross(omega) * vector("velocity") + cross(omega_dot) * vector("O")
    return found - vector("g") if weight else found
