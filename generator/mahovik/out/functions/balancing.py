"""`balance`: correction weights from vibration, by influence coefficients."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from mahovik.errors import UsageError
from mahovik.nearest import suggestion
from mahovik.out.functions.table import Column, Table
from mahovik.use.balance import METHODS, Influence, Made, Solution, choose_pieces, read_influence, solve
from mahovik.use.balance.polar import Complex, write_polar

NOTHING = 1e-12
"""Part of the largest vibration before that is written as zero."""


class Balance(Table):
    """Correction weights: a row per plane.

    solution  any weights; made: those of pieces, None where any can be made
    """

    index = "plane"

    def __init__(self, problem: Influence, solution: Solution, made: Made | None) -> None:
        self.problem, self.solution, self.made = problem, solution, made

    @property
    def w(self) -> Complex:
        """Correction weights (N), for the rotor without trial weights, in the unit of the trial weights."""
        return self.solution.w

    @property
    def residual(self) -> Complex:
        """Vibration that is left (M)."""
        return self.solution.left

    @property
    def columns(self) -> tuple[Column, ...]:
        planes = np.arange(len(self.w))
        found = [Column("plane", "", planes), *_columns("correction", self.w)]
        if self.problem.trial is not None:
            found += _columns("to add", self.w - self.problem.trial)
        if self.made is not None:
            found += _columns("made", self.made.w)
        return tuple(found)

    def to_dict(self) -> dict[str, Any]:
        """All figures, as `mahovik balance --json` prints them."""
        zero = NOTHING * float(np.abs(self.problem.A).max())
        found: dict[str, Any] = {
            "w": [write_polar(each) for each in self.w.tolist()],
            "left": [write_polar(each, zero) for each in self.residual.tolist()],
            "corrections": [_exact(each) for each in self.w.tolist()],
            "largest": {"before": float(np.abs(self.problem.A).max()), "after": float(np.abs(self.residual).max())},
        }
        if self.solution.bound is not None:
            found["bound"] = self.solution.bound
        if self.solution.standard_error is not None:
            found["standard_error"] = self.solution.standard_error.tolist()
        if self.problem.trial is not None:
            found["add"] = [write_polar(each) for each in (self.w - self.problem.trial).tolist()]
        if self.made is not None:
            found["made"] = {
                "w": [write_polar(each) for each in self.made.w.tolist()],
                "left": [write_polar(each, zero) for each in self.made.left.tolist()],
                "largest": float(np.abs(self.made.left).max()),
                "proven": self.made.proven,
                "pieces": [
                    {"plane": each.plane, "degrees": each.piece.degrees % 360.0, "amount": each.piece.amount}
                    | {"radius": each.piece.radius, "count": each.count, "remove": each.piece.value < 0.0}
                    for each in self.made.placed
                ],
            }
        return found

    def __repr__(self) -> str:
        before, after = float(np.abs(self.problem.A).max()), float(np.abs(self.residual).max())
        return f"<Balance of {len(self.w)} planes: largest vibration {before:.4g} before, {after:.4g} after>"


def _columns(name: str, values: Complex) -> list[Column]:
    return [
        Column(name, "", np.abs(values)),
        Column(f"{name} at", "deg", np.degrees(np.angle(values)) % 360.0),
    ]


def _exact(value: complex) -> dict[str, float]:
    return {"amplitude": abs(value), "degrees": math.degrees(math.atan2(value.imag, value.real)) % 360.0}


def balance(influence: str | Path | Mapping[str, Any], *, method: str = "least-squares") -> Balance:
    """Find correction weights that undo a vibration.

    influence  a JSON file or an object like it: "A", and "B" and "U" of trial runs, or "ALPHA"; numbers are
               "amplitude@degrees"
    method     "least-squares", or "min-max" for the smallest largest vibration

    Raises BalanceError, CheckError, UsageError.
    """
    if method not in METHODS:
        raise UsageError(f'method: unknown "{method}"{suggestion(method, METHODS)}')
    problem = read_influence(influence)
    return Balance(problem, solve(problem, method), choose_pieces(problem) if problem.choices else None)
