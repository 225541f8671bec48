"""The stand in the closed loop: carrier and flywheels under motor torques, in fixed steps of the emitted C."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import cast

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.core.motion.laws import Torque
from mahovik.core.stand.model import Stand, Vec3, Vec6
from mahovik.core.stand.motor import steepness
from mahovik.core.stand.state import State, rest_state
from mahovik.core.toolchain.block import Block
from mahovik.core.toolchain.compiled import compile_library
from mahovik.errors import StateError
from mahovik.use.numeric.course import Chart
from mahovik.use.numeric.frame import Frame
from mahovik.use.numeric.mechanics import inertia
from mahovik.use.numeric.se3 import EULER, Array
from mahovik.use.simulate.course import Course
from mahovik.use.simulate.held import long_steps

_MOST, _LONGEST, _SETTLED = 40, 3.0, 1e-13
"""Most steps of Newton's method; longest step of a coordinate, and the one that ends it, m or rad."""

_REACHED = 1e-6
"""m, rad: a pose farther off than this is one that the freedoms do not reach."""


def coordinates(stand: Stand, position: Array, attitude: Array, near: Array) -> Array:
    """q (M, 6; m, rad) of positions (M, 3) and quaternions (M, 4; w first), angles within half a turn of `near`.

    Of a held carrier those of its freedoms (M, m); what a pose is off the hold by rounding is left out. StateError: a
    pose is none that the hold allows.
    """
    rotations = Rotation.from_quat(attitude[:, [1, 2, 3, 0]])
    if stand.hold is not None:
        q = _held_coordinates(stand, position, rotations.as_matrix(), near)
        if np.isnan(q).any():
            raise StateError(f"{stand.name}: hold: found a pose far from the required one, which it does not allow")
        return q
    angles = rotations.as_euler(EULER[stand.angles])
    return np.hstack([position, near[:, 3:] + np.remainder(angles - near[:, 3:] + np.pi, 2.0 * np.pi) - np.pi])


def _held_coordinates(stand: Stand, O1: Array, C: Array, near: Array) -> Array:
    """Coordinates (M, m) of poses O1 (M, 3; m), C (M, 3, 3) of a held carrier, by Newton's method from `near` (M, m).

    Each row by itself, so that its bits depend on no other. Angles are those within half a turn of `near`. NaN where
    the freedoms do not reach the pose.
    """
    x, moving = near.copy(), np.arange(len(near))
    for _ in range(_MOST):
        off = _offset(stand, O1[moving], C[moving], x[moving])
        step = (np.linalg.pinv(Frame.of(stand).slopes(x[moving])[2]) @ off[:, :, None])[:, :, 0]
        x[moving] += np.clip(step, -_LONGEST, _LONGEST)
        far = np.abs(step).max(axis=1, initial=0.0) > _SETTLED * (1.0 + np.abs(x[moving]).max(axis=1, initial=0.0))
        moving = moving[far]
        if not len(moving):
            break
    lost = np.abs(_offset(stand, O1, C, x)).max(axis=1, initial=0.0) > _REACHED
    return np.where(lost[:, None], np.nan, x)


def _offset(stand: Stand, O1: Array, C: Array, x: Array) -> Array:
    """Shift and rotation vector (M, 6; m, rad) in E1 from the pose at coordinates x to another."""
    there, place = Frame.of(stand).pose(x)
    back = np.swapaxes(there, 1, 2)
    turned = Rotation.from_matrix(back @ C).as_rotvec()
    return np.hstack([(back @ (O1 - place)[:, :, None])[:, :, 0], turned])


STIFFNESS = 0.2
"""Largest product of step and fastest decay rate of a speed: a flywheel's by its motor, a freedom's by friction."""

TURN = 0.05
"""rad: largest turn of a flywheel in a step; the carrier's error is then far below a millionth of its motion."""


class Plant:
    """Plant in steps of fourth order. Torques are those of the motors at the speeds in the middle of each step.

    State: position (3), attitude (4, quaternion, w first), V (6), phi, phi_dot (N each); tau: torques at the end.
    """

    def __init__(self, stand: Stand, state: State) -> None:
        """In a state with a quaternion. Raises ToolchainError."""
        self._block = Block(stand, compile_library(stand, kind="states"), 1)
        block, N = self._block, len(stand.flywheels)
        x = block.x[:, 0]
        x[:] = [*state.position, *(state.quaternion or ()), *state.V, *state.phi, *state.phi_dot]
        block.given["order"][0] = 4
        self.position, self.attitude, self.V, self.phi_dot = x[:3], x[3:7], x[7:13], x[13 + N : 13 + 2 * N]
        drives = [(Torque(0.0), s.motor) for s in stand.flywheels]
        self._course = Course(block, [False] * N, drives, by_torque=True)
        self._first, self.tau, self._fastest = np.array(state.phi), np.zeros(N), _steepest_rate(stand)

    @property
    def phi(self) -> Array:
        """Angles (N, rad), not wrapped."""
        return self._first + self._course.turned[:, 0]

    def advance(self, command: Array, begin: float, end: float) -> None:
        """Advance from `begin` to `end` (s) under constant commanded torques (N, N m). StateError: out of range."""
        if not np.all(np.isfinite(command)):
            raise StateError(f"at t = {begin:.6g} s a commanded torque is not a number")
        span = end - begin
        count = max(1, math.ceil(span * max(self._fastest, float(np.abs(self.phi_dot).max()) / TURN)))
        self._course.advance(command, begin, span / count, count)
        if why := self._block.reason(0):
            raise StateError(why)
        self.tau = self._block.given["tau"][:, 0].copy()


def _steepest_rate(stand: Stand) -> float:
    """Steps per second that the steepest motor needs, and the friction of a hold."""
    rates = [steepness(s.motor) / (0.5 * inertia(s)[3, 3]) for s in stand.flywheels]
    rates += [1.0 / friction.bound for friction in long_steps(stand, math.inf)]
    return float(max(rates, default=0.0)) / STIFFNESS


def plant_state(stand: Stand, chart: Chart, y: Array, phi: Array, phi_dot: Array) -> State:
    """The state of a plant: y (12; held 2 m) of a chart, flywheels at phi, phi' (N each)."""
    at = chart.twists(y[None])
    a, b, c, w = Rotation.from_matrix(at.C[0]).as_quat().tolist()
    return replace(
        rest_state(stand),
        position=cast(Vec3, tuple(at.O1[0].tolist())),
        quaternion=(w, a, b, c),
        V=cast(Vec6, tuple(at.V[0].tolist())),
        u=() if stand.hold is None else tuple(y[chart.count :].tolist()),
        phi=tuple(phi.tolist()),
        phi_dot=tuple(phi_dot.tolist()),
    )
