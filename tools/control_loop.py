"""Cost of a control loop on an emulated Cortex-M7 and M4: writes the tables of docs/results/control-loop.md.

python tools/control_loop.py [--ticks 100000]
"""

from __future__ import annotations

import math
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import campaign
from kept import Campaign, Columns, Figures

from mahovik.core.emit.generate import generate_all
from mahovik.core.emit.literal import real_literal
from mahovik.core.emit.templates import template
from mahovik.core.stand import load
from mahovik.core.stand.model import Point, Stand
from mahovik.core.toolchain.board import build, run, version
from mahovik.core.toolchain.targets import TARGETS
from mahovik.stands import path

IMU = Point("imu", "carrier", (0.05, 0.0, 0.02), (0.0, 0.0, 0.0))

RATE = 1000
"""Hz; of the loop that is run. What a tick costs does not depend on it."""


@dataclass(frozen=True)
class Sway:
    """A motion for a stand, and where it is about.

    places   phases of the flywheels, rad
    center   of the carrier: position, m, and angles in the stand's sequence, rad
    linear, angular   amplitudes, m and rad
    """

    places: Sequence[float]
    center: Sequence[float]
    linear: Sequence[float]
    angular: Sequence[float]


BENCH8 = Sway(
    places=(-1.96, -0.61, -1.35, 0.12, -1.2, -0.19, -0.35, 0.68),
    center=(0.0, 0.0, 0.0, 0.0, 0.006582, 0.006415),
    linear=(3e-5, 3e-5, 3e-5),
    angular=(6e-5, 6e-5, 0.0),
)
"""For bench8: `mahovik rest` with these phases gives the centre; the least singular value is 0.36 of the largest."""


@dataclass(frozen=True)
class Counts:
    """Figures of a run: most instructions by stage and by kind of tick; the hash of the run; errors, SI.

    followed   largest error of the carrier's position while it follows the sway
    strayed    farthest from its rest under the sway that is too large
    observed   largest error of the observed velocity
    """

    stages: dict[str, int]
    ticks: dict[str, int]
    hash: int
    followed: float
    strayed: float
    observed: float


def control_loop(stand: Stand, sway: Sway, real: str, ticks: int) -> dict[str, str]:
    """C texts by file name for `board.build`: the stand with an IMU, and a `main` that runs the loop on it."""
    generated = generate_all(replace(stand, points=(IMU,)), real)
    precision = generated.program.precision

    def numbers(values: Sequence[float]) -> str:
        return ", ".join(real_literal(v, precision) for v in values)

    main = template("loop.c.j2").render(
        name=stand.name,
        NAME=stand.name.upper(),
        rate=RATE,
        imu=IMU.name,
        ticks=ticks,
        per_turn=4096,
        counts_per_rad=4096 / (2 * math.pi),
        places=numbers(sway.places),
        center=numbers(sway.center),
        sway_linear=numbers(sway.linear),
        sway_angular=numbers(sway.angular),
        omega=20 * math.pi,
    )
    return generated.files | {"loop.c": main}


def read_counts(printed: str) -> Counts:
    """Output of the program."""
    numbers = {name: int(value) for name, value in (line.rsplit(": ", 1) for line in printed.splitlines())}
    followed, strayed, observed = (
        numbers.pop(name) * 1e-6
        for name in (
            "off the wanted position, um",
            "off the rest under three times the sway, um",
            "observed velocity off, um/s",
        )
    )
    run = numbers.pop("hash")
    ticks = {name.removeprefix("tick: "): n for name, n in numbers.items() if name.startswith("tick: ")}
    stages = {name: n for name, n in numbers.items() if not name.startswith("tick: ")}
    return Counts(stages, ticks, run, followed, strayed, observed)


CYCLES = 2.0
"""Cycles an instruction takes on silicon: an assumption, and a careful one. Both cores issue at least an instruction a
cycle from fast memory; loads, divisions and the double FPU of the M7 take longer, and so does flash without a cache."""

RATES = (1000, 4000, 10000)
"""Hz."""

ROOM = 0.7
"""Part of its period that a loop may take and still leave room for the rest of the firmware."""


