"""Sparse least squares: the few columns that explain an error."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import svd

from mahovik.proof.reference.array import Array

Mask = NDArray[np.bool_]
"""True for the columns that a fit may use."""

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


@dataclass(frozen=True)
class Fit:
    """Few columns that explain an error.

    coefficients  by column
    left          root mean square of what they leave, over that of the error
    exact         whether they leave nothing beyond rounding
    twins         columns that explain the error as well in the place of one of these, by this one
    """

    coefficients: Mapping[int, float]
    left: float
    exact: bool = False
    twins: Mapping[int, list[int]] = field(default_factory=dict)


def least_squares(columns: Array, values: Array) -> Array:
    """Factors (m, c) of values (n, c) in columns (n, m); NaN where these leave something, or have no single answer."""
    size = np.linalg.norm(columns, axis=0)
    places = np.flatnonzero(size)
    c, _, rank, _ = np.linalg.lstsq(columns[:, places] / size[places], values, rcond=SINGULAR)
    factors = np.zeros((len(size), values.shape[1]))
    factors[places] = c / size[places, None]
    left = np.linalg.norm(values - columns @ factors, axis=0)
    known = (left <= KNOWN * np.linalg.norm(values, axis=0)) & (rank == len(places))
    return np.where(known, factors, np.nan)


class Columns:
    """Columns (n, m) that errors are explained by."""

    def __init__(self, columns: Array, later: Mask) -> None:
        """`later` (m): those that may depend on the others, and are looked at where the others are not sparse."""
        self._size = np.linalg.norm(columns, axis=0)
        self._scaled = np.divide(columns, self._size, out=np.zeros_like(columns), where=self._size > 0.0)
        self._later, self._sets = later, dict[bytes, _Set]()

    def independent(self, more: Array) -> list[int]:
        """Those of `more` (n, k) that these columns, and others of them, do not explain."""
        span, kept = self._set(~self._later).span, []
        for i, column in enumerate(more.T):
            rest = column / (np.linalg.norm(column) or 1.0)
            for _ in range(2):
                rest = rest - span @ (span.T @ rest)
            if (length := float(np.linalg.norm(rest))) > INDEPENDENT:
                span = np.column_stack([span, rest / length])
                kept.append(i)
        return kept

    def fit(self, error: Array, rounding: float, first: Mask) -> Fit:
        """Few columns whose combination is the error (n); of fits that do alike one of the columns `first` (m).

        `rounding`: root mean square of that of a right program.
        """
        whole = float(np.linalg.norm(error))
        limit = max(EXACT * whole, rounding * np.sqrt(len(error)))
        best, exact = Fit({}, 1.0), dict[int, tuple[Fit, _Set]]()
        for chosen in (first & ~self._later, first, ~self._later, np.full(first.shape, True)):
            columns = self._set(chosen)
            for kept in columns.candidates(error, limit):
                if 0 < kept.size <= MOST:
                    c, left = _solve(self._scaled[:, kept], error)
                    factors = dict(zip(kept.tolist(), (c / self._size[kept]).tolist(), strict=True))
                    fit = Fit(factors, left / whole, left <= min(limit, PART * whole))
                    best = min(best, fit, key=lambda fit: fit.left)
                    if fit.exact:
                        exact.setdefault(len(kept), (fit, columns))
        if not exact:
            return best
        fit, columns = exact[min(exact)]
        return Fit(fit.coefficients, fit.left, True, self._twins(fit, columns, error, limit))

    def _set(self, chosen: Mask) -> _Set:
        key = chosen.tobytes()
        if key not in self._sets:
            self._sets[key] = _Set(self._scaled, np.flatnonzero(chosen & (self._size > 0.0)))
        return self._sets[key]

    def _twins(self, fit: Fit, among: _Set, error: Array, limit: float) -> dict[int, list[int]]:
        """States of one's own choice have none; rows of a log may. Each has all others where few are independent."""
        kept = list(fit.coefficients)
        rest_of = [int(i) for i in among.places if i not in kept]
        if among.rank < min(2 * len(kept), len(among.places)):
            return dict.fromkeys(kept, rest_of)
        twins = {}
        for k in kept:
            base, _ = np.linalg.qr(self._scaled[:, [i for i in kept if i != k]])
            rest, columns = (x - base @ (base.T @ x) for x in (error, self._scaled[:, rest_of]))
            size = np.linalg.norm(columns, axis=0)
            factors = np.divide(columns.T @ rest, size**2, out=np.zeros_like(size), where=size > SINGULAR)
            left = np.linalg.norm(rest[:, None] - columns * factors, axis=0)
            if like := [rest_of[i] for i in np.flatnonzero((left <= limit) & (size > SINGULAR))]:
                twins[k] = like
        return twins


class _Set:
    """Some of the columns, at `places`, of unit length."""

    def __init__(self, scaled: Array, places: Places) -> None:
        self.places, self.columns = places, scaled[:, places]

    @cached_property
    def _svd(self) -> tuple[Array, Array, Array]:
        return svd(self.columns, full_matrices=False, check_finite=False) if self.places.size else (self.columns,) * 3

    @cached_property
    def rank(self) -> int:
        """Number of independent columns."""
        singular = self._svd[1].ravel()
        return int((singular > SINGULAR * singular[:1]).sum())

    @property
    def span(self) -> Array:
        """Orthonormal columns that span them."""
        return self._svd[0][:, : self.rank]

    def candidates(self, error: Array, limit: float) -> Iterator[Places]:
        """Few columns that may be the error: one after another, and least squares over all."""
        yield self.places[self._one_by_one(error, limit)]
        if self.places.size and self.rank == len(self.places):
            left, singular, right = self._svd
            yield self.places[np.abs(right.T @ (left.T @ error / singular)) > limit / singular[-1]]

    def _one_by_one(self, error: Array, limit: float) -> Places:
        """The column most like what is left, again and again; columns that later ones make needless are dropped."""
        kept, rest, c = list[int](), error, np.zeros(0)
        while len(kept) < min(PICKS, len(self.places)) and np.linalg.norm(rest) > limit:
            likeness = np.abs(self.columns.T @ rest)
            likeness[kept] = 0.0
            kept.append(int(likeness.argmax()))
            c, _ = _solve(self.columns[:, kept], error)
            rest = error - self.columns[:, kept] @ c
        return np.sort(np.array(kept, dtype=np.int64)[np.abs(c) > 10 * limit])


def _solve(columns: Array, error: Array) -> tuple[Array, float]:
    """Least squares, and the length of what it leaves."""
    c = np.asarray(np.linalg.lstsq(columns, error, rcond=None)[0])
    return c, float(np.linalg.norm(error - columns @ c))
