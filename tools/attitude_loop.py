"""The attitude loop of eye4 on emulated boards, with the exact plant: writes docs/results/attitude-loop.md.

A slew of 30 degrees, the first flywheel fails half-way, 1 N m s is dumped. Each board must have the bits of
this machine.

python tools/attitude_loop.py
"""

from __future__ import annotations

import re
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path

import campaign
from kept import Campaign, Columns, Figures

from mahovik.core.stand import load
from mahovik.core.toolchain.board import build, run, version
from mahovik.core.toolchain.targets import TARGETS
from mahovik.out.export.attitude import attitude_sources
from mahovik.stands import path
from mahovik.use.control.attitude import Failure, LoopOptions

STAND = "eye4"
RUNS: tuple[tuple[str, str, Failure], ...] = (
    ("m7", "double", "coasts"),
    ("m7", "double", "held"),
    ("m7", "double", "none"),
    ("m4", "float", "coasts"),
)
"""Board, element type, what happens to the first flywheel."""

_NUMBER = re.compile(r"\d+\.\d+|\d+")

TABLE = Columns(
    {
        "board": "{}",
        "real": "{}",
        "flywheel": "{}",
        "slew, s": "{:.1f}",
        "error, arcsec": "{:.1f}",
        "after the slew, arcsec": "{:.2f}",
        "at the end, arcsec": "{:.2f}",
        "torque, %": "{:.1f}",
        "speed, rad/s": "{:.0f}",
        "left, N m s": "{:.4f}",
        "dumped, s": "{:.1f}",
        "instructions": "{:,}",
        "stack, B": "{:,}",
        "hash": "{}",
    },
    3,
)


def output_of(target: str, files: Mapping[str, str]) -> list[str]:
    """Lines of the example on a target. Raises ToolchainError."""
    with tempfile.TemporaryDirectory() as scratch:
        program = build(TARGETS[target], files, Path(scratch))
        return run(TARGETS[target], program, timeout=3600).splitlines()


def read(lines: Sequence[str]) -> dict[str, object]:
    """Figures that the example prints."""

    def numbers(begin: str, among: Sequence[str] = lines) -> list[float]:
        return [float(x) for line in among if line.startswith(begin) for x in _NUMBER.findall(line[len(begin) :])]

    wheels = [line.partition(": ")[2] for line in lines if re.match(r"flywheel \w+: ", line)]
    each = [numbers("torque at most", [wheel]) for wheel in wheels]
    error, after, end = numbers("pointing error at most")
    _, left, dumped = numbers("momentum")
    return {
        "slew, s": numbers("slew of")[1],
        "error, arcsec": error,
        "after the slew, arcsec": after,
        "at the end, arcsec": end,
        "torque, %": max(found[1] for found in each),
        "speed, rad/s": max(found[2] for found in each),
        "left, N m s": left,
        "dumped, s": dumped,
        "instructions": int(numbers("# instructions of a sample, at most")[0]),
        "stack, B": int(numbers("# bytes of stack of a sample, at most")[0]),
        "hash": f"{int(numbers('hash')[0]):08x}",
    }


def row(board: str, real: str, failure: Failure) -> dict[str, object]:
    """A run on a board and on this machine. Raises SystemExit: other bits, or the example finds a failure."""
    files = attitude_sources(load(path(STAND)), LoopOptions(failure=failure), real).files
    there, here = (output_of(name, files) for name in (board, "host"))
    same = [[line for line in lines if not line.startswith("#")] for lines in (there, here)]
    if same[0] != same[1]:
        raise SystemExit(f"{board}, {real}, {failure}: other bits than on this machine")
    if there[-1] != "failures 0":
        raise SystemExit(f"{board}, {real}, {failure}: {there[-1]}")
    words = {"none": "works", "held": "is held", "coasts": "coasts"}[failure]
    return {"board": board, "real": real, "flywheel": words, **read(there)}


def page(found: Figures) -> str:
    """What ran, and the table."""
    return (
        f"`{STAND}`, {found['lines'][0].partition(': ')[2]}; {found['lines'][1].partition(': ')[2]}; "
        f"{found['lines'][2].partition(': ')[2]}.\nBy {found['compiler']} at -O2. Each run has the bits of the machine "
        f"that made this page, of all states and torques.\n\n{TABLE.text(found['rows'])}"
    )


CAMPAIGN = Campaign(
    "attitude-loop",
    campaign.Block("docs/results/attitude-loop.md", "figures: tools/attitude_loop.py"),
    page,
)


def main() -> None:
    """Run the loops, write the page."""
    campaign.parser(__doc__).parse_args()
    lines = attitude_sources(load(path(STAND)), LoopOptions(), "double").design.lines
    rows = [row(*each) for each in RUNS]
    CAMPAIGN.keep({"compiler": version(TARGETS["m7"].compiler[0]), "lines": list(lines), "rows": rows})


if __name__ == "__main__":
    main()
