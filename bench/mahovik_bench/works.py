"""The works that are timed: what goes in, what comes out, and how a result is judged."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass


@dataclass(frozen=True)
class Work:
    """One function of every peer that has it, `peer_NAME` in C.

    `size`: how many numbers it gives for N flywheels. `parts`: names and lengths of these by the reference, empty
    where the reference has no such want.
    """

    name: str
    meaning: str
    size: Callable[[int], int]
    parts: Mapping[str, Callable[[int], int]]

    @property
    def symbol(self) -> str:
        """The function in C."""
        return f"peer_{self.name}"


def _six(_: int) -> int:
    return 6


def _one_per_flywheel(N: int) -> int:
    return N


WORKS = {
    work.name: work
    for work in (
        Work("forward", "V* for given phi''", _six, {"V_dot": _six}),
        Work(
            "coupled", "V* and phi'' for given torques", lambda N: 6 + N, {"V_dot": _six, "phi_ddot": _one_per_flywheel}
        ),
        Work("torque", "torques for a given motion", _one_per_flywheel, {"tau": _one_per_flywheel}),
        Work("step", "one Runge-Kutta step of coupled, order 4", lambda N: 13 + 2 * N, {}),
        Work("inverse", "phi'' for a wanted V*, with diagnostics", _one_per_flywheel, {"phi_ddot": _one_per_flywheel}),
        Work("inverse_fast", "phi'' for a wanted V*", _one_per_flywheel, {}),
        Work("forward_jacobian", "slopes of forward", lambda N: 6 * (6 + 3 * N), {}),
        Work("coupled_jacobian", "slopes of coupled", lambda N: (6 + N) * (6 + 3 * N), {}),
    )
}
"""Works by name. A peer that takes many states in a call gives the same outputs for each."""
