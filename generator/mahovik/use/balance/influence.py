"""Correction weights of any rotor by influence coefficients: vibration and trial runs read from JSON, and solved.

    r = A + ALPHA w

A (M): vibration, a row for each sensor at each speed. ALPHA (M, N): influence of a unit weight in each plane. w (N):
correction weights, r (M): what is left. All complex, written amplitude@degrees. From trial runs: column k of B is the
vibration with trial weight U_k in plane k, and

    ALPHA_k = (B_k - A) / U_k,  or  (B_k - B_{k-1}) / U_k, B_0 = A,  where earlier trial weights stay on (keep_trial).

In both cases w acts on the rotor without trial weights. Without phase, of one sensor and one plane, amplitudes a before
and b_k with trial weights U_k tell ALPHA relative to A = a:

    b_k^2 = a^2 + |ALPHA|^2 |U_k|^2 + 2 a Re(ALPHA U_k).

T. P. Goodman, A Least-Squares Method for Computing Balance Corrections, Journal of Engineering for Industry 86 (1964),
273-277.
"""

from __future__ import annotations

import cmath
import json
import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, NamedTuple

import numpy as np
from scipy.optimize import linprog
from scipy.special import chdtri

from mahovik.core.stand.fields import Flag
from mahovik.core.stand.files import TEXT, parse_json, text_of
from mahovik.core.stand.tables import Problems, Table
from mahovik.core.stand.units import QuantityError
from mahovik.errors import BalanceError, CheckError, UsageError
from mahovik.use.numeric.se3 import Array, Complex

Method = Literal["least-squares", "min-max"]

_NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
_POLAR = re.compile(rf"\s*({_NUMBER})\s*(?:@\s*({_NUMBER})\s*)?")

LARGEST = 1e12
"""Largest amplitude and angle that are accepted."""

INDEPENDENT = 1e-9
"""Smallest singular value, as a part of the largest, of influences scaled to unit columns."""

DISTINCT = 1e-6
"""The same of the equations of amplitudes without phase; and difference of two answers that are not one."""

CONTRADICTORY = 0.1
"""Misfit of amplitudes without phase, as a part of the largest, above which nothing is to be corrected by them."""

AGREED = 1e-7
"""Largest vibration above its lower bound, as a part of the largest before, at which min-max is settled."""

ROUNDS, SIDES = 200, 8
"""Rounds of min-max; tangents of each cone at the start."""


@dataclass(frozen=True, eq=False)
class Influence:
    """A (M), ALPHA (M, N).

    trial    (N): trial weights that stay on the rotor; None: they were removed, or there were none
    """

    A: Complex
    alpha: Complex
    trial: Complex | None


class Misfit(NamedTuple):
    """How well amplitudes without phase agree with one influence.

    off      how far an amplitude is off it at most; largest: of the amplitudes
    left     vibration that a correction leaves, root of its mean square, by the noise that explains `off`
    error    standard error of a correction's components; None where no amplitude is left over to tell the noise
    """

    off: float
    largest: float
    left: float
    error: float | None

    @property
    def share(self) -> float:
        """The misfit as a part of the largest amplitude."""
        return self.off / self.largest

    @property
    def fair(self) -> bool:
        """Whether a rotor may have these amplitudes."""
        return self.share <= CONTRADICTORY

    @property
    def words(self) -> str:
        """The misfit in words, and what to do where it is no noise."""
        size = f"{self.off:.4g}, {100.0 * self.share:.3g} % of the largest"
        size = f"amplitudes differ from those of any rotor by up to {size}"
        if self.fair:
            return f"{size}: with noise as large about {self.left:.3g} will be left, in one rotor of six twice as much"
        return f"{size}: repeat the runs, and check the places of the trial weights"


class InfluenceFile(Table):
    """Keys of a file of influences."""

    A: Any
    B: Any = None
    U: Any = None
    ALPHA: Any = None
    keep_trial: Flag = False


def read_polar(text: str) -> complex | None:
    """The number of "170@112"; None if the text is no such number, its amplitude is negative or it is too large."""
    match = _POLAR.fullmatch(text)
    if match is None or match[2] is None:
        return None
    amplitude, degrees = float(match[1]), float(match[2])
    if not (0.0 <= amplitude <= LARGEST and abs(degrees) <= LARGEST):
        return None
    return cmath.rect(amplitude, math.radians(degrees))


def write_polar(value: complex, zero: float = 0.0) -> str:
    """The number with four digits and an angle of 0 to 360 deg to a tenth; "0@0" where it is not above `zero`."""
    if abs(value) <= zero:
        return "0@0"
    degrees = round(math.degrees(cmath.phase(value)) % 360.0, 1) % 360.0
    return f"{float(f'{abs(value):.4g}'):.12g}@{degrees:.10g}"


