"""The prescribed motion of a held carrier as twists in E1, from the coordinates of its freedoms, for M times at once.

The pose is the home pose moved by one freedom after the other (`core/stand/coordinates.py`). A factor exp(S x) takes
the twist so far to V_new = Ad V + S x', Ad the change of frame by the motion, and its derivative to

    V_new* = Ad V* - x' ad(S) (Ad V) + S x'',   ad(S) = [[<omega>, <v>], [0, <omega>]] of S = (v, omega).
"""

from __future__ import annotations

import numpy as np

from mahovik.core.motion.functions import Course
from mahovik.core.stand.coordinates import coordinates_of
from mahovik.core.stand.hold import twists as freedom_twists
from mahovik.core.stand.model import Stand
from mahovik.use.numeric.array import Array
from mahovik.use.numeric.se3 import attitude, motor_cross, skew

SMALL = 1e-2
"""rad: below it the translation of a screw is taken from a series."""


def held_pose(stand: Stand, x: Array) -> tuple[Array, Array]:
    """Attitude C (M, 3, 3) and place of O1 in E0 (M, 3) at coordinates x (M, m)."""
    hold = stand.hold
    assert hold is not None
    S = freedom_twists(hold)
    C = np.tile(attitude(stand.angles, np.array(hold.angles)), (len(x), 1, 1))
    O1 = np.tile(np.array(hold.position), (len(x), 1))
    for k in coordinates_of(stand).order:
        turn, shift = _motion(S[:, k], x[:, k])
        O1 = O1 + (C @ shift[:, :, None])[:, :, 0]
        C = C @ turn
    return C, O1


def held_twists(stand: Stand, course: Course) -> tuple[Array, Array]:
    """V and V* (M, 6 each) in E1 of coordinates x, x', x'' (M, m each)."""
    hold = stand.hold
    assert hold is not None
    S = freedom_twists(hold)
    V, V_dot = np.zeros((len(course.q), 6)), np.zeros((len(course.q), 6))
    for k in coordinates_of(stand).order:
        carried = _adjoint(*_motion(S[:, k], course.q[:, k]))
        V, V_dot = ((carried @ each[:, :, None])[:, :, 0] for each in (V, V_dot))
        rate = course.q_dot[:, k, None]
        bracket = -motor_cross(S[:, k]).T  # ad(S): the dual of what acts on momenta
        V_dot = V_dot - rate * (V @ bracket.T) + course.q_ddot[:, k, None] * S[:, k]
        V = V + rate * S[:, k]
    return V, V_dot


def held_slopes(stand: Stand, x: Array) -> Array:
    """J (M, 6, m): V = J x' in E1 at coordinates x (M, m)."""
    none, columns = np.zeros_like(x), []
    for k in range(x.shape[1]):
        one = none.copy()
        one[:, k] = 1.0
        columns.append(held_twists(stand, Course(x, one, none))[0])
    return np.stack(columns, axis=2)


def _motion(S: Array, x: Array) -> tuple[Array, Array]:
    """exp(S x) for M values of x: its turn (M, 3, 3) and its shift (M, 3), on the axes before it."""
    v, omega = S[:3], S[3:]
    size = float(np.linalg.norm(omega))
    if size == 0.0:
        return np.tile(np.eye(3), (len(x), 1, 1)), np.outer(x, v)
    n, angle = skew(omega / size), (size * x)[:, None, None]
    turn = np.eye(3) + np.sin(angle) * n + (1.0 - np.cos(angle)) * (n @ n)
    with np.errstate(divide="ignore", invalid="ignore"):
        first, second = (1.0 - np.cos(angle)) / angle, (angle - np.sin(angle)) / angle
    near = np.abs(angle) < SMALL
    first = np.where(near, angle / 2.0 - angle**3 / 24.0 + angle**5 / 720.0, first)
    second = np.where(near, angle**2 / 6.0 - angle**4 / 120.0 + angle**6 / 5040.0, second)
    return turn, x[:, None] * ((np.eye(3) + first * n + second * (n @ n)) @ v)


def _adjoint(turn: Array, shift: Array) -> Array:
    """Ad (M, 6, 6): twists (linear; angular) on the axes before a motion to those of the frame after it."""
    back = np.swapaxes(turn, 1, 2)
    found = np.zeros((len(turn), 6, 6))
    found[:, :3, :3] = found[:, 3:, 3:] = back
    found[:, :3, 3:] = -back @ skew(shift)
    return found
