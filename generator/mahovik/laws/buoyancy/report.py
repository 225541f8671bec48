"""Buoyancy in the report of a stand."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from markupsafe import Markup

from mahovik.core.stand.model import Body, Stand
from mahovik.laws.buoyancy.data import Buoyancy
from mahovik.out.report.stand.markup import Cell, figure
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


def column(stand: Stand) -> tuple[str, list[Cell]]:
    """Head of its column in the table of bodies, and displaced masses with their sum; no cells where there is none."""
    found = [body.law(Buoyancy) for body in stand.bodies]
    cells: list[Cell] = [figure(each.displaced_mass) if each else "" for each in found]
    return "displaced, kg>", [*cells, figure(_displaced_mass(stand))] if any(found) else []


def note(stand: Stand) -> Markup | None:
    """Weight against Archimedes' force."""
    displaced = _displaced_mass(stand)
    if not displaced or not any(stand.gravity):
        return None
    mass = math.fsum(body.mass for body in stand.bodies)
    if abs(displaced - mass) <= 1e-9 * mass:
        return Markup("neutrally buoyant")
    light = displaced > mass
    return Markup("{} by {} kg").format("light" if light else "heavy", figure(abs(displaced - mass), 4))


def _displaced_mass(stand: Stand) -> float:
    """Displaced mass of all bodies, kg."""
    return math.fsum(own.displaced_mass for body in stand.bodies if (own := body.law(Buoyancy)) is not None)
