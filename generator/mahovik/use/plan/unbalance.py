"""What unbalance and asymmetry add to a programme of the mean stand: the stand itself with the same flywheel motions.

The carrier of the stand has the momentum that the mean stand has at t = 0, so that it rests where unbalance only shakes
it; from there (8) with the programme's phi(t), block by block, each by collocation at uniform nodes.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand.masses import mean_stand
from mahovik.core.stand.model import Stand
from mahovik.use.numeric.course import INTERVALS, Chart, course
from mahovik.use.numeric.frame import Frame
from mahovik.use.numeric.mechanics import Mechanics
from mahovik.use.numeric.residual import drive
from mahovik.use.numeric.se3 import Array

NODES = 24
"""Nodes in a turn of the fastest flywheel: two to the period of what shakes twice a turn would be the least."""

LEAST, MOST = 4096, 1 << 20
"""Nodes in all."""

BLOCK = 1024
"""Nodes that are found together."""

LONGEST = 0.5
"""s: a longer block is cut."""


@dataclass(frozen=True, eq=False)
class UnbalanceEffect:
    """Motion of the carrier of the stand beside that of its mean stand, at times t (M, s).

    turn  (M, 3): rotation vector from the course of the programme to the carrier's attitude, rad, in E1
    shift (M, 3): of O1, m, in E0
    """

    t: Array
    turn: Array
    shift: Array

    def figures(self, sight: Array | None) -> dict[str, dict[str, float]]:
        """`angle` (rad) of the attitude or of the line of `sight` (3, in E1), `shift` (m): largest, RMS, at the end."""
        turn = self.turn if sight is None else np.cross(self.turn, sight)
        result = {}
        for name, values in (("angle", turn), ("shift", self.shift)):
            sizes = np.linalg.norm(values, axis=1)
            result[name] = {
                "largest": float(sizes.max()),
                "rms": float(np.sqrt(np.mean(sizes**2))),
                "end": float(sizes[-1]),
            }
        return result


def twist_at_rest(stand: Stand, V: Array, phi: Array, phi_dot: Array) -> Array:
    """Twist V (6) of the carrier of a stand that has the momentum of the mean stand with the twist V; phi, phi' (N)."""
    exact, mean = (Mechanics.of(variant).mass_and_coupling(phi[None]) for variant in (stand, mean_stand(stand)))
    (K, I), (K0, I0) = ((a[0], b[0]) for a, b in (exact, mean))
    return np.asarray(V + np.linalg.solve(K, (K0 - K) @ V + (I0 - I) @ phi_dot))


def unbalance_effect(stand: Stand, motion: RequiredMotion, programme: Programme) -> UnbalanceEffect | None:
    """Motion of the stand itself by a finite programme of its mean stand; None: the flywheels turn too often for it.

    Raises StateError: the carrier is lost.
    """
    span = programme.span
    speed = np.abs(programme.at(np.linspace(0.0, span, 1025)).phi_dot).max()
    count = max(LEAST, NODES * speed * span / (2.0 * np.pi))
    if count > MOST:
        return None
    size = max(1, min(BLOCK, int(LONGEST * count / span)) // INTERVALS) * INTERVALS
    blocks = int(np.ceil(count / size))
    t = np.linspace(0.0, span, blocks * size + 1)
    mechanics, h = Mechanics.of(stand), float(t[1])
    at = mechanics.frame.twists(motion.at(t[:1], programme.bias))
    start = programme.at(t[:1])
    V = twist_at_rest(stand, at.V[0], start.phi[0], start.phi_dot[0])
    O1, C = at.O1[0], at.C[0]
    turns, shifts = [np.zeros((1, 3))], [np.zeros((1, 3))]
    for k in range(blocks):
        times = t[k * size : (k + 1) * size + 1]
        chart = Chart(mechanics, Frame.at_pose(stand, C, O1))
        driven, begin = drive(mechanics, *programme.at(times)), np.concatenate([np.zeros(6), V])
        guess = begin + np.outer(times - times[0], np.concatenate([V, np.zeros(6)]))
        y = course(chart, driven, h, begin, guess, None).y
        moved, wanted = chart.twists(y[1:]), mechanics.frame.twists(motion.at(times[1:], programme.bias))
        turns.append(Rotation.from_matrix(np.swapaxes(wanted.C, 1, 2) @ moved.C).as_rotvec())
        shifts.append(moved.O1 - wanted.O1)
        O1, C, V = moved.O1[-1], moved.C[-1], y[-1, 6:]
    return UnbalanceEffect(t, np.vstack(turns), np.vstack(shifts))
