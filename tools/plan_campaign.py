"""How often and how fast `mahovik plan` finds programmes, on seeded random stands: the tables of docs/planning.md.

python tools/plan_campaign.py [--stands 4] [--first 5000] [--seconds 30] [--jobs 1] [--write]

Times are of the processor, of the plan without its verification. Exit status 1 where a programme fails the independent
verification. The page is written after each row; what preflight refuses is the business of `refusal_campaign.py`.
"""

from __future__ import annotations

import argparse
import os
import sys
import time
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np
from marked import put
from plan_stands import NO_BOUNDS, PERIOD, campaign_motion, campaign_move, campaign_stand

from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand.model import Stand
from mahovik.use.plan import PlanOptions, plan_motion
from mahovik.use.plan.certificate import certify, failed_items

PAGE = Path(__file__).resolve().parents[1] / "docs" / "planning.md"
BEGIN, END = "<!-- campaign: tools/plan_campaign.py --write -->", "<!-- end of campaign -->"
OMEGA = 2.0 * np.pi / PERIOD


@dataclass(frozen=True)
class Row:
    """A line of the table: N flywheels, windings, what differs from the usual stand and motion."""

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
ROWS = (
    Row("rock", 6, "rock"),
    *(Row(kind, N, kind) for N in (7, 8) for kind in ("spin", "rock")),
    *(Row("spin", N, "spin") for N in (9, 10, 11, 12, 16, 24)),
    Row("six axes, spin", 8, "spin", motion={"axes": 6}),
    Row("three axes, spin", 8, "spin", motion={"axes": 3}),
    Row("3 x amplitude, spin", 8, "spin", motion={"amplitude": 3.0}),
    Row("0.4 x unbalance, spin", 8, "spin", unbalance=0.4),
    Row("six axes, rock", 6, "rock", motion={"axes": 6}),
    Row("3 x amplitude, rock", 6, "rock", motion={"amplitude": 3.0}),
    Row("0.4 x unbalance, rock", 6, "rock", unbalance=0.4),
    Row("10 + 20 Hz, spin", 8, "spin", motion=TWO),
    Row("10 + 15 Hz, spin", 8, "spin", motion=CLOSE),
    Row("three harmonics, spin", 8, "spin", motion=THREE),
    Row("10 + 15 Hz, rock", 6, "rock", motion=CLOSE),
    Row("acceleration to 0.5 Omega^2, rock", 6, "rock", acceleration=0.5),
    Row("acceleration to 0.5 Omega^2, spin", 8, "spin", acceleration=0.5),
    Row("acceleration to 0.5 Omega^2, any", 8, "any", acceleration=0.5),
    Row("acceleration to 0.5 Omega^2, rock", 8, "rock", acceleration=0.5),
    Row("acceleration to 0.25 Omega^2, rock", 8, "rock", acceleration=0.25),
    Row("acceleration to 0.25 Omega^2, spin", 10, "spin", acceleration=0.25),
    Row("acceleration to 0.1 Omega^2, spin", 12, "spin", acceleration=0.1),
    Row("torque to 3 N m, spin", 8, "spin", torque=3.0),
    Row("finite, from rest to rest", 8, "any", finite=True),
    Row("finite, from rest to rest", 10, "any", finite=True),
)


@dataclass(frozen=True)
class Outcome:
    """Of one stand: status, s of the processor, peak acceleration (rad/s2), what the verification has against it."""

    status: str
    seconds: float
    peak: float
    wrong: str


def outcome(row: Row, seed: int, seconds: float, verify: bool) -> Outcome:
    """One plan."""
    stand, motion = row.problem(seed)
    begun = time.process_time()
    found = plan_motion(stand, motion, PlanOptions(seconds=seconds, verify=False))
    spent = time.process_time() - begun
    if not found.programmes:
        return Outcome(found.reason or found.status, spent, np.nan, "")
    programme = found.programmes[0]
    wrong = failed_items(certify(stand, motion, programme)) if verify else ""
    return Outcome(found.status, spent, float(np.max(programme.report["peak_acceleration"])), wrong)


def line(row: Row, outcomes: Sequence[Outcome]) -> str:
    """A line of the table."""
    good = [each for each in outcomes if each.status == "OK"]
    spent = sorted(each.seconds for each in outcomes)
    peak = f"{np.median([each.peak for each in good]):.0f}" if good else "-"
    median = f"{np.median(spent):.1f}"
    return f"| {row.N} | {row.name} | {len(good)} of {len(outcomes)} | {median} | {spent[-1]:.1f} | {peak} |"


def mapped(function: Callable[..., Any], jobs: int, *columns: Sequence[Any]) -> list[Any]:
    """The function of each, side by side where there are jobs."""
    if jobs == 1:
        return [function(*each) for each in zip(*columns, strict=True)]
    with ProcessPoolExecutor(jobs) as pool:
        return list(pool.map(function, *columns))


def main() -> None:
    """Runs the rows and writes the page."""
    options = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    options.add_argument("--stands", type=int, default=4, help="stands a row")
    options.add_argument("--first", type=int, default=5000, help="first seed")
    options.add_argument("--seconds", type=float, default=30.0, help="cut-off of a plan")
    options.add_argument("--jobs", type=int, default=1)
    options.add_argument("--rows", default="", help="those whose line holds this text")
    options.add_argument("--verify", type=int, help="stands of a row whose programmes are verified; default all")
    options.add_argument("--write", action="store_true", help="into docs/planning.md")
    asked = options.parse_args()
    seeds = list(range(asked.first, asked.first + asked.stands))
    n = len(seeds)
    lines, wrong = [], []
    verified = n if asked.verify is None else asked.verify
    for row in ROWS:
        if asked.rows not in f"{row.N} {row.name}":
            continue
        found = mapped(outcome, asked.jobs, [row] * n, seeds, [asked.seconds] * n, [k < verified for k in range(n)])
        lines.append(line(row, found))
        wrong += [f"{row.N} {row.name}, seed {s}: {o.wrong}" for s, o in zip(seeds, found, strict=True) if o.wrong]
        print(lines[-1], *wrong, sep="\n", flush=True)
        if asked.write:
            write(lines, len(wrong), asked)
    sys.exit(1 if wrong else 0)


def write(lines: Sequence[str], wrong: int, asked: argparse.Namespace) -> None:
    """The table between the marks of the page."""
    whose = "every programme is" if asked.verify is None else f"programmes of the first {asked.verify} of a row are"
    text = [
        f"{asked.stands} stands a row, seeds from {asked.first}, which were not used before; a plan is cut after "
        f"{asked.seconds:g} s; {whose} put through the independent verification, which refused {wrong}.",
        "",
        "| flywheels | motion, windings | found | median, s | longest, s | median peak acceleration, rad/s2 |",
        "|---|---|---|---|---|---|",
        *lines,
        "",
    ]
    put(PAGE, BEGIN, END, text)


if __name__ == "__main__":
    main()
