"""What a plant offers, whoever computes it."""

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
        """From `begin` to `end` (s) under commanded torques (N, N m), constant; `tau`: what motors gave at the end.

        Raises StateError where the motion leaves what can be computed.
        """
