"""TOML with every digit of its numbers."""

from __future__ import annotations

import re
import tomllib
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
