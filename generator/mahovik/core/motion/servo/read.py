"""Servo file (TOML) -> Servo. Every problem of the file is found before any is reported."""

from __future__ import annotations

import math
from decimal import Decimal
from pathlib import Path
from typing import Any, Literal, cast

from mahovik.core.motion.document import Section, text_of
from mahovik.core.motion.entry import FREQUENCY
from mahovik.core.motion.ranges import MAX_WRENCH
from mahovik.core.motion.servo.model import COORDINATES, Servo, Trim
from mahovik.core.stand.content import TEXT
from mahovik.core.stand.model import Stand
from mahovik.core.stand.problems import Problems
from mahovik.core.stand.toml import parse
from mahovik.core.stand.units import ANGLE, PLAIN, SPEED, TIME, TORQUE, Dimension, QuantityError, number, show
from mahovik.errors import ServoError
from mahovik.nearest import meant

KEYS = (
    "schema", "name", "sample_period", "latency", "bandwidth", "damping_ratio", "integral", "speed_filter",
    "feedforward", "friction", "torque_limit", "torque_rate", "encoder", "trim",
)  # fmt: skip
TRIM_KEYS = ("harmonics", "gain", "coordinates", "settling", "averaging", "limit")
ENCODERS = ("ideal", "stand")
TORQUE_RATE = Dimension("a torque rate", "N m/s")

MOST_PERIOD, MOST_LATENCY = 1.0, 16
"""s between samples; latency in sample periods."""
DAMPING_RATIO = 0.8
"""Unless told otherwise."""
MOST_DAMPING_RATIO = 5.0
MOST_HARMONICS = 16
"""Of a trim: its matrix has (coordinates x flywheels) numbers for the square of twice as many."""


def load_servo(path: str | Path, stand: Stand) -> Servo:
    """Read and check the servo file at `path` for a stand. Raises ServoError with every problem."""
    path = Path(path)
    try:
        text = text_of(path, TEXT)
    except ValueError as error:
        raise ServoError([str(error)]) from None
    return read_servo(text, stand, path.name)


def read_servo(text: str, stand: Stand, source: str = "servo") -> Servo:
    """Read and check a servo given as text; `source` names it in messages. Raises ServoError with every problem."""
    try:
        document = parse(text)
    except (RecursionError, ValueError) as error:
        raise ServoError([f"{source}: not TOML: {error}"]) from None
    if "schema" not in document:
        raise ServoError([f"{source}: schema: required, but missing"])
    if isinstance(document["schema"], bool) or document["schema"] != 1:
        raise ServoError([f"{source}: schema: expected 1, found {show(document['schema'])}"])
    problems = Problems(source)
    top = Section(problems, document)
    top.only(KEYS)
    if not stand.flywheels:
        problems.add(f'the stand "{stand.name}" has no flywheels: there is nothing to drive')
    top.has("sample_period", "bandwidth")
    period = top.above_zero("sample_period", TIME) if "sample_period" in top else None
    if period is not None and period > MOST_PERIOD:
        top.refuse("sample_period", f"{period:g} s is more than {MOST_PERIOD:g} s")
    latency = _latency(top, period)
    servo = Servo(
        name=top.text("name", Path(source).stem),
        period=period or math.nan,
        latency=latency,
        bandwidth=_turning(top, "bandwidth") or math.nan,
        damping_ratio=_between(top, "damping_ratio", DAMPING_RATIO, MOST_DAMPING_RATIO),
        integral=_turning(top, "integral"),
        speed_filter=_turning(top, "speed_filter"),
        feedforward=_switch(top, "feedforward", True),
        friction=_switch(top, "friction", True),
        torque_limit=_each(top, "torque_limit", TORQUE, _of_motors(stand)),
        torque_rate=_each(top, "torque_rate", TORQUE_RATE, (math.inf,) * len(stand.flywheels)),
        encoder=_encoder(top, stand),
        trim=_trim(top),
    )
    if servo.integral is not None and servo.integral > servo.bandwidth:
        top.refuse("integral", f"{servo.integral:g} rad/s is above the bandwidth, {servo.bandwidth:g} rad/s")
    if problems.lines:
        raise ServoError(problems.lines)
    return servo


def _latency(top: Section, period: float | None) -> float:
    """0 or more; so many sample periods at most."""
    found = top.number("latency", TIME) if "latency" in top else 0.0
    if found is None:
        return math.nan
    if found < 0.0:
        top.refuse("latency", f"{found:g} s is negative")
    elif period is not None and found > MOST_LATENCY * period:
        top.refuse("latency", f"{found:g} s is more than {MOST_LATENCY} sample periods of {period:g} s")
    return found


