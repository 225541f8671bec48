"""One number of the stand file, or two, that explain the error of a program: by derivative, then solved exactly."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.core.stand.numbers import StandNumber, StandNumbers
from mahovik.core.stand.read import read
from mahovik.errors import StandError, UsageError
from mahovik.proof.diagnose.answers import AnswerVector, Model, Reference
from mahovik.proof.reference.array import Array

STEP = 1e-5
"""Part of the size of a number by which it is changed for a derivative."""

SMALL = 1e-2
"""Size of a number that is zero in the file, as all beside it are, SI."""

SINGLES, PAIRS = 24, 8
"""Numbers, and pairs of them, that are solved: those whose derivatives explain most."""

LIKELY = 0.5
"""Part of the error that the derivatives of two numbers must explain, for them to be solved."""

MOST_STEPS = 12

SLOW = 0.7
"""Part of what was left that a step may leave, for another one to follow."""

DEPENDENT = 1e-9
"""Square of the sine of two derivatives below which two numbers do the same."""


@dataclass(frozen=True)
class SolvedNumbers:
    """Values of some numbers with which the right equations are nearest to a program.

    left  of the error in units of scale, root mean square: what they leave, over all of it
    """

    values: Mapping[StandNumber, float]
    left: float


class NumberSearch:
    """Numbers of one stand, with the derivatives of the answers to some requests by each."""

    def __init__(self, stand: Stand, document: Mapping[str, Any], vector: AnswerVector, among: Collection[str]) -> None:
        """`document`: the keys of the stand's file; `among`: ids of the requests by which numbers are looked for."""
        self._stand, self._vector, self._among = stand, vector, among
        self._file = StandNumbers(stand, document)
        self._numbers = list(self._file)

    def model(self, values: Mapping[StandNumber, float]) -> Model:
        """The right equations with other numbers. Raises StandError: a stand cannot have them."""
        try:
            return Reference(read(self._file.with_values(values), self._stand.name, physics=False))
        except UsageError as error:
            raise StandError([str(error)]) from None

    def singles(self, error: Array, noise: Array) -> list[SolvedNumbers]:
        """Single numbers, those that leave least of an error (NaN: not answered, or not looked at) first."""
        weighted, slopes = self._weighted(error, noise)
        with np.errstate(all="ignore"):
            alike = np.nan_to_num((slopes.T @ weighted) ** 2 / (slopes**2).sum(axis=0))
        order = np.argsort(-alike, kind="stable")[:SINGLES]
        found = [self._solve((int(j),), error, noise) for j in order if alike[j] > 0.0]
        return sorted((each for each in found if each is not None), key=lambda each: each.left)

    def pairs(self, error: Array, noise: Array) -> list[SolvedNumbers]:
        """Pairs of numbers, likewise."""
        weighted, slopes = self._weighted(error, noise)
        size = np.linalg.norm(slopes, axis=0)
        there = np.flatnonzero(size > 0.0)
        unit = slopes[:, there] / size[there]
        b, G = unit.T @ weighted, unit.T @ unit
        apart = 1.0 - G**2
        with np.errstate(all="ignore"):
            explained = (b[:, None] ** 2 + b**2 - 2.0 * G * np.outer(b, b)) / apart
        explained = np.where(np.triu(apart > DEPENDENT, 1), np.nan_to_num(explained), 0.0)
        order = np.argsort(-explained, axis=None, kind="stable")[:PAIRS]
        whole = float(weighted @ weighted)
        chosen = [np.unravel_index(k, explained.shape) for k in order if explained.flat[k] > LIKELY * whole]
        found = [self._solve((int(there[i]), int(there[j])), error, noise) for i, j in chosen]
        return sorted((each for each in found if each is not None), key=lambda each: each.left)

    def rounded(self, solved: SolvedNumbers, error: Array, noise: Array) -> SolvedNumbers:
        """The same numbers with the fewest digits that leave nothing beyond rounding."""
        values = dict(solved.values)
        for number, value in solved.values.items():
            for digits in range(1, 16):
                short = {**values, number: float(f"{value:.{digits}g}")}
                left = self._remainder(short, error)
                if left is not None and (np.abs(left) <= noise[np.isfinite(error)]).all():
                    values = short
                    break
        return SolvedNumbers(values, solved.left)

    @cached_property
    def _slopes(self) -> Array:
        """Derivatives (n, m) of the answers; zero where there is none."""
        columns = []
        for each in self._numbers:
            size = max((abs(x) for x in (each.value, *np.ravel(each.whole or 0.0))), default=0.0) or SMALL
            columns.append(np.zeros(self._vector.expected.size))
            for step in (STEP * size, -STEP * size):
                try:
                    moved = self._vector.of_model(self.model({each: each.value + step}), self._among)
                except StandError:
                    continue
                columns[-1] = np.nan_to_num((moved - self._vector.expected) / step, nan=0.0)
                break
        return np.column_stack(columns)

    def _weighted(self, error: Array, noise: Array) -> tuple[Array, Array]:
        there = np.isfinite(error)
        return error[there] / noise[there], self._slopes[there] / noise[there, None]

    def _remainder(self, values: Mapping[StandNumber, float], error: Array) -> Array | None:
        """What numbers leave of an error, where it was answered; None: a stand cannot have them."""
        try:
            found = self._vector.of_model(self.model(values), self._among)
        except StandError:
            return None
        left = (error + self._vector.expected - found)[np.isfinite(error)]
        return left if np.isfinite(left).all() else None

    def _solve(self, columns: Sequence[int], error: Array, noise: Array) -> SolvedNumbers | None:
        """Gauss-Newton with derivatives that are brought up to date by what each step changed (Broyden)."""
        numbers = [self._numbers[j] for j in columns]
        weighted, slopes = self._weighted(error, noise)
        unit = noise[np.isfinite(error)]
        jacobian, rest = slopes[:, list(columns)], weighted
        at = np.array([each.value for each in numbers])
        size, best = 1.0, (1.0, at)
        whole = float(np.linalg.norm(weighted)) or 1.0
        for k in range(MOST_STEPS):
            step = np.linalg.lstsq(jacobian, rest, rcond=None)[0]
            left = None
            for _ in range(4):
                left = self._remainder(dict(zip(numbers, (at + step).tolist(), strict=True)), error)
                if left is not None:
                    break
                step = step / 4.0
            if left is None or not step.any():
                break
            change = rest - left / unit
            jacobian = jacobian + np.outer(change - jacobian @ step, step) / float(step @ step)
            at, rest, before = at + step, left / unit, size
            size = float(np.linalg.norm(rest)) / whole
            if size < best[0]:
                best = size, at
            if (np.abs(rest) <= 0.1).all() or (k > 1 and size > SLOW * before) or size > 10.0:
                break
        if best[0] >= 1.0:
            return None
        return SolvedNumbers(dict(zip(numbers, best[1].tolist(), strict=True)), best[0])
