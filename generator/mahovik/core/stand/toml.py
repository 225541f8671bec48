"""TOML with every digit of its numbers."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Sequence
from decimal import Decimal, InvalidOperation
from typing import Any

_DEEPEST = 50
"""Parts of a dotted key. tomllib's time grows with their square: a line of 100 kB would take an hour."""

_DEEP_KEY = re.compile(rf"(?<![\w'\"-])(?:['\"\w-]++[ \t]*+\.[ \t]*+){{{_DEEPEST}}}")


def parse(text: str) -> dict[str, Any]:
    """The document, floats as Decimal so that a unit can be applied before they are rounded.

    Raises ValueError (TOMLDecodeError is one; an integer of 5000 digits is another) and RecursionError.
    """
    deep = _DEEP_KEY.search(text)
    if deep is not None:
        line = text.count("\n", 0, deep.start()) + 1
        raise ValueError(f"a key of more than {_DEEPEST} parts (at line {line})")
    return tomllib.loads(text, parse_float=exact)


def exact(text: str) -> Decimal:
    """A float literal with every digit it has."""
    try:
        return Decimal(text)
    except InvalidOperation:  # an exponent too long even for Decimal
        return Decimal("Infinity") if "e-" not in text.lower() else Decimal(0)


def value_of(value: Any) -> str:
    """A value in TOML, a number with all its digits."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return repr(value)
    if isinstance(value, Sequence) and not isinstance(value, str):
        return "[" + ", ".join(value_of(item) for item in value) + "]"
    return f'"{value}"' if isinstance(value, str) else str(value)


def line_of(key: str, value: Any) -> str:
    """`key = value` in TOML."""
    return f"{key} = {value_of(value)}"


def fields(table: Any, *keys: str) -> list[str]:
    """Lines of some attributes of a class of the model."""
    return [line_of(key, getattr(table, key)) for key in keys]
