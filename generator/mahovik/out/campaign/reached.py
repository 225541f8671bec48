"""Accuracy that a campaign shall reach: looked at shard after shard, so that the end is the same for any workers."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from mahovik.out.campaign.manifest import Manifest
from mahovik.out.campaign.shards import Record, read_shard

Values = Mapping[str, NDArray[np.float64]]

GROWTH = 1.05
"""Each look is at this many times the shards of the look before, so that all looks take time in proportion to rows."""

Judge = Callable[[Values], tuple[bool, str]]
"""Whether the quantities of all samples so far are accurate enough, and how accurate they are in a few words."""


class Accuracy:
    """Quantities of the samples from the first on, as far as no shard is missing, and the judge of them."""

    def __init__(self, judge: Judge) -> None:
        self._judge = judge
        self._next = self._judged = 0
        self._parts: list[dict[str, NDArray[np.float64]]] = []
        self._words = ""
        self.samples = 0

    def is_reached(self, folder: Path, manifest: Manifest, records: Mapping[int, Record]) -> bool:
        """Whether the samples so far are enough; `samples` is then their number."""
        while self._next in records:
            table = read_shard(folder, manifest, self._next)
            self._parts.append({name: table.column(name).to_numpy() for name in manifest.quantities})
            self._next += 1
            self.samples += int(table.num_rows)
            if self._next < GROWTH * self._judged:
                continue
            self._judged = self._next
            values = {name: np.concatenate([part[name] for part in self._parts]) for name in manifest.quantities}
            reached, self._words = self._judge(values)
            if reached:
                return True
        return False

    def words(self) -> str:
        """How accurate the samples so far are."""
        return self._words
