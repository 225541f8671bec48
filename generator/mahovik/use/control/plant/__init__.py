"""The stand itself in the closed loop: carrier and flywheels under the torques of motors, (8) with the drive equations.

By the emitted C, function `step`, in fixed steps; or by SciPy on the literal reference, adaptive and slow, to judge it.
"""

from __future__ import annotations

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.errors import UsageError
from mahovik.use.control.plant.plant import Plant

BACKENDS = ("c", "scipy")

__all__ = ["BACKENDS", "Plant", "plant"]


def plant(stand: Stand, state: State, backend: str = "c", finer: int = 1) -> Plant:
    """A plant in a state with a quaternion; `finer`: so many steps of the C in place of one.

    Raises UsageError, ToolchainError.
    """
    if backend == "c":
        from mahovik.use.control.plant.by_c import PlantByC

        return PlantByC(stand, state, finer)
    if backend == "scipy":
        from mahovik.use.control.plant.by_reference import PlantByReference

        return PlantByReference(stand, state)
    raise UsageError(f"--backend {backend}: expected one of {', '.join(BACKENDS)}")
