"""What a control loop costs on an emulated Cortex-M7 and M4: writes the tables of docs/results/control-loop.md.

python tools/control_loop.py [--ticks 100000]
"""

from __future__ import annotations

import argparse
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from mahovik.core.stand import load
from mahovik.core.toolchain.board import build, run, version
from mahovik.core.toolchain.loop import BENCH8, Counts, control_loop, read_counts
from mahovik.core.toolchain.targets import TARGETS
from mahovik.stands import path

PAGE = Path(__file__).resolve().parents[1] / "docs" / "results" / "control-loop.md"
BEGIN, END = "<!-- figures: tools/control_loop.py -->", "<!-- end of figures -->"

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


def counted(board: Silicon, ticks: int) -> Counts:
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


def figures(results: Sequence[tuple[Silicon, Counts]], ticks: int) -> str:
    """Both tables and what they rest on."""
    head = [f"{b.name}: {TARGETS[b.target].title.split(',')[0]}, {b.real}" for b, _ in results]
    stages = [[name, *(f"{c.stages[name]:,}" for _, c in results)] for name in results[0][1].stages]
    text = (
        f"Most instructions of a stage in {ticks:,} ticks, at -O2 by {version(TARGETS['m7'].compiler[0])}. QEMU counts "
        "them in steps of 40.\n\n" + table(["stage", *head], stages)
    )
    rows = []
    for name in results[0][1].ticks:
        for board, counts in results:
            time = board.microseconds(counts.ticks[name])
            shares = [time * 1e-6 * rate for rate in RATES]
            cells = [f"{share:.0%}{' no' if share > 1 else '' if share <= ROOM else ' tight'}" for share in shares]
            rows.append([name, f"{board.name} at {board.mhz} MHz", f"{counts.ticks[name]:,}", f"{time:.0f}", *cells])
    text += (
        "\nMost instructions of a whole tick, and an **estimate** of time. It rests on an assumption, cycles an "
        f"instruction:\n{CYCLES:g}; time is not measured. The last columns are the share of the period.\n\n"
        + table(["tick", "processor", "instructions", "estimate, us", *(f"{r / 1000:g} kHz" for r in RATES)], rows, 2)
    )
    for board, counts in results:
        text += (
            f"\n{board.target}, {board.real}: the carrier follows to {counts.followed * 1e6:.0f} um; under three times "
            f"the sway it stays within {counts.strayed * 1e3:.1f} mm of its rest. The observer's\nvelocity is right to "
            f"{counts.observed * 1e6:.0f} um/s throughout. Bits as on the machine that made this page: hash "
            f"{counts.hash:08x}.\n"
        )
    return text


def table(head: Sequence[str], rows: Sequence[Sequence[str]], words: int = 1) -> str:
    """A Markdown table, all but the first columns to the right."""
    lines = [head, [*["---"] * words, *["---:"] * (len(head) - words)], *rows]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def main() -> None:
    """Run the loops, write the page."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--ticks", type=int, default=100_000)
    ticks = parser.parse_args().ticks
    results = [(board, counted(board, ticks)) for board in BOARDS]
    before, rest = PAGE.read_text(encoding="utf-8").split(BEGIN)
    text = f"{before}{BEGIN}\n\n{figures(results, ticks)}\n{END}{rest.split(END)[1]}"
    PAGE.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
