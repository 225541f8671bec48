"""`[[propeller]]` of a stand file: thrust and torque of propellers by advance ratio."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Annotated, ClassVar, Self

from mahovik.core.stand import units
from mahovik.core.stand.declare import TIMES_EACH, Declared, Draw
from mahovik.core.stand.fields import ZERO3, Direction, Flag, Length3, Mounted, Name, scalar, validator, vec3
from mahovik.core.stand.law import Actuator, BodyLaw
from mahovik.core.stand.model import Body, Flywheel, Stand, Vec3
from mahovik.core.stand.tables import Default, Table
from mahovik.core.stand.units import Dimension, QuantityError

DENSITY = Dimension("a density", "kg/m^3")
MOST_SPEED = 1e5
"""Largest speed, rad/s, in the file and at run time: that of a flywheel."""


def _polynomial(raw: object) -> Vec3:
    """Two coefficients, or three."""
    if not isinstance(raw, list) or len(raw) not in (2, 3):
        raise QuantityError("expected [k0, k1] or [k0, k1, k2] of K = k0 + k1 J + k2 |J| J")
    return vec3([*raw, 0, 0][:3], units.PLAIN)


Polynomial = Annotated[Vec3, validator(_polynomial, units.PLAIN, shape="2 or 3 numbers"), TIMES_EACH]
Fraction = Annotated[float, scalar(units.PLAIN, least=-1.0, most=1.0), Default(0.0)]
Speed = Annotated[float, scalar(units.SPEED, least=-MOST_SPEED, most=MOST_SPEED)]


@dataclass(frozen=True)
class Propeller(Declared):
    """A propeller at `speed` n (in turns a second below), in water that comes at V_a, its advance ratio J = V_a/(n D).

    Thrust T = (1 - deduction) density D^4 |n| n K_T along the axis, torque Q = density D^5 |n| n K_Q against the turn,
    K = k0 + k1 J + k2 |J| J: where n is zero, their limits.

    name       a C identifier, different from the names of bodies, points and whatever else has a mount
    position   in the frame of its mount
    axis       direction of the thrust, in the frame of its mount
    density    of the fluid
    diameter   `D`
    thrust     `k0`, `k1` and `k2` of `K_T`
    torque     the same of `K_Q`
    speed      `n`, about the axis where right-handed; may be set at run time
    wake       `V_a` is `1 - wake` times the velocity of `position` relative to the fluid along the axis
    deduction  share of the thrust that the hull loses
    whole      `true`: `V_a` is `1 - wake` times the length of that velocity, as published for some vehicles
    left       `true`: a left-handed propeller, whose torque on the body is about the axis, not against it
    """

    name: Name
    position: Annotated[Length3, Default(ZERO3)]
    axis: Annotated[Direction, Default((1.0, 0.0, 0.0))]
    density: Annotated[float, scalar(DENSITY, above=0.0)]
    diameter: Annotated[float, scalar(units.LENGTH, above=0.0)]
    thrust: Polynomial
    torque: Annotated[Polynomial, Default(ZERO3)]
    speed: Annotated[Speed, Default(0.0)]
    wake: Fraction
    deduction: Fraction
    whole: Annotated[Flag, Default(False)]
    left: Annotated[Flag, Default(False)]

    keys: ClassVar[type[Table]] = Mounted


@dataclass(frozen=True)
class Propellers(BodyLaw):
    """All propellers of a body, in the order of the file."""

    propellers: tuple[Propeller, ...]

    key: ClassVar[str] = "propeller"
    name: ClassVar[str] = "propellers"
    item: ClassVar[type[Declared]] = Propeller
    mounted: ClassVar[bool] = True

    @property
    def nonlinear(self) -> bool:
        """True: thrust is quadratic."""
        return True

    @property
    def has_kinks(self) -> bool:
        """Whether thrust or torque depends on the magnitude of V_a."""
        return any(p.whole or p.thrust[2] or p.torque[2] for p in self.propellers)

    @property
    def inputs(self) -> dict[str, float]:
        """The speeds, rad/s."""
        return {f"{p.name}.speed": p.speed for p in self.propellers}

    @property
    def actuators(self) -> dict[str, Actuator]:
        """Drawn speeds are those of the file, or advance ratios of a half at 1 m/s."""
        usual = {p.name: abs(p.speed) or 4.0 * math.pi / p.diameter for p in self.propellers}
        return {name: Actuator("speed, rad/s", None, speed) for name, speed in usual.items()}

    def actuated(self, speeds: Mapping[str, float]) -> Self:
        """The propellers with other speeds, rad/s, by name."""
        return type(self)(tuple(replace(p, speed=speeds.get(p.name, p.speed)) for p in self.propellers))

    @classmethod
    def structure(cls, stand: Stand) -> dict[str, object]:
        """Body index, names and kinds of the propellers of each body; nothing without, as other stands have it."""
        kinds = tuple((i, tuple((p.name, p.whole) for p in law.propellers)) for i, _, law in cls.of(stand))
        return {"propellers": kinds} if kinds else {}

    @classmethod
    def random_on(cls, draw: Draw, body: Body) -> Self | None:
        """One or two propellers; a flywheel has none."""
        if isinstance(body, Flywheel):
            return None
        count = int(draw.rng.integers(1, 3))
        return cls(tuple(_random_propeller(draw, f"propeller{k + 1}_{body.name}") for k in range(count)))


def _random_propeller(draw: Draw, name: str) -> Propeller:
    """A small one, at rest in one of five cases."""
    rng = draw.rng
    k0, k1, k2 = (float(size) for size in rng.uniform([0.1, -0.5, -0.2], [0.5, 0.0, 0.1]))
    q0, q1, q2 = (0.15 * float(size) for size in rng.uniform([0.1, -0.5, -0.2], [0.5, 0.0, 0.1]))
    whole, left, still = (bool(flag) for flag in rng.random(3) < (0.5, 0.5, 0.2))
    return Propeller(
        name,
        draw.vec3(0.3),
        draw.vec3(1.0),
        1000.0,
        draw.uniform(0.05, 0.15),
        (k0, k1, k2),
        (q0, q1, q2),
        0.0 if still else draw.uniform(-200.0, 200.0),
        draw.uniform(0.0, 0.3),
        draw.uniform(0.0, 0.2),
        whole,
        left,
    )


LAW = Propellers
