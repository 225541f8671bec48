"""Flywheels as data sheets give them: moments of inertia and unbalance, turned into centre of mass and tensor.

Static unbalance U_s = mass r at angle a from axis 2: center_of_mass = r (0, cos a, sin a).
Dynamic unbalance U_d at angle b: J12 = -U_d cos b, J13 = -U_d sin b, J23 = 0. All at the flywheel's origin.
"""

from __future__ import annotations

import math

from mahovik.core.stand.columns import polar
from mahovik.core.stand.model import Mat3, Vec3
from mahovik.core.stand.moments import Moments
from mahovik.core.stand.schema import FlywheelTable, UnbalanceTable


def center_of_mass(mass: float, unbalance: UnbalanceTable | None) -> Vec3:
    """Centre of mass, m, of a flywheel of `mass` > 0 with this static unbalance."""
    if unbalance is None or unbalance.static == 0.0:
        return (0.0, 0.0, 0.0)
    y, z = polar(unbalance.static, unbalance.static_at, mass)
    return (0.0, y, z)


def inertia(spin: float, transverse: tuple[float, ...], unbalance: UnbalanceTable | None) -> Mat3:
    """Inertia tensor about the origin, kg m2, with this dynamic unbalance."""
    j12, j13 = (0.0, 0.0)
    if unbalance is not None and unbalance.dynamic != 0.0:
        j12, j13 = polar(-unbalance.dynamic, unbalance.dynamic_at, 1.0)
    return ((spin, j12, j13), (j12, transverse[0], 0.0), (j13, 0.0, transverse[1]))


def least_transverse(mass: float, spin: float, unbalance: UnbalanceTable | None) -> float | None:
    """An equal transverse inertia, kg m2, with which a body of this spin inertia and unbalance can be: a thin disc's.

    `spin/2` without dynamic unbalance. None where the static unbalance alone needs more spin inertia.
    """
    static, dynamic = (0.0, 0.0) if unbalance is None else (unbalance.static, unbalance.dynamic)
    thickness = spin / 2 - (
        static * static / mass if mass > 0.0 else 0.0
    )  # least second moment of mass across the axis
    if dynamic == 0.0:
        return spin / 2 if thickness >= 0.0 else None
    return spin / 2 + dynamic * dynamic / thickness if thickness > 0.0 else None


def thin_disc(table: FlywheelTable) -> str:
    """What to write where a data sheet's transverse inertia is missing or below that of a thin disc; else ""."""
    if table.spin_inertia is None:
        return ""
    least = least_transverse(table.mass, table.spin_inertia, table.unbalance)
    if table.transverse_inertia is None:
        return (
            ""
            if least is None or not math.isfinite(least)
            else f"; a thin disc has {_half(table.spin_inertia, least, table.moments)}"
        )
    if (
        least is None
        or not math.isfinite(least)
        or sum(table.transverse_inertia) / len(table.transverse_inertia) >= least
    ):
        return ""
    return f"no disc has less than {_half(table.spin_inertia, least, table.moments)}"


def _half(spin: float, least: float, moments: Moments) -> str:
    """The transverse inertia of a thin disc, and what to write."""
    half = spin / 2
    more = "" if least == half else f", with this unbalance {moments.at_least(least)} {moments.unit}"
    return (
        f"spin_inertia/2 = {moments.at_least(half)} {moments.unit} across its axis{more}: "
        f"for a thin disc write transverse_inertia = {moments.value(least)}"
    )
