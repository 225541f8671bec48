"""Kinematics of the state: how position and attitude change with the twist."""

from __future__ import annotations

import sympy as sp

from mahovik.core.derive.attitude import quaternion_product
from mahovik.core.derive.symbols import matrix, vector


def position_rate() -> sp.Matrix:
    """C v: velocity of O1 in E0."""
    return matrix("C") * vector("v")


def quaternion_rate() -> sp.Matrix:
    """q' = q (0, omega) / 2, omega in E1."""
    return quaternion_product(vector("q", 4), sp.Matrix([0]).col_join(vector("omega"))) / 2
