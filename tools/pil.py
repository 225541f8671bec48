"""Processor in the loop: the servos of bench8 on emulated boards, which also play the stand with 1 % of mismatch.

The torques of all samples must have the bits that they have on this machine. Costs of a sample beside them.

python tools/pil.py --programme programme.json [--samples 6000] [--mismatch 0.01] [--seed 1] [--write]
"""

from __future__ import annotations

import argparse
import tempfile
from dataclasses import dataclass
from pathlib import Path

from mahovik.core.motion.programme import load_programme
from mahovik.core.motion.required import load_motion
from mahovik.core.motion.servo import load_servo
from mahovik.core.stand import load
from mahovik.core.toolchain.board import build, run, version
from mahovik.core.toolchain.footprint import STACK_FLAGS, Footprint, footprint
from mahovik.core.toolchain.targets import TARGETS
from mahovik.out.export.pil import Run, processor_in_the_loop, read_run
from mahovik.out.export.servo import ExportedServo, export_servo
from mahovik.stands import motions, path, servos
from mahovik.use.control.mismatch import with_mismatch

PAGE = Path(__file__).resolve().parents[1] / "docs" / "servo.md"
BEGIN, END = "<!-- figures: tools/pil.py --write -->", "<!-- end of figures -->"
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


def found(board: str, real: str, given: argparse.Namespace) -> Found:
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
    return Found(board, real, runs[0], runs[0].torques == runs[1].torques, *prints[0], made)


def figures(results: list[Found], given: argparse.Namespace) -> str:
    """What ran, the table, how well it followed."""
    rate = 1 / results[0].made.tables.period
    text = (
        f"`{STAND}`, {given.samples:,} samples at {rate:g} Hz. The stand that is played has other masses, inertias and "
        f"places than its\nfile, by up to {given.mismatch:.3g} (seed {given.seed}); at -O2 by "
        f"{version(TARGETS['m7'].compiler[0])}. The emulator counts instructions in steps of 40;\n"
        "stack over the call graph; code with what a function calls.\n\n"
    )
    lines = [["processor", "function", "instructions", "stack, B", "code, B"], ["---", "---", "---:", "---:", "---:"]]
    for f in results:
        title = f"{TARGETS[f.board].title.split(',')[0]}, {f.real}"
        for name in ROWS:
            symbol, taken = f"{STAND}_{name}", f.programme if name == "programme_at" else f.servo
            count = next(n for words, n in f.run.counts.items() if f" {name}" in words)
            lines.append(
                [title, f"`{name}`", f"{count:,}", f"{taken.stack_of(symbol):,}", f"{taken.code_of(symbol):,}"]
            )
        counts = f.run.counts
        most, stack = counts["instructions of a sample, at most"], counts["bytes of stack of a sample, at most"]
        lines.append([title, "a whole sample, at most", f"{most:,}", f"{stack:,}", ""])
    text += "".join(f"| {' | '.join(line)} |\n" for line in lines)
    for f in results:
        equal = "all torques have the bits of the host" if f.equal else "torques DIFFER from those of the host"
        text += (
            f"\n{f.board}, {f.real}: {equal}; the largest error of an angle in the last quarter is "
            f"{f.run.followed * 1e3:.2f} mrad. Gains and trim are {sum(f.servo.constants.values()):,} B.\n"
        )
    return text


def main() -> None:
    """Run the boards; write the page, or print. Exit status 1 where bits differ."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--programme", type=Path, required=True)
    parser.add_argument("--samples", type=int, default=6000)
    parser.add_argument("--mismatch", type=float, default=0.01)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--write", action="store_true", help="into docs/servo.md")
    given = parser.parse_args()
    results = [found(board, real, given) for board, real in BOARDS]
    text = figures(results, given)
    print(text)
    wrong = [f.board for f in results if not f.equal]
    if wrong:
        raise SystemExit(f"{', '.join(wrong)}: other torques than on this machine")
    if given.write:
        before, rest = PAGE.read_text(encoding="utf-8").split(BEGIN)
        PAGE.write_text(f"{before}{BEGIN}\n\n{text}\n{END}{rest.split(END)[1]}", encoding="utf-8")


if __name__ == "__main__":
    main()
