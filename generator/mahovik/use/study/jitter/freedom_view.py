"""A freedom of a hold as what is seen in place of a point: its angle or shift about rest, speed, acceleration."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.core.stand.hold import freedom_names, twists, wrenches
from mahovik.core.stand.model import Stand
from mahovik.errors import UsageError
from mahovik.use.plan.array import Array, Complex
from mahovik.use.study.jitter.quantity import FullMotion, LinearMotion, Quantity
from mahovik.use.study.jitter.structure import Structure
from mahovik.use.study.response.outputs import freedom_of
from mahovik.use.study.response.scene import coordinates

_UNITS = {"turn": "rad", "slide": "m", "twist": "1"}
_POWERS = {"displacement": 0, "velocity": 1, "acceleration": 2}
_OF_TURNS = {"angle": 0, "rate": 1, "acceleration": 2}


def powers_of(kind: str) -> dict[str, int]:
    """Quantities of a kind of freedom, the usual one first, and the derivatives by time that they are."""
    return _OF_TURNS if kind == "turn" else _POWERS


@dataclass(frozen=True, eq=False)
class FreedomView:
    """A quantity of one freedom: the first of three columns, the others are zero.

    name      of the output, `hold.pitch`; axes: that of the freedom
    quantity  a key of `powers_of`: of the coordinate xi about rest, of which the pose is exp(S xi)
    number    place of the freedom; S, W (6, m): twists of the freedoms, and what finds speeds, u = W^T V
    """

    name: str
    axes: tuple[str, ...]
    quantity: str
    measure: Quantity
    number: int
    S: Array
    W: Array

    @staticmethod
    def of(stand: Stand, name: str, quantity: str | None) -> FreedomView | None:
        """The freedom of a name such as `hold.pitch` or `hold.1`; None where it is none. UsageError: quantity."""
        number = None if stand.hold is None else freedom_of(stand.hold, name)
        if stand.hold is None or number is None:
            return None
        kind, own = stand.hold.freedoms[number].kind, freedom_names(stand.hold)[number]
        known = powers_of(kind)
        chosen = quantity or next(iter(known))
        if chosen not in known:
            raise UsageError(f"--quantity {quantity}: {name} has none; expected one of {', '.join(known)}")
        unit = _UNITS[kind] + ("", "/s", "/s2")[known[chosen]]
        measure = Quantity(unit, kind == "turn", known[chosen])
        return FreedomView(f"hold.{own}", (own,), chosen, measure, number, twists(stand.hold), wrenches(stand.hold))

    def linear(self, motion: LinearMotion) -> Complex:
        """Amplitudes (S, L, 3, P) from those of the pose, S xi to first order."""
        found = np.zeros((*motion.omega.shape, 3, motion.pose.shape[-1]), dtype=np.complex128)
        along = np.tensordot(motion.pose, self.W[:, self.number], axes=([2], [0]))
        found[:, :, 0] = along * self.derivative(motion.omega)[..., None]
        return found

    def full(self, motion: FullMotion) -> Array:
        """Values (M, 3) from states in the chart about rest and V*."""
        found = np.zeros((len(motion.y), 3))
        if self.measure.power == 0:
            found[:, 0] = coordinates(self.S, motion.y)[:, self.number]
        else:
            rates = motion.y[:, 6:] if self.measure.power == 1 else motion.V_dot
            found[:, 0] = rates @ self.W[:, self.number]
        return found

    def by_pose(self, pose: Complex, omega: Array) -> Complex:
        """Amplitudes (..., 3) from those of the pose (..., 6) at omega (...; rad/s)."""
        found = np.zeros((*pose.shape[:-1], 3), dtype=np.complex128)
        found[..., 0] = pose @ self.W[:, self.number] * self.derivative(omega)
        return found

    def derivative(self, omega: Array) -> Complex:
        """Factor (...) of the quantity's derivatives at omega (...; rad/s)."""
        return np.asarray((1j * omega) ** self.measure.power)

    def shape(self, structure: Structure) -> Array:
        """UsageError: modes have no shape of a freedom."""
        raise UsageError(f"--modes: structural modes have no shape of a freedom, {self.name}; expected a point as --at")
