"""The torquers in planning: their wrench, and its derivatives, for M states at once."""

from __future__ import annotations

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.laws.torquer.law import Torquers, mount_of
from mahovik.use.plan.array import Array
from mahovik.use.plan.residual.kinematics import Twists, in_E1
from mahovik.use.plan.residual.slopes import CarrierPlan, Slopes
from mahovik.use.plan.residual.spatial import fixed_axes, skew


def wrench(stand: Stand, at: Twists) -> Array:
    """(0, d x B) (M, 6; N, N m) of all torquers on the carrier about O1 in E1."""
    dipole, field = _dipole(stand), _field(stand, at)
    return np.hstack([np.zeros_like(field), np.cross(dipole, field)])


def slopes(stand: Stand, at: Twists) -> Slopes:
    """Derivatives of the wrench by pose and twist: a turn r of the carrier turns the field in E1 by -r."""
    by_pose = np.zeros((len(at.V), 6, 6))
    by_pose[:, 3:, 3:] = skew(_dipole(stand)) @ skew(_field(stand, at))
    return Slopes(by_pose, np.zeros_like(by_pose))


def _dipole(stand: Stand) -> Array:
    """Sum of all dipoles (3; A m2), in E1."""
    law, total = stand.law(Torquers), np.zeros(3)
    for torquer in law.torquers if law else ():
        mount = mount_of(stand, torquer)
        total += np.array(torquer.dipole) if mount is None else fixed_axes(mount.angles) @ np.array(torquer.dipole)
    return total


def _field(stand: Stand, at: Twists) -> Array:
    """The field (M, 3; T), in E1."""
    law = stand.law(Torquers)
    return in_E1(at.C, np.broadcast_to(law.magnetic_field if law else (0.0, 0.0, 0.0), at.O1.shape))


LAW = CarrierPlan(wrench, slopes)
