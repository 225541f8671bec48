"""Accuracy that a campaign shall reach: looked at shard after shard, so that the end is the same for any workers."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from mahovik.out.campaign.convergence import Goal, Interval
from mahovik.out.campaign.manifest import Manifest
from mahovik.out.campaign.shards import Record, read_shard

GROWTH = 1.05
"""Each look is at this many times the shards of the look before, so that all looks take time in proportion to rows."""


class Accuracy:
    """The quantity of the goal in the samples from the first on, as far as no shard is missing."""

    def __init__(self, goal: Goal) -> None:
        self._goal = goal
        self._next = self._judged = 0
        self._parts: list[NDArray[np.float64]] = []
        self.samples = 0
        self.words = ""
        self.reached = False

    def is_reached(self, folder: Path, manifest: Manifest, records: Mapping[int, Record]) -> bool:
        """Whether the samples so far are enough; `samples` is then their number, `words` how well it is known."""
        while not self.reached and self._next in records:
            table = read_shard(folder, manifest, self._next)
            self._parts.append(table.column(self._goal.of).to_numpy())
            self._next += 1
            self.samples += int(table.num_rows)
            if self._next < GROWTH * self._judged:
                continue
            self._judged = self._next
            self._parts = [np.concatenate(self._parts)]
            self.words = words(self._goal, self._goal.interval(self._parts[0]))
            self.reached = self._goal.is_reached(self._parts[0])
        return self.reached


def words(goal: Goal, interval: Interval) -> str:
    """Quantile of a goal, and how well it is known."""
    near = f" ± {100.0 * interval.width:.2g} %" if np.isfinite(interval.width) else ", too few samples"
    return f"{100.0 * goal.p:g} % of {goal.of} below {interval.value:.4g}{near}"
