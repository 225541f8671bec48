"""Velocity of the fluid where O1 is: a number to the energies, so that all of the fluid moves as it does there."""

from __future__ import annotations

import casadi as ca

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof.second.chart import Expr


def stream_at(stand: Stand, position: Expr) -> Expr:
    """u (3; m/s) in E0, by CasADi's own function of lines between stations."""
    u = ca.DM(stand.stream or (0.0, 0.0, 0.0))
    if stand.profile is None:
        return u
    depth = ca.SX.sym("depth")
    lines = [ca.pw_lin(depth, ca.DM(stand.profile.depth), ca.DM(v)) for v in zip(*stand.profile.velocity, strict=True)]
    by_depth = ca.Function("stream_by_depth", [depth], [ca.vertcat(*lines)])
    return u + by_depth(_depth(stand, position))


def _depth(stand: Stand, position: Expr) -> Expr:
    assert stand.profile is not None
    down = ca.DM(stand.profile.down)
    return ca.dot(down, position) / ca.norm_2(down)


def check_depth(stand: Stand, state: State) -> None:
    """StateError where the profile does not reach to the depth of O1."""
    if stand.profile is None:
        return
    depth, stations = float(_depth(stand, ca.DM(state.position))), stand.profile.depth
    if not stations[0] <= depth <= stations[-1]:
        raise StateError(f"position: depth {depth:.6g} m is outside of stream_profile")
