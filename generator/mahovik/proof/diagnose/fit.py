"""A sparse fit: which few of many columns explain an error, exactly or nearly, and which would do so in their place."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import qr, solve_triangular

from mahovik.proof.reference.algebra import Array

Mask = NDArray[np.bool_]
"""True for the columns that a fit may use."""

Places = NDArray[np.int64]
"""Indices of columns."""

MOST = 24
"""Terms at most: an error of more is none of a few wrong terms."""

PICKS = 12
"""Terms that are looked for one after another, where least squares over all has no single answer."""

EXACT, SHARE, KNOWN = 1e-11, 0.01, 1e-7
"""A fit that leaves less of an error than the first part, or than its rounding, is the error itself; it leaves at most
the second, however large rounding may be. Part of the values of right equations that their products may leave, for the
factors to be known."""

SINGULAR, INDEPENDENT = 1e-11, 1e-6
"""Columns of which others leave less than this part have no single answer; part of a column that others do not explain,
from which on it is one of its own."""


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


class _Set:
    """Some of the columns, at `places`, of unit length, as an orthogonal basis (n, r) times a triangle, by pivots.

    rank: how many are independent; span: their basis.
    """

    def __init__(self, scaled: Array, places: Places, base: _Set | None = None) -> None:
        """`base`: the first of them, whose basis is kept."""
        self.places, self.columns = places, scaled[:, places]
        first = 0 if base is None else len(base.places)
        span = np.zeros((len(scaled), 0)) if base is None else base.span
        rest = more = self.columns[:, first:]
        for _ in range(2):
            rest = rest - span @ (span.T @ rest)
        basis, triangle, order = qr(rest, mode="economic", pivoting=True, check_finite=False)
        beyond = np.abs(np.diagonal(triangle)) > SINGULAR
        self.span: Array = np.column_stack([span, basis[:, : beyond.sum()]])
        self.rank = self.span.shape[1]
        self._order: Places = np.append(np.zeros(0, int) if base is None else base._order, first + order)
        self._triangle: Array = triangle
        if base is not None and self.rank == len(places):
            above, left = span.T @ more[:, order], np.zeros((len(order), first))
            self._triangle = np.block([[base._triangle, above], [left, triangle]])

    def candidates(self, error: Array, limit: float) -> Iterator[Places]:
        """Few columns that may be the error: one after another, and least squares over all.

        Of the first kind is the column most like what is left, again and again; those that later ones make needless are
        dropped.
        """
        kept, rest, c = list[int](), error, np.zeros(0)
        while len(kept) < min(PICKS, len(self.places)) and np.linalg.norm(rest) > limit:
            likeness = np.abs(self.columns.T @ rest)
            likeness[kept] = 0.0
            kept.append(int(likeness.argmax()))
            c = np.asarray(np.linalg.lstsq(self.columns[:, kept], error, rcond=None)[0])
            rest = error - self.columns[:, kept] @ c
        yield self.places[np.sort(np.array(kept, dtype=np.int64)[np.abs(c) > 10 * limit])]
        if self.places.size and self.rank == len(self.places):
            inverse = solve_triangular(self._triangle, np.eye(self.rank), check_finite=False)
            is_there = np.abs(inverse @ (self.span.T @ error)) > limit * np.linalg.norm(inverse, axis=1)
            yield np.sort(self.places[self._order[is_there]])


class Columns:
    """Columns (n, m) that errors are explained by."""

    def __init__(self, columns: Array, later: Mask, base: Columns | None = None) -> None:
        """`later` (m): those that may depend on the others, and are looked at where the others are not sparse.

        `base`: the first of them.
        """
        self._size = np.linalg.norm(columns, axis=0)
        self._scaled = np.divide(columns, self._size, out=np.zeros_like(columns), where=self._size > 0.0)
        self._later, self._base, self._sets = later, base, dict[bytes, _Set]()

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
        span = self._set(np.full(first.shape, True)).span
        beyond = error - span @ (span.T @ error)
        if (left := float(np.linalg.norm(beyond))) > min(limit, SHARE * whole):
            return Fit({}, left / whole)  # all columns at once do not explain it
        best, exact = Fit({}, 1.0), dict[int, tuple[Fit, _Set]]()
        for chosen in (first & ~self._later, first, ~self._later, np.full(first.shape, True)):
            columns = self._set(chosen)
            for kept in columns.candidates(error, limit):
                if 0 < kept.size <= MOST:
                    c = np.linalg.lstsq(self._scaled[:, kept], error, rcond=None)[0]
                    left = float(np.linalg.norm(error - self._scaled[:, kept] @ c))
                    factors = dict(zip(kept.tolist(), (c / self._size[kept]).tolist(), strict=True))
                    fit = Fit(factors, left / whole, left <= min(limit, SHARE * whole))
                    best = min(best, fit, key=lambda fit: fit.left)
                    if fit.exact:
                        exact.setdefault(len(kept), (fit, columns))
        if not exact:
            return best
        fit, columns = exact[min(exact)]
        return replace(fit, twins=self._twins(fit, columns, error, limit))

    def _set(self, chosen: Mask) -> _Set:
        key = chosen.tobytes()
        if key not in self._sets:
            base = None if self._base is None else self._base._set(chosen[: len(self._base._size)])
            self._sets[key] = _Set(self._scaled, np.flatnonzero(chosen & (self._size > 0.0)), base)
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
