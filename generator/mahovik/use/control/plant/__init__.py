"""The stand in the closed loop: carrier and flywheels under motor torques, (8) with the drive equations.

Computed by the emitted C (function `step`, fixed steps), or by SciPy on the literal reference, slowly, to judge the C.
"""

from __future__ import annotations

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.errors import UsageError
from mahovik.use.control.plant.plant import Plant

BACKENDS = ("c", "scipy")

__all__ = ["BACKENDS", "Plant", "plant"]


def plant(stand: Stand, state: State, backend: str = "c", finer: int = 1) -> Plant:
    """A plant in a state with a quaternion; `finer`: number of steps of the C in place of one.

    Raises UsageError, ToolchainError.
    """
    if backend == "c":
        from mahovik.use.control.plant.by_c import PlantByC

        return PlantByC(stand, state, finer)
    if backend == "scipy":
        from mahovik.use.control.plant.by_reference import PlantByReference

        return PlantByReference(stand, state)
    raise UsageError(f"--backend {backend}: expected one of {', '.join(BACKENDS)}")
