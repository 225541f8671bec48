"""(13) by IPOPT on bench8 and on seeded random stands: the table of docs/results/optimal-control.md.

python tools/ocp_campaign.py [--stands 1] [--first 8000] [--seconds 120] [--rows TEXT] [--write]

Seconds are processor time, of the whole plan with the search that it starts from, and its verification. Exit status
1 where a programme that is given is not verified.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import campaign
from kept import Campaign, Columns, Figures
from plan_stands import campaign_motion, campaign_stand

import mahovik.stands
from mahovik.core.motion.required import RequiredMotion, load_motion
from mahovik.core.stand import load
from mahovik.core.stand.model import Stand
from mahovik.use.plan import Plan, PlanOptions, plan_motion

STANDS = Path(mahovik.stands.__file__).parent


@dataclass(frozen=True, eq=False)
class Case:
    """A stand with its motion."""

    name: str
    stand: Stand
    motion: RequiredMotion


def cases(first: int, number: int) -> Iterator[Case]:
    """bench8, rocking and spinning; then seeds of N = 7, 8, 10."""
    bench8 = load(STANDS / "bench8.toml")
    motion = load_motion(STANDS / "bench8.motion.json", bench8)
    yield Case("bench8", bench8, motion)
    yield Case("bench8, spin", bench8, replace(motion, winding="spin"))
    for N in (7, 8, 10):
        for seed in range(first, first + number):
            yield Case(f"N = {N}, seed {seed}", campaign_stand(seed, N), campaign_motion(seed, N))


TABLE = Columns(
    {
        "stand": "{}", "status": "{}", "iterations": "{}", "s": "{:.1f}",
        "raw residual": "{:.0e}", "residual": "{:.0e}", "J / J of `fourier`": "{:.5g} / {:.5g}",
    },
    None,
)  # fmt: skip


def line(case: Case, found: Plan, seconds: float) -> tuple[object, ...]:
    """A line of the table."""
    if not found.programmes:
        why = "; ".join(found.words)
        words = f"{found.status} {found.reason}: {why}"
        return case.name, words, None, seconds, None, None, None
    report: Any = found.programmes[0].report
    own = report["ocp"]
    return (
        case.name, f"{found.status}, {report['kind']}", own["iterations"], seconds, own["raw_residual"],
        report["residual"], (own["objective"], own["objective_of_start"]),
    )  # fmt: skip


def page(found: Figures) -> str:
    """The table."""
    return (
        f"Stands of each N: {found['stands']}, seeds from {found['first']}. Processor seconds with search and "
        "verification; the largest relative residual between the nodes as IPOPT left it, and of the programme; J of "
        f"(13) over that of the Fourier programme it started from.\n\n{TABLE.text(found['rows'])}"
    )


CAMPAIGN = Campaign(
    "optimal-control",
    campaign.Block("docs/results/optimal-control.md", "campaign: tools/ocp_campaign.py --write"),
    page,
)


def main() -> None:
    """Runs the cases and writes the page."""
    asked = campaign.parser(__doc__, stands=1, first=8000, seconds=120.0, rows="", write=False).parse_args()
    lines, wrong = [], []
    for case in cases(asked.first, asked.stands):
        if asked.rows not in case.name:
            continue
        begun = time.process_time()
        found = plan_motion(case.stand, case.motion, PlanOptions(seconds=asked.seconds, method="ocp"))
        lines.append(line(case, found, time.process_time() - begun))
        print(*lines[-1], sep="   ", flush=True)
        wrong += [f"{case.name}: not verified" for p in found.programmes if not p.report["verified"]]
    if asked.write and not asked.rows:
        settings = {"first": asked.first, "stands": asked.stands, "seconds": asked.seconds}
        CAMPAIGN.keep({**settings, "rows": TABLE.rows(lines)}, asked.first)
    print(*wrong, sep="\n")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
