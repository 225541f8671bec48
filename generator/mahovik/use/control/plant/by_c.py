"""The plant by the emitted C."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from mahovik.contract.status import status_words
from mahovik.core.motion.motor import drive, steepness
from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.use.plan.array import Array
from mahovik.use.plan.residual.flywheels import tables_of
from mahovik.use.simulate.by_c import compiled_backend

STIFFNESS = 0.2
"""Largest product of step and fastest decay rate of a flywheel's speed by its motor."""

TURN = 0.05
"""rad: largest turn of a flywheel in a step; the carrier's error is then far below a millionth of its motion."""


class PlantByC:
    """Plant in steps of fourth order. Torques are those of the motors at the speeds in the middle of each step."""

    def __init__(self, stand: Stand, state: State, finer: int = 1) -> None:
        self.stand, self._finer = stand, finer
        own = compiled_backend(stand)
        ffi, N = own.library.ffi, len(stand.flywheels)
        self._x = ffi.new(f"{stand.name}_state *")
        self._view = np.frombuffer(ffi.buffer(self._x), dtype=np.float64)
        self.position, self.attitude, self.V = self._view[:3], self._view[3:7], self._view[7:13]
        self._wrapped, self.phi_dot = self._view[13 : 13 + N], self._view[13 + N : 13 + 2 * N]
        attitude = own.arguments(state)["x"]["attitude"]
        self._view[:] = [*state.position, *attitude, *state.V, *state.phi, *state.phi_dot]
        self.phi, self.tau, self._rate = np.array(state.phi), np.zeros(N), np.zeros(N)
        self._drive, self._wrench = np.zeros(N), np.zeros(max(6 * len(own.inputs), 1))
        self._step = own.library.function("step")
        self._motors = [(s, each.motor) for s, each in enumerate(stand.flywheels) if each.motor is not None]
        self._fastest = _steepest_rate(stand)
        known: dict[str, Any] = {
            "table": own.library.default("default"),
            "x": self._x,
            "tau": ffi.cast(f"{stand.name}_real *", self._drive.ctypes.data),
            "locked": ffi.new(f"int[{N}]"),
            "wrench": ffi.cast(f"{stand.name}_real *", self._wrench.ctypes.data),
            "order": 4,
            "next": self._x,
        }
        self._arguments = [(a.name, known.get(a.name)) for a in own.program.function("step").arguments]
        self._kept = known

    def advance(self, command: Array, begin: float, end: float) -> None:
        """See Plant."""
        span = end - begin
        if not np.all(np.isfinite(command)):
            raise StateError(f"at t = {begin:.6g} s a commanded torque is not a number")
        count = self._finer * max(1, math.ceil(span * max(self._fastest, float(np.abs(self.phi_dot).max()) / TURN)))
        h = span / count
        arguments = [h if name == "dt" else value for name, value in self._arguments]
        for _ in range(count):
            before, phase = self.phi_dot.copy(), self._wrapped.copy()
            self._drive[:] = command
            for s, motor in self._motors:
                self._drive[s] = drive(motor, float(command[s]), float(before[s] + 0.5 * h * self._rate[s]))
            status = self._step(*arguments)
            if status < 0:
                raise StateError(
                    f"at t = {begin:.6g} s a step returned {status_words(status)}: the motion leaves its ranges"
                )
            self._rate = (self.phi_dot - before) / h
            turned, expected = self._wrapped - phase, 0.5 * h * (before + self.phi_dot)
            self.phi = self.phi + turned + 2.0 * np.pi * np.round((expected - turned) / (2.0 * np.pi))
        self.tau = self._drive.copy()


def _steepest_rate(stand: Stand) -> float:
    """Steps per second that the steepest motor needs."""
    J = tables_of(stand).Theta_ff
    anywhere = math.inf
    falls = [steepness(s.motor, 0.0, -anywhere, anywhere) for s in stand.flywheels]
    return float(max((fall / (0.5 * j) for fall, j in zip(falls, J, strict=True)), default=0.0)) / STIFFNESS
