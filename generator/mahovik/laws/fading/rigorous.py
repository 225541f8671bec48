"""Fading damping of a body, in balls."""

from __future__ import annotations

from flint import arb_mat

from mahovik.core.stand.model import Body
from mahovik.laws.fading.data import FadingDamping
from mahovik.proof.rigorous.ball import length, matrix, number, part, zeros


def wrench(body: Body, gravity: arb_mat, V_r: arb_mat) -> arb_mat:
    """-exp(-rate U) linear V_r (6; N, N m), U the length of v, in the body's frame."""
    law = body.law(FadingDamping)
    if law is None:
        return zeros(6)
    fade = (-number(law.rate) * length(part(V_r, slice(0, 3)))).exp()
    return matrix(law.linear) * V_r * -fade
