"""How often and how fast run-ups and run-downs are found, on seeded random stands: the table of docs/results/run-up.md.

python tools/runup_campaign.py [--stands 10] [--first 7000] [--verify 1] [--rows TEXT] [--write]

Times are processor times, of run-up and run-down together, without the plan and the verification. Exit status 1 where
the independent verification refuses a table.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace

import campaign
import numpy as np
from kept import Campaign, Columns, Figures
from plan_stands import campaign_motion, campaign_stand

from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import Bounds
from mahovik.use.plan import PlanOptions, plan_motion
from mahovik.use.plan.certificate import certify, failed_items
from mahovik.use.plan.runup import shortcomings, with_runup

KEYS = ("runup", "rundown")


@dataclass(frozen=True)
class Row:
    """A line of the table: flywheels, windings, seconds; share of the plain run-up's deviation that is allowed."""

    N: int
    winding: str
    duration: float
    share: float | None = None

    @property
    def name(self) -> str:
        """The row in words."""
        bound = f", deviation to {self.share:g} of that without bound" if self.share else ""
        return f"{self.winding}, {self.duration:g} s{bound}"


ROWS = (
    *(Row(N, "spin", 1.0) for N in (8, 7, 10, 12)),
    *(Row(8, "spin", duration) for duration in (0.5, 0.3)),
    *(Row(6, "rock", duration) for duration in (1.0, 0.3)),
    *(Row(8, "spin", 1.0, share) for share in (0.8, 0.6)),
)


@dataclass(frozen=True)
class Outcome:
    """Result for one stand: tables inside their bounds, processor s, deviation (m, rad) and error of each table."""

    found: int
    seconds: float
    deviation: tuple[tuple[float, float], ...]
    errors: tuple[float, ...]
    wrong: str


def outcome(row: Row, seed: int, verify: bool) -> Outcome | None:
    """Run-up and run-down of the programme of a seed; None: no programme."""
    stand = campaign_stand(seed, row.N)
    motion = replace(campaign_motion(seed, row.N, winding=row.winding), runup=row.duration)
    planned = plan_motion(stand, replace(motion, runup=None), PlanOptions(seconds=30.0, verify=False))
    if not planned.programmes:
        return None
    programme = planned.programmes[0]
    if row.share is not None:
        plain = with_runup(stand, motion, programme)
        if plain.runup is None or plain.rundown is None:
            return None
        limits = row.share * np.max([deviation_of(plain, key) for key in KEYS], axis=0)
        motion = replace(motion, bounds=Bounds(deviation=(np.inf, float(limits[1]))))
    begun = time.process_time()
    made = with_runup(stand, motion, programme)
    seconds = time.process_time() - begun
    there = [key for key, table in zip(KEYS, (made.runup, made.rundown), strict=True) if table is not None]
    names = {"runup": "run-up", "rundown": "run-down"}
    good = [key for key in there if not any(line.startswith(names[key]) for line in shortcomings(made))]
    wrong = failed_items(certify(stand, motion, made)) if verify else ""
    errors = tuple(made.report[key]["terminal_error"] for key in there)
    return Outcome(len(good), seconds, tuple(deviation_of(made, key) for key in there), errors, wrong)


def deviation_of(programme: Programme, key: str) -> tuple[float, float]:
    """Deviation of a table: m, rad."""
    found = programme.report[key]["deviation"]
    return found["linear"]["largest"], found["angular"]["largest"]


TABLE = Columns(
    {
        "flywheels": "{}", "windings, duration": "{}", "found": "{} of {}", "median, s": "{:.1f}",
        "longest, s": "{:.1f}", "O1 strays, mm: median, most": "{:.2f}, {:.2f}",
        "E1 turns, mrad: median, most": "{:.1f}, {:.1f}", "largest terminal error": "{:.0e}",
    },
    None,
)  # fmt: skip


def line(row: Row, outcomes: Sequence[Outcome]) -> tuple[object, ...]:
    """A line of the table."""
    spent = sorted(each.seconds for each in outcomes)
    away = 1e3 * np.array([x for each in outcomes for x in each.deviation]).reshape(-1, 2)
    errors = [x for each in outcomes for x in each.errors]
    strays, turns = ([float(np.median(away[:, k])), float(away[:, k].max())] for k in (0, 1))
    found = [sum(each.found for each in outcomes), 2 * len(outcomes)]
    return row.N, row.name, found, np.median(spent), spent[-1], strays, turns, max(errors)


def page(found: Figures) -> str:
    """The table."""
    return (
        f"{found['stands']} stands per row, seeds from {found['first']}; tables of the first {found['verified']} of a "
        "row are put through the independent verification. A stand without a programme is left out. Found counts "
        "run-ups and run-downs that keep their bounds; seconds are for both, without the verification.\n\n"
        f"{TABLE.text(found['rows'])}"
    )


CAMPAIGN = Campaign(
    "run-up",
    campaign.Block("docs/results/run-up.md", "campaign: tools/runup_campaign.py --write"),
    page,
)


def main() -> None:
    """Runs the rows and writes the page."""
    options = campaign.parser(__doc__, stands=10, first=7000, rows="", write=False)
    options.add_argument("--verify", type=int, default=1, help="stands of a row whose tables are verified")
    asked = options.parse_args()
    lines, wrong = [], []
    for row in ROWS:
        if asked.rows not in f"{row.N} {row.name}":
            continue
        seeds = campaign.seeds(asked.first, asked.stands)
        found = [(seed, outcome(row, seed, seed - asked.first < asked.verify)) for seed in seeds]
        planned = [each for _, each in found if each is not None]
        if planned:
            lines.append(line(row, planned))
            print(campaign.row(*lines[-1]), flush=True)
        wrong += [f"{row.N} {row.name}, seed {seed}: {o.wrong}" for seed, o in found if o is not None and o.wrong]
    if asked.write and not asked.rows:
        settings = {"first": asked.first, "stands": asked.stands, "verified": asked.verify}
        CAMPAIGN.keep({**settings, "rows": TABLE.rows(lines)}, asked.first)
    print(*wrong, sep="\n")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
