"""Values of the numbers that vary, from a sample's place in the unit cube of all factors."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtr, ndtri

from mahovik.core.stand.numbers import StandNumber
from mahovik.out.campaign.distributions import Distribution

Array = NDArray[np.float64]

_LEAST, _MOST = 2.0**-54, 1.0 - 2.0**-53
"""Probabilities are kept within these, so that no sample of an unbounded distribution is infinite."""


@dataclass(frozen=True)
class Parameter:
    """One number that varies. `factor`: whose random number decides it; None where its distribution has one value."""

    place: StandNumber
    distribution: Distribution
    factor: str | None


@dataclass(frozen=True)
class Copula:
    """Gaussian copula: normal scores of some factors (columns of the cube) with a Cholesky factor, row by row."""

    columns: tuple[int, ...]
    lower: tuple[tuple[float, ...], ...]

    def correlate(self, unit: Array) -> Array:
        """The cube with these columns correlated. Sums are in a fixed order: the same bits for any number of rows."""
        found = unit.copy()
        scores = [ndtri(np.clip(unit[:, k], _LEAST, _MOST)) for k in self.columns]
        for i, k in enumerate(self.columns):
            mixed: Any = 0.0
            for weight, score in zip(self.lower[i], scores, strict=False):
                mixed = mixed + weight * score
            found[:, k] = ndtr(mixed)
        return found


@dataclass(frozen=True)
class Draw:
    """All numbers that vary, and the factors that decide them."""

    parameters: tuple[Parameter, ...]
    factors: tuple[str, ...]
    copula: Copula | None

    def values(self, unit: Array) -> dict[str, Array]:
        """Values by path, SI, of samples in the unit cube (n, factors), which is 0 < u < 1 here."""
        if self.copula is not None:
            unit = self.copula.correlate(unit)
        return self.at(np.clip(unit, _LEAST, _MOST))

    def at(self, unit: Array) -> dict[str, Array]:
        """Values by path at given quantiles (n, factors) in 0..1; infinite at the ends of what is unbounded."""
        columns = {name: np.ascontiguousarray(unit[:, k]) for k, name in enumerate(self.factors)}
        nothing = np.full(len(unit), 0.5)
        return {
            each.place.path: each.distribution.quantile(nothing if each.factor is None else columns[each.factor])
            for each in self.parameters
        }


def cholesky(matrix: Sequence[Sequence[float]]) -> tuple[tuple[float, ...], ...] | None:
    """Lower triangle L with L L^T = matrix, row by row; None where the matrix is not positive definite."""
    rows: list[tuple[float, ...]] = []
    for i, given in enumerate(matrix):
        row: list[float] = []
        for j in range(i):
            rest = given[j] - math.fsum(row[k] * rows[j][k] for k in range(j))
            row.append(rest / rows[j][j])
        square = given[i] - math.fsum(x * x for x in row)
        if square <= 1e-12:
            return None
        rows.append((*row, math.sqrt(square)))
    return tuple(rows)