def split_weight(w: complex, places: Sequence[float]) -> list[complex]:
    """Weights at the one or two places (degrees) beside a correction that together are it. Raises UsageError."""
    angle = math.degrees(cmath.phase(w))
    turned = sorted((place - angle) % 360.0 for place in places)
    after, before = turned[0], 360.0 - turned[-1]
    for at in (after, -before):
        if abs(at) < 1e-9:
            return [cmath.rect(abs(w), math.radians(angle))]
    if after + before >= 180.0:
        raise UsageError(f"places: none within half a turn on both sides of {angle % 360.0:.4g} degrees; give more")
    a, b = math.radians(after), math.radians(before)
    size, direction = abs(w) / math.sin(a + b), math.radians(angle)
    return [cmath.rect(size * math.sin(b), direction + a), cmath.rect(size * math.sin(a), direction - b)]


# -- reading ---------------------------------------------------------------------------------------------------------


def read_influence(source: str | Path | Mapping[str, Any]) -> tuple[list[Influence], Misfit | None]:
    """Influences of a JSON file or of an object like it, and of amplitudes without phase the misfit.

    Two influences: of amplitudes without phase that fit both. Raises BalanceError.
    """
    where = "influence" if isinstance(source, Mapping) else str(source)
    raw = source if isinstance(source, Mapping) else _load(Path(source))
    problems = Problems(where)
    table = problems.valid(InfluenceFile, dict(raw))
    if table is None:
        raise BalanceError(problems.lines)
    try:
        return _influences(table)
    except QuantityError as error:
        raise BalanceError([f"{where}: {error}"]) from None


def _load(path: Path) -> Mapping[str, Any]:
    try:
        raw = parse_json(text_of(path, "a file of influences", TEXT, BalanceError))
    except (ValueError, RecursionError) as error:
        raise BalanceError([f"{path}: not JSON: {error}"]) from None
    if not isinstance(raw, dict):
        raise BalanceError([f'{path}: expected an object with "A", and "B" and "U" or "ALPHA"'])
    return raw


def _influences(table: InfluenceFile) -> tuple[list[Influence], Misfit | None]:
    """The influences of a file, and the misfit of amplitudes. Raises QuantityError."""
    A, phases = _numbers("A", table.A)
    trial, misfit = None, None
    if table.ALPHA is not None:
        if table.B is not None or table.U is not None:
            raise QuantityError('ALPHA: given beside trial runs; give either "ALPHA", or "B" and "U"')
        if table.keep_trial:
            raise QuantityError('keep_trial: true needs trial runs; give "B" and "U", or leave it out')
        if not phases:
            raise QuantityError("A: without phase it needs trial runs; give B and U, or amplitude@degrees")
        alphas = [_matrix("ALPHA", table.ALPHA, len(A), True)]
    else:
        flat = (
            not phases and isinstance(table.B, list | tuple) and not any(isinstance(x, list | tuple) for x in table.B)
        )
        B = _matrix("B", [table.B] if flat else table.B, len(A), phases)
        U, _ = _numbers("U", table.U, True)
        if len(U) != B.shape[1]:
            many = f"{_count(len(U), 'trial weight')}, but B has {_count(B.shape[1], 'column')}"
            raise QuantityError(f"U: {many}, one a {'plane' if phases else 'trial run'}")
        if not np.all(U):
            raise QuantityError(f"U[{int(np.argmin(np.abs(U)))}]: a trial weight of 0 shows no influence")
        if phases:
            alphas = [(B - (np.column_stack([A, B[:, :-1]]) if table.keep_trial else A[:, None])) / U]
            trial = U if table.keep_trial else None
        elif len(A) > 1 or table.keep_trial:
            raise QuantityError("A: without phase there is one sensor, one plane, and no trial weight stays on")
        else:
            amplitudes, misfit = _without_phase(float(A[0].real), B[0].real, U)
            alphas = [np.array([[alpha]]) for alpha in amplitudes]
    _require_independent(alphas[0])
    return [Influence(A, alpha, trial) for alpha in alphas], misfit


def _numbers(key: str, raw: Any, phases: bool | None = None) -> tuple[Complex, bool]:
    """Complex numbers of a list, and whether they have phases, all or none. Raises QuantityError."""
    values = raw if isinstance(raw, list | tuple) else [raw]
    form = 'expected a list of "amplitude@degrees"'
    if raw is None or not values:
        raise QuantityError(f"{key}: {form}, {'missing' if raw is None else 'numbers none'}")
    numbers = []
    for i, value in enumerate(values):
        text = value if isinstance(value, str) else "" if isinstance(value, bool | list | dict) else str(value)
        match = _POLAR.fullmatch(text)
        has_phase = match is not None and match[2] is not None
        phases = has_phase if phases is None else phases
        read = read_polar(text if has_phase else f"{text}@0")
        if read is None or has_phase != phases:
            polar = phases or "@" in text
            expected = '"amplitude@degrees" without units, as "1.15@90"' if polar else "an amplitude, as the others"
            raise QuantityError(f"{key}[{i}]: expected {expected}, found {json.dumps(value, default=str)[:60]}")
        numbers.append(read)
    return np.array(numbers, dtype=np.complex128), bool(phases)


