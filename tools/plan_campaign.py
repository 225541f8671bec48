"""How often and how fast `mahovik plan` finds programmes on seeded random stands: docs/results/planning.md.

python tools/plan_campaign.py [--stands 4] [--first 5000] [--seconds 30] [--jobs 1] [--write]

Times are processor times, of the plan without its verification. Exit status 1 where a programme fails the independent
verification. What preflight refuses is the business of `refusal_campaign.py`.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import campaign
import numpy as np
from kept import Campaign, Columns, Figures
from plan_stands import NO_BOUNDS, PERIOD, campaign_motion, campaign_move, campaign_stand

from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand.model import Stand
from mahovik.use.plan import PlanOptions, plan_motion
from mahovik.use.plan.certificate import certify, failed_items

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
    """Result for one stand: status, processor s, peak acceleration (rad/s2), objections of the verification."""

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


TABLE = Columns(
    {
        "flywheels": "{}", "motion, windings": "{}", "found": "{} of {}", "median, s": "{:.1f}", "longest, s": "{:.1f}",
        "median peak acceleration, rad/s2": "{:.0f}",
    },
    None,
)  # fmt: skip


def line(row: Row, outcomes: Sequence[Outcome]) -> tuple[object, ...]:
    """A line of the table."""
    good = [each for each in outcomes if each.status == "OK"]
    spent = sorted(each.seconds for each in outcomes)
    peak = np.median([each.peak for each in good]) if good else None
    return row.N, row.name, (len(good), len(outcomes)), np.median(spent), spent[-1], peak


def page(found: Figures) -> str:
    """The table."""
    verified = found["verified"]
    whose = "every programme is" if verified is None else f"programmes of the first {verified} of a row are"
    return (
        f"{found['stands']} stands per row, seeds from {found['first']}, which were not used before; a plan is cut "
        f"after {found['seconds']:g} s; {whose} put through the independent verification, which refused "
        f"{found['refused']}.\n\n{TABLE.text(found['rows'])}"
    )


CAMPAIGN = Campaign(
    "planning",
    campaign.Block("docs/results/planning.md", "campaign: tools/plan_campaign.py --write"),
    page,
)


def main() -> None:
    """Runs the rows and writes the page."""
    options = campaign.parser(__doc__, stands=4, first=5000, seconds=30.0, jobs=1, rows="", write=False)
    options.add_argument("--verify", type=int, help="stands of a row whose programmes are verified; default all")
    asked = options.parse_args()
    seeds = campaign.seeds(asked.first, asked.stands)
    n = len(seeds)
    lines, wrong, peaks = [], [], []
    verified = n if asked.verify is None else asked.verify
    for row in ROWS:
        if asked.rows not in f"{row.N} {row.name}":
            continue
        columns = [row] * n, seeds, [asked.seconds] * n, [k < verified for k in range(n)]
        found = list(campaign.map_rows(outcome, asked.jobs, *columns))
        lines.append(line(row, found))
        peaks.append([each.peak if each.status == "OK" else None for each in found])
        wrong += [f"{row.N} {row.name}, seed {s}: {o.wrong}" for s, o in zip(seeds, found, strict=True) if o.wrong]
        print(campaign.row(*lines[-1]), *wrong, sep="\n", flush=True)
    if asked.write and not asked.rows:
        settings = {"first": asked.first, "stands": asked.stands, "seconds": asked.seconds, "verified": asked.verify}
        CAMPAIGN.keep({**settings, "refused": len(wrong), "rows": TABLE.rows(lines), "peaks": peaks}, asked.first)
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
