"""Interface of a plant."""

from __future__ import annotations

from typing import Protocol

from mahovik.use.plan.array import Array


class Plant(Protocol):
    """Carrier and flywheels. State: position (3), attitude (4, quaternion, w first), V (6), phi, phi_dot (N each)."""

    position: Array
    attitude: Array
    V: Array
    phi: Array
    phi_dot: Array
    tau: Array

    def advance(self, command: Array, begin: float, end: float) -> None:
        """Advance from `begin` to `end` (s) under constant commanded torques (N, N m); `tau`: motor torques at the end.

        Raises StateError if the motion leaves the computable range.
        """
