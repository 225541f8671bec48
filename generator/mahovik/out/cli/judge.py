"""`mahovik judge`: judge a program that implements the contract of `eval`; --explain names its fault."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from mahovik.errors import CheckError
from mahovik.out.cli.arguments import load_stand, stand_argument
from mahovik.out.cli.json_output import json_option
from mahovik.out.cli.progress import progress
from mahovik.out.cli.verify import finish, read_wants

if TYPE_CHECKING:
    from mahovik.core.stand.model import Stand
    from mahovik.proof.diagnose.diagnosis import Diagnosis
    from mahovik.proof.verify.report import Report


@click.command(short_help="Judge a program, and find its fault.")
@stand_argument
@click.option(
    "--with", "command", metavar="COMMAND", required=True, help="The program, which reads states; {stand}: the file."
)
@click.option("--explain", is_flag=True, help="If it differs, name the fault in its equations.")
@click.option("--want", metavar="NAME,...", help="Wants the program must offer; default: those it offers.")
@click.option("--states", default=200, show_default=True, type=click.IntRange(1, 1_000_000), help="Number of states.")
@click.option("--seed", default=1, show_default=True, type=click.IntRange(0), help="Seed of the random states.")
@click.option(
    "--tolerance",
    default=1e-12,
    show_default=True,
    type=click.FloatRange(1e-15, 0.1),
    help="Accepted difference, relative to the natural scale.",
)
@click.option(
    "--timeout", default=300.0, show_default=True, type=click.FloatRange(0.1), help="Time limit of the program, s."
)
@json_option("Print table and diagnosis as JSON.")
@click.option("--junit", metavar="FILE", type=click.Path(), help="Also write the table as JUnit XML.")
@click.option(
    "-o", "worst", metavar="FILE", type=click.Path(), help="Worst states, for `eval`; default on failure only."
)
def judge(
    stand_file: str,
    command: str,
    explain: bool,
    want: str | None,
    states: int,
    seed: int,
    tolerance: float,
    timeout: float,
    as_json: bool,
    junit: str | None,
    worst: str | None,
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
    from mahovik.proof.diagnose.diagnosis import Clinic, Diagnosis
    from mahovik.proof.verify.foreign import ask

    if found.passed:
        return Diagnosis("equal")
    offered = tuple(dict.fromkeys(row.want for row in found.rows if row.verdict in ("ok", "FAILED")))
    if not offered:
        return Diagnosis("nothing")
    clinic = Clinic(stand, seed, offered)
    results = ask(command, stand_file, clinic.requests, timeout)
    answers = {request.id: result for request, result in zip(clinic.requests, results, strict=True)}
    return clinic.diagnose(lambda request: answers[request.id])
