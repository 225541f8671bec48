"""Force of the torquers by their potential: U = -sum d . B."""

from __future__ import annotations

from functools import cache

import casadi as ca
import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.laws.torquer.law import Torquers, mount_of
from mahovik.proof.second.body import CarrierEnergy, Chart, Expr, fixed_rotation, turn


def force(stand: Stand, inputs: dict[str, Expr]) -> Expr:
    """Generalized force (6) of all torquers on the carrier."""
    law = stand.law(Torquers)
    if law is None:
        return ca.MX.zeros(6)
    total = np.zeros(3)  # the dipoles of rigid parts add up
    for torquer in law.torquers:
        mount = mount_of(stand, torquer)
        total += np.array(torquer.dipole) if mount is None else fixed_rotation(mount.angles) @ np.array(torquer.dipole)
    return _force()(total, inputs["C"].T @ ca.DM(law.magnetic_field))


@cache
def _force() -> Expr:
    """(dipole, field) -> generalized force (6): -dU/dq of U = -(E(xi) dipole) . field, both in E1 as it is now."""
    chart = Chart()
    dipole, field = ca.SX.sym("dipole", 3), ca.SX.sym("field", 3)
    potential = -ca.dot(turn(chart.xi) @ dipole, field)
    return ca.Function("torquer_force", [dipole, field], [chart.at_present(-ca.gradient(potential, chart.q))[:6]])


LAW = CarrierEnergy(force)
