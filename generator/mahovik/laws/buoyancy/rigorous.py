"""Archimedes force on a body, in balls."""

from __future__ import annotations

from flint import arb_mat

from mahovik.core.stand.model import Body
from mahovik.laws.buoyancy.data import Buoyancy
from mahovik.proof.rigorous.ball import column, number, zeros
from mahovik.proof.rigorous.screw import force_at


def wrench(body: Body, gravity: arb_mat, V_r: arb_mat) -> arb_mat:
    """-displaced_mass g at the centre of buoyancy (6; N, N m); `gravity` (3) in the body's frame."""
    buoyancy = body.law(Buoyancy)
    if buoyancy is None:
        return zeros(6)
    return -force_at(gravity * number(buoyancy.displaced_mass), column(buoyancy.center))
