"""Processor in the loop: the servos of bench8 on emulated boards, which also play the stand with 1 % of mismatch.

The torques of all samples must have the bits that they have on this machine. Costs of a sample beside them.

python tools/pil.py --programme programme.json [--samples 6000] [--mismatch 0.01] [--seed 1] [--write]
"""

from __future__ import annotations

import argparse
import re
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import campaign
from kept import Campaign, Columns, Figures

from mahovik.core.emit.constant import initialiser
from mahovik.core.emit.generate import generate_all
from mahovik.core.emit.servo import servo_program_text
from mahovik.core.motion.programme import load_programme
from mahovik.core.motion.required import load_motion
from mahovik.core.motion.servo import load_servo
from mahovik.core.stand import load
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand
from mahovik.core.toolchain.board import build, run, version
from mahovik.core.toolchain.footprint import STACK_FLAGS, Footprint, footprint
from mahovik.core.toolchain.targets import TARGETS
from mahovik.errors import UsageError
from mahovik.out.export.servo import ExportedServo, export_servo
from mahovik.stands import motions, path, servos
from mahovik.use.control.mismatch import with_mismatch

_COUNT = re.compile(r"(# )?(.+?) (\d+)")


@dataclass(frozen=True)
class Run:
    """Output of a board.

    torques    one line per sample: the bits
    followed   largest error of an angle in the last quarter, rad
    limited    samples with a torque cut
    counts     the board's own, by what they count
    """

    torques: tuple[str, ...]
    followed: float
    limited: int
    counts: dict[str, int]


def processor_in_the_loop(stand: Stand, real_stand: Stand, made: ExportedServo, samples: int) -> dict[str, str]:
    """C texts by file name for `board.build`: servos made for `stand` against `real_stand`, of the same structure.

    Raises UsageError where the structures differ.
    """
    if identities(stand).structure != identities(real_stand).structure:
        raise UsageError(f'"{real_stand.name}": another structure than "{stand.name}", only numbers may differ')
    precision = made.program.precision
    generated, other = generate_all(stand, precision.name), generate_all(real_stand, precision.name)
    words = "as its file says" if real_stand == stand else "with other numbers than its file"
    main = servo_program_text(
        "pil.c.j2",
        stand,
        made.program,
        made.form,
        made.tables,
        parameters=initialiser(generated.layout.parameters, other.values.parameters, precision, {}),
        other=words,
        hex_digits=precision.width // 4,
        pil_samples=samples,
        pil_last=samples * 3 // 4,
    )
    name = stand.name
    own = {f"{name}.h", f"{name}.c"}
    tables = {f"{name}_programme{end}" for end in (".h", ".c")}
    servo = {f"{name}_servo{end}" for end in (".h", ".c")}
    files = generated.files | made.programme.files | made.servo
    return {file: text for file, text in files.items() if file in own | tables | servo} | {"pil.c": main}


def read_run(printed: str) -> Run:
    """Output of the program."""
    lines = printed.splitlines()
    torques = tuple(line for line in lines if line.startswith(" "))
    numbers: dict[str, int] = {}
    counts: dict[str, int] = {}
    for line in lines[len(torques) :]:
        found = _COUNT.fullmatch(line)
        assert found is not None, line
        (counts if found[1] else numbers)[found[2]] = int(found[3])
    followed = numbers["largest error of an angle in the last part, urad"] * 1e-6
    return Run(torques, followed, numbers["samples with a torque cut"], counts)


STAND = "bench8"
BOARDS = (("m7", "double"), ("m4", "float"))
ROWS = ("programme_at", "servo_step", "trim_step")


@dataclass(frozen=True)
class Found:
    """A board's run, whether its torques are those of this machine, and what its objects take."""

    board: str
    real: str
    run: Run
    equal: bool
    servo: Footprint
    programme: Footprint
    made: ExportedServo


