"""`balance_stand`: corrections of the flywheels of a stand from measured data, by its model."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from mahovik.errors import CheckError
from mahovik.out.api.stands import Stand
from mahovik.out.arguments import StandGiven
from mahovik.out.functions.correction_planes import PlanesGiven, load_planes, read_planes
from mahovik.out.functions.table import Column, Table
from mahovik.out.notices import warn_of_turn
from mahovik.use.balance.by_model import HALF_WIDTH, Change, WheelBalance, balance_wheels
from mahovik.use.balance.first_order import first_order
from mahovik.use.balance.simulated import simulate_balance
from mahovik.use.measured import Recording

G_MM = 1e6
"""1 kg m in g mm."""


class StandBalance(Table):
    """Corrections of the flywheels of a stand: a row per plane.

    wheels      by flywheel, SI
    recordings  that were read
    notes       what was found in the data, and corrected
    """

    index = "flywheel"

    def __init__(
        self, stand: Stand, wheels: Sequence[WheelBalance], recordings: Sequence[Recording], notes: Sequence[str]
    ) -> None:
        self.stand, self.wheels, self.recordings, self.notes = stand, tuple(wheels), tuple(recordings), tuple(notes)

    @property
    def columns(self) -> tuple[Column, ...]:
        names = np.array([each.name for each in self.wheels for _ in each.positions], dtype=object)
        places = np.array([x for each in self.wheels for x in each.positions])
        w, made, residual = (
            np.concatenate([getattr(each, key) for each in self.wheels]) for key in ("w", "applied", "residual")
        )
        found = [
            Column("flywheel", "", names),
            Column("plane", "m", places),
            Column("correction", "g mm", G_MM * np.abs(w)),
            Column("correction at", "deg", np.degrees(np.angle(w)) % 360.0),
        ]
        if any(each.made is not None for each in self.wheels):
            found += [
                Column("made", "g mm", G_MM * np.abs(made)),
                Column("made at", "deg", np.degrees(np.angle(made)) % 360.0),
            ]
        return (*found, Column("residual", "g mm", G_MM * residual))

    def to_dict(self) -> dict[str, Any]:
        """All figures, as `mahovik balance --json` prints them; SI where no key names another unit."""
        return {
            "stand": self.stand.name,
            "flywheels": [_wheel_object(each) for each in self.wheels],
            "notes": list(self.notes),
        }

    def report(self, path: str | Path) -> Path:
        """Write one page: corrections, orders against speed as measured, modelled and corrected, confidence.

        Raises UsageError: matplotlib is missing, or the file cannot be written.
        """
        from mahovik.out.report.data.balance import balance_parts
        from mahovik.out.report.page import write_page

        place = Path(path)
        parts = balance_parts(self.recordings, self.wheels, self.notes)
        files = [("data", each.source) for each in self.recordings]
        write_page(place, f"{self.stand.name}: balancing", parts, stand=self.stand, files=files)
        return place

    def __repr__(self) -> str:
        return f"<StandBalance of {self.stand.name}: {len(self.wheels)} flywheels, {len(self)} planes>"


def _wheel_object(wheel: WheelBalance) -> dict[str, Any]:
    planes = []
    columns = zip(wheel.positions, wheel.w.tolist(), wheel.error.tolist(), wheel.residual.tolist(), strict=True)
    for k, (x, w, error, residual) in enumerate(columns):
        half = math.degrees(math.atan2(HALF_WIDTH * error, abs(w)))
        plane = {
            "position": x,
            "correction": _vector(w),
            "interval": {"g mm": G_MM * HALF_WIDTH * error, "degrees": half},
            "residual": residual,
        }
        if wheel.made is not None:
            plane["made"] = _vector(complex(wheel.made.w[k]))
            plane["pieces"] = [
                {
                    "degrees": each.piece.degrees % 360.0,
                    "amount": each.piece.amount,
                    "radius": each.piece.radius,
                    "count": each.count,
                    "remove": each.piece.value < 0.0,
                }
                for each in wheel.made.placed
                if each.plane == k
            ]
        planes.append(plane)
    left = wheel.static_residual
    found: dict[str, Any] = {
        "name": wheel.name,
        "speed": wheel.speed,
        "planes": planes,
        "static": {"before": abs(wheel.static), "residual": left},
        "grade": {"before": wheel.grade(abs(wheel.static)), "residual": wheel.grade(left)},
        "vibration": _change(wheel.vibration),
        "fit": wheel.fit,
    }
    if wheel.simulated:
        found["simulated"] = _change(wheel.simulated)
    if wheel.made is not None:
        found["proven"] = wheel.made.proven
    return found


def _vector(value: complex) -> dict[str, float]:
    return {"g mm": G_MM * abs(value), "degrees": math.degrees(math.atan2(value.imag, value.real)) % 360.0}


def _change(rows: Change) -> dict[str, Any]:
    return {name: {"before": before, "after": after} for name, before, after in rows}


def balance_stand(
    stand: StandGiven,
    data: str | Path | Sequence[str | Path],
    *,
    planes: str | Path | PlanesGiven | None = None,
) -> StandBalance:
    """Find corrections of all flywheels from measured data at constant speeds, without trial weights.

    stand   with the sensors as points; its own unbalances do not count
    data    files of measured data, with channels of sensors and phases of flywheels
    planes  by flywheel, "all" for the others: positions on its axis, m or texts with a unit, or a table of
            "positions" and "pieces"; or a TOML file of such tables. None: one plane each, at the flywheel's origin

    Raises BalanceError, DataError, StandError, UsageError, CheckError.
    """
    from mahovik.use.measured import read_recordings

    own = Stand.of(stand)
    given = load_planes(Path(planes)) if isinstance(planes, str | Path) else planes
    places = read_planes(own, given or {})
    files = [Path(data)] if isinstance(data, str | Path) else [Path(each) for each in data]
    recordings = read_recordings(files, own)
    notes = [note for each in recordings for note in each.notes]
    wheels = balance_wheels(own, recordings, places)
    if own.hold is not None and own.hold.freedoms:
        notes.append("not simulated: the harmonic balance of the full equations takes no held carrier that moves yet")
        return StandBalance(own, wheels, recordings, notes)
    try:
        wheels = tuple(simulate_balance(own, wheels, [first_order(each, own) for each in recordings]))
        warn_of_turn(own)
    except CheckError as error:
        notes.append(f"not simulated: {error}")
    return StandBalance(own, wheels, recordings, notes)
