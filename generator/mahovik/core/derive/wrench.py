"""Weight of (7) as an expression, less that of the displaced fluid."""

from __future__ import annotations

import sympy as sp

from mahovik.core.derive.screw import cross
from mahovik.core.derive.symbols import vector


def weight(displaces: bool) -> sp.Matrix:
    """Weight of every body and Archimedes force: (m g, mu x g) minus those of the displaced fluid.

    g = gravity in E1; mu at the phases of the flywheels: the line of action of a flywheel's weight moves with it.
    """
    g, m, moment = vector("g"), sp.Symbol("m"), vector("mu")
    if displaces:
        m = sp.Symbol("weight_mass")
        moment = moment - vector("displaced_moment")
    return (m * g).col_join(cross(moment) * g)


def weight_reaction(displaces: bool) -> sp.Matrix:
    """Load of weight and Archimedes force on the mount: the negative of `weight`."""
    return -weight(displaces)
