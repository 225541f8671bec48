"""How much quieter `mahovik quiet` makes sat4 and seeded random satellites: the tables of docs/results/quiet.md.

python tools/quiet_campaign.py [--stands 6] [--first 100] [--jobs 1] [--write]

Every figure "after" is simulated by the emitted C. Exit status 1 where a simulation disagrees with first order, where
the momentum is not kept, or where sat4 with small differences of speed is not ten times quieter.
"""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import campaign
import numpy as np
from kept import Campaign, Columns, Figures
from quiet_stands import satellite, speeds_before

from mahovik.core.stand import load
from mahovik.stands import path
from mahovik.use.study.quiet import QuietOptions, QuietResult, quiet
from mahovik.use.study.quiet.options import momentum_axes

RPM = math.pi / 30.0
BAND = (20.0, 200.0)
REQUIRED = 10.0
AXES = {
    "x, y, z": ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)),
    "z": ((0.0, 0.0, 1.0),),
}


@dataclass(frozen=True)
class Sat4Row:
    """A line of the first table: momentum (N m s), speeds before off those of least norm by +-`off` rpm of none."""

    name: str
    momentum: tuple[float, float, float]
    off: float
    change: float | None
    axes: str = "x, y, z"
    required: bool = False

    def run(self) -> QuietResult:
        """One choice."""
        stand = load(path("sat4"))
        axes = momentum_axes(stand)
        before = np.linalg.pinv(axes) @ self.momentum + self.off * RPM * np.array([1.0, -1.0, 1.0, -1.0])
        change = None if self.change is None else self.change * RPM
        speeds = tuple(float(x) for x in before)
        return quiet(stand, QuietOptions("acc1", BAND, self.momentum, speeds, AXES[self.axes], change=change))


SAT4 = (
    *(
        Sat4Row("along z, small differences", (0.0, 0.0, h), off, 20.0, required=True)
        for h, off in ((14.0, 9.0), (22.0, -12.0), (-14.0, 9.0), (9.0, 15.0))
    ),
    Sat4Row("along z, small differences", (0.0, 0.0, 14.0), 9.0, 20.0, "z", required=True),
    Sat4Row("along x, small differences", (14.0, 0.0, 0.0), 9.0, 20.0),
    Sat4Row("along y, small differences", (0.0, 14.0, 0.0), 9.0, 20.0),
    Sat4Row("along x, small differences", (14.0, 0.0, 0.0), 9.0, 20.0, "z"),
    Sat4Row("general, small differences", (3.0, 2.0, 9.0), 9.0, 20.0),
    Sat4Row("none, bias 3000 rpm, small differences", (0.0, 0.0, 0.0), 3000.0, 20.0),
    Sat4Row("along z, any change", (0.0, 0.0, 10.0), 1250.0, None),
    Sat4Row("general, any change", (2.0, 1.0, 3.0), 1250.0, None),
    Sat4Row("general, any change", (3.0, 2.0, 9.0), 1250.0, None),
)


@dataclass(frozen=True)
class RandomRow:
    """A line of the second table."""

    name: str
    N: int
    suspended: float | None = None
    options: dict[str, Any] = field(default_factory=dict)


KEPT = {"least": 1300.0 * RPM}
ROWS = (
    *(RandomRow("free, any speed", N) for N in (4, 6, 8)),
    *(RandomRow("free, no wheel below 1300 rpm", N, None, KEPT) for N in (5, 6, 8)),
    RandomRow("on 8 Hz, any speed", 6, 8.0),
    RandomRow("on 8 Hz, no wheel below 1300 rpm", 6, 8.0, KEPT),
    RandomRow("on 40 Hz, modes avoided, no wheel below 1300 rpm", 6, 40.0, {**KEPT, "modes": True}),
)


@dataclass(frozen=True)
class Outcome:
    """Result of one choice. `off`: simulated minus expected RMS over the RMS before; processor `seconds`."""

    before: float
    after: float
    reduction: float
    change: float
    off: float
    momentum_error: float
    seconds: float
    good: bool


def outcome(found: QuietResult, seconds: float) -> Outcome:
    """Figures of a search for quiet speeds."""
    after, before = found.after, found.before
    assert after.simulated is not None
    assert after.expected is not None
    assert before.simulated is not None
    assert before.expected is not None
    off = max(abs(each.simulated - each.expected) for each in (before, after)) / before.free  # type: ignore[operator]
    change = float(np.abs(after.speeds - before.speeds).max()) / RPM
    kept = found.momentum_error <= 1e-12 * max(1.0, float(np.abs(found.wheels.momentum).max()))
    return Outcome(
        before.free, after.simulated, found.reduction, change, off, found.momentum_error, seconds, found.agrees and kept
    )


