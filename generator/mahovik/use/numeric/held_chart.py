"""The equations of a held carrier along its freedoms, as `forward.Chart` has those of a free one.

A state is y = (x, u), two numbers for each freedom: x, the coordinates of `core/stand/coordinates.py` less those of the
chart's pose, and the speeds u of V = S u. What the hold blocks has no number and no equation:

    S^T K S u* = S^T (K V_r* - K (omega x C^T stream, 0)),    K V_r* the wrench on the carrier, the hold taken away,
    x' = J(x)^-1 u,    J(x) x' = u that of the coordinates' twist.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.core.motion.functions import Course
from mahovik.core.stand.coordinates import coordinates_of
from mahovik.core.stand.units import ANGLE
from mahovik.use.numeric.array import Array
from mahovik.use.numeric.forward import Chart, Drive
from mahovik.use.numeric.held_kinematics import held_pose, held_twists
from mahovik.use.numeric.kinematics import Twists, twists
from mahovik.use.numeric.prescribed_motion import Mechanics

SIDEWAYS = 1.5
"""rad: the second of three angles beyond this is too near to the quarter turn where the first and third are one."""


@dataclass(frozen=True, eq=False)
class HeldChart(Chart):
    """The equations of a held stand about the pose O1_0 (3; m), C_0 (3, 3) of its coordinates q (m)."""

    q: Array

    @property
    def count(self) -> int:
        """Freedoms."""
        return len(self.q)

    def of(self, course: Course) -> Array:
        """y (M, 2 m) of prescribed coordinates q, q' (M, m each)."""
        V, _ = held_twists(self.mechanics.stand, course)
        return np.hstack([course.q - self.q, V @ self._to_speeds.T])

    def twists(self, y: Array) -> Twists:
        """Attitude, position and twists (M) of states y (M, 2 m); V_r* is for V* = 0."""
        x, u = np.hsplit(y, 2)
        C, O1 = held_pose(self.mechanics.stand, self.q + x)
        return self._in_fluid(C, O1, u @ self.mechanics.freedoms.T)

    def displacement(self, y: Array) -> Array:
        """(M, 6; m, rad): way of O1 on the axes of the chart's pose, and rotation vector, from that pose.

        Turns about one axis are counted: the rotation vector may be longer than half a turn.
        """
        x, S = y[:, : self.count], self.mechanics.freedoms
        C, O1 = held_pose(self.mechanics.stand, self.q + x)
        r = Rotation.from_matrix(self.C.T @ C).as_rotvec() if np.linalg.matrix_rank(S[3:]) > 1 else x @ S[3:].T
        return np.hstack([(O1 - self.O1) @ self.C, r])

    def displacement_change(self, y: Array, moved: Array) -> Array:
        """Change (M, 6, P) of the displacement by changes of the states (M, 2 m, P); of r in E1, which |r| needs."""
        x = y[:, : self.count]
        C, _ = held_pose(self.mechanics.stand, self.q + x)
        twist = (self.mechanics.freedoms @ self._rates(x)) @ moved[:, : self.count]
        return np.concatenate([self.C.T @ C @ twist[:, :3], twist[:, 3:]], axis=1)

    def is_lost(self, y: Array) -> bool:
        """Whether three angles come near to where two of them turn about one axis."""
        coordinates = coordinates_of(self.mechanics.stand)
        turns = [k for k in coordinates.order if coordinates.dimensions[k] == ANGLE]
        return len(turns) == 3 and bool(np.abs(self.q[turns[1]] + y[:, turns[1]]).max() > SIDEWAYS)

    def acceleration(self, given: Drive, y: Array) -> Array:
        """V* (M, 6; m/s2, rad/s2) along the freedoms."""
        return np.asarray(self.speed_rates(given, y) @ self.mechanics.freedoms.T)

    def speed_rates(self, given: Drive, y: Array) -> Array:
        """u* (M, m; m/s2, rad/s2)."""
        at = self.twists(y)
        K = given.Theta + self.mechanics.base.K
        return np.asarray((given.mobility @ (self.wrench(given, at) - K @ at.V_r_dot[:, :, None]))[:, :, 0])

    def rate(self, given: Drive, y: Array) -> Array:
        """y' (M, 2 m)."""
        x, u = np.hsplit(y, 2)
        x_dot = np.linalg.solve(self._rates(x), u[:, :, None])[:, :, 0]
        return np.hstack([x_dot, self.speed_rates(given, y)])

    @property
    def _to_speeds(self) -> Array:
        """S^+ (m, 6): u of V = S u."""
        return np.asarray(np.linalg.pinv(self.mechanics.freedoms))

    def _rates(self, x: Array) -> Array:
        """J (M, m, m): u = J x'."""
        return coordinate_speeds(self.mechanics, self.q + x)


def coordinate_speeds(mechanics: Mechanics, q: Array) -> Array:
    """J (M, m, m) at coordinates q (M, m): u = J q'."""
    M, m = q.shape
    still, columns = np.zeros_like(q), []
    for k in range(m):
        V, _ = held_twists(mechanics.stand, Course(q, np.tile(np.eye(m)[k], (M, 1)), still))
        columns.append(V @ np.linalg.pinv(mechanics.freedoms).T)
    return np.stack(columns, axis=2)


def chart_at(mechanics: Mechanics, q: Array) -> Chart:
    """The chart of a free or held stand about the pose of coordinates q (6; held m)."""
    if mechanics.stand.hold is None:
        still = np.zeros((1, 6))
        return Chart.at_pose(mechanics, Course(q[None], still, still))
    still = np.zeros((1, len(q)))
    at = twists(mechanics.stand, Course(q[None], still, still))
    return HeldChart(mechanics, at.O1[0], at.C[0], np.array(q))
