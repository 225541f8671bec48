"""`mahovik judge`: judge a program that implements the contract of `eval`; --explain names its fault."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from mahovik.out.cli.options import (
    JUNIT,
    SEED_OF_STATES,
    STAND_FILE,
    STATES,
    WORST,
    command,
    flag,
    json_option,
    option,
)
from mahovik.out.cli.progress import progress
from mahovik.out.cli.verify import finish, read_wants

if TYPE_CHECKING:
    pass


@command(short_help="Judge a program, and find its fault.")
def judge(
    stand_file: str = STAND_FILE,
    command: str = option(
        "--with",
        "Start this program, which reads states; {stand} stands for the stand file.",
        metavar="COMMAND",
        required=True,
    ),
    explain: bool = flag("--explain", "Name the fault in its equations if it differs."),
    want: str | None = option(
        "--want", "Require these wants of the program; default: those it offers.", metavar="NAME,..."
    ),
    states: int = STATES,
    seed: int = SEED_OF_STATES,
    tolerance: float = option(
        "--tolerance",
        "Accept this difference, relative to the natural scale.",
        type=click.FloatRange(1e-15, 0.1),
        default=1e-12,
    ),
    timeout: float = option(
        "--timeout", "Limit the time of the program, s.", type=click.FloatRange(0.1), default=300.0
    ),
    as_json: bool = json_option("Print table and diagnosis as JSON."),
    junit: str | None = JUNIT,
    worst: str | None = WORST,
) -> None:
    """Judge a program by the reference, and find its fault.

    Starts a program, gives it states, and compares every quantity that it offers with the literal reference. With
    --explain a program that differs gets more states, which distinguish faults, and its error is compared with that of
    each physical fault in a dictionary. Where none is the cause, the few wrong terms are found whose sum is the error.

    Exit status: 0 it agrees, 1 it does not, 2 bad input.
    """
    from mahovik.out.functions.evidence import judge as judged

    wants = read_wants(want)
    with progress(f"judge {command}") as stage:
        found = judged(
            stand_file, command, explain=explain, want=wants, states=states, seed=seed, tolerance=tolerance,
            timeout=timeout, progress=stage.show,
        )  # fmt: skip
    finish(found.result, as_json, junit, worst, found.more(), found.explanation)
