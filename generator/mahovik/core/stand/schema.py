"""The tables of a stand file as pydantic models: which keys there are, what each takes, what is required.

A field holds its value in SI already. Only what one key can tell is checked here; what a whole body or the
whole stand must obey is in `physical` and `read`.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated, Any, TypeVar

from pydantic import BaseModel, ConfigDict, Field, PlainValidator, model_validator
from pydantic_core import PydanticCustomError

from mahovik.core.stand import units
from mahovik.core.stand.model import TWIST_LETTERS, WRENCH_LETTERS, About, Factor, Mat3, Mat6, PhaseInput, Vec3
from mahovik.core.stand.model import Sequence as AngleSequence
from mahovik.core.stand.names import name_problem, stand_name_problem
from mahovik.core.stand.shapes import Blocks, direction, matrix6, symmetric3, vec3, vector
from mahovik.core.stand.units import Dimension, QuantityError, number, show

T = TypeVar("T")

ADDED_MASS: Blocks = (
    (Dimension("an added mass", "kg"), Dimension("an added first moment", "kg m")),
    (Dimension("an added first moment", "kg m"), Dimension("an added inertia", "kg m^2")),
)
LINEAR: Blocks = (
    (Dimension("a linear damping", "N s/m"), Dimension("a linear damping", "N s/rad")),
    (Dimension("a linear damping", "N s"), Dimension("a linear damping", "N m s/rad")),
)
QUADRATIC: Blocks = (
    (Dimension("a quadratic damping", "N s^2/m^2"), Dimension("a quadratic damping", "N s^2/rad^2")),
    (Dimension("a quadratic damping", "N s^2/m"), Dimension("a quadratic damping", "N m s^2/rad^2")),
)
STIFFNESS: Blocks = (
    (Dimension("a stiffness", "N/m"), Dimension("a stiffness", "N/rad")),
    (Dimension("a stiffness", "N"), Dimension("a stiffness", "N m/rad")),
)
SEQUENCES: dict[str, AngleSequence] = {
    "ship": "ship", "zyx": "ship", "aircraft": "aircraft", "yzx": "aircraft", "euler": "euler", "zxz": "euler",
}  # fmt: skip


def _refuse(error: str, key: str = "") -> PydanticCustomError:
    return PydanticCustomError("stand", "{reason}", {"reason": error, "key": key})


def _validator(read: Callable[[Any], T]) -> PlainValidator:
    def validate(raw: Any) -> T:
        try:
            return read(raw)
        except QuantityError as error:
            raise _refuse(str(error)) from None

    return PlainValidator(validate)


def _scalar(
    dimension: Dimension, *, least: float | None = None, above: float | None = None, most: float | None = None
) -> PlainValidator:
    def read(raw: Any) -> float:
        value = number(raw, dimension)
        if least is not None and value < least:
            raise QuantityError(f"{value:.17g} is negative" if least == 0 else f"{value:.17g} is below {least:g}")
        if above is not None and value <= above:
            raise QuantityError(f"{value:.17g} is not above {above:g}")
        if most is not None and value > most:
            raise QuantityError(f"{value:.17g} is above {most:g}")
        return value

    return _validator(read)


def _integer(raw: Any) -> int:
    if isinstance(raw, bool) or not isinstance(raw, int):
        raise QuantityError(f"expected a whole number, found {show(raw)}")
    return raw


def _text(raw: Any) -> str:
    if not isinstance(raw, str):
        raise QuantityError(f"expected a string, found {show(raw)}")
    return raw


def _flag(raw: Any) -> bool:
    if not isinstance(raw, bool):
        raise QuantityError(f"expected true or false, found {show(raw)}")
    return raw


def _stand_name(raw: Any) -> str:
    problem = stand_name_problem(_text(raw))
    if problem is not None:
        raise QuantityError(problem)
    return str(raw)


def _name(raw: Any) -> str:
    problem = name_problem(_text(raw))
    if problem is not None:
        raise QuantityError(problem)
    return str(raw)


def _schema(raw: Any) -> int:
    if _integer(raw) != 1:
        raise QuantityError(f"{raw} is not known, this version reads schema 1")
    return 1


def _sequence(raw: Any) -> AngleSequence:
    if _text(raw) not in SEQUENCES:
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
        if _text(raw) not in letters:
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
        bars = len(_text(item)) == 3 and item[0] == item[2] == "|"
        try:
            factors.append(Factor(read(item[1] if bars else item), bars))
        except QuantityError:
            letters = " ".join(TWIST_LETTERS)
            raise QuantityError(f"expected one of {letters}, with or without bars, found {show(item)}") from None
    return factors[0], factors[1]


Name = Annotated[str, _validator(_name)]
StandName = Annotated[str, _validator(_stand_name)]
Text = Annotated[str, _validator(_text)]
Flag = Annotated[bool, _validator(_flag)]
Length3 = Annotated[Vec3, _validator(lambda raw: vec3(raw, units.LENGTH))]
Angle3 = Annotated[Vec3, _validator(lambda raw: vec3(raw, units.ANGLE))]
Direction = Annotated[Vec3, _validator(direction)]
Mass = Annotated[float, _scalar(units.MASS, least=0.0)]
Inertia3 = Annotated[Mat3, _validator(lambda raw: symmetric3(raw, units.INERTIA))]
AddedMass = Annotated[Mat6 | None, _validator(lambda raw: matrix6(raw, ADDED_MASS, symmetric=True))]
LinearDamping6 = Annotated[Mat6 | None, _validator(lambda raw: matrix6(raw, LINEAR))]
QuadraticDamping6 = Annotated[Mat6 | None, _validator(lambda raw: matrix6(raw, QUADRATIC))]
Stiffness6 = Annotated[Mat6 | None, _validator(lambda raw: matrix6(raw, STIFFNESS))]
ZERO3: Vec3 = (0.0, 0.0, 0.0)


class Table(BaseModel):
    """Base of all tables: a key that is no field is an error."""

    model_config = ConfigDict(extra="forbid", frozen=True, defer_build=True)


class Header(Table):
    """The keys of a stand outside any table."""

    schema_: Annotated[int, _validator(_schema)] = Field(alias="schema")
    name: StandName
    angles: Annotated[AngleSequence, _validator(_sequence)] = "ship"
    gravity: Annotated[Vec3, _validator(lambda raw: vec3(raw, units.ACCELERATION))] = ZERO3
    stream: Annotated[Vec3, _validator(lambda raw: vec3(raw, units.VELOCITY))] | None = None
    phase_input: Annotated[PhaseInput, _validator(_phase_input)] = "angle"


class BuoyancyTable(Table):
    """`buoyancy` of a body."""

    displaced_mass: Mass
    center: Length3 = ZERO3


class TermTable(Table):
    """One of `damping.terms`: a hydrodynamic derivative."""

    wrench: Annotated[int, _validator(_letter(WRENCH_LETTERS))]
    of: Annotated[tuple[Factor, Factor], _validator(_factors)]
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
            raise _refuse(str(error), "value") from None
        object.__setattr__(self, "value", value)
        return self


class DampingTable(Table):
    """`damping` of a body."""

    linear: LinearDamping6 = None
    quadratic: QuadraticDamping6 = None
    terms: list[TermTable] = []


class BodyTable(Table):
    """What any body may have."""

    center_of_mass: Length3 = ZERO3
    inertia_about: Annotated[About, _validator(_about)] | None = None
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

    static: Annotated[float, _scalar(units.STATIC_UNBALANCE, least=0.0)] = 0.0
    static_at: Annotated[float, _scalar(units.ANGLE)] = 0.0
    dynamic: Annotated[float, _scalar(units.DYNAMIC_UNBALANCE, least=0.0)] = 0.0
    dynamic_at: Annotated[float, _scalar(units.ANGLE)] = 0.0


class MotorTable(Table):
    """`[flywheel.motor]`."""

    torque: Annotated[float, _scalar(units.TORQUE, least=0.0)] | None = None
    speed: Annotated[float, _scalar(units.SPEED, above=0.0)] | None = None
    constant: Annotated[float, _scalar(units.TORQUE_CONSTANT, above=0.0)] | None = None
    resistance: Annotated[float, _scalar(units.RESISTANCE, least=0.0)] | None = None
    supply: Annotated[float, _scalar(units.VOLTAGE, above=0.0)] | None = None
    viscous: Annotated[float, _scalar(units.VISCOUS, least=0.0)] = 0.0
    coulomb: Annotated[float, _scalar(units.TORQUE, least=0.0)] = 0.0
    coulomb_speed: Annotated[float, _scalar(units.SPEED, above=0.0)] = 0.1


def _counts(raw: Any) -> int:
    if _integer(raw) == 0:
        raise QuantityError("0 counts a turn measure nothing")
    return int(raw)


class EncoderTable(Table):
    """`[flywheel.encoder]`."""

    counts: Annotated[int, _validator(_counts)]
    zero: Annotated[float, _scalar(units.PLAIN)] = 0.0
    latency: Annotated[float, _scalar(units.TIME, least=0.0)] = 0.0


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
    angles: Annotated[tuple[float, ...], _validator(_spin_angles)] | None = None
    axis: Direction | None = None
    zero: Direction | None = None
    mass: Mass
    inertia: Inertia3 | None = None
    spin_inertia: Annotated[float, _scalar(units.INERTIA, least=0.0)] | None = None
    transverse_inertia: Annotated[tuple[float, ...], _validator(_transverse)] | None = None
    unbalance: UnbalanceTable | None = None
    inverse_weight: Annotated[float, _scalar(units.PLAIN, least=1e-6, most=1e6)] = 1.0
    motor: MotorTable | None = None
    encoder: EncoderTable | None = None


class SuspensionTable(Table):
    """`[suspension]`."""

    stiffness: Stiffness6 = None
    damping: LinearDamping6 = None
    position: Length3 = ZERO3
    angles: Angle3 = ZERO3


class LegTable(Table):
    """One `[[leg]]`."""

    ground: Length3
    carrier: Length3
    length: Annotated[float, _scalar(units.LENGTH, least=0.0)]
    stiffness: Annotated[float, _scalar(units.STIFFNESS, least=0.0)] = 0.0
    damping: Annotated[float, _scalar(units.LINEAR_DAMPING, least=0.0)] = 0.0


class PointTable(Table):
    """One `[[point]]`."""

    name: Name
    mount: Text = "carrier"
    position: Length3 = ZERO3
    angles: Angle3 = ZERO3
