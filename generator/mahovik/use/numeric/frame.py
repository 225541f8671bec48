"""Coordinates of the carrier's pose, and its twist by their rates: one form for free and held carriers.

A pose is a first one moved by one freedom after the other, g = g0 exp(S_1 x_1) exp(S_2 x_2) ..., so that whole turns in
a plane are nowhere singular. A free carrier has all six freedoms, S = E. Required motions of it are O1 in E0 and the
angles of the stand's sequence; about any of its poses it slides along the axes there, then yaws, pitches and rolls.

With the columns J_k of V = J x', each carried on by the factors after it, V* = J x'' + sum_k [V_before, J_k x_k'],
where V_before is the twist by the freedoms that move before k, and [a, b] the bracket of twists.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.core.motion.functions import Course
from mahovik.core.stand.coordinates import coordinates_of
from mahovik.core.stand.hold import twists as freedom_twists
from mahovik.core.stand.model import Stand, Vec3
from mahovik.errors import StandError
from mahovik.use.numeric.se3 import AXES, SMALL, Array, attitude, skew


class Twists(NamedTuple):
    """Attitude C (M, 3, 3), place O1 in E0 (M, 3), and in E1: V (M, 6), V_r and V_r* relative to the fluid (M, 6).

    Derivatives are of components: V_r* = V* + (omega x C^T u, 0), u the stream.
    """

    C: Array
    O1: Array
    V: Array
    V_r: Array
    V_r_dot: Array


ORDER: tuple[int, ...] = (0, 1, 2, 5, 4, 3)
"""Freedoms of a free carrier about one of its poses, the first to move first."""
SIDEWAYS = 1.5
"""rad: the second of three angles beyond this is too near to the quarter turn where the first and third are one."""


@dataclass(frozen=True, eq=False)
class Frame:
    """The coordinates x (m) of a stand's carrier.

    S       (6, m): twists of its freedoms, V = S u
    screws  (6, m): twists in E1 of the coordinates, as they move one after the other by `order`
    C, O1   g0: attitude (3, 3) and place (3; m)
    start   (m): coordinates from which x is counted
    """

    stand: Stand
    S: Array
    screws: Array
    order: tuple[int, ...]
    C: Array
    O1: Array
    start: Array

    @staticmethod
    def of(stand: Stand) -> Frame:
        """The coordinates of a required motion. StandError: a held carrier has none."""
        coordinates_of(stand)
        if stand.hold is not None:
            return Frame.at_pose(stand, attitude(stand.angles, np.array(stand.hold.angles)), stand.hold.position)
        screws = np.eye(6)
        screws[3:, 3:] = np.eye(3)[:, AXES[stand.angles]]
        return replace(Frame.at_pose(stand, np.eye(3), np.zeros(3)), screws=screws, order=tuple(range(6)))

    @staticmethod
    def at_pose(stand: Stand, C: Array, O1: Array | Vec3) -> Frame:
        """The coordinates about a pose C (3, 3), O1 (3; m), which a hold allows. StandError as `of`, but if clamped."""
        S, order = freedom_twists(stand.hold), ORDER
        if stand.hold is not None:
            order = coordinates_of(stand).order if S.shape[1] else ()
        return Frame(stand, S, S, order, C, np.array(O1), np.zeros(S.shape[1]))

    def about(self, q: Array) -> Frame:
        """Coordinates counted from the pose at q (m)."""
        if self.stand.hold is not None:
            return replace(self, start=np.array(q))
        C, O1 = self.pose(q[None])
        return Frame.at_pose(self.stand, C[0], O1[0])

    def pose(self, x: Array) -> tuple[Array, Array]:
        """Attitude C (M, 3, 3) and place of O1 in E0 (M, 3) at coordinates x (M, m)."""
        return self.slopes(x)[:2]

    def slopes(self, x: Array) -> tuple[Array, Array, Array]:
        """The pose, and J (M, 6, m) of V = J x' in E1, at coordinates x (M, m)."""
        C, O1 = np.tile(self.C, (len(x), 1, 1)), np.tile(self.O1, (len(x), 1))
        moved = np.zeros((len(x), *self.screws.shape))  # columns as they move
        for n, k in enumerate(self.order):
            turn, shift = exponential(self.screws[:, k], self.start[k] + x[:, k])
            if shift is not None:
                O1 = O1 + (C @ shift[:, :, None])[:, :, 0]
            if turn is not None:
                C, back = C @ turn, np.swapaxes(turn, 1, 2)
                v, omega = moved[:, :3, :n], moved[:, 3:, :n]
                moved[:, :3, :n] = back @ (v if shift is None else v - skew(shift) @ omega)
                moved[:, 3:, :n] = back @ omega
            moved[:, :, n] = self.screws[:, k]
        J = np.empty_like(moved)
        J[:, :, self.order] = moved
        return C, O1, J

    def turning(self, J: Array, x_dot: Array) -> Array:
        """[V_before, J_k] of each coordinate k (M, 6, m): derivative by x_k of the twist J x', x' (M, m) constant."""
        result, V, turned = np.zeros_like(J), np.zeros(J.shape[:2]), False
        for k in self.order:
            turned |= bool(self.screws[3:, k].any())
            if turned:  # before, all slide
                v, omega = J[:, :3, k], J[:, 3:, k]
                result[:, :3, k] = np.cross(V[:, 3:], v) + np.cross(V[:, :3], omega)
                result[:, 3:, k] = np.cross(V[:, 3:], omega)
            V += J[:, :, k] * x_dot[:, k, None]
        return result

    def twists(self, course: Course) -> Twists:
        """Pose and twists (M) of a motion x, x', x'' (M, m each)."""
        C, O1, J = self.slopes(course.q)
        rates, seconds = course.q_dot[:, :, None], course.q_ddot[:, :, None]
        V_dot = J @ seconds + self.turning(J, course.q_dot) @ rates
        return in_fluid(self.stand, C, O1, (J @ rates)[:, :, 0], V_dot[:, :, 0])

    def coordinates(self, course: Course) -> Array:
        """x (M, m) here of a required motion q (M, m)."""
        if self.stand.hold is not None:
            return course.q - self.start
        C, O1 = Frame.of(self.stand).pose(course.q)
        turned = Rotation.from_matrix(self.C.T @ C).as_euler("ZYX")
        return np.hstack([(O1 - self.O1) @ self.C, turned[:, ::-1]])

    def is_lost(self, x: Array) -> bool:
        """Whether three angles come near to where two of them turn about one axis."""
        turns = [k for k in self.order if self.screws[3:, k].any()]
        return len(turns) == 3 and bool(np.abs(self.start[turns[1]] + x[:, turns[1]]).max() > SIDEWAYS)


