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

EXACT = 1e-11
"""A fit that leaves less of an error than this part, or than its rounding, is the error itself."""

KNOWN = 1e-7
"""Part of the values of right equations that their products may leave, for the factors to be known."""

PART = 0.01
"""An exact fit leaves at most this part of an error, however large rounding may be."""

SINGULAR = 1e-11
"""Columns whose singular values fall below this part of the largest have no single answer."""

INDEPENDENT = 1e-6
"""Part of a column that others do not explain, from which on it is one of its own."""

SMALL = 400
"""Columns up to which the answer with the least sum of magnitudes is looked for."""


@dataclass(frozen=True)
class Fit:
    """Few columns that explain an error.

    coefficients  by column
    left          root mean square of what they leave, over that of the error
    exact         whether they leave nothing beyond rounding
    """

    coefficients: dict[int, float]
    left: float
    exact: bool = False


class Columns:
    """Columns (n, m) that errors are explained by.

    later  columns (m) that may depend on the others: they take part only where the others alone are not sparse
    """

    def __init__(self, columns: Array, later: NDArray[np.bool_]) -> None:
        self._size: Array = np.linalg.norm(columns, axis=0)
        there = self._size > 0.0
        self._scaled: Array = np.where(there, columns / np.where(there, self._size, 1.0), 0.0)
        self._sets: tuple[_Set, ...] = tuple(
            _Set(self._scaled, np.flatnonzero(each)) for each in (there & ~later, there)
        )

    @property
    def count(self) -> int:
        """How many there are."""
        return len(self._size)

    def widen(self, more: Array) -> tuple[Columns, list[int]]:
        """These columns and, behind them, those of `more` that they do not explain; and the indices of these."""
        found = Columns.__new__(Columns)
        spanned = self._sets[0].span
        kept: list[int] = []
        sizes = np.linalg.norm(more, axis=0)
        for i, size in enumerate(sizes.tolist()):
            if size <= 0.0:
                continue
            rest = more[:, i] / size
            for _ in range(2):
                rest = rest - spanned @ (spanned.T @ rest)
            length = float(np.linalg.norm(rest))
            if length > INDEPENDENT:
                spanned = np.column_stack([spanned, rest / length])
                kept.append(i)
        m = len(self._size)
        found._size = np.concatenate([self._size, sizes[kept]])
        found._scaled = np.column_stack([self._scaled, more[:, kept] / sizes[kept]])
        added = np.arange(m, m + len(kept))
        found._sets = tuple(_Set(found._scaled, np.concatenate([each.places, added])) for each in self._sets)
        return found, kept

    def fit(self, error: Array, rounding: float) -> Fit:
        """Few columns whose combination is the error (n); `rounding`: root mean square of that of a right program."""
        whole = float(np.linalg.norm(error))
        limit = max(EXACT * whole, rounding * np.sqrt(len(error)))
        best = Fit({}, 1.0)
        exact: list[Fit] = []
        for each in self._sets:
            for kept in (each.all_at_once(error, limit), each.one_by_one(error, limit), each.least_sum(error, limit)):
                if not kept.size or kept.size > MOST:
                    continue
                found = self.refit(kept.tolist(), error, rounding)
                best = min(best, found, key=lambda fit: fit.left)
                if found.exact:
                    exact.append(found)
        return min(exact, key=lambda fit: len(fit.coefficients), default=best)

    def twins(self, fit: Fit, error: Array, rounding: float) -> dict[int, list[int]]:
        """Columns of an exact fit, each with others that explain the error as well in its place.

        States of one's own choice have none; rows of a log may. Each has all others where there are `too_few`.
        """
        kept = list(fit.coefficients)
        limit = max(EXACT * float(np.linalg.norm(error)), rounding * np.sqrt(len(error)))
        places = self._set_of(kept).places
        if self.too_few(fit):
            return {k: [int(i) for i in places if i not in kept] for k in kept}
        found = {k: self._in_place_of(k, kept, places, error, limit) for k in kept}
        return {k: others for k, others in found.items() if others}

    def too_few(self, fit: Fit) -> bool:
        """Whether so few columns are independent that any other of this number may explain the error as well."""
        of = self._set_of(list(fit.coefficients))
        return of.rank < min(2 * len(fit.coefficients), len(of.places))

    def refit(self, kept: list[int], error: Array, rounding: float) -> Fit:
        """The fit of an error by these columns."""
        whole = float(np.linalg.norm(error))
        limit = max(EXACT * whole, rounding * np.sqrt(len(error)))
        c, left = _refit(self._scaled, np.array(kept), error)
        by_column = dict(zip(kept, (c / self._size[kept]).tolist(), strict=True))
        return Fit(by_column, left / whole, left <= min(limit, PART * whole))

    def _set_of(self, kept: list[int]) -> _Set:
        """The smallest set that has these columns."""
        return next(each for each in self._sets if np.isin(kept, each.places).all())

    def _in_place_of(self, k: int, kept: list[int], places: Places, error: Array, limit: float) -> list[int]:
        """Columns that explain the error with the others of `kept`, without column k."""
        base, _ = np.linalg.qr(self._scaled[:, [i for i in kept if i != k]])
        rest = error - base @ (base.T @ error)
        columns = self._scaled[:, places] - base @ (base.T @ self._scaled[:, places])
        sizes = np.linalg.norm(columns, axis=0)
        with np.errstate(all="ignore"):
            factors = (columns.T @ rest) / sizes**2
        left = np.linalg.norm(rest[:, None] - columns * np.nan_to_num(factors), axis=0)
        return [int(i) for i in places[(left <= limit) & (sizes > SINGULAR)] if i not in kept]

    def least_squares(self, values: Array, with_later: bool) -> Array | None:
        """Coefficients (m, k) of values (n, k); None where the columns, with the later ones or not, leave something."""
        of = self._sets[int(with_later)]
        c = of.solve(values)
        if c is None or np.linalg.norm(values - of.columns @ c) > KNOWN * np.linalg.norm(values):
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

    @property
    def span(self) -> Array:
        """Orthonormal columns that span them."""
        left, _, _, rank = self._svd
        return left[:, :rank]

    @property
    def rank(self) -> int:
        """Number of independent columns."""
        return self._svd[3]

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
