"""A recording: channels with one time base, in SI, and notes on what was found and corrected."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

Kind = Literal["point", "instrument", "mount", "flywheel", "hold"]

GAP = 1.5
"""A step of time of more than this many usual ones is a gap."""


@dataclass(frozen=True, eq=False)
class Channel:
    """One measured quantity.

    kind       what bears it: a point, an instrument, the mount of a flywheel, a flywheel, the hold
    name       of that in the stand file; of a mount the name of its flywheel
    quantity   "acceleration" (specific force) or "rate", in own axes; of a flywheel "phase", "speed", "torque"; of a
               mount "mount" (wrench on the flywheel about Os, axes of the flywheel at phase zero)
    component  "x", "y", "z"; of a wrench also "k", "m", "n"; "" for a scalar
    unit       as the file writes it, "" without one
    values     (T,) in SI; NaN where there is no sample
    source     quantity of the file it was computed from, if another: "count" or "tacho" of a phase; "" else
    """

    kind: Kind
    name: str
    quantity: str
    component: str
    unit: str
    values: Array
    source: str = ""

    @property
    def label(self) -> str:
        """Name in a header, without unit: `acc1.acceleration.x`."""
        return ".".join(filter(None, (self.name, self.quantity, self.component)))


@dataclass(frozen=True, eq=False)
class Recording:
    """One run: channels with a common time base.

    t         (T,) s, rising strictly; steps may differ
    channels  in the order of the files
    source    name of the file, or of the files that were joined, with the number of the run where there are several
    notes     one line each: what was found, and what was corrected
    """

    t: Array
    channels: tuple[Channel, ...]
    source: str
    notes: tuple[str, ...] = ()

    def find(self, name: str, quantity: str, component: str = "") -> Channel | None:
        """The channel of this name, quantity and component; None if it is missing."""
        wanted = (name, quantity, component)
        return next((c for c in self.channels if (c.name, c.quantity, c.component) == wanted), None)

    @property
    def step(self) -> float:
        """Usual step of time in s (median)."""
        return float(np.median(np.diff(self.t))) if len(self.t) > 1 else 0.0

    @property
    def complete(self) -> NDArray[np.bool_]:
        """(T,) Whether every channel has a sample at this time."""
        found = np.ones(len(self.t), dtype=bool)
        for channel in self.channels:
            found &= np.isfinite(channel.values)
        return found

    def stretches(self) -> Iterator[slice]:
        """Stretches of samples without a gap in time between them."""
        ends = np.flatnonzero(np.diff(self.t) > GAP * self.step) + 1
        starts = [0, *ends.tolist()]
        yield from (slice(a, b) for a, b in zip(starts, [*starts[1:], len(self.t)], strict=True) if b > a)
