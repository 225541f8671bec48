"""Moment of the torquers, in balls."""

from __future__ import annotations

from flint import arb_mat

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.laws.torquer.data import Torquers, mount_of
from mahovik.proof.rigorous.ball import column, cross, zeros
from mahovik.proof.rigorous.rotation import fixed_rotation
from mahovik.proof.rigorous.screw import screw_of_parts


def wrenches(stand: Stand, state: State, O1: arb_mat, C: arb_mat, V: arb_mat) -> list[arb_mat]:
    """(0, d x B) (6; N, N m) of every torquer on the carrier about O1 in E1."""
    law = stand.law(Torquers)
    if law is None:
        return []
    field = C.transpose() * column(law.magnetic_field)
    found = []
    for torquer in law.torquers:
        dipole, mount = column(torquer.dipole), mount_of(stand, torquer)
        if mount is not None:
            dipole = fixed_rotation(mount.angles) * dipole
        found.append(screw_of_parts(zeros(3), cross(dipole) * field))
    return found
