"""A track: the channels of one table in one run while they are checked and corrected, with one base of time."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from mahovik.use.measured.quantities import FLYWHEEL, Name
from mahovik.use.measured.recording import Array


@dataclass(eq=False)
class Track:
    """Channels with one time base, as they stand at some step of the correction.

    t       (T,) s
    values  (T,) of each channel, in SI; counts and pulses as they are
    notes   what was found and corrected, one line each, without the name of the file
    """

    source: str
    t: Array
    values: dict[Name, Array]
    notes: list[str] = field(default_factory=list)

    @property
    def step(self) -> float:
        """Usual step of time in s."""
        return float(np.median(np.diff(self.t))) if len(self.t) > 1 else 0.0


def moves(name: Name) -> bool:
    """Whether a channel shows the motion or the drive of a flywheel: smooth, so that it can be interpolated."""
    return name.kind == "flywheel" and name.quantity in FLYWHEEL
