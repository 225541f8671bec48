"""The tables of a stand file as pydantic models: which keys there are, what each takes, what is required.

A field holds its value in SI already. Only what one key can tell is checked here; what a whole body or the
whole stand must obey is in `physical` and `read`.
"""

from __future__ import annotations

from decimal import Decimal
from itertools import pairwise
from typing import Annotated, Any, Self

from pydantic import Field, ModelWrapValidatorHandler, PrivateAttr, model_validator

from mahovik.contract.quantities import BOUNDS
from mahovik.core.stand import units
from mahovik.core.stand.echoes import list_item
from mahovik.core.stand.fields import (
    ZERO3,
    AddedMass,
    Angle3,
    Direction,
    Flag,
    Inertia3,
    Length3,
    Mass,
    Name,
    StandName,
    Table,
    Text,
    integer,
    refuse,
    require_bounds,
    scalar,
    text,
    validator,
)
from mahovik.core.stand.model import INVERSE_MOST, About, PhaseInput, Vec3
from mahovik.core.stand.model import Sequence as AngleSequence
from mahovik.core.stand.moments import Moments, moments_of
from mahovik.core.stand.shapes import vec3, vector
from mahovik.core.stand.units import QuantityError, number, show

_WEIGHT = BOUNDS["MAX_WEIGHT"].value

SEQUENCES: dict[str, AngleSequence] = {
    "ship": "ship", "zyx": "ship", "aircraft": "aircraft", "yzx": "aircraft", "euler": "euler", "zxz": "euler",
}  # fmt: skip


def _schema(raw: Any) -> int:
    if integer(raw) != 1:
        raise QuantityError(f"unknown version {raw}, this program reads schema 1")
    return 1


def _sequence(raw: Any) -> AngleSequence:
    if text(raw) not in SEQUENCES:
        raise QuantityError(f'expected "ship" (or "zyx"), "aircraft" ("yzx") or "euler" ("zxz"), found {show(raw)}')
    return SEQUENCES[raw]


def _about(raw: Any) -> About:
    if raw == "origin":
        return "origin"
    if raw == "center_of_mass":
        return "center_of_mass"
    raise QuantityError(f'expected "origin" or "center_of_mass", found {show(raw)}')


def _phase_input(raw: Any) -> PhaseInput:
    if raw == "angle":
        return "angle"
    if raw == "sincos":
        return "sincos"
    raise QuantityError(f'expected "angle" or "sincos", found {show(raw)}')


def _gravity(raw: Any) -> Vec3:
    """Three numbers, or 0 for none at all."""
    if not isinstance(raw, bool) and isinstance(raw, int | Decimal) and raw == 0:
        return ZERO3
    return vec3(raw, units.ACCELERATION)


class Header(Table):
    """The keys of a stand outside any table."""

    schema_: Annotated[int, validator(_schema)] = Field(alias="schema")
    name: StandName
    angles: Annotated[AngleSequence, validator(_sequence)] = "ship"
    gravity: Annotated[Vec3, validator(_gravity, units.ACCELERATION)] = ZERO3
    stream: Annotated[Vec3, validator(lambda raw: vec3(raw, units.VELOCITY), units.VELOCITY)] | None = None
    phase_input: Annotated[PhaseInput, validator(_phase_input)] = "angle"
    inverse_most: Annotated[float, scalar(units.ANGULAR_ACCELERATION, above=0.0)] = INVERSE_MOST


NEAREST_STATIONS = 1e-9
"""Least distance of stations of a stream by their depth: nearer, rounding makes the shear between them."""


def _depths(raw: Any) -> tuple[float, ...]:
    """Two numbers or more, increasing."""
    values = raw.get("value") if isinstance(raw, dict) else raw
    found = vector(raw, (max(2, len(values) if isinstance(values, list) else 0),), units.LENGTH)
    for above, below in pairwise(found):
        if not above < below:
            raise QuantityError(f"expected increasing numbers, found {below:g} m after {above:g} m")
        if below - above < NEAREST_STATIONS * max(abs(above), abs(below)):
            raise QuantityError(
                f"expected stations apart by at least {NEAREST_STATIONS:g} of their depth, found {below:.17g} m after "
                f"{above:.17g} m: leave one of them out"
            )
    if (deepest := max(map(abs, found))) > (most := BOUNDS["MAX_POSITION"].value):
        raise QuantityError(
            f"expected depths of at most {most:g} m, which is the range of a position, found {deepest:g} m"
        )
    return found


def _velocities(raw: Any) -> tuple[Vec3, ...]:
    """A list of velocities (3)."""
    if not isinstance(raw, list) or not all(isinstance(each, list | dict) for each in raw):
        raise QuantityError(f"expected a list of velocities such as [[0.5, 0, 0], [0.1, 0, 0]], found {show(raw)}")
    return tuple(vec3(each, units.VELOCITY) for each in raw)


