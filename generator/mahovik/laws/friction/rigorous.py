"""Friction along the freedoms, in balls."""

from __future__ import annotations

from flint import arb, arb_mat

from mahovik.core.stand.model import Hold, Stand
from mahovik.core.stand.state import State
from mahovik.laws.friction.data import Friction, frictions_of
from mahovik.proof.rigorous.ball import column, dot, length, number, part, zeros
from mahovik.proof.rigorous.screw import force_at, screw_of_parts


def wrenches(stand: Stand, state: State, O1: arb_mat, C: arb_mat, V: arb_mat) -> list[arb_mat]:
    """Wrench (6; N, N m) of the friction of every freedom on the carrier about O1 in E1."""
    hold = stand.hold
    if hold is None or not frictions_of(stand):
        return []
    along = _unit_wrenches(hold)
    found = []
    for friction in frictions_of(stand):
        own = along[friction.freedom]
        found.append(own * -_drag(friction, dot(own, V)))
    return found


def _drag(friction: Friction, u: arb) -> arb:
    smoothing = number(friction.smoothing)
    level = number(friction.coulomb)
    if friction.stribeck_speed is not None:
        ratio = u / number(friction.stribeck_speed)
        level += (number(friction.breakaway) - number(friction.coulomb)) / (1 + ratio * ratio)
    return number(friction.viscous) * u + level * u / (u * u + smoothing * smoothing).sqrt()


def _unit_wrenches(hold: Hold) -> list[arb_mat]:
    """Wrenches at O1 of a force 1 along each freedom; of a basis the columns of S (S^T S)^-1."""
    if any(freedom.kind == "twist" for freedom in hold.freedoms):
        S = arb_mat([[number(x) for x in freedom.twist] for freedom in hold.freedoms]).transpose()
        dual = (S * (S.transpose() * S).inv()).transpose()
        return [part(dual, slice(k, k + 1)).transpose() for k in range(dual.nrows())]
    found = []
    for freedom in hold.freedoms:
        d = column(freedom.direction) * (1 / length(column(freedom.direction)))
        found.append(force_at(d, column(hold.pivot)) if freedom.kind == "slide" else screw_of_parts(zeros(3), d))
    return found
