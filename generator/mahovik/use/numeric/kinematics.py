"""The prescribed motion of the carrier as twists in E1, (10), for M times at once."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mahovik.core.motion.functions import Course
from mahovik.core.stand.model import Stand
from mahovik.use.numeric.array import Array
from mahovik.use.numeric.held_kinematics import held_pose, held_twists
from mahovik.use.numeric.se3 import AXES, attitude, turn
from mahovik.use.numeric.stream import uniform_stream


class Twists(NamedTuple):
    """Attitude C (M, 3, 3), place O1 in E0 (M, 3), and in E1: V (M, 6), V_r and V_r* relative to the fluid (M, 6).

    Derivatives are of components: V_r* = V* + (omega x C^T u, 0), u the stream.
    """

    C: Array
    O1: Array
    V: Array
    V_r: Array
    V_r_dot: Array


def twists(stand: Stand, course: Course) -> Twists:
    """V = A q', V* = A q'' + D q' of (10), without the inverse of A: no attitude is singular here.

    Of a held carrier they come from the coordinates of its freedoms.
    """
    if stand.hold is not None:
        C, O1 = held_pose(stand, course.q)
        return _in_fluid(stand, C, O1, *held_twists(stand, course))
    angles, rates, seconds = (x[:, 3:] for x in (course.q, course.q_dot, course.q_ddot))
    C = attitude(stand.angles, angles)
    a, b, c = (np.eye(3)[axis] for axis in AXES[stand.angles])
    into_b = np.swapaxes(turn(AXES[stand.angles][2], angles[:, 2]), 1, 2)  # E1 has turned on by phi about c
    into_a = into_b @ np.swapaxes(turn(AXES[stand.angles][1], angles[:, 1]), 1, 2)
    by_psi, by_theta = into_a @ a, into_b @ b  # columns of B; the third is c itself
    psi_dot, theta_dot, phi_dot = (rates[:, k : k + 1] for k in range(3))
    by_theta_dot = -phi_dot * np.cross(c, by_theta)
    by_psi_dot = -phi_dot * np.cross(c, by_psi) - theta_dot * np.cross(by_theta, by_psi)
    omega = by_psi * psi_dot + by_theta * theta_dot + c * phi_dot
    omega_dot = by_psi * seconds[:, :1] + by_theta * seconds[:, 1:2] + c * seconds[:, 2:]
    omega_dot += by_psi_dot * psi_dot + by_theta_dot * theta_dot
    v = in_E1(C, course.q_dot[:, :3])
    v_dot = in_E1(C, course.q_ddot[:, :3]) - np.cross(omega, v)
    return _in_fluid(stand, C, course.q[:, :3], np.hstack([v, omega]), np.hstack([v_dot, omega_dot]))


def _in_fluid(stand: Stand, C: Array, O1: Array, V: Array, V_dot: Array) -> Twists:
    """With the twists relative to the fluid."""
    omega = V[:, 3:]
    u = in_E1(C, np.broadcast_to(uniform_stream(stand), O1.shape))
    V_r = np.hstack([V[:, :3] - u, omega])
    V_r_dot = np.hstack([V_dot[:, :3] + np.cross(omega, u), V_dot[:, 3:]])
    return Twists(C, O1, V, V_r, V_r_dot)


def in_E1(C: Array, x: Array) -> Array:
    """C^T x (M, 3) of x (M, 3) in E0."""
    return np.asarray((x[:, None, :] @ C)[:, 0, :])