def _turning(top: Section, key: str) -> float | None:
    """A frequency above 0 as rad/s: given as one, in Hz, or as an angular speed. None where there is none."""
    if key not in top or top.given[key] is False:
        return None
    raw = top.given[key]
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
            top.refuse(key, str(error))
            return None
    if found > 0.0:
        return found
    top.refuse(key, f"{found:g} rad/s is not above 0")
    return None


def _between(section: Section, key: str, default: float, most: float) -> float:
    """A plain number above 0 and at most `most`."""
    found = section.number(key, PLAIN) if key in section else default
    if found is not None and not 0.0 < found <= most:
        section.refuse(key, f"{found:g}: expected above 0, at most {most:g}")
    return math.nan if found is None else found


def _switch(top: Section, key: str, default: bool) -> bool:
    found = top.given.get(key, default)
    if not isinstance(found, bool):
        top.refuse(key, f"expected true or false, found {show(found)}")
        return default
    return found


def _of_motors(stand: Stand) -> tuple[float, ...]:
    """Torque limits of the stand file's motors."""
    motors = [s.motor for s in stand.flywheels]
    return tuple(math.inf if m is None or m.torque is None else m.torque for m in motors)


def _each(top: Section, key: str, dimension: Dimension, default: tuple[float, ...]) -> tuple[float, ...]:
    """One number for all flywheels, or a list with one for each; above 0."""
    if key not in top:
        return default
    raw, N = top.given[key], len(default)
    if isinstance(raw, list):
        found = top.numbers(key, raw, N, dimension)
    else:
        one = top.number(key, dimension)
        found = None if one is None else (one,) * N
    if found is None:
        return default
    for value in found:
        if not 0.0 < value <= MAX_WRENCH:
            top.refuse(key, f"{value:g} {dimension.si}: expected above 0, at most {MAX_WRENCH:g}")
    return found


def _encoder(top: Section, stand: Stand) -> Literal["ideal", "stand"]:
    found = top.text("encoder", "ideal")
    if found not in ENCODERS:
        top.refuse("encoder", f"unknown {show(found)}{meant(found, ENCODERS)}")
    without = [s.name for s in stand.flywheels if s.encoder is None]
    if found == "stand" and without:
        top.refuse("encoder", f'"stand", but the stand file has none for {", ".join(without)}')
    return cast(Literal["ideal", "stand"], found)


def _trim(top: Section) -> Trim | None:
    """The table `trim`; false and nothing are off."""
    given = top.given.get("trim", False)
    if given is False:
        return None
    if not isinstance(given, dict):
        top.refuse("trim", f"expected a table with {', '.join(TRIM_KEYS)}, or false, found {show(given)}")
        return None
    section = Section(top.problems, given, ("trim",))
    section.only(TRIM_KEYS)
    return Trim(
        harmonics=_whole(section, "harmonics", 1, 1, MOST_HARMONICS),
        gain=_between(section, "gain", 0.5, 1.0),
        coordinates=_coordinates(section),
        settling=_whole(section, "settling", 20, 0, 10**6),
        averaging=_whole(section, "averaging", 1, 1, 10**6),
        limit=_limit(section),
    )


def _limit(section: Section) -> float:
    found = section.above_zero("limit", ANGLE) if "limit" in section else 0.5
    return math.nan if found is None else found


def _whole(section: Section, key: str, default: int, least: int, most: int) -> int:
    found = section.integer(key, section.given[key]) if key in section else default
    if found is not None and not least <= found <= most:
        section.refuse(key, f"{found}: expected {least} to {most}")
    return default if found is None else found


def _coordinates(section: Section) -> tuple[int, ...]:
    """Numbers of the coordinates that are named, rising."""
    raw: Any = section.given.get("coordinates", list(COORDINATES))
    if not isinstance(raw, list) or not raw:
        section.refuse("coordinates", f"expected names among {', '.join(COORDINATES)}, found {show(raw)}")
        return ()
    found = set()
    for each in raw:
        if each not in COORDINATES:
            section.refuse("coordinates", f"unknown {show(each)}{meant(each, COORDINATES)}")
        elif COORDINATES.index(each) in found:
            section.refuse("coordinates", f"{show(each)} is there twice")
        else:
            found.add(COORDINATES.index(each))
    return tuple(sorted(found))
