"""Documents in JSON and TOML: read strictly, every digit kept; each problem is one line with file and key.

A key that depends on the stand finds the number of its flywheels in the context, as `flywheels`.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Sequence
from decimal import Decimal
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from mahovik.core.stand.fields import echo, integer, list_item, require_bounds, text, validator, vector
from mahovik.core.stand.files import exact, kind_of, parse_toml, readable_text, wrong_kind
from mahovik.core.stand.tables import Context, QuantityValidator
from mahovik.core.stand.units import PLAIN, SPEED, TIME, Dimension, QuantityError, number, show
from mahovik.errors import FileError
from mahovik.nearest import suggestion

FREQUENCY = Dimension("a frequency", "Hz")
_LONGEST = 10**9

T = TypeVar("T")


# -- files -----------------------------------------------------------------------------------------------------------


def text_of(path: Path, expected: str, most: int, error: type[FileError]) -> str:
    """The text of a file of at most `most` bytes. Raises `error` with one line that names the file."""
    try:
        return readable_text(path, expected, most)
    except ValueError as problem:
        raise error([str(problem)]) from None


def parse(text: str) -> Any:
    """The value of a JSON text, floats as Decimal. Raises ValueError; a repeated key is an error."""

    def once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        table: dict[str, Any] = {}
        for key, value in pairs:
            if key in table:
                raise ValueError(f"key {show(key)} appears twice")
            table[key] = value
        return table

    return json.loads(text, parse_float=exact, object_pairs_hook=once)


def kind_of_text(text: str, is_json: bool) -> str:
    """The kind of a file by its text, one of KINDS; empty where it is none."""
    try:
        document = parse(text) if is_json else parse_toml(text)
    except (RecursionError, ValueError):
        return ""
    return kind_of(document) if isinstance(document, dict) else ""


def document_of(text: str, source: str, error: type[FileError], *kinds: str, is_json: bool = True) -> dict[str, Any]:
    """The keys of a file of schema 1, which is of one of these KINDS. Raises `error` with one line."""
    try:
        document = parse(text) if is_json else parse_toml(text)
        if is_json and "\\u" in text:  # half of a pair, such as \ud800, is no character
            json.dumps(document, ensure_ascii=False, default=str).encode()
    except (RecursionError, ValueError) as problem:
        if (kind := kind_of_text(text, not is_json)) and kind not in kinds:
            raise error([f"{source}: {wrong_kind(kind, *kinds)}"]) from None
        raise error([f"{source}: not {'JSON' if is_json else 'TOML'}: {problem}"]) from None
    if not isinstance(document, dict):
        raise error([f"{source}: expected an object, found {show(document)}"])
    if (kind := kind_of(document)) and kind not in kinds:
        raise error([f"{source}: {wrong_kind(kind, *kinds)}"])
    if "schema" not in document:
        raise error([f"{source}: schema: required, but missing"])
    if isinstance(document["schema"], bool) or document["schema"] != 1:
        raise error([f"{source}: schema: expected 1, found {show(document['schema'])}"])
    return {key: value for key, value in document.items() if key != "schema"}


# -- fields ----------------------------------------------------------------------------------------------------------


def per_flywheel(
    dimension: Dimension, check: Callable[[float, Any], object] = lambda value, raw: None
) -> QuantityValidator:
    """A validator of one number for all flywheels, or a list with one for each.

    `check` takes a number in SI and as it stands in the file, and raises QuantityError.
    """

    def read(raw: Any, context: Context) -> tuple[float, ...]:
        N = context["flywheels"]
        if isinstance(raw, list) or (isinstance(raw, dict) and isinstance(raw.get("value"), list)):
            values = vector(raw, (N,), dimension)
            for i, value in enumerate(values):
                try:
                    check(value, list_item(raw, i))
                except QuantityError as error:
                    raise QuantityError(f"[{i}]: {error}") from None
            return values
        check(value := number(raw, dimension), raw)
        return (value,) * int(N)

    return QuantityValidator(read)


def bound_per_flywheel(dimension: Dimension, zero: bool = False) -> QuantityValidator:
    """A validator of a magnitude that is not exceeded, for all flywheels or for each; `zero`: it may be zero."""

    def check(value: float, raw: Any) -> None:
        if value < 0.0 or (value == 0.0 and not zero):
            written = echo(raw, value, dimension.si) or f"{value:g}"
            raise QuantityError(f"{written} is not above 0: a bound is a magnitude")

    return per_flywheel(dimension, check)


def numbers_of_flywheels(axes: int) -> QuantityValidator:
    """A validator of an array (N) of plain numbers, or with two axes (M, N)."""

    def read(raw: Any, context: Context) -> Any:
        lengths = (context["flywheels"],)
        if axes == 1:
            return np.array(vector(raw, lengths, PLAIN), dtype=np.float64)
        numbers = rows(raw, lambda row: vector(row, lengths, PLAIN))
        return np.array(numbers, dtype=np.float64).reshape(len(numbers), *lengths)

    return QuantityValidator(read)


def six_numbers() -> QuantityValidator:
    """A validator of an array (M, 6) of plain numbers."""
    return validator(lambda raw: np.array(rows(raw, lambda row: vector(row, (6,), PLAIN))).reshape(-1, 6))


def times() -> QuantityValidator:
    """A validator of an array (M) of times, s."""
    return validator(lambda raw: np.array(vector(raw, (len(any_list(raw)),), TIME)))


def short_integer(raw: Any) -> int:
    """A whole number of at most nine digits. Raises QuantityError."""
    if abs(integer(raw)) >= _LONGEST:
        raise QuantityError(f"expected a whole number, found {show(raw)}")
    return int(raw)


def whole_number(least: int, most: int) -> QuantityValidator:
    """A validator of a whole number within bounds."""

    def read(raw: Any) -> int:
        value = short_integer(raw)
        if not least <= value <= most:
            raise QuantityError(f"{value}: expected {least} to {most}")
        return value

    return validator(read, least=least, most=most)


def choice(*names: str) -> QuantityValidator:
    """A validator of one of some names."""

    def read(raw: Any) -> str:
        if text(raw) not in names:
            raise QuantityError(f"unknown {show(raw)}{suggestion(raw, names)}")
        return str(raw)

    return validator(read, words=tuple((name, name) for name in names))


def positions(raw: Any, known: Sequence[str]) -> tuple[int, ...]:
    """Places in `known` of the names of a list, in the list's order. Raises QuantityError."""
    places: list[int] = []
    for name in any_list(raw):
        if name not in known:
            raise QuantityError(f"unknown {show(name)}{suggestion(str(name), known)}")
        if known.index(name) in places:
            raise QuantityError(f"{show(name)} appears twice")
        places.append(known.index(name))
    return tuple(places)


def angular_speed(raw: Any) -> float:
    """A frequency (with unit) or an angular speed above 0, in rad/s. Raises QuantityError."""
    try:
        value = number(raw, SPEED) if isinstance(raw, str | dict) else math.nan
    except QuantityError:
        value = math.nan
    if math.isnan(value):
        value = 2 * math.pi * number(raw, FREQUENCY)
        if isinstance(raw, int | Decimal):
            raise QuantityError('expected a frequency with its unit, such as "40 Hz"')
    return require_bounds(value, "rad/s", above=0.0, raw=raw)


def any_list(raw: Any) -> list[Any]:
    """A list of anything. Raises QuantityError."""
    if not isinstance(raw, list):
        raise QuantityError(f"expected a list, found {show(raw)}")
    return raw


def rows(raw: Any, read: Callable[[Any], T]) -> tuple[T, ...]:
    """A list of rows, each read by `read`. Raises QuantityError for the first that cannot be read."""
    values = []
    for i, row in enumerate(any_list(raw)):
        try:
            values.append(read(row))
        except QuantityError as error:
            element = str(error)
            raise QuantityError(f"[{i}]{'' if element.startswith('[') else ': '}{element}") from None
    return tuple(values)
