"""A recording: channels of one run with one time base, in SI, and notes on what was met and corrected."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import NDArray

Array = NDArray[np.float64]

GAP = 1.5
"""A step of time of more than this many usual ones is a gap."""


@dataclass(frozen=True, eq=False)
class Recording:
    """One run.

    frame    channels by label, such as `acc1.rate.x`, in SI; NaN where there is no sample. The index is the time, s,
             rising strictly. Specific forces and rates on the axes of their point; phases go on over whole turns
    source   name of the file, or of the files that were joined, with the number of the run where there are several
    notes    one line each: what was met, and what was corrected
    counted  flywheels whose phase was computed from counts of an encoder
    """

    frame: pd.DataFrame
    source: str
    notes: tuple[str, ...] = ()
    counted: frozenset[str] = frozenset()

    @property
    def t(self) -> Array:
        """(T,) s."""
        return np.asarray(self.frame.index, dtype=np.float64)

    @property
    def step(self) -> float:
        """Usual step of time (median), s."""
        return float(np.median(np.diff(self.t))) if len(self.frame) > 1 else 0.0

    def get(self, label: str) -> Array | None:
        """(T,) The values of a channel; None if it is missing."""
        return np.asarray(self.frame[label]) if label in self.frame else None

    @property
    def of_flywheels(self) -> bool:
        """Whether all channels are of flywheels: smooth, so that they can be interpolated."""
        return all(label.count(".") == 1 for label in self.frame)


def count(number: int, noun: str) -> str:
    """`1 gap`, `2 gaps`."""
    return f"{number} {noun}{'' if number == 1 else 's'}"
