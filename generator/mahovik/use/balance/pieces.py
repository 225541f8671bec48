"""Corrections that can be made: weights or holes at allowed places, a split between screws, chosen by milp of SciPy.

Least largest vibration over the sensors, each circle replaced by its tangents, so that the choice is optimal within
1 - cos(pi / SIDES) of it; of equal choices the one with fewer pieces.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Annotated, Any

import numpy as np
from scipy.optimize import Bounds, LinearConstraint, milp

from mahovik.core.stand.fields import Flag, validator, whole_number
from mahovik.core.stand.numbers import exact
from mahovik.core.stand.tables import Problems, Table, TableError
from mahovik.core.stand.units import PLAIN, Dimension, QuantityError, number, show
from mahovik.errors import CheckError
from mahovik.use.numeric.se3 import Complex

MANY = 2000
"""Most combinations of position, amount and radius in a plane."""

Count = Annotated[int, whole_number(1, MANY)]

SIDES = 36
"""Tangents of a circle."""

SECONDS = 30.0
"""Wall-clock limit of the search."""

FEWER = 1e-6
"""Price of a piece, as a part of the largest vibration, where no other is given."""

FAR = 1e6
"""Bound of weights in planes that are left free, in multiples of what undoes the vibration."""


@dataclass(frozen=True)
class Piece:
    """One weight or hole: its angle (deg), amount and radius; `value`: amount times radius, negative for a hole."""

    degrees: float
    amount: float
    radius: float
    value: float


@dataclass(frozen=True)
class Choice:
    """Pieces of a plane.

    positions  groups of pieces at one angle
    per_place  most pieces at one angle; most: in the plane, None: any number
    split      whether the amounts are any numbers up to the largest, as of two screws that are filed
    """

    positions: tuple[tuple[Piece, ...], ...]
    per_place: int
    most: int | None
    split: bool


def _pair(raw: Any) -> Sequence[Any]:
    """Two of anything. Raises QuantityError."""
    if not isinstance(raw, list | tuple) or len(raw) != 2:
        raise QuantityError(f"expected [from, to], found {show(raw)}")
    return raw


class PiecesTable(Table):
    """Keys of the pieces of a plane.

    positions  angles of the places, degrees; or `holes`
    holes      number of equal divisions
    first      angle of the first of them, degrees
    amounts    what one weight or hole may have
    radii      radii to choose from: an amount counts times its radius; without it 1
    forbidden  sectors `[from, to]` without pieces, degrees
    most       most pieces in the plane
    each       most pieces at a place
    remove     `true`: material is taken away
    split      `true`: amounts are any numbers up to the largest, as of two screws
    """

    positions: Sequence[Any] | None = None
    holes: Count | None = None
    first: Any = 0
    amounts: Sequence[Any]
    radii: Sequence[Any] | None = None
    forbidden: Sequence[Annotated[Sequence[Any], validator(_pair)]] = ()
    most: Count | None = None
    each: Count = 1
    remove: Flag = False
    split: Flag = False

    def check(self) -> None:
        """Raises TableError where there is nothing to choose from."""
        for key in ("amounts", "radii"):
            if getattr(self, key) == []:
                raise TableError("expected at least one", key)


def read_choices(raw: Any, N: int, amount: Dimension, radius: Dimension) -> tuple[Choice | None, ...]:
    """Choices of N planes, of a table for all planes or a list of tables; None or an empty one leaves a plane free.

    Raises QuantityError.
    """
    if raw is None:
        return ()
    several = isinstance(raw, list | tuple)
    values: Sequence[Any] = raw if isinstance(raw, list | tuple) else [raw] * N
    if len(values) != N:
        raise QuantityError(f"pieces: a list of {len(values)}, but the number of planes is {N}")
    choices = []
    for k, value in enumerate(values):
        where = f"pieces[{k}]" if several else "pieces"
        problems = Problems(where)
        table = problems.valid(PiecesTable, value) if value else None
        if problems.lines:
            raise QuantityError(problems.lines[0])
        try:
            choices.append(None if table is None else _choice(table, amount, radius))
        except QuantityError as error:
            raise QuantityError(f"{where}.{error}") from None
    return tuple(choices)


def _choice(table: PiecesTable, amount: Dimension, radius: Dimension) -> Choice:
    def numbers(key: str, raw: Sequence[Any], dimension: Dimension, above: float = -np.inf) -> list[float]:
        try:
            read = [number(exact(x), dimension) for x in raw]
        except QuantityError as error:
            raise QuantityError(f"{key}: {error}") from None
        if read and min(read) <= above:
            raise QuantityError(f"{key}: expected numbers above {above:g}, found {min(read):g}")
        return read

    if (table.positions is None) == (table.holes is None):
        raise QuantityError('positions: expected "positions", a list of degrees, or "holes", a number of divisions')
    if table.radii is None and radius != PLAIN:
        raise QuantityError('radii: missing; expected a list of lengths, such as ["30 mm"]')
    angles = numbers("positions", table.positions or (), PLAIN)
    if table.holes is not None:
        (first,) = numbers("first", [table.first], PLAIN)
        angles = [first + 360.0 * i / table.holes for i in range(table.holes)]
    for i, sector in enumerate(table.forbidden):
        low, high = numbers(f"forbidden[{i}]", sector, PLAIN)
        angles = [angle for angle in angles if (angle - low) % 360.0 > (high - low) % 360.0]
    if not angles:
        raise QuantityError("forbidden: leaves no position")
    amounts = numbers("amounts", table.amounts, amount, 0.0)
    radii = numbers("radii", table.radii or [1], radius, 0.0)
    if (many := len(angles) * len(amounts) * len(radii)) > MANY:
        raise QuantityError(f"amounts: {many} combinations, at most {MANY}; give fewer")
    sign = -1.0 if table.remove else 1.0
    positions = tuple(tuple(Piece(angle, m, r, sign * m * r) for m in amounts for r in radii) for angle in angles)
    return Choice(positions, table.each, table.most, table.split)


@dataclass(frozen=True)
class Placed:
    """A piece in a plane: how many of it, or with `split` how much of its amount (0 to 1)."""

    plane: int
    piece: Piece
    count: float


@dataclass(frozen=True, eq=False)
class Made:
    """Pieces, the weights (N) that they make, and what they leave (M); proven: no choice is better."""

    placed: tuple[Placed, ...]
    w: Complex
    left: Complex
    proven: bool


@dataclass(frozen=True)
class _Column:
    """An unknown: a piece, or one part of the weight of a free plane."""

    plane: int
    effect: complex
    piece: Piece | None
    whole: bool
    upper: float


def choose_pieces(
    A: Complex, alpha: Complex, choices: tuple[Choice | None, ...], price: float = FEWER, seconds: float = SECONDS
) -> Made:
    """The best pieces for a vibration A (M) with influences alpha (M, N).

    price    a piece has to lower the largest vibration by at least this part of it
    seconds  wall-clock limit of the search

    Raises CheckError: none was met in time.
    """
    scale = float(np.abs(A).max()) or 1.0
    columns = _columns(alpha, choices, scale)
    effects = np.array([column.effect * alpha[:, column.plane] for column in columns]).T / scale
    n, turns = len(columns), np.exp(2j * np.pi * np.arange(SIDES) / SIDES)
    rows = (turns[:, None, None] * effects).real.reshape(-1, n)
    limit = -(turns[:, None] * (A / scale)).real.ravel()
    tangents = LinearConstraint(np.column_stack([rows, -np.ones(len(rows))]), ub=limit)
    least = [-column.upper if column.piece is None else 0.0 for column in columns]
    with _silent_output():
        solved = milp(
            np.array([*(0.0 if column.piece is None else price for column in columns), 1.0]),
            integrality=np.array([*(column.whole for column in columns), False], dtype=np.int64),
            bounds=Bounds(np.array([*least, 0.0]), np.array([*(column.upper for column in columns), np.inf])),
            constraints=[tangents, *_counts(choices, columns)],
            options={"time_limit": seconds, "mip_rel_gap": 0.0},
        )
    if solved.x is None:
        raise CheckError(f"pieces: no choice was met in {seconds:g} s; give fewer amounts or positions")
    x = np.where([column.whole for column in columns], np.round(solved.x[:-1]), solved.x[:-1])
    w = np.zeros(alpha.shape[1], dtype=np.complex128)
    placed = []
    for column, amount in zip(columns, x.tolist(), strict=True):
        w[column.plane] += column.effect * amount
        if column.piece is not None and amount > 1e-9:
            placed.append(Placed(column.plane, column.piece, amount))
    return Made(tuple(placed), w, A + alpha @ w, solved.status == 0)


def _columns(alpha: Complex, choices: Sequence[Choice | None], scale: float) -> list[_Column]:
    columns = []
    for plane, choice in enumerate(choices):
        if choice is None:
            size = scale / float(np.linalg.norm(alpha[:, plane]))
            columns += [_Column(plane, size * turn, None, False, FAR) for turn in (1.0, 1j)]
            continue
        for pieces in choice.positions:
            for piece in (max(pieces, key=lambda piece: abs(piece.value)),) if choice.split else pieces:
                effect = piece.value * complex(np.exp(1j * np.radians(piece.degrees)))
                columns.append(
                    _Column(plane, effect, piece, not choice.split, 1.0 if choice.split else choice.per_place)
                )
    return columns


def _counts(choices: Sequence[Choice | None], columns: Sequence[_Column]) -> list[LinearConstraint]:
    """Most pieces at each position and in each plane."""
    rows, limits = [], []
    for plane, choice in enumerate(choices):
        if choice is None or choice.split:
            continue
        in_plane = [column.plane == plane for column in columns]
        for pieces in choice.positions:
            at = [there and column.piece in pieces for there, column in zip(in_plane, columns, strict=True)]
            rows.append([*at, False])
            limits.append(choice.per_place)
        if choice.most is not None:
            rows.append([*in_plane, False])
            limits.append(choice.most)
    return [LinearConstraint(np.array(rows, dtype=float), ub=np.array(limits, dtype=float))] if rows else []


@contextmanager
def _silent_output() -> Iterator[None]:
    """Discard what is written to file descriptor 1: HiGHS prints lines in some searches, whatever its options."""
    sys.stdout.flush()
    try:
        kept = os.dup(1)
    except OSError:  # no standard output at all
        yield
        return
    try:
        with open(os.devnull, "wb") as nowhere:
            os.dup2(nowhere.fileno(), 1)
        yield
    finally:
        os.dup2(kept, 1)
        os.close(kept)