class StreamProfileTable(Table):
    """`[stream_profile]`."""

    down: Direction | None = None
    depth: Annotated[tuple[float, ...], validator(_depths, units.LENGTH)]
    velocity: Annotated[tuple[Vec3, ...], validator(_velocities, units.VELOCITY)]

    @model_validator(mode="after")
    def _one_velocity_a_depth(self) -> Self:
        """There is one velocity for each depth."""
        if len(self.velocity) != len(self.depth):
            raise refuse(
                f"expected {len(self.depth)} velocities, one for each `depth`, found {len(self.velocity)}", "velocity"
            )
        return self


class BodyTable(Table):
    """Keys that any body may have; those of the laws are added to them, see `laws.with_laws`."""

    center_of_mass: Length3 = ZERO3
    inertia_about: Annotated[About, validator(_about)] | None = None
    wrench_input: Flag = False

    _raw: dict[str, Any] = PrivateAttr(default_factory=dict)

    @model_validator(mode="wrap")
    @classmethod
    def _keep_raw(cls, raw: Any, handler: ModelWrapValidatorHandler[Self]) -> Self:
        table = handler(raw)
        table._raw = raw
        return table

    @property
    def moments(self) -> Moments:
        """How messages show the moments of inertia of this body."""
        return moments_of(self._raw)


class CarrierTable(BodyTable):
    """`[carrier]`."""

    mass: Mass
    inertia: Inertia3
    added_mass: AddedMass = None


class InstrumentTable(BodyTable):
    """One `[[instrument]]`."""

    name: Name
    position: Length3 = ZERO3
    angles: Angle3 = ZERO3
    mass: Mass = 0.0
    inertia: Inertia3 = (ZERO3, ZERO3, ZERO3)
    added_mass: AddedMass = None


class UnbalanceTable(Table):
    """`unbalance` of a flywheel given by its data sheet."""

    static: Annotated[float, scalar(units.STATIC_UNBALANCE, least=0.0)] = 0.0
    static_at: Annotated[float, scalar(units.ANGLE)] = 0.0
    dynamic: Annotated[float, scalar(units.DYNAMIC_UNBALANCE, least=0.0)] = 0.0
    dynamic_at: Annotated[float, scalar(units.ANGLE)] = 0.0


class MotorTable(Table):
    """`[flywheel.motor]`."""

    torque: Annotated[float, scalar(units.TORQUE, least=0.0)] | None = None
    speed: Annotated[float, scalar(units.SPEED, above=0.0)] | None = None
    constant: Annotated[float, scalar(units.TORQUE_CONSTANT, above=0.0)] | None = None
    resistance: Annotated[float, scalar(units.RESISTANCE, least=0.0)] | None = None
    supply: Annotated[float, scalar(units.VOLTAGE, above=0.0)] | None = None
    viscous: Annotated[float, scalar(units.VISCOUS, least=0.0)] = 0.0
    coulomb: Annotated[float, scalar(units.TORQUE, least=0.0)] = 0.0
    coulomb_speed: Annotated[float, scalar(units.SPEED, above=0.0)] = 0.1


def _counts(raw: Any) -> int:
    if integer(raw) == 0:
        raise QuantityError("expected at least 1 count per turn, found 0")
    return int(raw)


class EncoderTable(Table):
    """`[flywheel.encoder]`."""

    counts: Annotated[int, validator(_counts)]
    zero: Annotated[float, scalar(units.PLAIN)] = 0.0
    latency: Annotated[float, scalar(units.TIME, least=0.0)] = 0.0


def _spin_angles(raw: Any) -> tuple[float, ...]:
    return vector(raw, (2, 3), units.ANGLE)


def _transverse(raw: Any) -> tuple[float, ...]:
    if isinstance(raw, list) or (isinstance(raw, dict) and isinstance(raw.get("value"), list)):
        pair = vector(raw, (2,), units.INERTIA)
        for i, value in enumerate(pair):
            try:
                require_bounds(value, units.INERTIA.si, least=0.0, raw=list_item(raw, i))
            except QuantityError as error:
                raise QuantityError(f"[{i}]: {error}") from None
        return pair
    return (require_bounds(number(raw, units.INERTIA), units.INERTIA.si, least=0.0, raw=raw),) * 2


class FlywheelTable(BodyTable):
    """One `[[flywheel]]`."""

    name: Name
    mount: Text = "carrier"
    position: Length3 = ZERO3
    angles: Annotated[tuple[float, ...], validator(_spin_angles, units.ANGLE)] | None = None
    axis: Direction | None = None
    zero: Direction | None = None
    mass: Mass
    inertia: Inertia3 | None = None
    spin_inertia: Annotated[float, scalar(units.INERTIA, least=0.0)] | None = None
    transverse_inertia: Annotated[tuple[float, ...], validator(_transverse, units.INERTIA)] | None = None
    unbalance: UnbalanceTable | None = None
    inverse_weight: Annotated[float, scalar(units.PLAIN, least=1.0 / _WEIGHT, most=_WEIGHT)] = 1.0
    motor: MotorTable | None = None
    encoder: EncoderTable | None = None


class PointTable(Table):
    """One `[[point]]`."""

    name: Name
    mount: Text = "carrier"
    position: Length3 = ZERO3
    angles: Angle3 = ZERO3
