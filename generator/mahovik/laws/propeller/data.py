"""Raw data of the propellers of one body, as the stand file gives them, in SI."""

from __future__ import annotations

from dataclasses import dataclass

from mahovik.core.stand.model import LawData, Vec3

MOST_SPEED = 1e5
"""Largest speed, rad/s, in the file and at run time: that of a flywheel."""


@dataclass(frozen=True)
class Propeller:
    """A propeller at `speed` n (in turns a second below), in water that comes at V_a, its advance ratio J = V_a/(n D).

    Thrust T = (1 - deduction) density D^4 |n| n K_T along the axis, torque Q = density D^5 |n| n K_Q against the turn,
    K = k0 + k1 J + k2 |J| J: where n is zero, their limits.

    position       m, in the body's frame, as is
    axis           direction of any length, along which T > 0 pushes
    density, diameter  kg/m3, m
    thrust, torque (k0, k1, k2) of K_T and of K_Q
    speed          rad/s, about the axis where right-handed; the C takes another one at run time
    wake           V_a = (1 - wake) times the velocity of `position` relative to the fluid along the axis
    whole          V_a = (1 - wake) times the length of that velocity
    left           a left-handed propeller: the torque on the body is Q about the axis, else -Q
    """

    name: str
    position: Vec3
    axis: Vec3
    density: float
    diameter: float
    thrust: Vec3
    torque: Vec3
    speed: float
    wake: float
    deduction: float
    whole: bool
    left: bool


@dataclass(frozen=True)
class Propellers(LawData):
    """All propellers of a body, in the order of the file."""

    propellers: tuple[Propeller, ...]

    @property
    def nonlinear(self) -> bool:
        """True: thrust is quadratic."""
        return True

    @property
    def drives(self) -> bool:
        """True: thrust does work."""
        return True

    @property
    def has_kinks(self) -> bool:
        """Whether thrust or torque depends on the magnitude of V_a."""
        return any(p.whole or p.thrust[2] or p.torque[2] for p in self.propellers)

    @property
    def inputs(self) -> dict[str, float]:
        """The speeds, rad/s."""
        return {f"{p.name}.speed": p.speed for p in self.propellers}
