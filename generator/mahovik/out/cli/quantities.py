"""Numbers with units on the command line: lists, vectors, bands, axes. Every error names the option."""

from __future__ import annotations

import math
import re
from decimal import Decimal, InvalidOperation

import click

from mahovik.contract.quantities import RPM
from mahovik.errors import UsageError
from mahovik.out.notices import FAST, rpm_question

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


def speeds(option: str, text: str) -> tuple[float, ...]:
    """Angular speeds, rad/s, as "100 200 rpm". Raises UsageError; warns of one above FAST without a unit."""
    found = tuple(_list(option, text, ("an angular speed", "rad/s")))
    fastest = max(map(abs, found), default=0.0)
    if fastest > FAST and not any(letter.isalpha() for letter in re.sub(_NUMBER, "", text)):
        click.echo(f"warning: {option}: {RPM * fastest:.6g} rpm{rpm_question(fastest)}", err=True)
    return found


def vector(option: str, text: str) -> tuple[float, float, float]:
    """An angular momentum, N m s. Raises UsageError."""
    found = _list(option, text, ("an angular momentum", "N m s"))
    if len(found) != 3:
        raise UsageError(f'{option} {text}: expected three numbers, as "0 0 14"')
    return found[0], found[1], found[2]


def speed(option: str, text: str, least: str = "of at least") -> float:
    """One angular speed of at least 0, rad/s. Raises UsageError."""
    found = speeds(option, text)
    if len(found) != 1:
        raise UsageError(f'{option} {text}: expected a speed, as "100 rpm"')
    if not found[0] >= 0.0 or (least == "above" and found[0] == 0.0):
        raise UsageError(f"{option} {text}: expected a speed {least} 0")
    return found[0]


def speed_above_zero(option: str, text: str) -> float:
    """One angular speed above 0, rad/s. Raises UsageError."""
    return speed(option, text, "above")


def frequency(option: str, text: str) -> float:
    """One frequency, Hz. Raises UsageError."""
    found = _list(option, text, ("a frequency", "Hz"))
    if len(found) != 1:
        raise UsageError(f'{option} {text}: expected a frequency, as "35Hz"')
    return found[0]


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


def band(option: str, text: str) -> tuple[float, float]:
    """Two frequencies, Hz, the lower first, as "20..200Hz". Raises UsageError."""
    from mahovik.use.vibration.band import check_band

    low, dots, high = text.partition("..")
    if not dots or not low.strip() or not high.strip():
        raise UsageError(f'{option} {text}: expected two frequencies, as "20..200Hz"')
    unit = _NUMBER.sub("", high, count=1).strip()
    first = low if not _NUMBER.fullmatch(low.strip()) else f"{low} {unit}"
    found = frequency(option, first), frequency(option, high)
    if not unit:
        raise UsageError(f"{option} {text}: expected two frequencies with their unit, as 20..200Hz")
    check_band(option, found)
    return found


def fraction(option: str, text: str) -> float:
    """A part of 1, as "10%" or 0.1. Raises UsageError."""
    body = text.strip().removesuffix("%")
    try:
        value = float(body) / (100.0 if text.strip().endswith("%") else 1.0)
    except ValueError:
        raise UsageError(f'{option} {text}: expected a fraction, as "10%"') from None
    return value


def axes(option: str, text: str) -> tuple[tuple[float, float, float], ...]:
    """Letters of axes, "xy", or one direction, "0,0,1", to unit vectors. Raises UsageError."""
    units = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}
    if text and set(text) <= set(units) and len(set(text)) == len(text):
        return tuple(units[letter] for letter in text)
    try:
        direction = [float(each) for each in text.replace(",", " ").split()]
    except ValueError:
        direction = []
    size = math.hypot(*direction)
    if len(direction) != 3 or not math.isfinite(size) or size == 0.0:
        raise UsageError(f'{option} {text}: expected some of the letters xyz, or a direction as "0,0,1"')
    x, y, z = (each / size for each in direction)
    return ((x, y, z),)


def whole_numbers(option: str, text: str) -> tuple[int, ...]:
    """Whole numbers, as "1,2". Raises UsageError."""
    try:
        return tuple(int(each) for each in text.split(","))
    except ValueError:
        raise UsageError(f"{option} {text}: expected whole numbers, as 1,2") from None
