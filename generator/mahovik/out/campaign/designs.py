"""Designs: where the samples of a campaign are in the unit cube of all factors, and what a design tells of them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from hashlib import blake2b
from typing import Any

import numpy as np
from numpy.random import Generator, Philox
from numpy.typing import NDArray
from scipy.stats import qmc, sobol_indices

Array = NDArray[np.float64]

DESIGNS = ("random", "latin", "sobol", "morris", "saltelli")
IN_BLOCKS = ("morris", "saltelli")
"""Designs whose samples change one factor after the other."""

LEVELS = 4
"""Levels of a factor in Morris' design."""

MOST_HELD = 100_000_000
"""Numbers of a Latin hypercube or of Morris' design, at most: every process makes them whole."""

_PER_COUNT = 4
"""Numbers of 64 bits that Philox makes of one count."""


@dataclass(frozen=True)
class Design:
    """Samples in the unit cube of the factors; any range can be asked for, in any process, with the same bits.

    wanted  samples; those of designs in blocks are rounded up to whole blocks
    """

    kind: str
    factors: tuple[str, ...]
    wanted: int
    seed: int

    @property
    def block(self) -> int:
        """Samples that belong together: a trajectory of Morris, or a pair of points that exchange their factors."""
        return {"morris": len(self.factors) + 1, "saltelli": len(self.factors) + 2}.get(self.kind, 1)

    @property
    def samples(self) -> int:
        """Number of samples."""
        return -(-self.wanted // self.block) * self.block

    def unit(self, first: int, count: int) -> Array:
        """Samples from `first` on (count, factors), in 0..1."""
        d = len(self.factors)
        if not d or not count:
            return np.zeros((count, d))
        if self.kind == "random":
            return np.column_stack([self._uniform(name, first, count) for name in self.factors])
        if self.kind == "latin":
            columns = [_latin_column(self.seed, name, self.samples) for name in self.factors]
            return np.column_stack([column[first : first + count] for column in columns])
        if self.kind == "sobol":
            return self._sequence(d, first, count)
        if self.kind == "morris":  # levels are the medians of equal parts: no sample is at an infinite end
            return (0.5 + self._morris_levels[first : first + count] * (LEVELS - 1)) / LEVELS
        pair, place = np.divmod(np.arange(first, first + count), self.block)
        points = self._sequence(2 * d, int(pair[0]), int(pair[-1] - pair[0]) + 1)[pair - pair[0]]
        from_b = (place[:, None] == np.arange(1, d + 1)) | (place == d + 1)[:, None]
        return np.asarray(np.where(from_b, points[:, d:], points[:, :d]))

    def _uniform(self, name: str, first: int, count: int) -> Array:
        """Independent numbers in 0 <= u < 1, by seed, name and sample: they stay when factors are added."""
        skip = first % _PER_COUNT
        stream = Generator(Philox(counter=first // _PER_COUNT, key=_key(self.seed, name)))
        return np.asarray(stream.random(skip + count)[skip:])

    def _sequence(self, dimensions: int, first: int, count: int) -> Array:
        """Points of a scrambled Sobol' sequence (count, dimensions)."""
        engine = qmc.Sobol(d=dimensions, scramble=True, seed=_generator(self.seed, "sobol"))
        if first:
            engine.fast_forward(first)
            return np.asarray(engine.random(count))
        return np.asarray(engine.random(1 << (count - 1).bit_length())[:count])  # SciPy warns of no power of 2

    @cached_property
    def _morris_levels(self) -> Array:
        """What SALib makes: (samples, factors), from 0, the lowest level, to 1."""
        from SALib.sample.morris import sample

        seed = _key(self.seed, "morris") % 2**31
        return np.asarray(sample(self._problem, self.samples // self.block, LEVELS, seed=seed))

    @property
    def _problem(self) -> dict[str, Any]:
        """The factors, as SALib takes them."""
        d = len(self.factors)
        return {"num_vars": d, "names": list(self.factors), "bounds": [[0.0, 1.0]] * d}

    def sensitivity(self, values: Array) -> tuple[Mapping[str, Array], int]:
        """What a quantity (n; of the first samples in order) depends on, by factor, and how many samples say so.

        Of `saltelli` Sobol' indices: `S1` alone, `ST` with all that a factor does together with others, shares of the
        variance; of `morris` `mu_star` and `sigma`, mean size and spread of the change between the lowest and the
        highest level. `+-` are halves of 95 % intervals. Blocks with a NaN are left out, and of pairs those beyond the
        largest power of two, which Sobol' sequences are balanced for. Empty where there are fewer than two blocks.
        """
        blocks = values[: len(values) // self.block * self.block].reshape(-1, self.block)
        good = ~np.isnan(blocks).any(axis=1)
        if self.kind not in IN_BLOCKS or good.sum() < 2:
            return {}, 0
        if self.kind == "morris":
            from SALib.analyze.morris import analyze

            levels = self._morris_levels[: blocks.size].reshape(*blocks.shape, -1)[good].reshape(-1, len(self.factors))
            result = analyze(self._problem, levels, blocks[good].ravel(), num_levels=LEVELS, seed=1)
            figures = {"mu_star": result["mu_star"], "mu_star +-": result["mu_star_conf"], "sigma": result["sigma"]}
            return {name: np.asarray(column, dtype=float) for name, column in figures.items()}, int(blocks[good].size)
        used = blocks[good][: 1 << (int(good.sum()).bit_length() - 1)].T
        first, total = _sobol_indices(used)
        random = np.random.default_rng(1)
        again = [_sobol_indices(used[:, random.integers(used.shape[1], size=used.shape[1])]) for _ in range(100)]
        S1, ST = 1.96 * np.std(again, axis=0)
        return {"S1": first, "S1 +-": S1, "ST": total, "ST +-": ST}, used.size


def _sobol_indices(values: Array) -> tuple[Array, Array]:
    """First and total indices (factors), of values at the first points, at each exchange, at the second points."""
    functions = {"f_A": values[:1], "f_B": values[-1:], "f_AB": values[1:-1, None]}
    indices = sobol_indices(func=functions, n=values.shape[1])
    return np.atleast_1d(indices.first_order), np.atleast_1d(indices.total_order)


def _key(seed: int, name: str) -> int:
    """Key of a stream of random numbers, 128 bits."""
    return int.from_bytes(blake2b(f"{seed} {name}".encode(), digest_size=16).digest(), "little")


def _generator(seed: int, name: str) -> Generator:
    return Generator(Philox(_key(seed, name)))


@lru_cache(maxsize=32)
def _latin_column(seed: int, name: str, samples: int) -> Array:
    """One factor of all samples of a Latin hypercube."""
    return np.asarray(qmc.LatinHypercube(d=1, seed=_generator(seed, f"latin {name}")).random(samples)[:, 0])
