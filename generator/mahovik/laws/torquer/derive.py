"""A torquer as expressions."""

from __future__ import annotations

import sympy as sp

from mahovik.core.derive.screw import cross
from mahovik.core.derive.symbols import vector


def moment() -> sp.Matrix:
    """d x B, both in E1."""
    return cross(vector("dipole")) * vector("field")
