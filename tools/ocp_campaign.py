"""(13) by IPOPT on bench8 and on seeded random stands: the table of docs/results/optimal-control.md.

python tools/ocp_campaign.py [--stands 1] [--first 8000] [--seconds 120] [--rows TEXT] [--write]

Seconds are of the processor, of the whole plan with the search that it starts from, and its verification. Exit status
1 where a programme that is given is not verified.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import campaign
from plan_stands import campaign_motion, campaign_stand

import mahovik.stands
from mahovik.core.motion.required import RequiredMotion, load_motion
from mahovik.core.stand import load
from mahovik.core.stand.model import Stand
from mahovik.use.plan import Plan, PlanOptions, plan_motion
from mahovik.use.plan.options import Method

BLOCK = campaign.Block("docs/results/optimal-control.md", "campaign: tools/ocp_campaign.py --write")
STANDS = Path(mahovik.stands.__file__).parent
METHODS: tuple[Method, ...] = ("ocp-partition", "ocp")


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


HEAD = (
    "stand", "method", "status", "partition", "iterations", "s", "raw residual", "residual", "J / J of `fourier`",
)  # fmt: skip


def line(case: Case, method: Method, found: Plan, seconds: float) -> tuple[object, ...]:
    """A line of the table."""
    if not found.programmes:
        why = "; ".join(found.words)
        words = f"{found.status} {found.reason}: {why}"
        return case.name, f"`{method}`", words, "", "", f"{seconds:.1f}", "", "", ""
    report: Any = found.programmes[0].report
    own, six = report["ocp"], report["ocp"]["partition"]
    held = f"{six['least_singular_value']:.1e}" if six["regular"] else f"0 at {len(six['det_zero_at'])} times"
    raw = "" if own["raw_residual"] is None else f"{own['raw_residual']:.0e}"
    return (
        case.name, f"`{method}`", f"{found.status}, {report['kind']}", f"{','.join(six['plus'])}: {held}",
        own["iterations"], f"{seconds:.1f}", raw, f"{report['residual']:.0e}",
        f"{own['objective']:.5g} / {own['objective_of_start']:.5g}",
    )  # fmt: skip


def main() -> None:
    """Runs the cases and writes the page."""
    asked = campaign.parser(__doc__, stands=1, first=8000, seconds=120.0, rows="", write=False).parse_args()
    lines, wrong = [], []
    for case in cases(asked.first, asked.stands):
        for method in METHODS if asked.rows in case.name else ():
            begun = time.process_time()
            found = plan_motion(case.stand, case.motion, PlanOptions(seconds=asked.seconds, method=method))
            lines.append(line(case, method, found, time.process_time() - begun))
            print(campaign.row(*lines[-1]), flush=True)
            wrong += [f"{case.name} {method}: not verified" for p in found.programmes if not p.report["verified"]]
    if asked.write:
        write(lines, asked)
    print(*wrong, sep="\n")
    sys.exit(1 if wrong else 0)


def write(lines: Sequence[Sequence[object]], asked: argparse.Namespace) -> None:
    """The table between the marks of the page."""
    BLOCK.write(
        f"Stands of each N: {asked.stands}, seeds from {asked.first}. The partition with the least singular value of "
        "I+ along the programme; seconds of the processor with search and verification; the largest relative residual "
        "between the nodes as IPOPT left it, and of the programme; J of (13) over that of the Fourier programme it "
        f"started from.\n\n{campaign.table(HEAD, lines, None)}"
    )


if __name__ == "__main__":
    main()
