"""How well bench8 follows its programmes with mismatch: writes the tables of docs/results/following.md.

python tools/following_campaign.py [--seeds 10] [--mismatch 1] [--write]
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import campaign
import numpy as np

from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import RequiredMotion, load_motion
from mahovik.core.motion.servo import Servo, load_servo
from mahovik.core.stand import load
from mahovik.core.stand.model import Stand
from mahovik.stands import path, servos
from mahovik.use.control.causes import contributions
from mahovik.use.control.following import following
from mahovik.use.control.loop import Case, close_loop
from mahovik.use.control.mismatch import with_mismatch
from mahovik.use.control.trim import TrimDesign, design_trim
from mahovik.use.control.wanted import Wanted
from mahovik.use.plan.options import PlanOptions
from mahovik.use.plan.planner import plan_motion

BLOCK = campaign.Block("docs/results/following.md", "campaign: tools/following_campaign.py --write")

WINDINGS = ("spin", "rock")
LIMIT, TRIMMED = 0.05, 0.01
"""What must hold: shares of the carrier's amplitude, without and with trim."""

SETTLING, MEASURED, ROUNDS = 10, 10, 5
ROWS = 128
"""Of the programme's table, a period."""


@dataclass(frozen=True)
class Outcome:
    """Errors of one seed as shares, without and with trim; flywheels' largest distance from the programme, rad."""

    plain: float
    trimmed: float
    apart: float


def outcome(wanted: Wanted, servo: Servo, design: TrimDesign, share: float, seed: int) -> Outcome:
    """Both runs of a seed."""
    real = with_mismatch(wanted.stand, share, seed)
    off = replace(servo, trim=None)
    case = Case(wanted, real, off, SETTLING + MEASURED)
    plain = following(close_loop(case), MEASURED)
    periods = ROUNDS * (design.trim.settling + design.trim.averaging + 1) + MEASURED
    trimmed = following(close_loop(replace(case, servo=servo, design=design, periods=periods)), MEASURED)
    return Outcome(plain.share, trimmed.share, float(max(plain.apart.max(), trimmed.apart.max())))


HEAD = ("programme", "median", "worst", "within 5 %", "with trim: median", "worst", "within 1 %", "flywheels")


def line(name: str, found: Sequence[Outcome]) -> list[str]:
    """A row of the table."""
    cells = [name]
    for values, limit in ((np.array([o.plain for o in found]), LIMIT), (np.array([o.trimmed for o in found]), TRIMMED)):
        cells += [
            f"{100 * np.median(values):.2g} %",
            f"{100 * values.max():.2g} %",
            f"{int(np.sum(values <= limit))} of {len(values)}",
        ]
    cells.append(f"{1e3 * max(o.apart for o in found):.2g} mrad")
    return cells


def figures(stand: Stand, motion: RequiredMotion, programmes: dict[str, Programme], seeds: int, share: float) -> str:
    """The tables."""
    servo = load_servo(servos("bench8")[0], stand)
    assert servo.trim is not None
    rows, causes, designs = [], [], []
    for name, programme in programmes.items():
        wanted = Wanted.of(stand, motion, programme, ROWS)
        design = design_trim(stand, motion, wanted.programme, servo.trim)
        found = [outcome(wanted, servo, design, share, seed) for seed in range(1, seeds + 1)]
        rows.append(line(f"{name}, winding {', '.join(map(str, programme.winding))}", found))
        print(campaign.row(*rows[-1]), flush=True)
        wrong = f"{100 * design.margin:.2g} % wrong"
        designs.append(f"{name} {design.radius:.2g} of an error is left by a round, and it may be {wrong}")
        case = Case(wanted, with_mismatch(stand, share, 1), servo, SETTLING + MEASURED)
        for each in contributions(case):
            alone, without = ("lost" if x is None else f"{100 * x:.2g} %" for x in (each.alone, each.without))
            causes.append((name, each.cause.name, alone, without))
    return (
        "Error of the carrier about its mean, largest over a period, as a share of the amplitude; mismatch "
        f"{100 * share:g} %, seeds 1 to {seeds}; 1 kHz, latency a tenth of a sample, tables of {ROWS} nodes; trim "
        f"after {ROUNDS} rounds. The last column: the largest distance of a flywheel from its programme.\n\n"
        f"{campaign.table(HEAD, rows)}\n"
        f"By the nominal model of the trim: {'; '.join(designs)}.\n\n"
        "What limits it, seed 1, no trim: a run with each cause alone, and a run without it.\n\n"
        + campaign.table(("programme", "cause", "alone", "without it"), causes, 2)
    )


def main() -> None:
    """Plans, runs, and writes the page."""
    options = campaign.parser(__doc__, seeds=10, write=False)
    options.add_argument("--mismatch", type=float, default=1.0, help="per cent")
    asked = options.parse_args()
    stand = load(path("bench8"))
    motion = load_motion(path("bench8").with_suffix(".motion.json"), stand)
    programmes = {}
    for winding in WINDINGS:
        found = plan_motion(stand, motion, PlanOptions(0, None, winding, 1), None)
        programmes[winding] = found.programmes[0]
    text = figures(stand, motion, programmes, asked.seeds, asked.mismatch / 100.0)
    print(text)
    if asked.write:
        BLOCK.write(text)


if __name__ == "__main__":
    main()
