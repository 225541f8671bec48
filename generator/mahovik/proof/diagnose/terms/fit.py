"""Sparse least squares: the few columns that explain an error."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import svd
from scipy.optimize import linprog

from mahovik.proof.reference.array import Array

Places = NDArray[np.int64]
"""Indices of columns."""

MOST = 24
"""Terms at most: an error of more is none of a few wrong terms."""

PICKS = 12
"""Terms that are looked for one after another, where least squares over all has no single answer."""

EXACT = 1e-7
"""A fit that leaves less of an error than this part, or than its rounding, is the error itself."""

SINGULAR = 1e-11
"""Columns whose singular values fall below this part of the largest have no single answer."""

SMALL = 400
"""Columns up to which the answer with the least sum of magnitudes is looked for."""


@dataclass(frozen=True)
class Fit:
    """Coefficients by column; `left`: root mean square of what they leave, over that of the error."""

    coefficients: dict[int, float]
    left: float


class Columns:
    """Columns (n, m) that errors are explained by.

    later  columns (m) that may depend on the others: they take part only where the others alone are not sparse
    """

    def __init__(self, columns: Array, later: NDArray[np.bool_]) -> None:
        self._size = np.linalg.norm(columns, axis=0)
        there = self._size > 0.0
        self._scaled = np.where(there, columns / np.where(there, self._size, 1.0), 0.0)
        self._sets = tuple(_Set(self._scaled, np.flatnonzero(each)) for each in (there & ~later, there))

    def fit(self, error: Array, rounding: float) -> Fit:
        """Few columns whose combination is the error (n); `rounding`: root mean square of that of a right program."""
        whole = float(np.linalg.norm(error))
        limit = max(EXACT * whole, rounding * np.sqrt(len(error)))
        best = Fit({}, 1.0)
        exact: list[Fit] = []
        for each in self._sets:
            for way in (each.all_at_once, each.one_by_one, each.least_sum):
                kept = way(error, limit)
                if not kept.size or kept.size > MOST:
                    continue
                c, left = _refit(self._scaled, kept, error)
                found = Fit(dict(zip(kept.tolist(), (c / self._size[kept]).tolist(), strict=True)), left / whole)
                best = min(best, found, key=lambda fit: fit.left)
                if left <= limit:
                    exact.append(found)
        return min(exact, key=lambda fit: len(fit.coefficients), default=best)

    def least_squares(self, values: Array, which: int = 0) -> Array | None:
        """Coefficients (m, k) of values (n, k) over the first columns, or with 1 all; None: they leave something."""
        of = self._sets[which]
        c = of.solve(values)
        if c is None or np.linalg.norm(values - of.columns @ c) > EXACT * np.linalg.norm(values):
            return None
        found = np.zeros((self._size.size, values.shape[1]))
        found[of.places] = c / self._size[of.places, None]
        return found


class _Set:
    """Some of the columns, at `places`, of unit length."""

    def __init__(self, scaled: Array, places: Places) -> None:
        self.places, self.columns = places, scaled[:, places]

    @cached_property
    def _svd(self) -> tuple[Array, Array, Array, int]:
        left, singular, right = svd(self.columns, full_matrices=False, check_finite=False)
        return left, singular, right, int((singular > SINGULAR * singular[:1]).sum())

    def solve(self, values: Array) -> Array | None:
        """Least squares; None where it has no single answer."""
        left, singular, right, rank = self._svd
        if rank < len(self.places):
            return None
        turned = left.T @ values
        found: Array = right.T @ (turned / (singular if values.ndim == 1 else singular[:, None]))
        return found

    def all_at_once(self, error: Array, limit: float) -> Places:
        """Columns that least squares over all of them gives more than rounding; none where it has no single answer."""
        c = self.solve(error)
        if c is None or np.linalg.norm(error - self.columns @ c) > limit:
            return _NONE
        found: Places = self.places[np.abs(c) > limit / self._svd[1][-1]]
        return found

    def one_by_one(self, error: Array, limit: float) -> Places:
        """The column most like what is left, again and again; columns that later ones make needless are dropped."""
        kept: list[int] = []
        rest, c = error, np.zeros(0)
        while len(kept) < PICKS and np.linalg.norm(rest) > limit:
            likeness = np.abs(self.columns.T @ rest)
            likeness[kept] = 0.0
            kept.append(int(likeness.argmax()))
            c, _ = _refit(self.columns, np.array(kept), error)
            rest = error - self.columns[:, kept] @ c
        return np.sort(self.places[np.array(kept, dtype=np.int64)[np.abs(c) > 10 * limit]])

    def least_sum(self, error: Array, limit: float) -> Places:
        """Columns of the answer with the least sum of magnitudes, which is sparse; for few columns."""
        m = len(self.places)
        if m > SMALL:
            return _NONE
        left, singular, right, rank = self._svd
        equal, wanted = right[:rank], (left.T @ error)[:rank] / singular[:rank]
        unit = float(np.abs(wanted).max(initial=0.0))
        if unit == 0.0 or np.linalg.norm(error - self.columns @ (equal.T @ wanted)) > limit:
            return _NONE
        found = linprog(np.ones(2 * m), A_eq=np.hstack([equal, -equal]), b_eq=wanted / unit, method="highs")
        if found.x is None:
            return _NONE
        c = unit * (found.x[:m] - found.x[m:])
        used: Places = self.places[np.abs(c) > 1e-6 * np.abs(c).max()]
        return used


_NONE: Places = np.zeros(0, dtype=np.int64)


def _refit(scaled: Array, kept: Places, error: Array) -> tuple[Array, float]:
    c: Array = np.asarray(np.linalg.lstsq(scaled[:, kept], error, rcond=None)[0], dtype=np.float64)
    return c, float(np.linalg.norm(error - scaled[:, kept] @ c))
