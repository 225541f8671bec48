"""Faults in the stops of freedoms, as they occur in programs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.laws.stop.data import Stop, stops_of
from mahovik.laws.stop.reference import wrench
from mahovik.proof.diagnose.fault import LawFault
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.pose import Pose


def _of_data(change: Callable[[Stop], Stop], factor: float = 1.0) -> Callable[[Stand, State, Pose], Array]:
    """The push of all stops with some numbers replaced, times a factor."""

    def total(stand: Stand, state: State, at: Pose) -> Array:
        found = np.zeros(6)
        for stop in stops_of(stand):
            assert stand.hold is not None
            found += factor * wrench(change(stop), stand.hold, stand.angles, at)
        return found

    return total


FAULTS = (
    LawFault("stops missing", "The stops are missing.", "`stop` of `hold`", _of_data(lambda each: each, 0.0)),
    LawFault("stops, sign", "The stops pull into the stop.", "a stop pushes back", _of_data(lambda each: each, -1.0)),
    LawFault("stops, side", "The stops push on the wrong side.", "`side` of the stop",
             _of_data(lambda each: replace(each, above=not each.above))),
    LawFault("stop damping missing", "The damping of the stops is missing.", "depth (stiffness + damping speed)",
             _of_data(lambda each: replace(each, damping=0.0))),
)  # fmt: skip
