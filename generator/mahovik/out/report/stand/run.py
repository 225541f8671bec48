"""A run of `mahovik simulate` as a report needs it: arrays in the stand's order."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import cast

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.model import Vec3, Vec6
from mahovik.core.stand.state import Quaternion, State

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Run:
    """Columns of a run by their whole names, unit and all: M rows; `flywheels` are the stand's names in its order.

    `source` is the name of its file, without folders.
    """

    source: str
    flywheels: tuple[str, ...]
    columns: Mapping[str, Array]

    @cached_property
    def t(self) -> Array:
        """Times (M), s."""
        return self.columns["t [s]"]

    @cached_property
    def position(self) -> Array:
        """Position of O1 in E0 (M, 3), m."""
        return self._stack([f"{a} [m]" for a in "xyz"])

    @cached_property
    def quaternion(self) -> Array:
        """Attitude of the carrier (M, 4), w first, of x0 = C x1; unit length."""
        found = self._stack(["qw", "qx", "qy", "qz"])
        unit: Array = found / np.linalg.norm(found, axis=1, keepdims=True)
        return unit

    @cached_property
    def V(self) -> Array:
        """Twist of the carrier in E1 (M, 6), linear part first; m/s, rad/s."""
        return self._stack([*(f"v_{a} [m/s]" for a in "xyz"), *(f"omega_{a} [rad/s]" for a in "xyz")])

    @cached_property
    def V_dot(self) -> Array | None:
        """Derivative of its components (M, 6); m/s2, rad/s2. None: a run that follows a programme does not have it."""
        names = [*(f"v_dot_{a} [m/s2]" for a in "xyz"), *(f"omega_dot_{a} [rad/s2]" for a in "xyz")]
        return self._stack(names) if names[0] in self.columns else None

    @cached_property
    def phi(self) -> Array:
        """Phases of the flywheels (M, N), rad."""
        return self._flywheels("phi", "rad")

    @cached_property
    def phi_dot(self) -> Array:
        """Speeds of the flywheels (M, N), rad/s."""
        return self._flywheels("phi_dot", "rad/s")

    @cached_property
    def phi_ddot(self) -> Array | None:
        """Accelerations of the flywheels (M, N), rad/s2. None: a run that follows a programme does not have them."""
        there = all(f"phi_ddot {name} [rad/s2]" in self.columns for name in self.flywheels)
        return self._flywheels("phi_ddot", "rad/s2") if there else None

    @cached_property
    def tau(self) -> Array:
        """Drive torques (M, N), N m."""
        return self._flywheels("tau", "N m")

    def state(self, row: int) -> State:
        """The state of a row, to be evaluated; accelerations zero where the run has none. No run-time wrench."""
        zeros = (0.0,) * len(self.flywheels)
        return State(
            position=cast(Vec3, tuple(self.position[row].tolist())),
            angles=None,
            quaternion=cast(Quaternion, tuple(self.quaternion[row].tolist())),
            V=cast(Vec6, tuple(self.V[row].tolist())),
            phi=tuple(np.remainder(self.phi[row], 2 * np.pi).tolist()),
            phi_dot=tuple(self.phi_dot[row].tolist()),
            phi_ddot=zeros if self.phi_ddot is None else tuple(self.phi_ddot[row].tolist()),
            V_dot=(0.0,) * 6 if self.V_dot is None else cast(Vec6, tuple(self.V_dot[row].tolist())),
            tau=tuple(self.tau[row].tolist()),
        )

    def _flywheels(self, kind: str, unit: str) -> Array:
        return self._stack([f"{kind} {name} [{unit}]" for name in self.flywheels])

    def _stack(self, names: Sequence[str]) -> Array:
        if not names:
            return np.zeros((len(self.t), 0))
        return np.stack([self.columns[name] for name in names], axis=1)
