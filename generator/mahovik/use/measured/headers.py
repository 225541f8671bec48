"""Headers of measured data, `acc1.acceleration.x [m/s2]`: what they mean on a stand, and their unit in SI.

Columns of a run of `mahovik simulate` are known by the names they have there.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from fractions import Fraction
from typing import Any, NamedTuple

from mahovik.core.stand.files import split_head
from mahovik.core.stand.hold import freedom_names, has_coordinates, numbered_freedoms
from mahovik.core.stand.model import WRENCH_LETTERS, Stand
from mahovik.core.stand.units import (
    ACCELERATION,
    ANGLE,
    ANGULAR_ACCELERATION,
    FORCE,
    LENGTH,
    PLAIN,
    SPEED,
    TIME,
    TORQUE,
    VELOCITY,
    Dimension,
    QuantityError,
    factor,
)
from mahovik.nearest import suggestion

AXES, LETTERS = "xyz", "xyzkmn"
"""Components of a vector, and of a wrench: forces, then moments."""

SENSOR = {
    **{f"acceleration.{axis}": ACCELERATION for axis in AXES},
    **{f"rate.{axis}": SPEED for axis in AXES},
}
FLYWHEEL = {"phase": ANGLE, "speed": SPEED, "count": PLAIN, "tacho": PLAIN, "torque": TORQUE}
HOLD = {f"reaction.{letter}": FORCE if letter in AXES else TORQUE for letter in LETTERS}

WITHOUT_UNIT = {"", "1", "count", "counts", "-"}
GRAVITIES = {"g": Fraction("9.80665"), "mg": Fraction("0.00980665"), "m/s/s": Fraction(1)}
"""Units of accelerometers that are masses elsewhere."""

RUN_MARKS = ("qw", "v_x [m/s]", "omega_x [rad/s]")
"""Columns that every run of `mahovik simulate` has, and no measured data."""

RUN_SENSORS = {"force": "acceleration", "gyro": "rate"}
RUN_FLYWHEELS = {"phi": "phase", "phi_dot": "speed", "tau": "torque"}

_PART_OF_TURN = re.compile(r"1\s*/\s*(\d{1,9})\s*(?:turn|rev|revolution)s?")
_RUN = re.compile(r"(?:(force|gyro)_([xyz])|(phi|phi_dot|tau)) (.+) (\[.+\])")


class HeaderError(ValueError):
    """A header that is no channel of the stand; the text says what was found and what was expected."""


class Channel(NamedTuple):
    """A channel of a stand by its `label`, such as `acc1.rate.x`.

    scale   SI units of one unit of the file; of a count 1
    counts  counts a turn that the unit states (`[1/4096 turn]`), None without
    """

    label: str
    scale: float = 1.0
    counts: int | None = None


def sensors(stand: Stand) -> tuple[str, ...]:
    """Names of what `points` of the C reads, in its order: instruments, then points."""
    return (*(place.name for place in stand.instruments), *(place.name for place in stand.points))


def split_header(header: str) -> tuple[str, str]:
    """Name and unit of a header; the unit is "" without brackets. Raises HeaderError."""
    name, unit = split_head(header)
    if not name:
        raise HeaderError(f'"{header[:60]}": expected a name and a unit, such as "acc1.rate.x [rad/s]"')
    return name, unit


def is_time(header: str) -> bool:
    """Whether a header is that of the time."""
    return split_head(header)[0].lower() in ("time", "t")


def time_scale(header: str) -> float:
    """Seconds of one unit of the column of time. Raises HeaderError."""
    name, unit = split_header(header)
    return float(_factor(unit, TIME, name)) if unit else 1.0


def channel_of(header: str, stand: Stand) -> Channel:
    """The channel of a stand that a header names. Raises HeaderError."""
    text, unit = split_header(header)
    bearer, _, rest = text.partition(".")
    known = _quantities(bearer, text, stand)
    if rest not in known:
        raise HeaderError(f'"{text}": {bearer} has no "{rest}"{suggestion(rest, known)}')
    dimension = known[rest]
    if dimension != PLAIN:
        if not unit:
            raise HeaderError(f'"{text}" has no unit, expected {dimension.words}, such as [{dimension.si}]')
        return Channel(text, float(_factor(unit, dimension, text)))
    turn = _PART_OF_TURN.fullmatch(unit) if rest == "count" else None
    if turn is None and unit not in WITHOUT_UNIT and not (rest == "tacho" and unit == "V"):
        raise HeaderError(f'"{text}": unit "{unit}" does not fit, expected [1] or, of a count, [1/4096 turn]')
    return Channel(text, counts=int(turn[1]) if turn is not None and int(turn[1]) else None)


def known_header(column: str) -> str | None:
    """Header of a column of a run of `mahovik simulate`; None: it is no measured quantity."""
    run = _RUN.fullmatch(column)
    if run is None:
        return column if is_time(column) or "." in column.partition(" [")[0] else None
    if run[1]:
        return f"{run[4]}.{RUN_SENSORS[run[1]]}.{run[2]} {run[5]}"
    return f"{run[4]}.{RUN_FLYWHEELS[run[3]]} {run[5]}"


def is_run(columns: Mapping[str, Any]) -> bool:
    """Whether a table with these columns is a run of `mahovik simulate`."""
    return all(mark in columns for mark in RUN_MARKS)


def _quantities(bearer: str, text: str, stand: Stand) -> Mapping[str, Dimension]:
    """Quantities of a point, an instrument, a flywheel or the hold, with their dimensions. Raises HeaderError."""
    by_name = dict.fromkeys(sensors(stand), SENSOR)
    by_name |= {wheel.name: FLYWHEEL for wheel in stand.flywheels}
    if bearer == "hold" and bearer not in by_name:
        if stand.hold is None:
            raise HeaderError(f'"{text}": the carrier is free, expected a stand with [hold]; leave this channel out')
        return HOLD
    if bearer == "carrier":
        raise HeaderError(f'"{text}": the carrier has no sensor; name a [[point]] of the stand at its place')
    if bearer not in by_name:
        near = suggestion(bearer, by_name)
        raise HeaderError(f'"{text}": {stand.name} has no point, instrument or flywheel "{bearer}"{near}')
    return by_name[bearer]


def _factor(unit: str, dimension: Dimension, text: str) -> Fraction:
    if dimension == ACCELERATION and unit in GRAVITIES:
        return GRAVITIES[unit]
    try:
        return factor(unit, dimension)
    except QuantityError as error:
        raise HeaderError(f'"{text}": {error}') from None


# -- columns of a run of `mahovik simulate`, which logs of states have too ---------------------------------------------

Columns = list[tuple[str, Dimension]]
"""Names of columns, with their dimensions."""

RATES = {"slide": (VELOCITY, ACCELERATION), "turn": (SPEED, ANGULAR_ACCELERATION), "twist": (PLAIN, PLAIN)}
"""Dimensions of u and u_dot of a kind of freedom."""

CARRIER: Mapping[str, Columns] = {
    "position": [(a, LENGTH) for a in AXES],
    "quaternion": [(f"q{a}", PLAIN) for a in "wxyz"],
    "angles": [(name, ANGLE) for name in ("psi", "theta", "phi")],
    "V": [*((f"v_{a}", VELOCITY) for a in AXES), *((f"omega_{a}", SPEED) for a in AXES)],
    "V_dot": [
        *((f"v_dot_{a}", ACCELERATION) for a in AXES), *((f"omega_dot_{a}", ANGULAR_ACCELERATION) for a in AXES)
    ],
}  # fmt: skip
"""Columns of each key of `eval` that every stand has."""


def state_columns(stand: Stand) -> dict[str, Columns]:
    """Columns of each key of `eval` that a stand has."""
    result = dict(CARRIER)
    if stand.hold is not None:
        names, kinds = freedom_names(stand.hold), [freedom.kind for freedom in stand.hold.freedoms]
        for k, key in enumerate(("u", "u_dot") if names else ()):
            result[key] = [(f"{key} {name}", RATES[kind][k]) for name, kind in zip(names, kinds, strict=True)]
        if names and has_coordinates(stand.hold):
            numbered = numbered_freedoms(stand.hold)
            if numbered:
                result["q"] = [(f"q {names[k]}", LENGTH if kinds[k] == "slide" else ANGLE) for k in numbered]
            if len(numbered) < len(names):
                result["orientation"] = [(f"orientation_{letter}", PLAIN) for letter in "wxyz"]
        result["reaction"] = [(f"hold.reaction.{a}", FORCE if a in AXES else TORQUE) for a in LETTERS]
    if stand.flywheels:
        wheels = [wheel.name for wheel in stand.flywheels]
        for key, unit in (("phi", ANGLE), ("phi_dot", SPEED), ("phi_ddot", ANGULAR_ACCELERATION), ("tau", TORQUE)):
            result[key] = [(f"{key} {name}", unit) for name in wheels]
        letters = list(zip(WRENCH_LETTERS, (FORCE,) * 3 + (TORQUE,) * 3, strict=True))
        result["mount_wrench"] = [(f"mount_{letter} {name}", unit) for name in wheels for letter, unit in letters]
    return result


def with_units(columns: Columns) -> list[str]:
    """Headers of columns, with their units in SI."""
    return [f"{name} [{unit.si.replace('^', '')}]" if unit.si else name for name, unit in columns]
