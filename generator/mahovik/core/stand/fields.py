"""Types of the keys in a stand file's tables, also in those of laws.

A field holds its value in SI already.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Annotated, Any, TypeVar

from pydantic import BaseModel, ConfigDict, PlainValidator
from pydantic_core import PydanticCustomError

from mahovik.core.stand import units
from mahovik.core.stand.echoes import echo
from mahovik.core.stand.model import Mat3, Mat6, Vec3
from mahovik.core.stand.names import name_problem, stand_name_problem
from mahovik.core.stand.shapes import Blocks, direction, matrix6, symmetric3, vec3
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


def refuse(error: str, key: str = "") -> PydanticCustomError:
    """The error that pydantic is to report, of `key` inside the table where one is named."""
    return PydanticCustomError("stand", "{reason}", {"reason": error, "key": key})


@dataclass(frozen=True)
class QuantityValidator(PlainValidator):
    """A validator that knows what it reads.

    dimension  of its numbers, of a 6x6 by blocks; None where it reads none
    least      smallest accepted number, above: one that is too small, most: the largest; SI, None: no bound
    """

    dimension: Dimension | Blocks | None = None
    least: float | None = None
    above: float | None = None
    most: float | None = None


def validator(
    read: Callable[[Any], T], dimension: Dimension | Blocks | None = None, **bounds: float | None
) -> QuantityValidator:
    """A validator that reads a raw value by `read`, which raises QuantityError; `bounds`: see QuantityValidator."""

    def validate(raw: Any) -> T:
        try:
            return read(raw)
        except QuantityError as error:
            raise refuse(str(error)) from None

    return QuantityValidator(validate, dimension=dimension, **bounds)


def require_bounds(
    value: float,
    unit: str,
    least: float | None = None,
    above: float | None = None,
    most: float | None = None,
    raw: Any = None,
) -> float:
    """`value` itself, in `unit`. Raises QuantityError if it is out of bounds, with `raw`, the number in the file."""
    found = echo(raw, value, unit) or f"{repr(value).removesuffix('.0')} {unit}".rstrip()
    if above is not None and most is not None and not above < value <= most:
        raise QuantityError(f"{found}: expected above {above:g}, at most {most:g}")
    if above is not None and value <= above:
        raise QuantityError(f"{found} is not above {above:g}")
    if least is not None and value < least:
        raise QuantityError(f"{found} is negative" if least == 0 else f"{found} is below {least:g}")
    if most is not None and value > most:
        raise QuantityError(f"{found} is above {most:g}")
    return value


def scalar(
    dimension: Dimension, *, least: float | None = None, above: float | None = None, most: float | None = None
) -> QuantityValidator:
    """A validator of a number within bounds."""

    def read(raw: Any) -> float:
        return require_bounds(number(raw, dimension), dimension.si, least, above, most, raw)

    return validator(read, dimension, least=least, above=above, most=most)


def vector3(dimension: Dimension) -> QuantityValidator:
    """A validator of three numbers."""
    return validator(lambda raw: vec3(raw, dimension), dimension)


def matrix(blocks: Blocks, *, symmetric: bool = False) -> QuantityValidator:
    """A validator of a 6x6; None where it is zero."""
    return validator(lambda raw: matrix6(raw, blocks, symmetric=symmetric), blocks)


def integer(raw: Any) -> int:
    """A whole number. Raises QuantityError."""
    if isinstance(raw, bool) or not isinstance(raw, int):
        raise QuantityError(f"expected a whole number, found {show(raw)}")
    return raw


def text(raw: Any) -> str:
    """A string. Raises QuantityError."""
    if not isinstance(raw, str):
        raise QuantityError(f"expected a string, found {show(raw)}")
    return raw


def letter(letters: tuple[str, ...]) -> Callable[[Any], int]:
    """What reads one of some letters as its place among them; it raises QuantityError."""

    def read(raw: Any) -> int:
        if text(raw) not in letters:
            raise QuantityError(f"expected one of {' '.join(letters)}, found {show(raw)}")
        return letters.index(raw)

    return read


def flag(raw: Any) -> bool:
    """true or false. Raises QuantityError."""
    if not isinstance(raw, bool):
        raise QuantityError(f"expected true or false, found {show(raw)}")
    return raw


def _stand_name(raw: Any) -> str:
    problem = stand_name_problem(text(raw))
    if problem is not None:
        raise QuantityError(problem)
    return str(raw)


def _name(raw: Any) -> str:
    problem = name_problem(text(raw))
    if problem is not None:
        raise QuantityError(problem)
    return str(raw)


Name = Annotated[str, validator(_name)]
StandName = Annotated[str, validator(_stand_name)]
Text = Annotated[str, validator(text)]
Flag = Annotated[bool, validator(flag)]
Length3 = Annotated[Vec3, vector3(units.LENGTH)]
Angle3 = Annotated[Vec3, vector3(units.ANGLE)]
Direction = Annotated[Vec3, validator(direction)]
Mass = Annotated[float, scalar(units.MASS, least=0.0)]
Inertia3 = Annotated[Mat3, validator(lambda raw: symmetric3(raw, units.INERTIA), units.INERTIA)]
AddedMass = Annotated[Mat6 | None, matrix(ADDED_MASS, symmetric=True)]
ZERO3: Vec3 = (0.0, 0.0, 0.0)


class Table(BaseModel):
    """Base of all tables: a key that is no field is an error."""

    model_config = ConfigDict(extra="forbid", frozen=True, defer_build=True)


class Mounted(Table):
    """Base of tables of what is mounted on the carrier or an instrument."""

    mount: Text = "carrier"
