"""One number of the stand file, or two, that explain the error of a program: by derivative, then solved exactly."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.core.stand.numbers import StandNumber, StandNumbers
from mahovik.core.stand.stand_file import read
from mahovik.errors import MahovikError, StandError, UsageError
from mahovik.proof.diagnose.answers import AnswerVector, Model, Reference
from mahovik.proof.reference.algebra import Array

STEP = 1e-5
"""Part of the size of a number by which it is changed for a derivative."""

SMALL = 1e-2
"""Size of a number that is zero in the file, as all beside it are, SI."""

MOST = {1: 24, 2: 8}
"""Single numbers, and pairs of them, that are solved: those whose derivatives explain most."""

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


def pairs_explain(unit: Array, error: Array) -> Array:
    """Square (m, m) of what least squares by each two columns of unit length (n, m) explains of an error (n).

    Zero below the diagonal, on it, and where two columns are one.
    """
    b, G = unit.T @ error, unit.T @ unit
    apart = 1.0 - G**2
    with np.errstate(all="ignore"):
        explained = (b[:, None] ** 2 + b**2 - 2.0 * G * np.outer(b, b)) / apart
    return np.where(np.triu(apart > DEPENDENT, 1), np.nan_to_num(explained), 0.0)


class NumberSearch:
    """Numbers of one stand that explain an error, with the derivatives of the answers to some requests by each."""

    def __init__(
        self,
        stand: Stand,
        document: Mapping[str, Any],
        vector: AnswerVector,
        among: Collection[str],
        error: Array,
        noise: Array,
    ) -> None:
        """`document`: the keys of the stand's file; `among`: ids of the requests by which numbers are looked for.

        `error`: NaN where the program did not answer; `noise`: what of it may be rounding.
        """
        self._stand, self._vector, self._among = stand, vector, among
        self._file = StandNumbers(stand, document)
        self._numbers = list(self._file)
        self._there = np.isfinite(error) & vector.places(among)
        self._noise, self._answered = noise[self._there], error + vector.expected
        self._error = error[self._there] / self._noise

    def model(self, values: Mapping[StandNumber, float]) -> Model:
        """The right equations with other numbers. Raises StandError: a stand cannot have them."""
        try:
            return Reference(read(self._file.with_values(values), self._stand.name, physics=False))
        except UsageError as error:
            raise StandError([str(error)]) from None

    def solutions(self, count: int) -> list[SolvedNumbers]:
        """Single numbers (count 1), or pairs that a stand can have, those that leave least of the error first."""
        size = np.linalg.norm(self._slopes, axis=0)
        there = np.flatnonzero(size > 0.0)
        unit = self._slopes[:, there] / size[there]
        least = 0.0 if count == 1 else LIKELY * float(self._error @ self._error)
        explained = np.diag((unit.T @ self._error) ** 2) if count == 1 else pairs_explain(unit, self._error)
        order = np.argsort(-explained, axis=None, kind="stable")[: MOST[count]]
        chosen = [{there[i] for i in divmod(int(k), len(there))} for k in order if explained.flat[k] > least]
        solved = (self._solve([self._numbers[j] for j in sorted(places)], sorted(places)) for places in chosen)
        possible = (x for x in solved if x is not None and (count == 1 or self._is_physical(x.values)))
        return sorted(possible, key=lambda solution: solution.left)

    def _is_physical(self, values: Mapping[StandNumber, float]) -> bool:
        """Whether there can be bodies with these numbers."""
        try:
            read(self._file.with_values(values), self._stand.name)
        except MahovikError:
            return False
        return True

    def rounded(self, solved: SolvedNumbers) -> SolvedNumbers:
        """The same numbers with the fewest digits that leave nothing beyond rounding."""
        values = dict(solved.values)
        for number, value in solved.values.items():
            for digits in range(1, 16):
                short = {**values, number: float(f"{value:.{digits}g}")}
                left = self._remainder(short)
                if left is not None and (np.abs(left) <= 1.0).all():
                    values = short
                    break
        return SolvedNumbers(values, solved.left)

    @cached_property
    def _slopes(self) -> Array:
        """Derivatives (n, m) of the answers over rounding; zero where there is none."""
        columns = []
        for number in self._numbers:
            size = max((abs(x) for x in (number.value, *np.ravel(number.whole or 0.0))), default=0.0) or SMALL
            columns.append(np.zeros(self._error.size))
            for step in (STEP * size, -STEP * size):
                try:
                    moved = self._vector.of_model(self.model({number: number.value + step}), self._among)
                except StandError:
                    continue
                change = np.nan_to_num((moved - self._vector.expected) / step, nan=0.0)
                columns[-1] = change[self._there] / self._noise
                break
        return np.column_stack(columns)

    def _remainder(self, values: Mapping[StandNumber, float]) -> Array | None:
        """What numbers leave of the error, over rounding; None: a stand cannot have them."""
        try:
            left = (self._answered - self._vector.of_model(self.model(values), self._among))[self._there] / self._noise
        except StandError:
            return None
        return left if np.isfinite(left).all() else None

    def _solve(self, numbers: Sequence[StandNumber], columns: Sequence[int]) -> SolvedNumbers | None:
        """Gauss-Newton with derivatives that are brought up to date by what each step changed (Broyden)."""
        jacobian, rest = self._slopes[:, columns], self._error
        at = np.array([number.value for number in numbers])
        size, best = 1.0, (1.0, at)
        whole = float(np.linalg.norm(rest)) or 1.0
        for k in range(MOST_STEPS):
            step = np.linalg.lstsq(jacobian, rest, rcond=None)[0]
            for _ in range(4):
                left = self._remainder(dict(zip(numbers, (at + step).tolist(), strict=True)))
                if left is not None:
                    break
                step = step / 4.0
            if left is None or not step.any():
                break
            change = rest - left
            jacobian = jacobian + np.outer(change - jacobian @ step, step) / float(step @ step)
            at, rest, before = at + step, left, size
            size = float(np.linalg.norm(rest)) / whole
            if size < best[0]:
                best = size, at
            if (np.abs(rest) <= 0.1).all() or (k > 1 and size > SLOW * before) or size > 10.0:
                break
        if best[0] >= 1.0:
            return None
        return SolvedNumbers(dict(zip(numbers, best[1].tolist(), strict=True)), best[0])
