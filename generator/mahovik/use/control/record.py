"""Record of a closed loop: a row per sample; as columns with units."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.core.stand.state import State
from mahovik.use.control.plant import Plant
from mahovik.use.control.wanted import Wanted
from mahovik.use.plan.array import Array
from mahovik.use.simulate.run import Run, identity_of

_AXES = "xyz"
_ANGLES = ("psi", "theta", "phi")


@dataclass(eq=False)
class Record:
    """Rows at the samples; fewer if the run ended early. `stopped`: why it did, or None.

    t (M, s), position (M, 3), attitude (M, 4), V (M, 6), phi, phi_dot (M, N each): the true state
    tau           (M, N; N m): of motors and friction, during the step that ends there
    q, required   (M, 6): the carrier's coordinates, actual and required; m, rad
    apart         (M, N; rad): of the flywheels from the programme with its corrections
    command       (M, N; N m): of the servos
    corrections   (M, N, T; rad): of the trim
    rounds, limited   corrections made; samples in which a torque was cut
    """

    wanted: Wanted
    start: State
    t: Array
    position: Array
    attitude: Array
    V: Array
    phi: Array
    phi_dot: Array
    tau: Array
    q: Array
    required: Array
    apart: Array
    command: Array
    corrections: Array
    stopped: str | None = None
    interrupted: bool = False
    rounds: int = 0
    limited: int = 0

    @staticmethod
    def empty(wanted: Wanted, first: int, last: int, period: float, start: State) -> Record:
        """An empty record for samples with these numbers."""
        t: Array = period * np.arange(first, last + 1, dtype=np.float64)
        M, N = len(t), len(wanted.stand.flywheels)

        def rows(width: int) -> Array:
            return np.zeros((M, width))

        return Record(
            wanted, start, t, rows(3), rows(4), rows(6), rows(N), rows(N), rows(N), rows(6), rows(6), rows(N), rows(N),
            np.zeros((M, N, 1)),
        )  # fmt: skip

    def put(
        self, n: int, t: float, own: Plant, q: Array, required: Array, apart: Array, command: Array, corrections: Array
    ) -> None:
        """Write row n."""
        if n == 0 and corrections.shape != self.corrections.shape[1:]:
            self.corrections = np.zeros((len(self.t), *corrections.shape))
        self.t[n] = t
        self.position[n], self.attitude[n], self.V[n] = own.position, own.attitude, own.V
        self.phi[n], self.phi_dot[n], self.tau[n] = own.phi, own.phi_dot, own.tau
        self.q[n], self.required[n], self.apart[n], self.command[n] = q, required, apart, command
        self.corrections[n] = corrections

    def end(self, rows: int, why: str) -> None:
        """Keep only the first rows."""
        for name, value in vars(self).items():
            if isinstance(value, np.ndarray):
                setattr(self, name, value[:rows])
        self.stopped = why

    def run(self) -> Run:
        """The record as columns with units: those of `mahovik simulate` and the required motion."""
        names = [f"{a} [m]" for a in _AXES] + ["qw", "qx", "qy", "qz"]
        names += [f"v_{a} [m/s]" for a in _AXES] + [f"omega_{a} [rad/s]" for a in _AXES]
        names += [*(f"{a} [rad]" for a in _ANGLES), *(f"required_{a} [m]" for a in _AXES)]
        names += [f"required_{a} [rad]" for a in _ANGLES]
        parts = [self.position, self.attitude, self.V, self.q[:, 3:], self.required]
        kinds = (
            ("phi", "rad", self.phi), ("phi_dot", "rad/s", self.phi_dot), ("tau", "N m", self.tau),
            ("apart", "rad", self.apart), ("command", "N m", self.command),
        )  # fmt: skip
        for kind, unit, columns in kinds:
            names += [f"{kind} {s.name} [{unit}]" for s in self.wanted.stand.flywheels]
            parts.append(columns)
        data = np.hstack([self.t[:, None], *parts])
        return Run(("t [s]", *names), data, self.stopped, self.interrupted, identity_of(self.wanted.stand))
