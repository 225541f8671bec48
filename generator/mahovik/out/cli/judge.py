"""`mahovik judge`: judge a program that implements the contract of `eval`; --explain names its fault."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from mahovik.errors import CheckError
from mahovik.out.cli.options import (
    JUNIT,
    SEED_OF_STATES,
    STAND_FILE,
    STATES,
    WORST,
    command,
    flag,
    json_option,
    load_stand,
    option,
)
from mahovik.out.cli.progress import progress
from mahovik.out.cli.verify import finish, read_wants

if TYPE_CHECKING:
    from mahovik.core.stand.model import Stand
    from mahovik.proof.diagnose.diagnosis import Diagnosis
    from mahovik.proof.verify.report import Report


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
    each physical fault in a dictionary.

    Exit status: 0 it agrees, 1 it does not, 2 bad input.
    """
    from mahovik.proof.diagnose.words import as_object, sentences
    from mahovik.proof.verify.foreign import verify_program

    wants = read_wants(want)
    stand = load_stand(stand_file)
    with progress(f"judge {command}"):
        found = verify_program(
            stand, command, stand_file, wants=wants, seed=seed, count=states, timeout=timeout, tolerance=tolerance
        )
    if not explain or found.error:
        finish(found, as_json, junit, worst)
        return
    try:
        with progress("distinguish faults"):
            diagnosis = _diagnosis(stand, command, stand_file, found, seed, timeout)
    except CheckError as error:
        from dataclasses import replace

        finish(replace(found, error=str(error)), as_json, junit, worst)
        return
    finish(found, as_json, junit, worst, {"diagnosis": as_object(diagnosis)}, sentences(diagnosis))


def _diagnosis(stand: Stand, command: str, stand_file: str, found: Report, seed: int, timeout: float) -> Diagnosis:
    """Diagnosis of a program that differs, for the wants that it offers."""
    from mahovik.proof.diagnose.diagnosis import Diagnoser, Diagnosis
    from mahovik.proof.verify.foreign import ask

    if found.passed:
        return Diagnosis("equal")
    offered = tuple(dict.fromkeys(row.want for row in found.rows if row.verdict in ("ok", "FAILED")))
    if not offered:
        return Diagnosis("nothing")
    diagnoser = Diagnoser(stand, seed, offered)
    results = ask(command, stand_file, diagnoser.requests, timeout)
    answers = {request.id: result for request, result in zip(diagnoser.requests, results, strict=True)}
    return diagnoser.diagnose(lambda request: answers[request.id])