def in_fluid(stand: Stand, C: Array, O1: Array, V: Array, V_dot: Array) -> Twists:
    """Poses and twists (M) with those relative to the fluid."""
    stream = uniform_stream(stand)
    if not any(stream):
        return Twists(C, O1, V, V, V_dot)
    u = in_E1(C, stream)
    none = np.zeros_like(u)
    return Twists(C, O1, V, V - np.hstack([u, none]), V_dot + np.hstack([np.cross(V[:, 3:], u), none]))


def in_E1(C: Array, x: Array | Vec3) -> Array:
    """C^T x (M, 3) of x (3, or M x 3) in E0."""
    return np.asarray((np.broadcast_to(x, (len(C), 3))[:, None, :] @ C)[:, 0, :])


def uniform_stream(stand: Stand) -> Vec3:
    """u (m/s) in E0, zero without a stream. StandError where it changes with depth."""
    if stand.profile is not None:
        raise StandError(
            [
                f"stand {stand.name}: stream_profile: found a stream that changes with depth, expected a uniform one: "
                "write its velocity at the depth that matters as `stream`, without [stream_profile]"
            ]
        )
    return stand.stream or (0.0, 0.0, 0.0)


def exponential(S: Array, x: Array) -> tuple[Array | None, Array | None]:
    """exp(S x) of a twist S (6), x (M): turn (M, 3, 3) and shift (M, 3) on the axes before it; None without one."""
    v, omega = S[:3], S[3:]
    size = float(np.linalg.norm(omega))
    if size == 0.0:
        return None, np.outer(x, v)
    n, angle = skew(omega / size), (size * x)[:, None, None]
    turn = np.eye(3) + np.sin(angle) * n + (1.0 - np.cos(angle)) * (n @ n)
    if not v.any():
        return turn, None
    with np.errstate(divide="ignore", invalid="ignore"):
        first, second = (1.0 - np.cos(angle)) / angle, (angle - np.sin(angle)) / angle
    near = np.abs(angle) < SMALL
    first = np.where(near, angle / 2.0 - angle**3 / 24.0 + angle**5 / 720.0, first)
    second = np.where(near, angle**2 / 6.0 - angle**4 / 120.0 + angle**6 / 5040.0, second)
    return turn, x[:, None] * ((np.eye(3) + first * n + second * (n @ n)) @ v)
