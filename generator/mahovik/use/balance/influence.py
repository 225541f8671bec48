"""Vibration before balancing and influence coefficients of planes: read from JSON, checked.

    r = A + ALPHA w

A (M): vibration, a row for each sensor at each speed. ALPHA (M, N): influence of a unit weight in each plane. w (N):
correction weights, r (M): what is left. All complex. From trial runs: column k of B is the vibration with trial weight
U_k in plane k, and

    ALPHA_k = (B_k - A) / U_k,  or  (B_k - B_{k-1}) / U_k, B_0 = A,  where earlier trial weights stay on (keep_trial).

In both cases w acts on the rotor without trial weights. T. P. Goodman, A Least-Squares Method for Computing Balance
Corrections, Journal of Engineering for Industry 86 (1964), 273-277.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from decimal import Decimal
from pathlib import Path
from typing import Any

import numpy as np

from mahovik.core.motion.document import parse, text_of
from mahovik.core.stand.content import TEXT
from mahovik.errors import BalanceError
from mahovik.nearest import suggestion
from mahovik.use.balance.choices import Choice, read_choices
from mahovik.use.balance.polar import Array, Complex, read_polar

KEYS = ("A", "B", "U", "ALPHA", "keep_trial", "most", "pieces")

INDEPENDENT = 1e-9
"""Smallest singular value, as a part of the largest, of influences scaled to unit columns."""


@dataclass(frozen=True, eq=False)
class Influence:
    """A (M), ALPHA (M, N), and what corrections are allowed.

    trial    (N): trial weights that stay on the rotor; None: they were removed, or there were none
    most     (N): largest amplitude of each correction, infinite where none is given
    choices  corrections that can be made in each plane (N); empty: any
    """

    A: Complex
    alpha: Complex
    trial: Complex | None
    most: Array
    choices: tuple[Choice | None, ...] = ()


def read_influence(given: str | Path | Mapping[str, Any]) -> Influence:
    """The influence of a JSON file, or of an object like it. Raises BalanceError."""
    where, raw = ("influence", given) if isinstance(given, Mapping) else (str(given), _load(Path(given)))
    reader = _Reader(where)
    found = reader.read(raw)
    if found is None or reader.problems:
        raise BalanceError(reader.problems)
    return found


def _load(path: Path) -> Mapping[str, Any]:
    text = text_of(path, TEXT, BalanceError)
    try:
        raw = _floats(parse(text))
    except (ValueError, RecursionError) as error:
        raise BalanceError([f"{path}: not JSON: {error}"]) from None
    if not isinstance(raw, dict):
        raise BalanceError([f'{path}: expected an object with "A", and "B" and "U" or "ALPHA"'])
    return raw


def _floats(value: object) -> Any:
    """A value of JSON with its decimal numbers as floats."""
    if isinstance(value, dict):
        return {key: _floats(each) for key, each in value.items()}
    if isinstance(value, list):
        return [_floats(each) for each in value]
    return float(value) if isinstance(value, Decimal) else value


class _Reader:
    """Reads an object and collects its problems."""

    def __init__(self, where: str) -> None:
        self.where, self.problems = where, list[str]()

    def read(self, raw: Mapping[str, Any]) -> Influence | None:
        """The influence; None if a problem hides it."""
        for key in raw:
            if key not in KEYS:
                self.say(str(key), f"unknown key{suggestion(str(key), KEYS)}")
        A = self.vector("A", raw)
        if "ALPHA" in raw and ("B" in raw or "U" in raw):
            self.say("ALPHA", 'given beside trial runs; give either "ALPHA", or "B" and "U"')
            return None
        keep = raw.get("keep_trial", False)
        if not isinstance(keep, bool):
            self.say("keep_trial", f"expected true or false, found {json.dumps(keep)}")
            return None
        if "ALPHA" in raw:
            if keep:
                self.say("keep_trial", 'true needs trial runs; give "B" and "U", or leave it out')
            alpha, trial = self.matrix("ALPHA", raw, A), None
        else:
            alpha, trial = self.trial_runs(raw, A, keep)
        if A is None or alpha is None or self.problems:
            return None
        self.independent(alpha)
        if raw.get("most") is not None and raw.get("pieces") is not None:
            self.say(
                "most", 'not allowed with "pieces"; limit what a plane may have by "amounts", "each" and "most" there'
            )
        N = alpha.shape[1]
        most, choices = self.most(raw.get("most"), N), self.choices(raw.get("pieces"), N)
        return Influence(A, alpha, trial if keep else None, most, choices)

    def say(self, key: str, words: str) -> None:
        """Note a problem."""
        self.problems.append(f"{self.where}: {key}: {words}")

    def trial_runs(
        self, raw: Mapping[str, Any], A: Complex | None, keep: bool
    ) -> tuple[Complex | None, Complex | None]:
        """ALPHA and U of trial runs."""
        B, U = self.matrix("B", raw, A), self.vector("U", raw)
        if A is None or B is None or U is None:
            return None, None
        if len(U) != B.shape[1]:
            self.say("U", f"{_count(len(U), 'trial weight')}, but B has {_count(B.shape[1], 'column')}, one a plane")
            return None, None
        if not np.all(U):
            self.say(f"U[{int(np.argmin(np.abs(U)))}]", "a trial weight of 0 shows no influence")
            return None, None
        before = np.column_stack([A, B[:, :-1]]) if keep else A[:, None]
        return (B - before) / U, U

    def number(self, key: str, value: object) -> complex:
        """A complex number; 0 with a problem."""
        found = read_polar(value) if isinstance(value, str) else None
        if found is None:
            self.say(key, f'expected "amplitude@degrees", as "1.15@90", found {json.dumps(value, default=str)}')
        return found or 0j

    def vector(self, key: str, raw: Mapping[str, Any]) -> Complex | None:
        """A list of complex numbers."""
        values = raw.get(key)
        if not isinstance(values, list | tuple) or not values:
            found = "missing" if key not in raw else f"found {json.dumps(values, default=str)[:60]}"
            self.say(key, f'expected a list of "amplitude@degrees", {found}')
            return None
        return np.array([self.number(f"{key}[{i}]", each) for i, each in enumerate(values)], dtype=np.complex128)

    def matrix(self, key: str, raw: Mapping[str, Any], A: Complex | None) -> Complex | None:
        """A row for each element of A, a column for each plane."""
        rows = raw.get(key)
        if not isinstance(rows, list | tuple) or not rows or not all(isinstance(row, list | tuple) for row in rows):
            hint = ', or "ALPHA" in place of B and U' if key == "B" and key not in raw else ""
            found = "missing" if key not in raw else "found no such list"
            self.say(key, f"expected a list of rows, one for each sensor, {found}{hint}")
            return None
        N = len(rows[0])
        for i, row in enumerate(rows):
            if len(row) != N or not row:
                self.say(f"{key}[{i}]", f"{_count(len(row), 'plane')}, but the first row has {N}")
                return None
        if A is not None and len(rows) != len(A):
            self.say(key, f"{_count(len(rows), 'row')}, but A has {_count(len(A), 'sensor')}; one row for each sensor")
            return None
        values = [[self.number(f"{key}[{i}][{k}]", x) for k, x in enumerate(row)] for i, row in enumerate(rows)]
        return np.array(values, dtype=np.complex128)

    def independent(self, alpha: Complex) -> None:
        """Note planes that no sensor tells apart."""
        M, N = alpha.shape
        if M < N:
            words = f"{_count(N, 'plane')}, but only {_count(M, 'sensor')}; add sensors or speeds, or use fewer planes"
            self.say("A", words)
            return
        size = np.linalg.norm(alpha, axis=0)
        if not np.all(size):
            self.say("planes", f"plane {int(np.argmin(size))} has no influence on any sensor")
            return
        left, right = np.linalg.svd(alpha / size)[1:]
        if left[-1] < INDEPENDENT * left[0]:
            share = np.abs(right[-1])
            names = " and ".join(str(k) for k in np.flatnonzero(share > 0.1 * share.max()))
            self.say("planes", f"not independent: {names} act alike on all sensors; use fewer planes or other sensors")

    def most(self, given: object, N: int) -> Array:
        """Largest amplitudes (N)."""
        if given is None:
            return np.full(N, np.inf)
        values = given if isinstance(given, list | tuple) else [given] * N
        if len(values) != N:
            self.say("most", f"{_count(len(values), 'number')}, but there are {_count(N, 'plane')}")
            return np.full(N, np.inf)
        for i, each in enumerate(values):
            if isinstance(each, bool) or not isinstance(each, int | float) or not 0.0 < each < np.inf:
                self.say(f"most[{i}]", f"expected a number above 0, found {json.dumps(each, default=str)}")
                return np.full(N, np.inf)
        return np.array(values, dtype=np.float64)

    def choices(self, given: object, N: int) -> tuple[Choice | None, ...]:
        """Corrections that can be made."""
        found, problems = read_choices(given, N)
        for key, words in problems:
            self.say(key, words)
        return found


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"
