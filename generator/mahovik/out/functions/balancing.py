"""`balance`: correction weights from vibration, by influence coefficients. `balance_stand`: by the model of a stand."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from mahovik.core.stand.units import LENGTH
from mahovik.errors import UsageError
from mahovik.nearest import suggestion
from mahovik.out.api.stands import Stand
from mahovik.out.functions.given import Number, StandGiven, quantity
from mahovik.out.functions.table import Column, Table
from mahovik.use.balance import METHODS, Influence, Made, Solution, choose_pieces, read_influence, solve
from mahovik.use.balance.by_model import HALF_WIDTH, RADIUS, WheelBalance, balance_wheels
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
        raise UsageError(f'method: unknown "{method}"{suggestion(method, METHODS)}, expected {" or ".join(METHODS)}')
    problem = read_influence(influence)
    return Balance(problem, solve(problem, method), choose_pieces(problem) if problem.choices else None)


G_MM = 1e6
"""1 kg m in g mm."""


class StandBalance(Table):
    """Corrections of the flywheels of a stand: a row per plane. `notes`: what was found in the data, and corrected."""

    index = "flywheel"

    def __init__(self, stand: Stand, wheels: Sequence[WheelBalance], notes: Sequence[str]) -> None:
        self.stand, self.wheels, self.notes = stand, tuple(wheels), tuple(notes)

    @property
    def columns(self) -> tuple[Column, ...]:
        names = np.array([each.name for each in self.wheels for _ in each.positions], dtype=object)
        places = np.array([x for each in self.wheels for x in each.positions])
        w, error = (np.concatenate([getattr(each, key) for each in self.wheels]) for key in ("w", "error"))
        return (
            Column("flywheel", "", names),
            Column("plane", "m", places),
            Column("correction", "g mm", G_MM * np.abs(w)),
            Column("correction at", "deg", np.degrees(np.angle(w)) % 360.0),
            Column("residual", "g mm", G_MM * RADIUS * error),
        )

    def to_dict(self) -> dict[str, Any]:
        """All figures, as `mahovik balance --json` prints them."""
        return {
            "stand": self.stand.name,
            "flywheels": [_wheel_object(each) for each in self.wheels],
            "notes": list(self.notes),
        }

    def __repr__(self) -> str:
        return f"<StandBalance of {self.stand.name}: {len(self.wheels)} flywheels, {len(self)} planes>"


def _wheel_object(wheel: WheelBalance) -> dict[str, Any]:
    planes = []
    for x, w, error in zip(wheel.positions, wheel.w.tolist(), wheel.error.tolist(), strict=True):
        half = math.degrees(math.atan2(HALF_WIDTH * error, abs(w)))
        planes.append(
            {"position": x, "correction": {"g mm": G_MM * abs(w), "degrees": _exact(w)["degrees"]}}
            | {"interval": {"g mm": G_MM * HALF_WIDTH * error, "degrees": half}, "residual": G_MM * RADIUS * error}
        )
    left = RADIUS * wheel.static_error
    return {
        "name": wheel.name,
        "speed": wheel.speed,
        "planes": planes,
        "static": {"before": G_MM * abs(wheel.static), "residual": G_MM * left},
        "grade": {"before": wheel.grade(abs(wheel.static)), "residual": wheel.grade(left)},
        "vibration": {name: {"before": before, "after": after} for name, before, after in wheel.vibration},
        "fit": wheel.fit,
    }


def balance_stand(
    stand: StandGiven,
    data: str | Path | Sequence[str | Path],
    *,
    planes: Mapping[str, Sequence[Number]] | None = None,
) -> StandBalance:
    """Find corrections of all flywheels from measured data at constant speeds, without trial weights.

    stand   with the sensors as points; its own unbalances do not count
    data    files of measured data, with channels of sensors and phases of flywheels
    planes  positions on the axis of a flywheel by its name, m or texts with a unit, "all" for the others; None: one
            plane each, at the flywheel's origin

    Raises BalanceError, DataError, StandError, UsageError, CheckError.
    """
    from mahovik.use.measured import read_recordings

    own = Stand.of(stand)
    places = read_planes(own, planes or {})
    files = [Path(data)] if isinstance(data, str | Path) else [Path(each) for each in data]
    recordings = read_recordings(files, own)
    notes = [note for each in recordings for note in each.notes]
    return StandBalance(own, balance_wheels(own, recordings, places), notes)


def read_planes(stand: Stand, given: Mapping[str, Sequence[Number]]) -> dict[str, tuple[float, ...]]:
    """Positions of planes by flywheel, m. Raises UsageError."""
    names = [each.name for each in stand.flywheels]
    found: dict[str, tuple[float, ...]] = {}
    for name, values in given.items():
        if name not in (*names, "all"):
            raise UsageError(f'planes: unknown flywheel "{name}"{suggestion(name, names, "the stand has none")}')
        places = tuple(quantity(f"planes of {name}", each, LENGTH) for each in values)
        if not places or len(set(places)) < len(places):
            raise UsageError(f"planes of {name}: expected different positions, found {list(values)}")
        for each in names if name == "all" else [name]:
            if name != "all" or each not in given:
                found[each] = places
    return found
