"""How much quieter `mahovik quiet` makes sat4 and seeded random satellites: the tables of docs/quiet.md.

python tools/quiet_campaign.py [--stands 6] [--first 100] [--jobs 1] [--write]

Every figure "after" is simulated by the emitted C. Exit status 1 where a simulation disagrees with first order, where
the momentum is not kept, or where sat4 with small differences of speed is not ten times quieter.
"""

from __future__ import annotations

import argparse
import math
import os
import sys
import time
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np
from marked import put
from quiet_stands import satellite, speeds_before

from mahovik.core.stand import load
from mahovik.stands import path
from mahovik.use.study.quiet import QuietOptions, QuietResult, quiet
from mahovik.use.study.quiet.wheels import momentum_axes

PAGE = Path(__file__).resolve().parents[1] / "docs" / "quiet.md"
BEGIN, END = "<!-- campaign: tools/quiet_campaign.py --write -->", "<!-- end of campaign -->"
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
    """Of one choice. `off`: difference of simulated and expected RMS to the RMS before; `seconds` of the processor."""

    before: float
    after: float
    reduction: float
    change: float
    off: float
    momentum_error: float
    seconds: float
    good: bool


def outcome(found: QuietResult, seconds: float) -> Outcome:
    """Its figures."""
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


def sat4_lines(outcomes: Sequence[Outcome]) -> list[str]:
    """The first table."""
    found = [
        "| momentum, N m s | | axes | change of speeds, rpm | RMS before, m/s2 | simulated after | times lower |",
        "|---|---|---|---:|---:|---:|---:|",
    ]
    for row, each in zip(SAT4, outcomes, strict=True):
        momentum = " ".join(f"{x:g}" for x in row.momentum)
        found.append(
            f"| {momentum} | {row.name} | {row.axes} | {each.change:.3g} | {each.before:.3g} | {each.after:.3g} "
            f"| {times(each.reduction)} |"
        )
    return found


def times(x: float) -> str:
    """A reduction with as many digits as mean something."""
    return f"{x:.1f}" if x < 100.0 else f"{x:.0e}".replace("e+0", "e")


def random_lines(found: Sequence[tuple[RandomRow, Sequence[Outcome | str]]]) -> list[str]:
    """The second table."""
    text = [
        "| wheels | | found | times lower: least | median | most | simulated less expected, of RMS before "
        "| median, s |",
        "|---:|---|---|---:|---:|---:|---:|---:|",
    ]
    for row, outcomes in found:
        good = [each for each in outcomes if isinstance(each, Outcome)]
        lower = sorted(each.reduction for each in good) or [math.nan]
        off = max((each.off for each in good), default=math.nan)
        spent = float(np.median([each.seconds for each in good])) if good else math.nan
        text.append(
            f"| {row.N} | {row.name} | {len(good)} of {len(outcomes)} | {times(lower[0])} "
            f"| {times(float(np.median(lower)))} | {times(lower[-1])} | {off:.0e} | {spent:.1f} |"
        )
    return text


def main() -> None:
    """Runs both tables and writes the page."""
    options = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    options.add_argument("--stands", type=int, default=6, help="stands a row")
    options.add_argument("--first", type=int, default=100, help="first seed")
    options.add_argument("--jobs", type=int, default=1)
    options.add_argument("--write", action="store_true", help="into docs/quiet.md")
    asked = options.parse_args()
    with ProcessPoolExecutor(asked.jobs) as pool:
        sat4 = list(pool.map(of_sat4, SAT4))
        print(*sat4_lines(sat4), sep="\n", flush=True)
        found = []
        for row in ROWS:
            seeds = range(asked.first, asked.first + asked.stands)
            found.append((row, list(pool.map(of_random, [row] * asked.stands, seeds))))
            print(random_lines(found[-1:])[-1], flush=True)
    wrong = [f"sat4, {row.momentum}: {each}" for row, each in zip(SAT4, sat4, strict=True) if not each.good]
    wrong += [f"sat4, {row.momentum}: required" for row, each in zip(SAT4, sat4, strict=True)
              if row.required and each.reduction < REQUIRED]  # fmt: skip
    wrong += [f"{row}: {each}" for row, outcomes in found for each in outcomes
              if isinstance(each, Outcome) and not each.good]  # fmt: skip
    for row, outcomes in found:
        print(*(f"{row.N} {row.name}: {each}" for each in outcomes if isinstance(each, str)), sep="\n", end="")
    if asked.write:
        write([
            *sat4_lines(sat4), "",
            f"Stands a row: {asked.stands}, seeds from {asked.first}; times of the processor, with simulations.", "",
            *random_lines(found),
        ])  # fmt: skip
    print(*wrong, sep="\n")
    sys.exit(1 if wrong else 0)


def write(lines: Sequence[str]) -> None:
    """The tables between the marks of the page."""
    put(PAGE, BEGIN, END, lines)


if __name__ == "__main__":
    main()
