"""Loads as what is seen in place of a motion: the reaction of a hold, and the wrench of a mount on its flywheel.

Force and moment are seen apart, about O1 in E1 for the reaction, about the flywheel's origin on its axes at phase zero
for a mount.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.errors import UsageError
from mahovik.use.plan.array import Array, Complex
from mahovik.use.study.jitter.quantity import AXES, FullMotion, LinearMotion, Quantity
from mahovik.use.study.jitter.structure import Structure
from mahovik.use.study.response.scene import REACTION

LOADS = {"force": Quantity("N", False, 0), "moment": Quantity("N m", False, 0)}
"""Quantities of a load."""


@dataclass(frozen=True)
class LoadView:
    """Force or moment of the reaction (`name` is REACTION) or of a flywheel's mount (its name).

    wheel   number of the flywheel; None: the reaction
    """

    name: str
    quantity: str
    wheel: int | None

    @staticmethod
    def of(stand: Stand, name: str, quantity: str) -> LoadView:
        """The load of a name. Raises UsageError: the stand has none of it, or another quantity."""
        if quantity not in LOADS:
            raise UsageError(f"--quantity {quantity}: {name} is a load; expected one of {', '.join(LOADS)}")
        if name != REACTION:
            return LoadView(name, quantity, [s.name for s in stand.flywheels].index(name))
        if stand.hold is None:
            raise UsageError(f"--at {name}: {stand.name} has no [hold]; expected a point, an instrument or a flywheel")
        return LoadView(name, quantity, None)

    @property
    def axes(self) -> tuple[str, ...]:
        """Axes of force and moment."""
        return AXES

    @property
    def measure(self) -> Quantity:
        """Unit and kind of the quantity."""
        return LOADS[self.quantity]

    @property
    def rows(self) -> slice:
        """Rows of a wrench that are seen."""
        return slice(0, 3) if self.quantity == "force" else slice(3, 6)

    def linear(self, motion: LinearMotion) -> Complex:
        """Amplitudes (S, L, 3, P) of the load."""
        found = motion.reaction() if self.wheel is None else motion.mount(self.wheel)
        return found[:, :, self.rows]

    def full(self, motion: FullMotion) -> Array:
        """Values (M, 3) of the load."""
        found = motion.reaction() if self.wheel is None else motion.mount(self.wheel)
        return found[:, self.rows]

    def derivative(self, omega: Array) -> Complex:
        """1: a load is not differentiated."""
        return np.ones(omega.shape, dtype=np.complex128)

    def shape(self, structure: Structure) -> Array:
        """UsageError: modes have no shape of a load."""
        raise UsageError(f"--modes: structural modes have no shape of a load, {self.name}; expected a point as --at")
