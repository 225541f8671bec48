"""Names of channels, `acc1.acceleration.x [m/s2]`: what they mean on a stand, and their unit in SI.

A table has the quantities of each kind of bearer; one place reads a header and matches it to a stand.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import get_args

from mahovik.core.stand.model import Stand
from mahovik.core.stand.units import (
    ACCELERATION,
    ANGLE,
    FORCE,
    PLAIN,
    SPEED,
    TIME,
    TORQUE,
    Dimension,
    QuantityError,
    factor,
)
from mahovik.nearest import suggestion
from mahovik.use.measured.recording import Channel, Kind

AXES = ("x", "y", "z")
WRENCH = {**dict.fromkeys(AXES, FORCE), **dict.fromkeys(("k", "m", "n"), TORQUE)}

SENSOR: Mapping[str, Mapping[str, Dimension]] = {
    "acceleration": dict.fromkeys(AXES, ACCELERATION),
    "rate": dict.fromkeys(AXES, SPEED),
}
FLYWHEEL: Mapping[str, Mapping[str, Dimension]] = {
    "phase": {"": ANGLE},
    "speed": {"": SPEED},
    "count": {"": PLAIN},
    "tacho": {"": PLAIN},
    "torque": {"": TORQUE},
    "mount": WRENCH,
}
QUANTITIES: Mapping[Kind, Mapping[str, Mapping[str, Dimension]]] = {
    "point": SENSOR,
    "instrument": SENSOR,
    "flywheel": FLYWHEEL,
    "mount": {},
    "hold": {"reaction": WRENCH},
}
"""Quantities of a kind, their components ("" for a scalar), and the dimension of each."""

WITHOUT_UNIT = {"", "1", "count", "counts", "-"}
GRAVITIES = {"g": Fraction("9.80665"), "mg": Fraction("0.00980665"), "m/s/s": Fraction(1)}
"""Units of accelerometers that are masses elsewhere."""

_HEADER = re.compile(r"\s*([^\[\]]*?)\s*(?:\[\s*([^\[\]]*?)\s*\])?\s*")
_PART_OF_TURN = re.compile(r"1\s*/\s*(\d{1,9})\s*(?:turn|rev|revolution)s?")


def si_unit(channel: Channel) -> str:
    """The SI unit of a channel's values, as pages write it: "m/s2"; "" of a count."""
    of_kind = QUANTITIES["flywheel" if channel.kind == "mount" else channel.kind]
    return of_kind[channel.quantity][channel.component].si.replace("^", "")


class HeaderError(ValueError):
    """A header that is no channel of the stand; the text says what was found and what was expected."""


@dataclass(frozen=True)
class Name:
    """A channel of a stand as its header names it.

    scale   SI units of one unit of the file; of a count without a unit of its own 1
    counts  counts per turn that the unit states (`[1/4096 turn]`), None without
    """

    kind: Kind
    name: str
    quantity: str
    component: str
    unit: str
    scale: float = 1.0
    counts: int | None = None

    @property
    def label(self) -> str:
        """Name without unit."""
        return ".".join(filter(None, (self.name, self.quantity, self.component)))


def split_header(header: str) -> tuple[str, str]:
    """Name and unit of a header; the unit is "" without brackets. Raises HeaderError."""
    found = _HEADER.fullmatch(header)
    if found is None or not found[1]:
        raise HeaderError(f'"{header[:60]}": expected a name and a unit, such as "acc1.rate.x [rad/s]"')
    return found[1], found[2] or ""


def is_time(header: str) -> bool:
    """Whether a header is that of the time."""
    try:
        return split_header(header)[0].lower() in ("time", "t")
    except HeaderError:
        return False


def time_scale(header: str) -> float:
    """Seconds of one unit of the column of time. Raises HeaderError."""
    name, unit = split_header(header)
    return float(_factor(unit, TIME, name)) if unit else 1.0


def name_of(header: str, stand: Stand) -> Name:
    """The channel of the stand that a header names. Raises HeaderError."""
    text, unit = split_header(header)
    bearer, _, rest = text.partition(".")
    kind = _kind_of(bearer, text, stand)
    quantity, _, component = rest.partition(".")
    known = QUANTITIES[kind]
    if quantity not in known:
        raise HeaderError(f'"{text}": unknown quantity "{quantity}" of {bearer}{suggestion(quantity, known)}')
    components = known[quantity]
    if component not in components:
        expected = ", ".join(components) if "" not in components else "none"
        raise HeaderError(f'"{text}": unknown component "{component}", expected {expected}')
    dimension = components[component]
    if quantity == "count":
        turn = _PART_OF_TURN.fullmatch(unit)
        if turn is not None and int(turn[1]):
            return Name(kind, bearer, quantity, component, unit, counts=int(turn[1]))
    if dimension == PLAIN:
        if unit not in WITHOUT_UNIT and not (quantity == "tacho" and unit == "V"):
            raise HeaderError(f'"{text}": unit "{unit}" does not fit, expected [1] or, of a count, [1/4096 turn]')
        return Name(kind, bearer, quantity, component, unit)
    if not unit:
        raise HeaderError(f'"{text}" has no unit, expected {dimension.words}, such as [{dimension.si}]')
    scale = float(_factor(unit, dimension, text))
    return Name("mount" if quantity == "mount" else kind, bearer, quantity, component, unit, scale)


def _kind_of(bearer: str, text: str, stand: Stand) -> Kind:
    """What bears a channel. Raises HeaderError."""
    by_name: dict[str, Kind] = {point.name: "point" for point in stand.points}
    by_name |= {instrument.name: "instrument" for instrument in stand.instruments}
    by_name |= {flywheel.name: "flywheel" for flywheel in stand.flywheels}
    if bearer == "hold" and bearer not in by_name:
        if stand.hold is None:
            raise HeaderError(f'"{text}": the carrier is free, expected a stand with [hold]; leave this channel out')
        return "hold"
    if bearer == "carrier":
        raise HeaderError(f'"{text}": the carrier has no sensor; name a [[point]] of the stand at its place')
    if bearer not in by_name:
        raise HeaderError(
            f'"{text}": the stand has no point, instrument or flywheel "{bearer}"{suggestion(bearer, by_name)}'
        )
    kind = by_name[bearer]
    assert kind in get_args(Kind)
    return kind


def _factor(unit: str, dimension: Dimension, text: str) -> Fraction:
    if dimension == ACCELERATION and unit in GRAVITIES:
        return GRAVITIES[unit]
    try:
        return factor(unit, dimension)
    except QuantityError as error:
        raise HeaderError(f'"{text}": {error}') from None
