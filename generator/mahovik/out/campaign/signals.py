"""Signals in time that quantities are made of: their names, units and components, and what of a stand has them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from mahovik.core.lower import law_arrays
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import structure
from mahovik.core.stand.units import (
    ACCELERATION,
    ANGLE,
    LENGTH,
    PLAIN,
    SPEED,
    TORQUE,
    VELOCITY,
    Dimension,
)
from mahovik.errors import UsageError
from mahovik.nearest import suggestion

AXES = ("x", "y", "z")

Place = Literal["point", "part", "flywheel", "stand"]

FORCE, POWER = Dimension("a force", "N"), Dimension("a power", "W")


@dataclass(frozen=True)
class Kind:
    """A signal.

    place      what it belongs to: a point (`at`); a part that carries load or a flywheel (`of`); the whole stand
    dimension  of its numbers
    vector     three components, on x, y, z; otherwise one number
    needs      results of the C that it is made of
    meaning    one line
    """

    place: Place
    dimension: Dimension
    vector: bool
    needs: frozenset[str]
    meaning: str

    @property
    def unit(self) -> str:
        """SI unit, as columns have it."""
        return self.dimension.si.replace("^", "")


def _kind(place: Place, dimension: Dimension, vector: bool, needs: str, meaning: str) -> Kind:
    return Kind(place, dimension, vector, frozenset(needs.split()), meaning)


SIGNALS: Mapping[str, Kind] = {
    "acceleration": _kind("point", ACCELERATION, True, "V_dot points", "of the point, in E0"),
    "velocity": _kind("point", VELOCITY, True, "points", "of the point, in E0"),
    "displacement": _kind("point", LENGTH, True, "points", "of the point, from its place at the start"),
    "rotation": _kind("point", ANGLE, True, "points", "rotation vector of the carrier, from its attitude at the start"),
    "rate": _kind("point", SPEED, True, "points", "angular velocity of the carrier"),
    "specific_force": _kind("point", ACCELERATION, True, "V_dot readings", "what an accelerometer at the point reads"),
    "force": _kind("part", FORCE, True, "V_dot loads", "that the part transmits to the carrier or the flywheel"),
    "moment": _kind("part", TORQUE, True, "V_dot loads", "that the part transmits, about its point"),
    "torque": _kind("flywheel", TORQUE, False, "V_dot tau", "whole drive torque"),
    "power": _kind("flywheel", POWER, False, "V_dot tau speeds", "drive torque times speed"),
    "speed": _kind("flywheel", SPEED, False, "speeds", "of the flywheel relative to its mount"),
    "sigma": _kind("stand", Dimension("a coupling", ""), False, "I", "smallest singular value of I of (8), in SI"),
    "error": _kind("stand", PLAIN, False, "", "of the carrier that follows a programme"),
}

HOLD = "hold"
"""What holds a carrier, as a part that transmits force: its reaction, in E1 about O1."""

EVERY = "all"
"""In place of a flywheel's name: the largest magnitude of all flywheels at each moment."""


def parts(stand: Stand) -> tuple[str, ...]:
    """What carries load: ties of the carrier to E0 by the names of their laws, the hold, mounts by their flywheels."""
    held = (HOLD,) if stand.hold is not None else ()
    return (*ties(stand), *held, *(s.name for s in stand.flywheels if s.name not in held))


def ties(stand: Stand) -> tuple[str, ...]:
    """What ties the carrier to E0."""
    return tuple(law_arrays.ties(structure(stand)))


def points(stand: Stand) -> tuple[str, ...]:
    """Names of places on the carrier: instruments, points, and the carrier itself, which stands for O1."""
    return (*sensors(stand), stand.carrier.name)


def sensors(stand: Stand) -> tuple[str, ...]:
    """Names of what `points` reads, in order: instruments, then points."""
    return (*(p.name for p in stand.instruments), *(p.name for p in stand.points))


def find_part(stand: Stand, kind: Kind, at: str | None, of: str | None) -> str:
    """The name that a signal belongs to; "" for the whole stand. Raises UsageError, which begins with the key."""
    key, given = ("at", at) if kind.place == "point" else ("of", of)
    if kind.place == "stand":
        if at is not None or of is not None:
            raise UsageError(f"{'at' if at is not None else 'of'}: not allowed, the signal is of the whole stand")
        return ""
    if (other := of if key == "at" else at) is not None:
        raise UsageError(f'{"of" if key == "at" else "at"}: not allowed, expected `{key}`, found "{other}"')
    known = {"point": points, "part": parts, "flywheel": _flywheels}[kind.place](stand)
    none = {"point": "the stand has none", "part": "the stand has none that carries load"}.get(
        kind.place, "the stand has no flywheels"
    )
    if given is None:
        what = ", ".join(known) if known else none
        raise UsageError(f"{key}: required, but missing; expected one of {what}")
    if given == HOLD and kind.place == "part" and HOLD not in known:
        raise UsageError(f'{key}: "{HOLD}" is what holds a held carrier, and the stand has no [hold]')
    if given not in known:
        raise UsageError(f'{key}: unknown "{given}"{suggestion(given, known, none)}')
    return given


def _flywheels(stand: Stand) -> tuple[str, ...]:
    names = tuple(s.name for s in stand.flywheels)
    return (*names, EVERY) if names else ()
