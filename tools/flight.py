"""A flight on an emulated board, its log printed as over a serial console, and replayed here bit for bit.

python tools/flight.py [--board m4] [--real float] [--stand bench8] [--steps 2000] [-o flight.log]
"""

from __future__ import annotations

import tempfile
from pathlib import Path

import campaign

from mahovik.core.emit.generate import generate_all
from mahovik.core.emit.literal import real_literal
from mahovik.core.emit.recorder import recorder_files
from mahovik.core.emit.templates import template
from mahovik.core.stand import load
from mahovik.core.stand.model import Stand
from mahovik.core.toolchain.board import build, run
from mahovik.core.toolchain.targets import TARGETS
from mahovik.errors import UsageError
from mahovik.out.cli import main as mahovik
from mahovik.stands import path


def flight(stand: Stand, real: str, steps: int, dt: float = 1e-3, torque: float = 0.02) -> dict[str, str]:
    """C texts by file name for `board.build`: the stand, its recorder, and a `main` that prints the log.

    New torques are drawn for each of `steps` steps of `dt` seconds, up to `torque` N m. Raises UsageError: a stand
    without flywheels, or with run-time wrenches.
    """
    generated = generate_all(stand, real)
    if not stand.flywheels or generated.layout.inputs:
        raise UsageError(f'stand "{stand.name}": the flight wants flywheels, and no run-time wrenches')
    precision = generated.program.precision
    main = template("flight.c.j2").render(
        name=stand.name,
        NAME=stand.name.upper(),
        steps=steps,
        dt=real_literal(dt, precision),
        torque=real_literal(torque, precision),
        unit=real_literal(2.0**-15, precision),
    )
    return generated.files | recorder_files(stand, generated) | {"flight.c": main}


def main() -> None:
    """Build, fly, write the log, replay it. Exit status of `mahovik replay`."""
    parser = campaign.parser(__doc__, stand="bench8", steps=2000)
    parser.add_argument("--board", default="m4", choices=sorted(TARGETS))
    parser.add_argument("--real", default="float", choices=["float", "double"])
    parser.add_argument("-o", dest="log", type=Path, default=Path("build/flight.log"))
    given = parser.parse_args()
    board = TARGETS[given.board]
    with tempfile.TemporaryDirectory() as scratch:
        program = build(board, flight(load(path(given.stand)), given.real, given.steps), Path(scratch))
        printed = run(board, program, timeout=600)
    given.log.parent.mkdir(parents=True, exist_ok=True)
    given.log.write_text(printed, encoding="ascii")
    print(f"{given.log}   {printed.count(chr(10))} lines from {board.title}")
    mahovik(["replay", str(path(given.stand)), "--log", str(given.log)])


if __name__ == "__main__":
    main()
