"""How often and how fast `mahovik design` finds few flywheels for simple motions: the table of docs/results/design.md.

python tools/design_campaign.py [--seeds 10] [--first 7000] [--rows TEXT] [--write]

Times are processor times, of a whole design: search, least cost, programme, verification. Exit status 1 where a row
has fewer successes than eight in ten.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace

import campaign
import numpy as np
from kept import Campaign, Columns, Figures
from plan_stands import PERIOD, campaign_motion, campaign_stand

from mahovik.core.motion.required import RequiredMotion
from mahovik.core.motion.required.course import Harmonics
from mahovik.core.stand.model import Stand
from mahovik.use.design import DesignOptions, Outcome, design_stand
from mahovik.use.design.read import read_freedom

SECONDS = 60.0
FREE = """
schema = 1
quality = {quality}

[[free]]
position = {{ min = ["-250 mm", "-250 mm", "-250 mm"], max = ["250 mm", "250 mm", "250 mm"] }}
angles = true
unbalance = {{ min = 0, max = "20 kg mm" }}

[limits]
distance = "100 mm"
"""


@dataclass(frozen=True)
class Row:
    """A line of the table: flywheels, the coordinates that move, how, and the relative residual that is asked for."""

    name: str
    N: int
    quality: float

    def problem(self, seed: int) -> tuple[Stand, RequiredMotion]:
        """Stand and motion of a seed: 10 Hz, 0.2 mm, 0.6 mrad."""
        motion = campaign_motion(seed, self.N)
        rng = np.random.default_rng([seed, 99])
        cos, sin = np.zeros((1, 6)), np.zeros((1, 6))
        if self.name == "one axis":
            cos[0, rng.integers(3)] = 2e-4
        elif self.name == "translation in a plane":
            cos[0, :3], sin[0, :3] = rng.uniform(-2e-4, 2e-4, (2, 3))
        else:
            for k, size in ((2, 2e-4), (4, 6e-4), (5, 6e-4)):
                cos[0, k], sin[0, k] = rng.uniform(-size, size, 2)
        return campaign_stand(seed, self.N), replace(motion, course=Harmonics(PERIOD, (1,), cos, sin))


ROWS = (
    Row("one axis", 2, 1e-9),
    Row("translation in a plane", 2, 1e-9),
    Row("z and two rotations", 4, 1e-4),
)


def outcome(row: Row, seed: int) -> tuple[Outcome, float]:
    """One design, and the processor seconds that it took."""
    stand, motion = row.problem(seed)
    freedom = read_freedom(FREE.format(quality=row.quality), stand)
    begun = time.process_time()
    found = design_stand(stand, lambda _: motion, freedom, DesignOptions(seed=seed))
    return found, time.process_time() - begun


def good(row: Row, found: Outcome, seconds: float) -> bool:
    """Whether it is what the row asks for, in time."""
    return found.stand is not None and found.residual <= row.quality and seconds <= SECONDS


TABLE = Columns(
    {
        "motion": "{}", "flywheels": "{}", "relative residual asked": "{:g}", "found": "{} of {}",
        "verified as exact": "{}", "median residual": "{:.1g}", "worst": "{:.1g}", "median, s": "{:.1f}",
        "longest, s": "{:.1f}",
    },
    None,
)  # fmt: skip


def line(row: Row, found: Sequence[tuple[Outcome, float]]) -> tuple[object, ...]:
    """A line of the table."""
    some = [each for each, seconds in found if good(row, each, seconds)]
    exact = sum(each.status == "OK" for each in some)
    spent = sorted(seconds for _, seconds in found)
    median = np.median([each.residual for each in some]) if some else np.nan
    worst = max((each.residual for each in some), default=np.nan)
    return row.name, row.N, row.quality, (len(some), len(found)), exact, median, worst, np.median(spent), spent[-1]


def page(found: Figures) -> str:
    """The table."""
    return (
        f"{found['stands']} stands per row, seeds from {found['first']}; found within {found['seconds']:g} s of "
        f"processor time.\n\n{TABLE.text(found['rows'])}"
    )


CAMPAIGN = Campaign(
    "design",
    campaign.Block("docs/results/design.md", "campaign: tools/design_campaign.py --write"),
    page,
)


def main() -> None:
    """Runs the rows and writes the page."""
    asked = campaign.parser(__doc__, seeds=10, first=7000, rows="", write=False).parse_args()
    lines, few = [], False
    for row in ROWS:
        if asked.rows not in row.name:
            continue
        found = []
        for seed in campaign.seeds(asked.first, asked.seeds):
            found.append(outcome(row, seed))
            each, seconds = found[-1]
            print(f"{row.name}, seed {seed}: {each.status} {each.residual:.2g} {seconds:.1f} s", flush=True)
        few |= sum(good(row, *each) for each in found) < 0.8 * asked.seeds
        lines.append(line(row, found))
        print(campaign.row(*lines[-1]), flush=True)
    if asked.write and not asked.rows:
        rows = TABLE.rows(lines)
        first, stands = asked.first, asked.seeds
        CAMPAIGN.keep({"first": first, "stands": stands, "seconds": SECONDS, "rows": rows}, first)
    sys.exit(1 if few else 0)


if __name__ == "__main__":
    main()
