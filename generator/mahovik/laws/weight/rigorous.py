"""Weight of a body, in balls."""

from __future__ import annotations

from flint import arb_mat

from mahovik.core.stand.model import Body
from mahovik.proof.rigorous.ball import column, number
from mahovik.proof.rigorous.screw import force_at


def wrench(body: Body, gravity: arb_mat, V_r: arb_mat) -> arb_mat:
    """m g at the centre of mass (6; N, N m); `gravity` (3) in the body's frame."""
    return force_at(gravity * number(body.mass), column(body.center_of_mass))
