"""Channels that can be predicted: `acc1.acceleration.x`, `acc1.rate.z`, `hold.reaction.z` of a held carrier."""

from __future__ import annotations

from dataclasses import dataclass

from mahovik.core.stand.model import Stand
from mahovik.errors import UsageError
from mahovik.nearest import suggestion
from mahovik.out.campaign.signals import sensors

KINDS = {"acceleration": "m/s2", "rate": "rad/s"}
"""Quantities of a sensor, in its own axes, with the SI unit: specific force, angular velocity relative to E0."""

AXES = "xyz"

HOLD, REACTION = "hold", "reaction"
"""Bearer and kind of the channels of a force table: the wrench of the hold on the carrier, in E1 about O1."""

LETTERS = "xyzkmn"
"""Components of a wrench: forces in N, then moments in N m."""


@dataclass(frozen=True)
class Channel:
    """One axis of a sensor at a point or instrument, or one of the six components of the reaction of a hold."""

    point: str
    kind: str
    axis: int

    @property
    def name(self) -> str:
        """Name of its column in data."""
        return f"{self.point}.{self.kind}.{self.letter}"

    @property
    def letter(self) -> str:
        """Name of the axis or component."""
        return LETTERS[self.axis]

    @property
    def unit(self) -> str:
        """SI."""
        if self.kind == REACTION:
            return "N" if self.axis < 3 else "N m"
        return KINDS[self.kind]


def channel_of(name: str, stand: Stand) -> Channel:
    """The channel of a name. Raises UsageError: unknown sensor, kind or axis."""
    known = sensors(stand)
    point, _, rest = name.partition(".")
    kind, _, axis = rest.partition(".")
    if (point, kind) == (HOLD, REACTION) and stand.hold is not None and len(axis) == 1 and axis in LETTERS:
        return Channel(point, kind, LETTERS.index(axis))
    if point not in known:
        raise UsageError(f'{name}: {stand.name} has no point or instrument "{point}"{suggestion(point, known)}')
    if kind not in KINDS or len(axis) != 1 or axis not in AXES:
        raise UsageError(f"{name}: expected {point}.acceleration or {point}.rate with .x, .y or .z")
    return Channel(point, kind, AXES.index(axis))


def known_channels(stand: Stand) -> tuple[Channel, ...]:
    """All channels that a stand may have: of its sensors, and of the hold of a held carrier."""
    found = [channel for point in sensors(stand) for channel in six_axes(point)]
    if stand.hold is not None:
        found += [Channel(HOLD, REACTION, component) for component in range(len(LETTERS))]
    return tuple(found)


def six_axes(point: str) -> tuple[Channel, ...]:
    """All channels of an IMU at a point."""
    return tuple(Channel(point, kind, axis) for kind in KINDS for axis in range(3))
