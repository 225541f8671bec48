"""Velocity of the fluid where O1 is, in balls."""

from __future__ import annotations

from itertools import pairwise

from flint import arb, arb_mat

from mahovik.core.stand.model import Stand, Vec3
from mahovik.errors import StateError
from mahovik.proof.rigorous.ball import column, dot, length, number


def stream_at(stand: Stand, position: Vec3) -> arb_mat:
    """u (3; m/s) in E0, the profile as weights of its stations. StateError where the depth is surely outside."""
    u = column(stand.stream or (0.0, 0.0, 0.0))
    if stand.profile is None:
        return u
    down = column(stand.profile.down)
    depth = dot(down, column(position)) / length(down)
    stations = [number(d) for d in stand.profile.depth]
    if depth < stations[0] or depth > stations[-1]:
        raise StateError("position: its depth is outside of stream_profile")
    u = u + column(stand.profile.velocity[0])
    for (top, bottom), (above, below) in zip(pairwise(stations), pairwise(stand.profile.velocity), strict=True):
        share = ((depth - top) / (bottom - top)).max(arb(0)).min(arb(1))
        u = u + (column(below) - column(above)) * share
    return u
