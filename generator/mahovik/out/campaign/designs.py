"""Designs: where the samples of a campaign are in the unit cube of all factors; any range can be asked for."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from mahovik.out.campaign.factors import generator, key_of, uniform

Array = NDArray[np.float64]

LEVELS = 4
"""Levels of a factor in Morris' design."""

MOST_HELD = 5_000_000
"""Samples of a Latin hypercube, and numbers of Morris' design, at most: every process makes them whole."""

_HELD = 8_000_000
"""Numbers of a Latin hypercube that are kept, 64 MB; other columns are made again when they are asked for."""


class Design(Protocol):
    """Samples in the unit cube."""

    @property
    def samples(self) -> int:
        """How many there are."""

    def unit(self, first: int, count: int) -> Array:
        """Samples from `first` on, (count, factors), in 0..1. They depend on nothing but their numbers."""


@dataclass(frozen=True)
class Random:
    """Monte Carlo: independent samples."""

    factors: tuple[str, ...]
    samples: int
    seed: int

    def unit(self, first: int, count: int) -> Array:
        columns = [uniform(self.seed, name, first, count) for name in self.factors]
        return np.column_stack(columns) if columns else np.zeros((count, 0))


@dataclass(frozen=True)
class Latin:
    """Latin hypercube: each of n equal intervals of every factor has one sample."""

    factors: tuple[str, ...]
    samples: int
    seed: int
    _kept: dict[str, Array] = field(default_factory=dict, compare=False, repr=False)

    def unit(self, first: int, count: int) -> Array:
        columns = [self._column(name)[first : first + count] for name in self.factors]
        return np.column_stack(columns) if columns else np.zeros((count, 0))

    def _column(self, name: str) -> Array:
        """One factor of all samples: by SciPy factor by factor, so that one fits in memory."""
        if name in self._kept:
            return self._kept[name]
        from scipy.stats import qmc

        found: Array = qmc.LatinHypercube(d=1, seed=generator(self.seed, f"latin {name}")).random(self.samples)[:, 0]
        if (len(self._kept) + 1) * self.samples <= _HELD:
            self._kept[name] = found
        return found


@dataclass(frozen=True)
class Sobol:
    """Scrambled Sobol' sequence, which fills the cube evenly however many samples are taken."""

    factors: tuple[str, ...]
    samples: int
    seed: int

    def unit(self, first: int, count: int) -> Array:
        return sequence(len(self.factors), self.seed, first, count)


@dataclass(frozen=True)
class InBlocks(ABC):
    """A design whose samples come in blocks that belong together; `wanted` is rounded up to whole blocks."""

    factors: tuple[str, ...]
    wanted: int
    seed: int

    @property
    @abstractmethod
    def block(self) -> int:
        """Samples of a block."""

    @property
    def samples(self) -> int:
        """Number of samples."""
        return -(-self.wanted // self.block) * self.block


@dataclass(frozen=True)
class Saltelli(InBlocks):
    """Pairs of points of a Sobol' sequence that exchange one factor after the other: for Sobol' indices.

    The order of the samples is that of SALib without second order: the first point, then it with each factor in
    turn of the second point, then the second point.
    """

    @property
    def block(self) -> int:
        """Samples of one pair of points."""
        return len(self.factors) + 2

    def unit(self, first: int, count: int) -> Array:
        d, block = len(self.factors), self.block
        pair, place = np.divmod(np.arange(first, first + count), block)
        if not count:
            return np.zeros((0, d))
        points = sequence(2 * d, self.seed, int(pair[0]), int(pair[-1] - pair[0]) + 1)[pair - pair[0]]
        a, b = points[:, :d], points[:, d:]
        from_b = (place[:, None] == np.arange(1, d + 1)) | (place == d + 1)[:, None]
        found: Array = np.where(from_b, b, a)
        return found


@dataclass(frozen=True)
class Morris(InBlocks):
    """Morris' trajectories: from a random point, one factor after the other jumps by half of its range.

    The levels are the medians of as many parts of equal probability, so that no sample is at the end of a
    distribution, which for a normal one is infinite.
    """

    @property
    def block(self) -> int:
        """Samples of one trajectory."""
        return len(self.factors) + 1

    @cached_property
    def levels(self) -> Array:
        """What SALib makes: (samples, factors), from 0, the lowest level, to 1."""
        from SALib.sample.morris import sample

        found: Array = sample(
            problem(self.factors), self.samples // self.block, LEVELS, seed=key_of(self.seed, "morris") % 2**31
        )
        return found

    def unit(self, first: int, count: int) -> Array:
        return (0.5 + self.levels[first : first + count] * (LEVELS - 1)) / LEVELS


DESIGNS: dict[str, Any] = {
    "random": Random, "latin": Latin, "sobol": Sobol, "morris": Morris, "saltelli": Saltelli,
}  # fmt: skip
"""Designs by their names in a campaign file."""


def problem(factors: tuple[str, ...]) -> dict[str, Any]:
    """Factors in the unit cube, as SALib takes them."""
    return {"num_vars": len(factors), "names": list(factors), "bounds": [[0.0, 1.0]] * len(factors)}


def sequence(dimensions: int, seed: int, first: int, count: int) -> Array:
    """Points of a scrambled Sobol' sequence, (count, dimensions)."""
    from scipy.stats import qmc

    if not dimensions or not count:
        return np.zeros((count, dimensions))
    engine = qmc.Sobol(d=dimensions, scramble=True, seed=generator(seed, "sobol"))
    if first:
        engine.fast_forward(first)
        found: Array = engine.random(count)
    else:  # SciPy warns of a first part that is no power of 2
        found = engine.random(1 << (count - 1).bit_length())[:count]
    return found
