"""How well bench8 follows its programmes with mismatch: writes the tables of docs/results/following.md.

python tools/following_campaign.py [--seeds 10] [--mismatch 1] [--write]
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import campaign
import numpy as np
from kept import Campaign, Columns, Figures

from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import RequiredMotion, load_motion
from mahovik.core.motion.required.model import Winding
from mahovik.core.motion.servo import Servo, load_servo
from mahovik.core.stand import load
from mahovik.core.stand.model import Stand
from mahovik.stands import path, servos
from mahovik.use.control.causes import contributions
from mahovik.use.control.loop import Case, close_loop
from mahovik.use.control.mismatch import with_mismatch
from mahovik.use.control.record import following
from mahovik.use.control.reference_motion import ReferenceMotion
from mahovik.use.control.trim import TrimDesign, design_trim
from mahovik.use.plan.outcome import PlanOptions
from mahovik.use.plan.planner import plan_motion

WINDINGS: dict[str, Winding] = {"spin": "spin", "rock": "rock"}
LIMIT, TRIMMED = 0.05, 0.01
"""Accepted errors: shares of the carrier's amplitude, without and with trim."""

SETTLING, MEASURED, ROUNDS = 10, 10, 5
ROWS = 128
"""Rows of the programme's table in one period."""


@dataclass(frozen=True)
class Outcome:
    """Errors of one seed as shares, without and with trim; flywheels' largest distance from the programme, rad."""

    plain: float
    trimmed: float
    apart: float


def outcome(wanted: ReferenceMotion, servo: Servo, design: TrimDesign, share: float, seed: int) -> Outcome:
    """Both runs of a seed."""
    real = with_mismatch(wanted.stand, share, seed)
    off = replace(servo, trim=None)
    case = Case(wanted, real, off, SETTLING + MEASURED)
    plain = following(close_loop(case), MEASURED)
    periods = ROUNDS * (design.trim.settling + design.trim.averaging + 1) + MEASURED
    trimmed = following(close_loop(replace(case, servo=servo, design=design, periods=periods)), MEASURED)
    return Outcome(plain.share, trimmed.share, float(max(plain.apart.max(), trimmed.apart.max())))


PER_CENT = "{:.2g} %"
TABLE = Columns(
    {
        "programme": "{}", "median": PER_CENT, "worst": PER_CENT, "within 5 %": "{} of {}",
        "with trim: median": PER_CENT, "with trim: worst": PER_CENT, "within 1 %": "{} of {}",
        "flywheels": "{:.2g} mrad",
    }
)  # fmt: skip
CAUSES = Columns({"programme": "{}", "cause": "{}", "alone": PER_CENT, "without it": PER_CENT}, 2)


def line(name: str, found: Sequence[Outcome]) -> list[Any]:
    """A row of the table: per cent, and mrad."""
    cells: list[Any] = [name]
    for values, limit in ((np.array([o.plain for o in found]), LIMIT), (np.array([o.trimmed for o in found]), TRIMMED)):
        cells += [100 * np.median(values), 100 * values.max(), (int(np.sum(values <= limit)), len(values))]
    return [*cells, 1e3 * max(o.apart for o in found)]


def cause_lines(name: str, wanted: ReferenceMotion, servo: Servo, share: float) -> Iterator[tuple[object, ...]]:
    """Rows of the second table, seed 1: per cent."""
    case = Case(wanted, with_mismatch(wanted.stand, share, 1), servo, SETTLING + MEASURED)
    for each in contributions(case):
        yield name, each.cause.name, *(None if x is None else 100 * x for x in (each.alone, each.without))


def figures(
    stand: Stand, motion: RequiredMotion, programmes: dict[str, Programme], seeds: int, share: float
) -> Figures:
    """The figures to keep."""
    servo = load_servo(servos("bench8")[0], stand)
    assert servo.trim is not None
    rows, designs = [], []
    causes: list[tuple[object, ...]] = []
    for name, programme in programmes.items():
        wanted = ReferenceMotion.of(stand, motion, programme, ROWS)
        design = design_trim(stand, motion, wanted.programme, servo.trim)
        found = [outcome(wanted, servo, design, share, seed) for seed in range(1, seeds + 1)]
        rows.append(line(f"{name}, winding {', '.join(map(str, programme.winding))}", found))
        print(campaign.row(*rows[-1]), flush=True)
        designs.append({"programme": name, "left": design.radius, "wrong, per cent": 100 * design.margin})
        causes += cause_lines(name, wanted, servo, share)
    return {
        "mismatch, per cent": 100 * share,
        "seeds": seeds,
        "nodes": ROWS,
        "rounds": ROUNDS,
        "rows": TABLE.rows(rows),
        "designs": designs,
        "causes": CAUSES.rows(causes),
    }


def page(found: Figures) -> str:
    """The tables."""
    designs = [
        f"{each['programme']} {each['left']:.2g} of an error is left by a round, and it may be "
        f"{each['wrong, per cent']:.2g} % wrong"
        for each in found["designs"]
    ]
    return (
        "Error of the carrier about its mean, largest over a period, as a share of the amplitude; mismatch "
        f"{found['mismatch, per cent']:g} %, seeds 1 to {found['seeds']}; 1 kHz, latency a tenth of a sample, tables "
        f"of {found['nodes']} nodes; trim after {found['rounds']} rounds. The last column: the largest distance of a "
        f"flywheel from its programme.\n\n{TABLE.text(found['rows'])}\n"
        f"By the nominal model of the trim: {'; '.join(designs)}.\n\n"
        "What limits it, seed 1, no trim: a run with each cause alone, and a run without it.\n\n"
        + CAUSES.text(found["causes"])
    )


def programme_of(stand: Stand, motion: RequiredMotion, winding: Winding) -> Programme:
    """The programme of a winding."""
    return plan_motion(stand, motion, PlanOptions(0, None, winding, 1), None).programmes[0]


CAMPAIGN = Campaign(
    "following",
    campaign.Block("docs/results/following.md", "campaign: tools/following_campaign.py --write"),
    page,
)


def main() -> None:
    """Plans, runs, and writes the page."""
    options = campaign.parser(__doc__, seeds=10, write=False)
    options.add_argument("--mismatch", type=float, default=1.0, help="per cent")
    asked = options.parse_args()
    stand = load(path("bench8"))
    motion = load_motion(path("bench8").with_suffix(".motion.json"), stand)
    programmes = {name: programme_of(stand, motion, winding) for name, winding in WINDINGS.items()}
    found = figures(stand, motion, programmes, asked.seeds, asked.mismatch / 100.0)
    print(page(found))
    if asked.write:
        CAMPAIGN.keep(found, 1)


if __name__ == "__main__":
    main()
