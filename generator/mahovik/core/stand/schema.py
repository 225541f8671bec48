"""The tables of a stand file as pydantic models: which keys there are, what each takes, what is required.

A field holds its value in SI already. Only what one key can tell is checked here; what a whole body or the
whole stand must obey is in `physical` and `read`.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated, Any

from pydantic import Field, model_validator

from mahovik.core.stand import units
from mahovik.core.stand.fields import (
    ZERO3,
    AddedMass,
    Angle3,
    Direction,
    Flag,
    Inertia3,
    Length3,
    LinearDamping6,
    Mass,
    Name,
    QuadraticDamping6,
    StandName,
    Table,
    Text,
    integer,
    refuse,
    scalar,
    text,
    validator,
)
from mahovik.core.stand.model import TWIST_LETTERS, WRENCH_LETTERS, About, Factor, PhaseInput, Vec3
from mahovik.core.stand.model import Sequence as AngleSequence
from mahovik.core.stand.shapes import vec3, vector
from mahovik.core.stand.units import Dimension, QuantityError, number, show

SEQUENCES: dict[str, AngleSequence] = {
    "ship": "ship", "zyx": "ship", "aircraft": "aircraft", "yzx": "aircraft", "euler": "euler", "zxz": "euler",
}  # fmt: skip


def _schema(raw: Any) -> int:
    if integer(raw) != 1:
        raise QuantityError(f"{raw} is not known, this version reads schema 1")
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


def _letter(letters: tuple[str, ...]) -> Callable[[Any], int]:
    def read(raw: Any) -> int:
        if text(raw) not in letters:
            raise QuantityError(f"expected one of {' '.join(letters)}, found {show(raw)}")
        return letters.index(raw)

    return read


def _factors(raw: Any) -> tuple[Factor, Factor]:
    if not isinstance(raw, list) or len(raw) != 2:
        found = f"{len(raw)}" if isinstance(raw, list) else show(raw)
        raise QuantityError(f'expected two factors such as ["r", "|v|"], found {found}')
    read = _letter(TWIST_LETTERS)
    factors = []
    for item in raw:
        bars = len(text(item)) == 3 and item[0] == item[2] == "|"
        try:
            factors.append(Factor(read(item[1] if bars else item), bars))
        except QuantityError:
            letters = " ".join(TWIST_LETTERS)
            raise QuantityError(f"expected one of {letters}, with or without bars, found {show(item)}") from None
    return factors[0], factors[1]


class Header(Table):
    """The keys of a stand outside any table."""

    schema_: Annotated[int, validator(_schema)] = Field(alias="schema")
    name: StandName
    angles: Annotated[AngleSequence, validator(_sequence)] = "ship"
    gravity: Annotated[Vec3, validator(lambda raw: vec3(raw, units.ACCELERATION))] = ZERO3
    stream: Annotated[Vec3, validator(lambda raw: vec3(raw, units.VELOCITY))] | None = None
    phase_input: Annotated[PhaseInput, validator(_phase_input)] = "angle"


class BuoyancyTable(Table):
    """`buoyancy` of a body."""

    displaced_mass: Mass
    center: Length3 = ZERO3


class TermTable(Table):
    """One of `damping.terms`: a hydrodynamic derivative."""

    wrench: Annotated[int, validator(_letter(WRENCH_LETTERS))]
    of: Annotated[tuple[Factor, Factor], validator(_factors)]
    value: Any

    @model_validator(mode="after")
    def _value_in_si(self) -> TermTable:
        """The unit of a derivative follows from the wrench component and the two factors."""
        angular = sum(factor.component >= 3 for factor in self.of)
        moment = "N m" if self.wrench >= 3 else "N"
        per = {0: "s^2/m^2", 1: "s^2/m/rad", 2: "s^2/rad^2"}[angular]
        try:
            value = number(self.value, Dimension("a hydrodynamic derivative", f"{moment} {per}"))
        except QuantityError as error:
            raise refuse(str(error), "value") from None
        object.__setattr__(self, "value", value)
        return self


class DampingTable(Table):
    """`damping` of a body."""

    linear: LinearDamping6 = None
    quadratic: QuadraticDamping6 = None
    terms: list[TermTable] = Field(default_factory=list)


class BodyTable(Table):
    """What any body may have."""

    center_of_mass: Length3 = ZERO3
    inertia_about: Annotated[About, validator(_about)] | None = None
    buoyancy: BuoyancyTable | None = None
    damping: DampingTable | None = None
    wrench_input: Flag = False


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
        raise QuantityError("0 counts a turn measure nothing")
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
    else:
        pair = (number(raw, units.INERTIA),) * 2
    if min(pair) < 0:
        raise QuantityError(f"{min(pair):.17g} is negative")
    return pair


class FlywheelTable(BodyTable):
    """One `[[flywheel]]`."""

    name: Name
    mount: Text = "carrier"
    position: Length3 = ZERO3
    angles: Annotated[tuple[float, ...], validator(_spin_angles)] | None = None
    axis: Direction | None = None
    zero: Direction | None = None
    mass: Mass
    inertia: Inertia3 | None = None
    spin_inertia: Annotated[float, scalar(units.INERTIA, least=0.0)] | None = None
    transverse_inertia: Annotated[tuple[float, ...], validator(_transverse)] | None = None
    unbalance: UnbalanceTable | None = None
    inverse_weight: Annotated[float, scalar(units.PLAIN, least=1e-6, most=1e6)] = 1.0
    motor: MotorTable | None = None
    encoder: EncoderTable | None = None


class PointTable(Table):
    """One `[[point]]`."""

    name: Name
    mount: Text = "carrier"
    position: Length3 = ZERO3
    angles: Angle3 = ZERO3
