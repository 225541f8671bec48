"""Buoyancy in the report of a stand."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from mahovik.core.stand.model import Body, Stand
from mahovik.laws.buoyancy.data import Buoyancy
from mahovik.out.report.stand.tie import Array, Mark


def marks(stand: Stand, placed: Callable[[Body], tuple[Array, Array]]) -> tuple[Mark, ...]:
    """Centre of buoyancy of the whole; `placed`: origin (3, m) and axes (3x3) of a body in E1 at phi = 0."""
    total, moment = 0.0, np.zeros(3)
    for body in stand.bodies:
        if (buoyancy := body.law(Buoyancy)) is not None:
            at, C = placed(body)
            total += buoyancy.displaced_mass
            moment += buoyancy.displaced_mass * (at + C @ np.array(buoyancy.center))
    return (Mark(moment / total, "centre of buoyancy of the whole"),) if total else ()
