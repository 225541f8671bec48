"""Base parameters: the combinations of parameters that the rows of Y can tell apart, by rank-revealing QR.

The rank is that of QR with column pivoting of the columns, each scaled to length 1. The combinations are named after
the first columns that are independent, in the order of Y: other columns are sums of them, and each adds to those.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import qr

Array = NDArray[np.float64]

RANK = 1e-8
"""Part of the largest diagonal element of R below which a column is a sum of others: rounding of Y is 1e-15 of it."""

UNSEEN = 1e-12
"""Part of the largest number of Y, in each row, below which a whole column is zero."""

DROPPED = 1e-7
"""Relative size of a coefficient below which it is rounding."""


@dataclass(frozen=True, eq=False)
class Base:
    """Columns by their number: `independent`, of which the others are sums, and `unseen`, which are zero.

    coefficients  (independent, dependent): dependent column j is the sum of independent columns times these, so that
                  the independent parameter i is seen with coefficient (i, j) of the parameter j added
    """

    independent: tuple[int, ...]
    dependent: tuple[int, ...]
    unseen: tuple[int, ...]
    coefficients: Array


def base(Y: Array) -> Base:
    """Base parameters of rows Y (m, P), stacked over many states."""
    rows = np.abs(Y).max(axis=1, initial=0.0)
    Y = Y[rows > 0] / rows[rows > 0, None]  # forces and torques count alike
    largest = np.abs(Y).max(axis=0, initial=0.0)
    seen = np.flatnonzero(largest > UNSEEN)
    unseen = tuple(int(k) for k in np.flatnonzero(largest <= UNSEEN))
    if not len(seen):
        return Base((), (), unseen, np.zeros((0, 0)))
    lengths = np.linalg.norm(Y[:, seen], axis=0)
    scaled = Y[:, seen] / lengths
    R, order = qr(scaled, mode="r", pivoting=True)[:2]
    diagonal = np.abs(np.diag(R))
    rank = int(np.sum(diagonal > RANK * diagonal[0]))
    first = _first_independent(scaled, rank)
    chosen = first if len(first) == rank else sorted(int(k) for k in order[:rank])
    rest = [k for k in range(len(seen)) if k not in set(chosen)]
    found = np.linalg.lstsq(scaled[:, chosen], scaled[:, rest], rcond=None)[0]
    found[np.abs(found) < DROPPED] = 0.0
    found = found * (lengths[rest] / lengths[chosen][:, None])
    independent, dependent = (tuple(int(seen[k]) for k in part) for part in (chosen, rest))
    return Base(independent, dependent, unseen, np.asarray(found, dtype=np.float64))


def _first_independent(columns: Array, rank: int) -> list[int]:
    """The first columns that are no sum of those before them, at most `rank`: Gram-Schmidt, twice against rounding."""
    basis = np.zeros((len(columns), 0))
    found: list[int] = []
    for k in range(columns.shape[1]):
        rest = columns[:, k]
        for _ in range(2):
            rest = rest - basis @ (basis.T @ rest)
        size = float(np.linalg.norm(rest))
        if size > RANK and len(found) < rank:
            basis = np.column_stack([basis, rest / size])
            found.append(k)
    return found
