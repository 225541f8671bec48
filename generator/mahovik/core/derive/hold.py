"""Attitude of a held carrier by its turn from the home attitude."""

from __future__ import annotations

import sympy as sp

from mahovik.core.derive.attitude import quaternion_product
from mahovik.core.derive.symbols import vector


def from_home() -> sp.Matrix:
    """h* q: the turn from the home attitude h to the attitude q, quaternions with w first."""
    home = vector("home", 4)
    return quaternion_product(sp.Matrix([home[0], -home[1], -home[2], -home[3]]), vector("q", 4))


def turned_home() -> sp.Matrix:
    """h q: the attitude after the turn q from the home attitude h."""
    return quaternion_product(vector("home", 4), vector("q", 4))
