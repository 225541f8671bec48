"""`mahovik judge`: judge a program that implements the contract of `eval`; --explain names its fault."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from mahovik.contract.evaluation import text_lines
from mahovik.errors import UsageError
from mahovik.out.cli import quantities
from mahovik.out.cli.options import (
    JUNIT,
    SEED_OF_STATES,
    STAND_FILE,
    STATES,
    WORST,
    choice,
    command,
    file_option,
    flag,
    is_given,
    json_option,
    option,
)
from mahovik.out.cli.verify import finish
from mahovik.out.progress import progress

if TYPE_CHECKING:
    from mahovik.proof.verify.foreign import Attitude


@command(short_help="Judge a program, and find its fault.", lines=text_lines())
def judge(
    stand_file: str = STAND_FILE,
    command: str | None = option(
        "--with", "Start this program, which reads states; {stand} stands for the stand file.", metavar="COMMAND"
    ),
    log: str | None = file_option(
        "--log", "FILE.csv", "Judge a log of states and accelerations instead, with the columns of `simulate`."
    ),
    fmu: str | None = file_option("--fmu", "FILE.fmu", "Judge an FMU instead, with --map."),
    variables: str | None = file_option(
        "--map", "MAP.toml", "Read from this file what the variables of --fmu are.", reads="a map of variables"
    ),
    attitude: Attitude | None = choice(
        "--attitude", ["quaternion", "angles"], "Give attitudes in this form; default: some states each way."
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
        "--timeout", "Limit the time of the program.", metavar="TIME", default="5 min", parse=quantities.time_limit
    ),
    as_json: bool = json_option("Print table and diagnosis as JSON."),
    junit: str | None = JUNIT,
    worst: str | None = WORST,
) -> None:
    """Judge a program, an FMU or a log by the reference, and find its fault.

    Starts a program, gives it states, and compares every quantity that it offers with the literal reference. With
    --explain a program that differs gets more states, and its error is compared with wrong readings, then with wrong
    numbers of the stand file; where none is the cause, the few wrong terms are found whose sum is the error.
    An FMU is a program too, of which --map names the variables. A log has states of its own: all its rows are compared.

    Exit status: 0 it agrees, 1 it does not, 2 bad input.
    """
    from mahovik.out.functions.judging import judge as judged

    for name in ("states", "timeout") if log is not None else ():
        if is_given(name):
            raise UsageError(f"--{name}: not with --log, of which all rows are judged")
    wants = () if want is None else tuple(dict.fromkeys(name.strip() for name in want.split(",")))
    with progress(f"judge {command or log or fmu}") as stage:
        found = judged(
            stand_file, command, log=log, fmu=fmu, variables=variables, attitude=attitude, explain=explain, want=wants,
            states=states, seed=seed, tolerance=tolerance, timeout=timeout, progress=stage.show,
        )  # fmt: skip
    finish(found.result, as_json, junit, worst, found.more(), found.explanation)
