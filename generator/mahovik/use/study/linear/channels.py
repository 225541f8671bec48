"""Channels of a linear model: names and units of its states, inputs and outputs."""

from __future__ import annotations

from typing import NamedTuple

from mahovik.core.stand.model import Stand


class Channel(NamedTuple):
    """One state, input or output: a name (a space only before a flywheel or point), and an SI unit."""

    name: str
    unit: str

    def __str__(self) -> str:
        return f"{self.name} [{self.unit}]"


AXES = ("x", "y", "z")


def triple(prefix: str, unit: str, suffix: str = "") -> list[Channel]:
    """Three channels along the axes."""
    return [Channel(f"{prefix}{axis}{suffix}", unit) for axis in AXES]


def states(stand: Stand, locked: bool) -> tuple[Channel, ...]:
    """Pose (6), V (6), then phi (N) and phi' (N) of flywheels that are not locked."""
    carrier = [*triple("", "m"), *triple("r", "rad"), *triple("v_", "m/s"), *triple("omega_", "rad/s")]
    if locked:
        return tuple(carrier)
    names = [s.name for s in stand.flywheels]
    angles = [Channel(f"phi {name}", "rad") for name in names]
    return (*carrier, *angles, *(Channel(f"phi_dot {name}", "rad/s") for name in names))


def inputs(stand: Stand, locked: bool) -> tuple[Channel, ...]:
    """Drive torques (N) of flywheels that are not locked, then the wrench on the carrier (6)."""
    drives = [] if locked else [Channel(f"tau {s.name}", "N m") for s in stand.flywheels]
    wrench = [Channel(f"wrench {letter}", "N" if letter in "XYZ" else "N m") for letter in "XYZKMN"]
    return (*drives, *wrench)


def outputs(points: tuple[str, ...]) -> tuple[Channel, ...]:
    """Displacement, velocity, acceleration (3 each) of every point."""
    found: list[Channel] = []
    for name in points:
        for prefix, unit in (("d", "m"), ("v", "m/s"), ("a", "m/s2")):
            found += triple(f"{prefix}_", unit, f" {name}")
    return tuple(found)
