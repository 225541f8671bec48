"""A flight on an emulated board, its log printed as over a serial console, and replayed here bit for bit.

python tools/flight.py [--board m4] [--real float] [--stand bench8] [--steps 2000] [-o flight.log]
"""

from __future__ import annotations

import argparse
import tempfile
from pathlib import Path

from mahovik.core.stand import load
from mahovik.core.toolchain.board import build, run
from mahovik.core.toolchain.flight import flight
from mahovik.core.toolchain.targets import TARGETS
from mahovik.out.cli import main as mahovik
from mahovik.stands import path


def main() -> None:
    """Build, fly, write the log, replay it. Exit status of `mahovik replay`."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--board", default="m4", choices=sorted(TARGETS))
    parser.add_argument("--real", default="float", choices=["float", "double"])
    parser.add_argument("--stand", default="bench8")
    parser.add_argument("--steps", type=int, default=2000)
    parser.add_argument("-o", dest="log", type=Path, default=Path("build/flight.log"))
    given = parser.parse_args()
    board = TARGETS[given.board]
    with tempfile.TemporaryDirectory() as scratch:
        program = build(board, flight(load(path(given.stand)), given.real, given.steps), Path(scratch))
        printed = run(board, program, timeout=600)
    given.log.parent.mkdir(parents=True, exist_ok=True)
    given.log.write_text(printed, encoding="ascii")
    print(f"{given.log}   {printed.count(chr(10))} lines from {board.title}")
    mahovik(["replay", str(given.log), str(path(given.stand))])


if __name__ == "__main__":
    main()
