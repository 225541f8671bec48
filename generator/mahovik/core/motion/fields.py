"""Fields of motion, programme, regime, servo and design files; they hold their values in SI.

Fields that depend on the stand find the number of its flywheels in the context of the validation, as `flywheels`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Sequence
from decimal import Decimal
from typing import Annotated, Any, TypeVar

from pydantic import BaseModel, BeforeValidator, PlainValidator, ValidationInfo

from mahovik.core.stand.echoes import list_item
from mahovik.core.stand.fields import integer, refuse, require_bounds, text, validator
from mahovik.core.stand.shapes import vector
from mahovik.core.stand.units import SPEED, TIME, Dimension, QuantityError, number, show
from mahovik.nearest import suggestion

FREQUENCY = Dimension("a frequency", "Hz")
_LONGEST = 10**9

Row = TypeVar("Row")


def context_validator(read: Callable[[Any, dict[str, Any]], Any]) -> PlainValidator:
    """A validator that reads a raw value and the context of the validation by `read`, which raises QuantityError."""

    def validate(raw: Any, info: ValidationInfo) -> Any:
        try:
            return read(raw, info.context or {})
        except QuantityError as error:
            raise refuse(str(error)) from None

    return PlainValidator(validate)


def _accept(value: float, raw: Any) -> None:
    """Any number is in order."""


def per_flywheel(dimension: Dimension, check: Callable[[float, Any], object] = _accept) -> PlainValidator:
    """A validator of one number for all flywheels, or a list with one for each.

    `check` takes a number in SI and as it stands in the file, and raises QuantityError.
    """

    def read(raw: Any, context: dict[str, Any]) -> tuple[float, ...]:
        N = context["flywheels"]
        if isinstance(raw, list) or (isinstance(raw, dict) and isinstance(raw.get("value"), list)):
            found = vector(raw, (N,), dimension)
            for i, each in enumerate(found):
                try:
                    check(each, list_item(raw, i))
                except QuantityError as error:
                    raise QuantityError(f"[{i}]: {error}") from None
            return found
        value = number(raw, dimension)
        check(value, raw)
        return (value,) * int(N)

    return context_validator(read)


def short_integer(raw: Any) -> int:
    """A whole number of at most nine digits. Raises QuantityError."""
    if abs(integer(raw)) >= _LONGEST:
        raise QuantityError(f"expected a whole number, found {show(raw)}")
    return int(raw)


def whole_number(least: int, most: int) -> PlainValidator:
    """A validator of a whole number within bounds."""

    def read(raw: Any) -> int:
        found = short_integer(raw)
        if not least <= found <= most:
            raise QuantityError(f"{found}: expected {least} to {most}")
        return found

    return validator(read)


def integers(raw: Any) -> tuple[int, ...]:
    """A list of whole numbers. Raises QuantityError."""
    return rows(raw, short_integer)


def choice(*names: str) -> PlainValidator:
    """A validator of one of some names."""

    def read(raw: Any) -> str:
        if text(raw) not in names:
            raise QuantityError(f"unknown {show(raw)}{suggestion(raw, names)}")
        return str(raw)

    return validator(read)


def positions(raw: Any, known: Sequence[str]) -> tuple[int, ...]:
    """Places in `known` of the names of a list, in the list's order. Raises QuantityError."""
    found: list[int] = []
    for name in any_list(raw):
        if name not in known:
            raise QuantityError(f"unknown {show(name)}{suggestion(str(name), known)}")
        if known.index(name) in found:
            raise QuantityError(f"{show(name)} appears twice")
        found.append(known.index(name))
    return tuple(found)


def angular_speed(raw: Any) -> float:
    """A frequency (with unit) or an angular speed above 0, in rad/s. Raises QuantityError."""
    try:
        found = 2 * math.pi * number(raw, FREQUENCY)
        if isinstance(raw, int | Decimal):
            raise QuantityError('expected a frequency with its unit, such as "40 Hz"')
    except QuantityError as error:
        try:
            found = number(raw, SPEED) if isinstance(raw, str | dict) else math.nan
        except QuantityError:
            found = math.nan
        if math.isnan(found):
            raise QuantityError(str(error)) from None
    return require_bounds(found, "rad/s", above=0.0, raw=raw)


def times(raw: Any) -> tuple[float, ...]:
    """A list of times, s, of any length. Raises QuantityError."""
    return vector(raw, (len(any_list(raw)),), TIME)


def any_list(raw: Any) -> list[Any]:
    """A list of anything. Raises QuantityError."""
    if not isinstance(raw, list):
        raise QuantityError(f"expected a list, found {show(raw)}")
    return raw


def rows(raw: Any, read: Callable[[Any], Row]) -> tuple[Row, ...]:
    """A list of rows, each read by `read`. Raises QuantityError for the first that cannot be read."""
    found = []
    for i, row in enumerate(any_list(raw)):
        try:
            found.append(read(row))
        except QuantityError as error:
            element = str(error)
            raise QuantityError(f"[{i}]{'' if element.startswith('[') else ': '}{element}") from None
    return tuple(found)


def table_or_false(keys: Collection[str]) -> BeforeValidator:
    """A validator of a table with some of `keys`, or false, which reads as None."""

    def read(raw: Any) -> Any:
        if raw is not False and not isinstance(raw, dict):
            raise refuse(f"expected a table with {', '.join(keys)}, or false, found {show(raw)}")
        return None if raw is False else raw

    return BeforeValidator(read)


def table_with(table: type[BaseModel]) -> BeforeValidator:
    """A validator of a table, whose keys the message names."""

    def read(raw: Any) -> Any:
        if not isinstance(raw, dict):
            keys = (info.alias or name for name, info in table.model_fields.items())
            raise refuse(f"expected a table with {', '.join(keys)}, found {show(raw)}")
        return raw

    return BeforeValidator(read)


def _not_null(raw: Any) -> Any:
    if raw is None:
        raise refuse("expected a value, found null")
    return raw


NOT_NULL = BeforeValidator(_not_null)
"""A table that may be left out, but not null."""

Times = Annotated[tuple[float, ...], validator(times)]
