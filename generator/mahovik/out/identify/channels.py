"""Channels of sensors that can be predicted: `acc1.acceleration.x`, `acc1.rate.z`."""

from __future__ import annotations

from dataclasses import dataclass

from mahovik.core.stand.model import Stand
from mahovik.errors import UsageError
from mahovik.nearest import suggestion
from mahovik.out.campaign.signals import sensors

KINDS = {"acceleration": "m/s2", "rate": "rad/s"}
"""Quantities of a sensor, in its own axes, with the SI unit: specific force, angular velocity relative to E0."""

AXES = "xyz"


@dataclass(frozen=True)
class Channel:
    """One axis of a sensor at a point or instrument."""

    point: str
    kind: str
    axis: int

    @property
    def name(self) -> str:
        """Name of its column in data."""
        return f"{self.point}.{self.kind}.{AXES[self.axis]}"

    @property
    def unit(self) -> str:
        """SI."""
        return KINDS[self.kind]


def channel_of(name: str, stand: Stand) -> Channel:
    """The channel of a name. Raises UsageError: unknown sensor, kind or axis."""
    known = sensors(stand)
    point, _, rest = name.partition(".")
    kind, _, axis = rest.partition(".")
    if point not in known:
        raise UsageError(f'{name}: {stand.name} has no point or instrument "{point}"{suggestion(point, known)}')
    if kind not in KINDS or len(axis) != 1 or axis not in AXES:
        raise UsageError(f"{name}: expected {point}.acceleration or {point}.rate with .x, .y or .z")
    return Channel(point, kind, AXES.index(axis))


def six_axes(point: str) -> tuple[Channel, ...]:
    """All channels of an IMU at a point."""
    return tuple(Channel(point, kind, axis) for kind in KINDS for axis in range(3))
