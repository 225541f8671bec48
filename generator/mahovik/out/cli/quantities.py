"""Numbers with units on the command line: lists, vectors, bands, axes. Every error names the option."""

from __future__ import annotations

import re
from decimal import Decimal, InvalidOperation

from mahovik.errors import UsageError

_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?(?![\d./])")  # the 1 of 1/min is its unit's


def _list(option: str, text: str, dimension: tuple[str, str]) -> list[float]:
    """Numbers, and after the last one the unit of all; without a unit SI. Raises UsageError."""
    from mahovik.core.stand.units import Dimension, QuantityError, number

    rest, found = text.replace(",", " ").strip(), []
    while match := _NUMBER.match(rest):
        found.append(match[0])
        rest = rest[match.end() :].lstrip()
    try:
        return [number(Decimal(each), Dimension(*dimension), rest or None) for each in found]
    except (QuantityError, InvalidOperation) as error:
        raise UsageError(f"{option} {text}: {error}") from None


def time(option: str, text: str) -> float:
    """One time, s. Raises UsageError."""
    found = _list(option, text, ("a time", "s"))
    if len(found) != 1:
        raise UsageError(f'{option} {text}: expected a time, as "10 ms"')
    return found[0]


def time_limit(option: str, text: str) -> float:
    """How long something may take, s. Raises UsageError."""
    found = time(option, text)
    if not found > 0.0:
        raise UsageError(f"{option} {text}: expected a time above 0")
    return found
