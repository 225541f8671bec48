"""The stand in the closed loop: carrier and flywheels under motor torques, (8) with the drive equations.

Computed by the emitted C (function `step`, fixed steps), or by SciPy on the literal reference, slowly, to judge the C.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import cast

import numpy as np
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from mahovik.contract.status import status_words
from mahovik.core.motion.laws import drive, steepness
from mahovik.core.stand.model import Stand, Vec3, Vec6
from mahovik.core.stand.state import State, rest_state
from mahovik.core.toolchain.block import Block
from mahovik.errors import StateError, UsageError
from mahovik.proof import reference
from mahovik.proof.reference.motion import coupled
from mahovik.proof.reference.rotation import quaternion_rotation
from mahovik.use.numeric import Array, Chart, inertia
from mahovik.use.simulate.by_c import compiled_backend
from mahovik.use.simulate.by_scipy import quaternion_rate
from mahovik.use.simulate.friction_steps import long_steps

STIFFNESS = 0.2
"""Largest product of step and fastest decay rate of a speed: a flywheel's by its motor, a freedom's by friction."""

TURN = 0.05
"""rad: largest turn of a flywheel in a step; the carrier's error is then far below a millionth of its motion."""


class SteppedPlant:
    """Plant in steps of fourth order. Torques are those of the motors at the speeds in the middle of each step.

    State: position (3), attitude (4, quaternion, w first), V (6), phi, phi_dot (N each); tau: motor torques at the end.
    """

    def __init__(self, stand: Stand, state: State, block: Block, lane: int = 0, finer: int = 1) -> None:
        """The state in `lane` of a block; `finer`: number of steps in place of one."""
        self.stand, self._block, self._lane, self._finer = stand, block, lane, finer
        N, x = len(stand.flywheels), block.x[:, lane]
        block.x.T[:] = [*state.position, *(state.quaternion or ()), *state.V, *state.phi, *state.phi_dot]
        block.given["order"][0] = 4
        self.position, self.attitude, self.V = x[:3], x[3:7], x[7:13]
        self._wrapped, self.phi_dot = x[13 : 13 + N], x[13 + N : 13 + 2 * N]
        self.phi, self.tau, self._rate = np.array(state.phi), np.zeros(N), np.zeros(N)
        self._drive = block.given["tau"][:, lane]
        self._motors = [(s, each.motor) for s, each in enumerate(stand.flywheels) if each.motor is not None]
        self._fastest = _steepest_rate(stand)

    def advance(self, command: Array, begin: float, end: float) -> None:
        """Advance from `begin` to `end` (s) under constant commanded torques (N, N m). StateError: out of range."""
        span = end - begin
        if not np.all(np.isfinite(command)):
            raise StateError(f"at t = {begin:.6g} s a commanded torque is not a number")
        count = self._finer * max(1, math.ceil(span * max(self._fastest, float(np.abs(self.phi_dot).max()) / TURN)))
        h = span / count
        for _ in range(count):
            before, phase = self.phi_dot.copy(), self._wrapped.copy()
            self._drive[:] = command
            for s, motor in self._motors:
                self._drive[s] = drive(motor, float(command[s]), float(before[s] + 0.5 * h * self._rate[s]))
            self._block.given["dt"][0], self._block.status[self._lane] = h, 0
            self._block.call("step")
            if (status := int(self._block.status[self._lane])) < 0:
                raise StateError(
                    f"at t = {begin:.6g} s a step returned {status_words(status)}: the motion leaves its ranges"
                )
            self._rate = (self.phi_dot - before) / h
            turned, expected = self._wrapped - phase, 0.5 * h * (before + self.phi_dot)
            self.phi = self.phi + turned + 2.0 * np.pi * np.round((expected - turned) / (2.0 * np.pi))
        self.tau = self._drive.copy()


def _steepest_rate(stand: Stand) -> float:
    """Steps per second that the steepest motor needs, and the friction of a hold."""
    J = [inertia(s)[3, 3] for s in stand.flywheels]
    anywhere = math.inf
    falls = [steepness(s.motor, 0.0, -anywhere, anywhere) for s in stand.flywheels]
    rates = [fall / (0.5 * j) for fall, j in zip(falls, J, strict=True)]
    rates += [1.0 / friction.bound for friction in long_steps(stand, math.inf)]
    return float(max(rates, default=0.0)) / STIFFNESS


class PlantByReference:
    """The same plant by DOP853 on the literal reference, with independent kinematics."""

    def __init__(self, stand: Stand, state: State) -> None:
        assert state.quaternion is not None
        self.stand, self._state = stand, state
        self.position, self.attitude, self.V = (np.array(x) for x in (state.position, state.quaternion, state.V))
        self.phi, self.phi_dot = np.array(state.phi), np.array(state.phi_dot)
        self.tau = np.zeros(len(state.phi))

    def advance(self, command: Array, begin: float, end: float) -> None:
        """Advance from `begin` to `end` (s) under constant commanded torques (N, N m). StateError: out of range."""
        y = np.concatenate([self.position, self.attitude, self.V, self.phi, self.phi_dot])
        found = solve_ivp(lambda _, y: self._rates(y, command), (begin, end), y, "DOP853", rtol=1e-9, atol=1e-12)
        if not found.success:
            raise StateError(f"at t = {begin:.6g} s the integration fails: {found.message}")
        y, N = found.y[:, -1], len(self.phi)
        self.position, self.attitude, self.V = y[:3], y[3:7] / np.linalg.norm(y[3:7]), y[7:13]
        self.phi, self.phi_dot = y[13 : 13 + N], y[13 + N :]
        self.tau = self._torques(command, self.phi_dot)

    def _torques(self, command: Array, speeds: Array) -> Array:
        motors = [s.motor for s in self.stand.flywheels]
        return np.array([drive(m, float(u), float(w)) for m, u, w in zip(motors, command, speeds, strict=True)])

    def _rates(self, y: Array, command: Array) -> Array:
        N = len(self.phi)
        w, a, b, c = (y[3:7] / np.linalg.norm(y[3:7])).tolist()
        state = replace(
            self._state,
            position=cast(Vec3, tuple(y[:3].tolist())),
            angles=None,
            quaternion=(w, a, b, c),
            V=cast(Vec6, tuple(y[7:13].tolist())),
            phi=tuple(y[13 : 13 + N].tolist()),
            phi_dot=tuple(y[13 + N :].tolist()),
        )
        at, driven = reference.pieces(self.stand, state), self._torques(command, y[13 + N :])
        V_dot, phi_ddot = coupled(at, driven, np.zeros(N, dtype=bool))
        turning = quaternion_rate(np.array([w, a, b, c]), y[10:13])
        return np.concatenate([quaternion_rotation(w, a, b, c) @ y[7:10], turning, V_dot, y[13 + N :], phi_ddot])


Plant = SteppedPlant | PlantByReference
BACKENDS = ("c", "scipy")


def plant(stand: Stand, state: State, backend: str = "c", finer: int = 1) -> Plant:
    """A plant in a state with a quaternion; `finer`: number of steps of the C in place of one.

    Raises UsageError, ToolchainError.
    """
    if backend == "c":
        return SteppedPlant(stand, state, Block(stand, compiled_backend(stand).made, 1), finer=finer)
    if backend == "scipy":
        return PlantByReference(stand, state)
    raise UsageError(f"--backend {backend}: expected one of {', '.join(BACKENDS)}")


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
