"""The stand in the closed loop: carrier and flywheels under motor torques, (8) with the drive equations.

Computed by the emitted C (function `step`, fixed steps), or by SciPy on the literal reference, slowly, to judge the C.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import cast

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.core.motion.laws import Torque
from mahovik.core.stand.model import Stand, Vec3, Vec6
from mahovik.core.stand.motor import drive, steepness
from mahovik.core.stand.state import State, rest_state
from mahovik.core.toolchain.block import Block
from mahovik.core.toolchain.compiled import compile_library
from mahovik.errors import StateError, UsageError
from mahovik.use.numeric.course import Chart
from mahovik.use.numeric.mechanics import inertia
from mahovik.use.numeric.se3 import Array
from mahovik.use.simulate import judge
from mahovik.use.simulate.course import Course
from mahovik.use.simulate.held import long_steps

STIFFNESS = 0.2
"""Largest product of step and fastest decay rate of a speed: a flywheel's by its motor, a freedom's by friction."""

TURN = 0.05
"""rad: largest turn of a flywheel in a step; the carrier's error is then far below a millionth of its motion."""


class SteppedPlant:
    """Plant in steps of fourth order. Torques are those of the motors at the speeds in the middle of each step.

    State: position (3), attitude (4, quaternion, w first), V (6), phi, phi_dot (N each); tau: torques at the end.
    """

    def __init__(self, stand: Stand, state: State, finer: int = 1) -> None:
        """`finer`: number of steps in place of one. Raises ToolchainError."""
        self._finer, self._block = finer, Block(stand, compile_library(stand, kind="states"), 1)
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
        count = self._finer * max(1, math.ceil(span * max(self._fastest, float(np.abs(self.phi_dot).max()) / TURN)))
        self._course.advance(command, begin, span / count, count)
        if why := self._block.reason(0):
            raise StateError(why)
        self.tau = self._block.given["tau"][:, 0].copy()


def _steepest_rate(stand: Stand) -> float:
    """Steps per second that the steepest motor needs, and the friction of a hold."""
    rates = [steepness(s.motor) / (0.5 * inertia(s)[3, 3]) for s in stand.flywheels]
    rates += [1.0 / friction.bound for friction in long_steps(stand, math.inf)]
    return float(max(rates, default=0.0)) / STIFFNESS


class PlantByReference:
    """The same plant by the judge, on the literal reference."""

    def __init__(self, stand: Stand, state: State) -> None:
        self.stand, self._state = stand, state
        self._y = np.array([*state.position, *(state.quaternion or ()), *state.V, *state.phi, *state.phi_dot])
        self.tau = np.zeros(len(state.phi))
        self._take(self._y)

    def advance(self, command: Array, begin: float, end: float) -> None:
        """Advance from `begin` to `end` (s) under constant commanded torques (N, N m). StateError: out of range."""
        driven = np.ones(len(command), dtype=bool)

        def slope(_: float, y: Array) -> Array:
            state = self._state_of(y)
            tau = self._torques(command, y[13 + len(command) :])
            V_dot, phi_ddot = judge.accelerations(self.stand, state, tau, np.zeros(len(command)), driven)
            return judge.rate(state, V_dot, phi_ddot)

        y, _ = judge.integrate(slope, self._y, begin, end)
        y[3:7] /= np.linalg.norm(y[3:7])
        self._take(y)
        self.tau = self._torques(command, self.phi_dot)

    def _take(self, y: Array) -> None:
        N = len(self.tau)
        self._y, self.position, self.attitude, self.V = y, y[:3], y[3:7], y[7:13]
        self.phi, self.phi_dot = y[13 : 13 + N], y[13 + N :]

    def _torques(self, command: Array, speeds: Array) -> Array:
        motors = [s.motor for s in self.stand.flywheels]
        return np.array([drive(m, float(u), float(w)) for m, u, w in zip(motors, command, speeds, strict=True)])

    def _state_of(self, y: Array) -> State:
        N = len(self.tau)
        w, a, b, c = (y[3:7] / np.linalg.norm(y[3:7])).tolist()
        return replace(
            self._state, position=cast(Vec3, tuple(y[:3].tolist())), angles=None, quaternion=(w, a, b, c),
            V=cast(Vec6, tuple(y[7:13].tolist())), phi=tuple(y[13 : 13 + N].tolist()),
            phi_dot=tuple(y[13 + N :].tolist()),
        )  # fmt: skip


Plant = SteppedPlant | PlantByReference
BACKENDS = ("c", "scipy")


def plant(stand: Stand, state: State, backend: str = "c", finer: int = 1) -> Plant:
    """A plant in a state with a quaternion; `finer`: number of steps of the C in place of one.

    Raises UsageError, ToolchainError.
    """
    if backend == "c":
        return SteppedPlant(stand, state, finer)
    if backend == "scipy":
        return PlantByReference(stand, state)
    raise UsageError(f"backend {backend}: expected one of {', '.join(BACKENDS)}")


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