def _matrix(key: str, raw: Any, rows: int, phases: bool) -> Complex:
    """A row for each of A, a column for each plane, or without phases for each trial run. Raises QuantityError."""
    if not isinstance(raw, list | tuple) or not raw or not all(isinstance(row, list | tuple) for row in raw):
        hint = ', or "ALPHA" in place of B and U' if key == "B" and raw is None else ""
        raise QuantityError(f"{key}: expected a list of rows, one for each sensor{hint}")
    if len(raw) != rows:
        raise QuantityError(f"{key}: {_count(len(raw), 'row')}, but A has {_count(rows, 'sensor')}; one row a sensor")
    for i, row in enumerate(raw):
        if len(row) != len(raw[0]):
            raise QuantityError(f"{key}[{i}]: {_count(len(row), 'plane')}, but the first row has {len(raw[0])}")
    return np.array([_numbers(f"{key}[{i}]", row, phases)[0] for i, row in enumerate(raw)])


def _require_independent(alpha: Complex) -> None:
    """Raise QuantityError: planes that no sensor tells apart."""
    M, N = alpha.shape
    if M < N:
        words = f"{_count(N, 'plane')}, but only {_count(M, 'sensor')}; add sensors or speeds, or use fewer planes"
        raise QuantityError(f"A: {words}")
    size = np.linalg.norm(alpha, axis=0)
    if not np.all(size):
        raise QuantityError(f"planes: plane {int(np.argmin(size))} has no influence on any sensor")
    _, sigma, rows = np.linalg.svd(alpha / size)
    if sigma[-1] < INDEPENDENT * sigma[0]:
        share = np.abs(rows[-1])
        names = " and ".join(str(k) for k in np.flatnonzero(share > 0.1 * share.max()))
        raise QuantityError(
            f"planes: not independent: {names} act alike on all sensors; use fewer planes or other sensors"
        )


def _count(number_: int, noun: str) -> str:
    return f"{number_} {noun}" if number_ == 1 else f"{number_} {noun}s"


def _without_phase(a: float, b: Array, U: Complex) -> tuple[list[complex], Misfit]:
    """ALPHA relative to A = a, the one with the lighter correction first, and how well the amplitudes agree with it.

    Linear in |ALPHA|^2 and the parts of ALPHA. Trial runs of rank 3 tell them all: size and angle come from these, as
    circles drawn by hand give them. Of rank 2, as with two runs, |ALPHA|^2 that of its parts leaves two answers.
    Raises QuantityError.
    """
    if a == 0.0:
        raise QuantityError("A: an amplitude of 0 needs no correction")
    unit = float(np.abs(U).max())
    u = U / unit
    rows = np.column_stack([np.abs(u) ** 2, 2.0 * u.real, -2.0 * u.imag])
    left, sigma, axes = np.linalg.svd(rows, full_matrices=True)
    rank = int(np.sum(sigma > DISTINCT * sigma[0]))
    if rank < 2:
        raise QuantityError("U: without phase expected trial runs with weights at two different places, better three")
    by_squares = axes[:rank].T @ (left.T[:rank] / sigma[:rank, None])
    nearest = by_squares @ ((b / a) ** 2 - 1.0)
    if rank == 3:
        size, x, y = nearest
        if size <= 0.0 or not (x or y):
            raise QuantityError(
                "B: no influence fits these amplitudes; repeat the runs, or take a heavier trial weight"
            )
        answers = [math.sqrt(size) * complex(x, y) / abs(complex(x, y))]
    else:
        v = axes[2]  # |x + iy|^2 = size along nearest + t v
        p, q = nearest[1:], v[1:]
        curve = np.array([q @ q, 2.0 * (p @ q) - v[0], p @ p - nearest[0]])
        root = cmath.sqrt(complex(curve[1] ** 2 - 4.0 * curve[0] * curve[2]))
        if abs(root.imag) > 0.5 * DISTINCT**0.5 * (abs(curve[1]) + curve[0]):
            raise QuantityError("B: no influence fits these amplitudes; repeat the runs, or add one at another place")
        steps = [(-curve[1] + sign * root.real) / (2.0 * curve[0]) for sign in (1.0, -1.0)]
        answers = [complex(*(p + t * q)) for t in steps]
        answers = sorted(answers, key=abs, reverse=True)
        if abs(answers[0] - answers[1]) < DISTINCT * abs(answers[0]):
            answers = answers[:1]
    off = max(float(np.abs(np.abs(1.0 + answer * u) - b / a).max()) for answer in answers)
    remains, error = _noise(answers[0], u, b / a, by_squares)
    misfit = Misfit(off * a, max(a, float(b.max())), remains * a, None if error is None else error * unit)
    return [answer * a / unit for answer in answers], misfit


