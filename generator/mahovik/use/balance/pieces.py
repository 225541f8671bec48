"""Corrections that can be made: pieces chosen by mixed-integer linear programming (scipy.optimize.milp).

Least largest vibration over the sensors, each circle replaced by its tangents, so that the choice is optimal within
1 - cos(pi / SIDES) of it; of equal choices the one with fewer pieces.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import Bounds, LinearConstraint, milp

from mahovik.errors import CheckError
from mahovik.use.balance.choices import Choice, Piece
from mahovik.use.balance.influence import Influence
from mahovik.use.balance.polar import Array, Complex

SIDES = 36
SECONDS = 30.0
"""Wall-clock limit of the search."""

FEWER = 1e-6
"""Price of a piece, as a part of the largest vibration."""

FAR = 1e6
"""Bound of weights in planes that are left free, in multiples of what undoes the vibration."""


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


def choose_pieces(problem: Influence) -> Made:
    """The best pieces for a problem with choices. Raises CheckError: none found in time."""
    scale = float(np.abs(problem.A).max()) or 1.0
    columns = _columns(problem, scale)
    effects = np.array([each.effect * problem.alpha[:, each.plane] for each in columns]).T / scale
    n, turns = len(columns), np.exp(2j * np.pi * np.arange(SIDES) / SIDES)
    rows = (turns[:, None, None] * effects).real.reshape(-1, n)
    limit = -(turns[:, None] * (problem.A / scale)).real.ravel()
    tangents = LinearConstraint(np.column_stack([rows, -np.ones(len(rows))]), ub=limit)
    price = np.array([0.0 if each.piece is None else FEWER for each in columns])
    found = milp(
        np.append(price, 1.0),
        integrality=np.array([*(each.whole for each in columns), False], dtype=np.int64),
        bounds=Bounds(
            np.array([*(-each.upper if each.piece is None else 0.0 for each in columns), 0.0]),
            np.array([*(each.upper for each in columns), np.inf]),
        ),
        constraints=[tangents, *_counts(problem.choices, columns)],
        options={"time_limit": SECONDS, "mip_rel_gap": 0.0},
    )
    if found.x is None:
        raise CheckError(f"pieces: no choice was found in {SECONDS:g} s; give fewer amounts or positions")
    x = np.where([each.whole for each in columns], np.round(found.x[:-1]), found.x[:-1])
    w = np.zeros(problem.alpha.shape[1], dtype=np.complex128)
    for each, amount in zip(columns, x, strict=True):
        w[each.plane] += each.effect * amount
    placed = tuple(
        Placed(each.plane, each.piece, float(amount))
        for each, amount in zip(columns, x, strict=True)
        if each.piece is not None and amount > 1e-9
    )
    return Made(placed, w, problem.A + problem.alpha @ w, found.status == 0)


def _columns(problem: Influence, scale: float) -> list[_Column]:
    found = []
    for plane, choice in enumerate(problem.choices):
        if choice is None:
            size = scale / float(np.linalg.norm(problem.alpha[:, plane]))
            found += [_Column(plane, size * turn, None, False, FAR) for turn in (1.0, 1j)]
            continue
        for pieces in choice.positions:
            used = (max(pieces, key=lambda piece: abs(piece.value)),) if choice.split else pieces
            for piece in used:
                effect = piece.value * complex(np.exp(1j * np.radians(piece.degrees)))
                upper = 1.0 if choice.split else float(choice.each)
                found.append(_Column(plane, effect, piece, not choice.split, upper))
    return found


def _counts(choices: tuple[Choice | None, ...], columns: list[_Column]) -> list[LinearConstraint]:
    """Most pieces at each position and in each plane."""
    rows: list[Array] = []
    limits: list[int] = []
    for plane, choice in enumerate(choices):
        if choice is None or choice.split:
            continue
        for pieces in choice.positions:
            rows.append(np.array([*(each.piece in pieces and each.plane == plane for each in columns), False], float))
            limits.append(choice.each)
        if choice.most is not None:
            rows.append(np.array([*(each.plane == plane for each in columns), False], float))
            limits.append(choice.most)
    return [LinearConstraint(np.array(rows), ub=np.array(limits, dtype=np.float64))] if rows else []
