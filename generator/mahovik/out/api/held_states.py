"""Many states of a held carrier at once: poses that are left out, poses that the hold blocks, states of coordinates."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.hold import (
    TWIST_NAMES,
    carried_point,
    freedom_names,
    has_coordinates,
    is_closed,
    numbered_freedoms,
    twists,
    words,
)
from mahovik.core.stand.model import Stand
from mahovik.errors import InputError
from mahovik.proof.verify.held import ALLOWED
from mahovik.use.simulate.held import home

Array = NDArray[Any]


def home_attitude(stand: Stand) -> Array:
    """Quaternion (4), w first, of the home pose; of a free carrier (1, 0, 0, 0)."""
    return np.array(home(stand).quaternion)


def place_at(stand: Stand, attitude: Array) -> Array:
    """O1 in E0 (3, or n x 3; m), where the hold has a carrier of this attitude (4, or n x 4) that did not slide."""
    hold = stand.hold
    assert hold is not None
    arm = _rotate(home_attitude(stand), np.array(hold.pivot)) - _rotate(attitude, np.array(hold.pivot))
    return np.asarray(np.array(hold.position) + arm)


def check_pose(stand: Stand, position: Array, attitude: Array) -> None:
    """Raise InputError for poses that the hold does not allow; of a set that is not closed all are allowed.

    position: m, in E0, (3) or (n, 3); attitude: quaternions, w first, (4) or (n, 4)
    """
    hold = stand.hold
    assert hold is not None
    if not is_closed(hold) or any(freedom.kind == "twist" for freedom in hold.freedoms):
        return
    back = home_attitude(stand) * np.array([1.0, -1.0, -1.0, -1.0])
    pivot, slides = map(np.array, carried_point(hold))
    gone = position - np.array(hold.position) + _rotate(attitude, pivot)
    way = np.atleast_2d(_rotate(back, gone) - pivot)
    turned = np.atleast_2d(2.0 * _product(back, attitude)[..., 1:])
    turns = np.array([twists(hold)[3:, k] for k, freedom in enumerate(hold.freedoms) if freedom.kind == "turn"])
    way, turned = np.broadcast_arrays(way - way @ slides.T, turned - (turned @ turns.T @ turns if len(turns) else 0.0))
    off = np.concatenate([way, turned], axis=1)
    far = np.abs(off).max(axis=1) > ALLOWED * np.maximum(1.0, np.abs(np.atleast_2d(position)).max(axis=1))
    if far.any():
        first = off[np.flatnonzero(far)[0]]
        worst = int(np.argmax(np.abs(first)))
        which = f" of state {np.flatnonzero(far)[0]}" if len(far) > 1 else ""
        free = words(hold).partition(";")[0].partition(", ")[2]
        expected = f"what the freedoms ({free}) reach, or no position" if hold.freedoms else "the home pose, as clamped"
        raise InputError(
            f"position, attitude{which}: off by {abs(first[worst]):.3g} {'m' if worst < 3 else 'rad'} along "
            f"{TWIST_NAMES[worst]}, which [hold] blocks; expected {expected}"
        )


def coordinate_names(stand: Stand) -> tuple[str, ...]:
    """Freedoms with a number of their own in q. InputError: a free carrier, or no coordinates."""
    hold, function = stand.hold, "state_from_coordinates"
    if hold is None:
        raise InputError(f"{function}: the stand has no [hold], expected state(position=, attitude=, V=)")
    if not has_coordinates(hold):
        problem = "the freedoms of [hold] have no coordinates" if hold.freedoms else "a clamped carrier has no freedoms"
        raise InputError(f"{function}: {problem}, expected state({'u=' if hold.freedoms else ''})")
    return tuple(freedom_names(hold)[k] for k in numbered_freedoms(hold))


def of_coordinates(stand: Stand, q: Array, orientation: Array, q_dot: Array) -> tuple[Array, Array, Array]:
    """Position, attitude and V (each for n states) of q (n, k), orientation (n, 4) and q_dot (n, m).

    C = C0 R, O1 = O1_home + C0 (w + pivot) - C pivot, V = S u, u = R^T w* of what slides.
    """
    hold = stand.hold
    assert hold is not None
    S, numbered = twists(hold), numbered_freedoms(hold)
    w, turn, u, sliding = np.zeros((len(q), 3)), orientation, q_dot.copy(), np.zeros((len(q), 3))
    for i, k in enumerate(numbered):
        if hold.freedoms[k].kind == "slide":
            w = w + q[:, i, None] * S[:3, k]
        else:
            half = q[:, i, None] / 2
            turn = np.concatenate([np.cos(half), np.sin(half) * S[3:, k]], axis=1)
    slides = [k for k in numbered if hold.freedoms[k].kind == "slide"]
    sliding = sum((q_dot[:, k, None] * S[:3, k] for k in slides), sliding)
    back = turn * np.array([1.0, -1.0, -1.0, -1.0])
    for k in slides:
        u[:, k] = _rotate(back, sliding) @ S[:3, k]
    at_home, pivot = home_attitude(stand), np.array(hold.pivot)
    attitude = _product(at_home, turn)
    position = np.array(hold.position) + _rotate(at_home, w + pivot) - _rotate(attitude, pivot)
    return position, attitude, u @ S.T


def _product(a: Array, b: Array) -> Array:
    """Quaternions a b, w first."""
    v, w = a[..., 1:], b[..., 1:]
    scalar = a[..., :1] * b[..., :1] - np.sum(v * w, axis=-1, keepdims=True)
    return np.concatenate([scalar, a[..., :1] * w + b[..., :1] * v + np.cross(v, w)], axis=-1)


def _rotate(attitude: Array, vector: Array) -> Array:
    """C x of unit quaternions."""
    axis = attitude[..., 1:]
    cross = 2.0 * np.cross(axis, vector)
    return np.asarray(vector + attitude[..., :1] * cross + np.cross(axis, cross))