def _noise(alpha: complex, u: Complex, b: Array, by_squares: Array) -> tuple[float, float | None]:
    """Vibration that w = -1 / ALPHA leaves of A = 1, root of its mean square, and standard error of the parts of w.

    By noise whose median is what the amplitudes 1, b (K) leave in a linear fit of A and the parts of ALPHA; of these
    |ALPHA|^2 and the parts are `by_squares` (3, K) of the squares.
    """
    places = np.concatenate([[0.0], u])
    direction = 1.0 + alpha * places
    direction /= np.abs(direction)
    turned = direction.conj() * places
    slopes = np.column_stack([direction.real, turned.real, -turned.imag])
    off = np.abs(1.0 + alpha * places) - np.concatenate([[1.0], b])
    over = off - slopes @ np.linalg.lstsq(slopes, off, rcond=None)[0]
    spare = len(off) - slopes.shape[1]
    if spare < 1:
        return 0.0, None
    size, x, y = by_squares * (2.0 * b)  # slopes of |ALPHA|^2 and of the parts by b
    share = size / (2.0 * abs(alpha) ** 2) + 1j * ((x + 1j * y) / alpha).imag  # of ALPHA, as a part of it
    left = math.sqrt(float(over @ over) / chdtri(spare, 0.5) * float((np.abs(share) ** 2).sum() + abs(b @ share) ** 2))
    return left, left / (math.sqrt(2.0) * abs(alpha))


# -- solving ---------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class Solution:
    """Corrections w (N) and what they leave, r = A + ALPHA w (M).

    bound           min-max: no weights leave a largest vibration below this; None for least squares
    standard_error  (N): of each component of w along and across its direction, from what least squares leaves; None
                    without more sensors than planes, or for min-max
    """

    w: Complex
    left: Complex
    bound: float | None = None
    standard_error: Array | None = None


def solve(problem: Influence, method: Method = "least-squares") -> Solution:
    """Correction weights of least squares, or with the least largest vibration. Raises CheckError."""
    A, alpha, (M, N) = problem.A, problem.alpha, problem.alpha.shape
    if method == "min-max":
        return _min_max(A, alpha)
    w = np.asarray(np.linalg.lstsq(alpha, -A, rcond=None)[0])
    left = A + alpha @ w
    if M <= N:
        return Solution(w, left)
    variance = float(np.sum(np.abs(left) ** 2)) / (2.0 * (M - N))
    return Solution(w, left, None, np.sqrt(variance * np.diag(np.linalg.inv(alpha.conj().T @ alpha)).real))


def _min_max(A: Complex, alpha: Complex) -> Solution:
    """Least t with |A_m + (ALPHA w)_m| <= t, by linear programmes over tangents of these cones.

    Each is a bound of t from below; tangents where its answer leaves a cone are added until both agree.
    """
    (M, N), scale, size = alpha.shape, float(np.abs(A).max()) or 1.0, np.linalg.norm(alpha, axis=0)
    at, turn = np.repeat(np.arange(M), SIDES), np.tile(np.exp(2j * np.pi * np.arange(SIDES) / SIDES), M)
    x = np.linalg.lstsq(alpha / size, -A / scale, rcond=None)[0]
    best, most = x, float(np.abs(A / scale + alpha / size @ x).max())
    for _ in range(ROUNDS):
        left = A / scale + alpha / size @ x
        there = np.flatnonzero(left)
        at, turn = np.concatenate([at, there]), np.concatenate([turn, left[there] / np.abs(left[there])])
        rows = turn.conj()[:, None] * (alpha / size)[at]
        solved = linprog(
            np.eye(2 * N + 1)[-1],
            np.column_stack([rows.real, -rows.imag, -np.ones(len(rows))]),
            -(turn.conj() * A[at]).real / scale,
            bounds=[(None, None)] * (2 * N) + [(0.0, None)],
        )
        if solved.x is None:
            break
        x, bound = solved.x[:N] + 1j * solved.x[N : 2 * N], float(solved.fun)
        largest = float(np.abs(A / scale + alpha / size @ x).max())
        best, most = (x, largest) if largest < most else (best, most)
        if most - bound <= AGREED:
            w = best * scale / size
            return Solution(w, A + alpha @ w, min(bound, most) * scale)
    raise CheckError("min-max: the linear programmes do not settle; use least-squares")