def run_board(board: str, real: str, given: argparse.Namespace) -> Found:
    """The run of a board and of this machine. Raises ToolchainError."""
    stand = load(path(STAND))
    motion, servo = load_motion(motions(STAND)[0], stand), load_servo(servos(STAND)[0], stand)
    made = export_servo(stand, load_programme(given.programme), motion, servo, real)
    texts = processor_in_the_loop(stand, with_mismatch(stand, given.mismatch, given.seed), made, given.samples)
    runs, prints = [], []
    for name in (board, "host"):
        with tempfile.TemporaryDirectory() as scratch:
            place, target = Path(scratch), TARGETS[name]
            runs.append(read_run(run(target, build(target, texts, place, extra=STACK_FLAGS), timeout=3600)))
            prints.append([footprint(target.compiler[0], place / f"{STAND}_{o}.o") for o in ("servo", "programme")])
    of_servo, of_programme = prints[0]
    return Found(board, real, runs[0], runs[0].torques == runs[1].torques, of_servo, of_programme, made)


TABLE = Columns({"processor": "{}", "function": "{}", "instructions": "{:,}", "stack, B": "{:,}", "code, B": "{:,}"}, 2)


def lines(f: Found) -> Iterator[tuple[object, ...]]:
    """Rows of a board."""
    title, counts = f"{TARGETS[f.board].title.split(',')[0]}, {f.real}", f.run.counts
    for name in ROWS:
        symbol, taken = f"{STAND}_{name}", f.programme if name == "programme_at" else f.servo
        count = next(n for words, n in counts.items() if f" {name}" in words)
        yield title, f"`{name}`", count, taken.stack_of(symbol), taken.code_of(symbol)
    most, stack = counts["instructions of a sample, at most"], counts["bytes of stack of a sample, at most"]
    yield title, "a whole sample, at most", most, stack, None


def run_of(f: Found) -> Figures:
    """The figures to keep of a board's run."""
    return {
        "board": f.board,
        "real": f.real,
        "equal": f.equal,
        "error, mrad": f.run.followed * 1e3,
        "gains and trim, B": sum(f.servo.constants.values()),
    }


def figures(results: list[Found], given: argparse.Namespace) -> Figures:
    """The figures to keep."""
    return {
        "samples": given.samples,
        "rate": 1 / results[0].made.tables.period,
        "mismatch": given.mismatch,
        "seed": given.seed,
        "compiler": version(TARGETS["m7"].compiler[0]),
        "rows": TABLE.rows(line for f in results for line in lines(f)),
        "runs": [run_of(f) for f in results],
    }


def page(found: Figures) -> str:
    """What ran, the table, how well it followed."""
    text = (
        f"`{STAND}`, {found['samples']:,} samples at {found['rate']:g} Hz. The stand that is played has other masses, "
        f"inertias and places than its\nfile, by up to {found['mismatch']:.3g} (seed {found['seed']}); at -O2 by "
        f"{found['compiler']}. The emulator counts instructions in steps of 40;\n"
        f"stack over the call graph; code with what a function calls.\n\n{TABLE.text(found['rows'])}"
    )
    for each in found["runs"]:
        equal = "all torques have the bits of the host" if each["equal"] else "torques DIFFER from those of the host"
        text += (
            f"\n{each['board']}, {each['real']}: {equal}; the largest error of an angle in the last quarter is "
            f"{each['error, mrad']:.2f} mrad. Gains and trim are {each['gains and trim, B']:,} B.\n"
        )
    return text


CAMPAIGN = Campaign(
    "servo",
    campaign.Block("docs/results/servo.md", "figures: tools/pil.py --write"),
    page,
)


def main() -> None:
    """Run the boards; write the page, or print. Exit status 1 where bits differ."""
    parser = campaign.parser(__doc__, samples=6000, seed=1, write=False)
    parser.add_argument("--programme", type=Path, required=True)
    parser.add_argument("--mismatch", type=float, default=0.01)
    given = parser.parse_args()
    results = [run_board(board, real, given) for board, real in BOARDS]
    found = figures(results, given)
    print(page(found))
    wrong = [f.board for f in results if not f.equal]
    if wrong:
        raise SystemExit(f"{', '.join(wrong)}: other torques than on this machine")
    if given.write:
        CAMPAIGN.keep(found, given.seed)


if __name__ == "__main__":
    main()
