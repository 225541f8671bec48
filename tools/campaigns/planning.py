"""How often and how fast `mahovik plan` finds programmes on seeded random stands; each is verified independently."""

from __future__ import annotations

import time
from argparse import Namespace
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from plan_stands import NO_BOUNDS, PERIOD, campaign_motion, campaign_move, campaign_stand

from campaigns import Row, Rows, Table, side_by_side
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand.model import Stand
from mahovik.use.plan.outcome import PlanOptions, certify, failed_items
from mahovik.use.plan.planner import plan_motion

OPTIONS = {"stands": 4, "first": 5000, "seconds": 30.0, "rows": "", "jobs": 1}
"""`seconds`: after which a search is cut; `rows`: only rows that hold this text."""

OMEGA = 2.0 * np.pi / PERIOD


@dataclass(frozen=True)
class Case:
    """A row: N flywheels, windings, what differs from the usual stand and motion; accelerations over OMEGA^2."""

    name: str
    N: int
    winding: str
    unbalance: float = 1.0
    acceleration: float | None = None
    torque: float | None = None
    finite: bool = False
    motion: dict[str, Any] = field(default_factory=dict)

    def problem(self, seed: int) -> tuple[Stand, RequiredMotion]:
        """Stand and motion of a seed."""
        stand = campaign_stand(seed, self.N, self.unbalance)
        if self.finite:
            return stand, campaign_move(seed, self.N)
        bounds = NO_BOUNDS
        if self.acceleration is not None:
            bounds = replace(bounds, acceleration=(self.acceleration * OMEGA**2,) * self.N)
        if self.torque is not None:
            bounds = replace(bounds, torque=(self.torque,) * self.N)
        return stand, campaign_motion(seed, self.N, winding=self.winding, bounds=bounds, **self.motion)


TWO, CLOSE = {"harmonics": (1, 2)}, {"harmonics": (2, 3), "period": 0.2}
THREE = {"harmonics": (1, 2, 3)}
CASES = (
    Case("rock", 6, "rock"),
    *(Case(kind, N, kind) for N in (7, 8) for kind in ("spin", "rock")),
    *(Case("spin", N, "spin") for N in (9, 10, 11, 12, 16, 24)),
    Case("six axes, spin", 8, "spin", motion={"axes": 6}),
    Case("three axes, spin", 8, "spin", motion={"axes": 3}),
    Case("3 x amplitude, spin", 8, "spin", motion={"amplitude": 3.0}),
    Case("0.4 x unbalance, spin", 8, "spin", unbalance=0.4),
    Case("six axes, rock", 6, "rock", motion={"axes": 6}),
    Case("3 x amplitude, rock", 6, "rock", motion={"amplitude": 3.0}),
    Case("0.4 x unbalance, rock", 6, "rock", unbalance=0.4),
    Case("10 + 20 Hz, spin", 8, "spin", motion=TWO),
    Case("10 + 15 Hz, spin", 8, "spin", motion=CLOSE),
    Case("three harmonics, spin", 8, "spin", motion=THREE),
    Case("10 + 15 Hz, rock", 6, "rock", motion=CLOSE),
    Case("acceleration to 0.5 Omega^2, rock", 6, "rock", acceleration=0.5),
    Case("acceleration to 0.5 Omega^2, spin", 8, "spin", acceleration=0.5),
    Case("acceleration to 0.5 Omega^2, any", 8, "any", acceleration=0.5),
    Case("acceleration to 0.5 Omega^2, rock", 8, "rock", acceleration=0.5),
    Case("acceleration to 0.25 Omega^2, rock", 8, "rock", acceleration=0.25),
    Case("acceleration to 0.25 Omega^2, spin", 10, "spin", acceleration=0.25),
    Case("acceleration to 0.1 Omega^2, spin", 12, "spin", acceleration=0.1),
    Case("torque to 3 N m, spin", 8, "spin", torque=3.0),
    Case("finite, from rest to rest", 8, "any", finite=True),
    Case("finite, from rest to rest", 10, "any", finite=True),
)


def outcome(case: Case, seed: int, seconds: float) -> tuple[bool, float, float, str]:
    """Whether a programme was found, processor s, peak acceleration (rad/s2), objections of the verification."""
    stand, motion = case.problem(seed)
    begun = time.process_time()
    plan = plan_motion(stand, motion, PlanOptions(seconds=seconds, verify=False))
    spent = time.process_time() - begun
    if not plan.programmes:
        return False, spent, np.nan, ""
    programme = plan.programmes[0]
    peak = float(np.max(programme.report["peak_acceleration"]))
    return plan.status == "OK", spent, peak, failed_items(certify(stand, motion, programme))


def measure(options: Namespace) -> Iterator[tuple[Any, ...]]:
    """A row for each case."""
    seeds = range(options.first, options.first + options.stands)
    for case in CASES:
        if options.rows in f"{case.N} {case.name}":
            columns = [case] * len(seeds), seeds, [options.seconds] * len(seeds)
            good, spent, peaks, objections = zip(*side_by_side(outcome, options.jobs, *columns), strict=True)
            refused = sum(map(bool, objections))
            peak = (
                float(np.median([peak for peak, is_good in zip(peaks, good, strict=True) if is_good]))
                if any(good)
                else None
            )
            yield case.N, case.name, len(seeds), sum(good), refused, float(np.median(spent)), max(spent), peak


def is_verified(row: Row) -> bool:
    """Whether every programme passed the verification."""
    return bool(row["refused"] == 0)


def claim(rows: Rows) -> str:
    """How often and how fast programmes are found."""
    planned, stands = (sum(row[key] for row in rows) for key in ("found", "stands"))
    return (
        f"`plan` finds programmes for {planned} of {stands} random stands and motions, in a median of at most "
        f"{max(row['median, s'] for row in rows):.1f} s; the independent verification refuses "
        f"{sum(row['refused'] for row in rows)}"
    )


def plain_motions(rows: Rows) -> Rows:
    """The rows of the plain motion by number of flywheels, without those of harder variants."""
    return [row for row in rows if row["motion, windings"] in ("rock", "spin")]


TABLES = {
    "planning": Table(
        measure,
        {
            "flywheels": "{}", "motion, windings": "{}", "stands": "{}", "found": "{}", "refused": "{}",
            "median, s": "{:.1f}", "longest, s": "{:.1f}", "median peak acceleration, rad/s2": "{:.0f}",
        },
        claim,
        is_verified,
        "A carrier of 12 kg on a suspension of 1.5 Hz, flywheels of 0.5 to 1.2 kg with axes anywhere, their centres 4 "
        "to 10 mm off them. Motions of 10 Hz in x, y, z, psi, theta to 0.2 mm and 0.6 mrad; `Omega` = 2 pi 10 Hz. "
        "Processor times of the search.",
        shown=plain_motions,
        hidden=("refused",),
    )
}  # fmt: skip