def of_sat4(row: Sat4Row) -> Outcome:
    """One line of the first table."""
    begun = time.process_time()
    found = row.run()
    return outcome(found, time.process_time() - begun)


def of_random(row: RandomRow, seed: int) -> Outcome | str:
    """One stand of the second table; in words why there is none."""
    from mahovik.errors import CheckError

    begun = time.process_time()
    stand = satellite(seed, row.N, row.suspended)
    speeds = speeds_before(seed, stand, momentum_axes(stand))
    try:
        found = quiet(stand, QuietOptions("bench", BAND, speeds=tuple(speeds.tolist()), **row.options))
    except CheckError as error:
        return str(error)
    return outcome(found, time.process_time() - begun)


def times(x: float) -> str:
    """A reduction with as many digits as mean something."""
    return f"{x:.1f}" if x < 100.0 else f"{x:.0e}".replace("e+0", "e")


SAT4_TABLE = Columns(
    {
        "momentum, N m s": "{:g} {:g} {:g}", "": "{}", "axes": "{}", "change of speeds, rpm": "{:.3g}",
        "RMS before, m/s2": "{:.3g}", "simulated after": "{:.3g}", "times lower": times,
    },
    3,
)  # fmt: skip
RANDOM_TABLE = Columns(
    {
        "wheels": "{}", "": "{}", "found": "{} of {}", "times lower: least": times, "median": times, "most": times,
        "simulated less expected, of RMS before": "{:.0e}", "median, s": "{:.1f}",
    },
    3,
)  # fmt: skip


def sat4_line(row: Sat4Row, each: Outcome) -> tuple[object, ...]:
    """A line of the first table."""
    return row.momentum, row.name, row.axes, each.change, each.before, each.after, each.reduction


def random_line(row: RandomRow, outcomes: Sequence[Outcome | str]) -> tuple[object, ...]:
    """A line of the second table."""
    good = [each for each in outcomes if isinstance(each, Outcome)]
    lower = sorted(each.reduction for each in good) or [math.nan]
    off = max((each.off for each in good), default=math.nan)
    spent = float(np.median([each.seconds for each in good])) if good else math.nan
    lows = lower[0], float(np.median(lower)), lower[-1]
    return row.N, row.name, (len(good), len(outcomes)), *lows, off, spent


def page(found: Figures) -> str:
    """Both tables."""
    return (
        f"{SAT4_TABLE.text(found['sat4'])}\nStands per row: {found['stands']}, seeds from {found['first']}; processor "
        f"times, with simulations.\n\n{RANDOM_TABLE.text(found['random'])}"
    )


CAMPAIGN = Campaign(
    "quiet",
    campaign.Block("docs/results/quiet.md", "campaign: tools/quiet_campaign.py --write"),
    page,
)


def main() -> None:
    """Runs both tables and writes the page."""
    asked = campaign.parser(__doc__, stands=6, first=100, jobs=1, write=False).parse_args()
    sat4 = list(campaign.map_rows(of_sat4, asked.jobs, SAT4))
    rows = SAT4_TABLE.rows(map(sat4_line, SAT4, sat4))
    print(SAT4_TABLE.text(rows), flush=True)
    found = []
    for row in ROWS:
        seeds = campaign.seeds(asked.first, asked.stands)
        found.append((row, list(campaign.map_rows(of_random, asked.jobs, [row] * asked.stands, seeds))))
        print(*random_line(*found[-1]), sep="   ", flush=True)
    wrong = [f"sat4, {row.momentum}: {each}" for row, each in zip(SAT4, sat4, strict=True) if not each.good]
    wrong += [f"sat4, {row.momentum}: required" for row, each in zip(SAT4, sat4, strict=True)
              if row.required and each.reduction < REQUIRED]  # fmt: skip
    wrong += [f"{row}: {each}" for row, outcomes in found for each in outcomes
              if isinstance(each, Outcome) and not each.good]  # fmt: skip
    for row, outcomes in found:
        print(*(f"{row.N} {row.name}: {each}" for each in outcomes if isinstance(each, str)), sep="\n", end="")
    if asked.write:
        lines = RANDOM_TABLE.rows(random_line(*each) for each in found)
        CAMPAIGN.keep({"first": asked.first, "stands": asked.stands, "sat4": rows, "random": lines}, asked.first)
    print(*wrong, sep="\n")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
