"""`mahovik eval`: states in, values out, one JSON object per line."""

from __future__ import annotations

import sys
from contextlib import nullcontext
from typing import TYPE_CHECKING

import click

from mahovik.contract.evaluation import text_lines
from mahovik.errors import UsageError
from mahovik.out.cli.options import REAL, STAND_FILE, choice, command, load_stand
from mahovik.out.cli.progress import progress

if TYPE_CHECKING:
    from mahovik.core.stand.model import Stand
    from mahovik.proof.verify.states import Backend


@command(name="eval", lines=text_lines())
def evaluate(
    stand_file: str = STAND_FILE,
    backend: str = choice(
        "--backend",
        ["c", "numpy", "casadi"],
        "Evaluate by c, the generated C; numpy, the literal reference; or casadi, the second derivation.",
        default="c",
    ),
    real: str = REAL,
) -> None:
    """Evaluate states from standard input.

    One JSON object per line; a result line for each, in order.

    With a task `inverse` answers for its rows, `torque_for` with drive torques within what the motors have, and
    `torque`, `mounts`, `points` take the motion that results.

    A state that cannot be evaluated gives an error line in its place; the exit status is then 1.
    """
    if real == "float" and backend != "c":
        raise UsageError(f"--real float: only --backend c has it, not {backend}")
    stand = load_stand(stand_file)
    chosen = _backend(stand, backend, real)
    from mahovik.proof.verify.states import evaluate_lines, split_lines

    failed = 0
    piped = not (sys.stdin.isatty() or sys.stdout.isatty())  # otherwise the lines themselves show the progress
    with progress("states evaluated") if piped else nullcontext() as stage:
        for done, (line, good) in enumerate(
            evaluate_lines(stand, chosen, split_lines(sys.stdin.buffer), real), start=1
        ):
            failed += not good
            sys.stdout.write(line + "\n")
            sys.stdout.flush()  # line by line, so that a program can hold a conversation
            if stage is not None:
                stage.at(done)
    if failed:
        click.echo(f"error: {failed} of the states cannot be evaluated, see their lines", err=True)
        raise SystemExit(1)


def _backend(stand: Stand, name: str, real: str) -> Backend:
    if name == "numpy":
        from mahovik.proof.verify.backends import NumpyBackend

        return NumpyBackend(stand)
    if name == "casadi":
        from mahovik.proof.verify.backends import CasadiBackend

        return CasadiBackend(stand)
    from mahovik.proof.verify.backends import KeptBackend

    return KeptBackend(stand, "float" if real == "float" else "double")
