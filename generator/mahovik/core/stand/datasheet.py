"""Flywheels as data sheets give them: moments of inertia and unbalance, turned into centre of mass and tensor.

Static unbalance U_s = mass r at angle a from axis 2: center_of_mass = r (0, cos a, sin a).
Dynamic unbalance U_d at angle b: J12 = -U_d cos b, J13 = -U_d sin b, J23 = 0. All at the flywheel's origin.
"""

from __future__ import annotations

from mahovik.core.stand.model import Mat3, Vec3
from mahovik.core.stand.schema import UnbalanceTable

_DIGITS = 40  # rounded once to a double: the same bits on every machine, which no libm promises


def center_of_mass(mass: float, unbalance: UnbalanceTable | None) -> Vec3:
    """Centre of mass, m, of a flywheel of `mass` > 0 with this static unbalance."""
    if unbalance is None or unbalance.static == 0.0:
        return (0.0, 0.0, 0.0)
    y, z = _polar(unbalance.static, unbalance.static_at, mass)
    return (0.0, y, z)


def inertia(spin: float, transverse: tuple[float, ...], unbalance: UnbalanceTable | None) -> Mat3:
    """Inertia tensor about the origin, kg m2, with this dynamic unbalance."""
    j12, j13 = (0.0, 0.0)
    if unbalance is not None and unbalance.dynamic != 0.0:
        j12, j13 = _polar(-unbalance.dynamic, unbalance.dynamic_at, 1.0)
    return ((spin, j12, j13), (j12, transverse[0], 0.0), (j13, 0.0, transverse[1]))


def _polar(length: float, angle: float, divisor: float) -> tuple[float, float]:
    """`length / divisor` times (cos, sin) of `angle`, each correctly rounded."""
    import mpmath

    with mpmath.workdps(_DIGITS):
        ratio, at = mpmath.mpf(length) / mpmath.mpf(divisor), mpmath.mpf(angle)
        return float(ratio * mpmath.cos(at)) + 0.0, float(ratio * mpmath.sin(at)) + 0.0