@dataclass(frozen=True)
class Silicon:
    """A processor on the market, and the target that stands for it here."""

    name: str
    target: str
    real: str
    mhz: int

    def microseconds(self, instructions: int) -> float:
        """Estimated time."""
        return instructions * CYCLES / self.mhz


BOARDS = (Silicon("STM32H743", "m7", "double", 480), Silicon("STM32F407", "m4", "float", 168))


def counts_of(board: Silicon, ticks: int) -> Counts:
    """A run on the board's emulator, and the same on this machine. Raises ToolchainError, SystemExit: other bits."""
    texts = control_loop(load(path("bench8")), BENCH8, board.real, ticks)
    found = []
    for name in (board.target, "host"):
        with tempfile.TemporaryDirectory() as scratch:
            program = build(TARGETS[name], texts, Path(scratch))
            found.append(read_counts(run(TARGETS[name], program, timeout=3600)))
    if found[0].hash != found[1].hash:
        raise SystemExit(f"{board.target}, {board.real}: other bits than on this machine")
    return found[0]


def _title(board: Silicon) -> str:
    return f"{board.name}: {TARGETS[board.target].title.split(',')[0]}, {board.real}"


def figures(results: Sequence[tuple[Silicon, Counts]], ticks: int) -> Figures:
    """The figures to keep: counts, and how well the runs followed."""
    counts = [c for _, c in results]
    return {
        "ticks": ticks,
        "compiler": version(TARGETS["m7"].compiler[0]),
        "cycles an instruction, assumed": CYCLES,
        "stages": [
            {"stage": name, **{_title(b): c.stages[name] for b, c in results}} for name in counts[0].stages
        ],
        "whole ticks": [{"tick": name, **{_title(b): c.ticks[name] for b, c in results}} for name in counts[0].ticks],
        "runs": [
            {
                "board": _title(b), "followed, um": c.followed * 1e6, "strayed, mm": c.strayed * 1e3,
                "observed, um/s": c.observed * 1e6, "hash": f"{c.hash:08x}",
            }
            for b, c in results
        ],
    }  # fmt: skip


def page(found: Figures) -> str:
    """Both tables and what they rest on."""
    titles = {_title(board): board for board in BOARDS}
    stages = Columns({"stage": "{}", **dict.fromkeys(titles, "{:,}")})
    text = (
        f"Most instructions of a stage in {found['ticks']:,} ticks, at -O2 by {found['compiler']}. QEMU counts them in "
        f"steps of 40.\n\n{stages.text(found['stages'])}"
    )
    rows = []
    for row in found["whole ticks"]:
        for title, board in titles.items():
            time = board.microseconds(row[title])
            shares = [time * 1e-6 * rate for rate in RATES]
            cells = [f"{share:.0%}{' no' if share > 1 else '' if share <= ROOM else ' tight'}" for share in shares]
            rows.append([row["tick"], f"{board.name} at {board.mhz} MHz", f"{row[title]:,}", f"{time:.0f}", *cells])
    text += (
        "\nMost instructions of a whole tick, and an **estimate** of time. It rests on an assumption, cycles an "
        f"instruction:\n{found['cycles an instruction, assumed']:g}; time is not measured. The last columns are the "
        "share of the period.\n\n"
        + campaign.table(
            ["tick", "processor", "instructions", "estimate, us", *(f"{r / 1000:g} kHz" for r in RATES)], rows, 2
        )
    )
    for each in found["runs"]:
        board = titles[each["board"]]
        text += (
            f"\n{board.target}, {board.real}: the carrier follows to {each['followed, um']:.0f} um; under three times "
            f"the sway it stays within {each['strayed, mm']:.1f} mm of its rest. The observer's\nvelocity is right to "
            f"{each['observed, um/s']:.0f} um/s throughout. Bits as on the machine that made this page: hash "
            f"{each['hash']}.\n"
        )
    return text


CAMPAIGN = Campaign(
    "control-loop",
    campaign.Block("docs/results/control-loop.md", "figures: tools/control_loop.py"),
    page,
)


def main() -> None:
    """Run the loops, write the page."""
    ticks = campaign.parser(__doc__, ticks=100_000).parse_args().ticks
    results = [(board, counts_of(board, ticks)) for board in BOARDS]
    CAMPAIGN.keep(figures(results, ticks))


if __name__ == "__main__":
    main()
