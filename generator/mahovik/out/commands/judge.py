"""`judge`: a program, an FMU or a log against the reference; the fault in its equations."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Annotated, Any, Literal

from mahovik.contract.functions import ALL_WANTS
from mahovik.errors import CheckError, UsageError, above_zero, whole_number
from mahovik.nearest import names_in, suggestion
from mahovik.out.arguments import FilePath, Names, Progressing, Seconds, command, expecting, reading, time
from mahovik.out.commands.verify import report_result
from mahovik.out.notices import Progress, notify, warn
from mahovik.out.result import Result
from mahovik.writing import probe

if TYPE_CHECKING:
    from mahovik.core.stand.model import Stand as CoreStand
    from mahovik.proof.diagnose.answers import Answers
    from mahovik.proof.diagnose.diagnosis import Judged
    from mahovik.proof.verify.foreign import Program
    from mahovik.proof.verify.states import Request

MARGIN = 10.0
"""Accepted difference over the error of derived accelerations."""

COARSEST = 0.01
"""Largest accepted difference of derived accelerations."""


@command(needs={"fmu": ("map",), "map": ("fmu",), "with_": ("attitude",)}, excludes={"log": ("states", "timeout")})
def judge(
    stand: Annotated[str | Path, "STAND.toml"],
    *,
    with_: Annotated[str, "COMMAND"] | None = None,
    fmu: FilePath | None = None,
    map: FilePath | None = None,
    log: FilePath | None = None,
    attitude: Literal["quaternion", "angles"] | None = None,
    want: Names = (),
    explain: bool = False,
    states: int = 200,
    seed: int = 1,
    tolerance: float = 1e-12,
    timeout: Seconds = "5 min",
    junit: FilePath | None = None,
    progress: Progressing = None,
) -> Result:
    """Judge a program, an FMU or a log by the reference, and find its fault.

    Compares every quantity that a program offers with the literal reference. With --explain the error of a program that
    differs is compared with wrong readings, then with wrong numbers of the stand file; where none is the cause, the few
    wrong terms are found whose sum is the error. All rows of a log are compared. `mahovik new adapter` writes a program
    to begin with, and says what each answer is. Exit status 1 where it does not agree.

    Args:
        stand: the stand file, which the program reads.
        with_: start this program; {stand} stands for the stand file.
        fmu: judge this FMU instead, with --map.
        map: read from this file what the variables of the FMU are.
        log: judge this log of states and accelerations instead, with the columns of `simulate`.
        attitude: give attitudes in this form; default some states each way.
        want: wants that the program must offer; default those that it offers.
        explain: name the fault in its equations if it differs.
        states: number of states.
        seed: seed of the random states.
        tolerance: accepted difference, relative to the natural scale.
        timeout: limit of the time of the program, s or with a unit.
        junit: write the table as JUnit XML too.

    Raises:
        UsageError: options that contradict one another, a program that cannot be started.
        DataError: a log that cannot be read.
    """
    from mahovik.out.api.stands import Stand

    machine, wants = Stand.of(stand), names_in("want", want) if want else ()
    longest = time("timeout", timeout)
    for name, value in (("tolerance", tolerance), ("timeout", longest)):
        above_zero(name, value)
    whole_number("states", states)
    if junit is not None:
        probe(Path(junit))
    if unknown := [word for word in wants if word not in ALL_WANTS]:
        raise UsageError(f'want: unknown "{unknown[0]}"{suggestion(unknown[0], ALL_WANTS)}')
    judged = sum(subject is not None for subject in (with_, log, fmu))
    if judged != 1:
        raise UsageError(f"with_, log, fmu: found {judged or 'none'} of them, expected one")
    with TemporaryDirectory(prefix="mahovik-") as unpacked:
        notify(progress, Progress(f"judge {next(x for x in (with_, log, fmu) if x is not None)}"))
        if log is not None:
            return _explained(machine, _judge_log(machine, Path(log), wants, tolerance), explain, seed, junit, progress)
        if fmu is not None and map is not None:
            from mahovik.proof.verify.fmu import fmu_program

            with expecting("fmu", fmu), expecting("map", map):
                program = fmu_program(Path(fmu), Path(unpacked), Path(map), machine, str(stand))
        else:
            from mahovik.proof.verify.foreign import program_of

            program = program_of(str(with_), str(stand), attitude)
            program = replace(program, actuators=_takes_actuators(machine, program, longest))
        judged_program = _judge_program(machine, program, wants, seed, states, longest, tolerance)
        return _explained(machine, judged_program, explain, seed, junit, progress)


def _judge_program(
    stand: CoreStand, program: Program, wants: tuple[str, ...], seed: int, count: int, timeout: float, tolerance: float
) -> Judged:
    """The verdict on a program."""
    from mahovik.proof.diagnose.diagnosis import Judged
    from mahovik.proof.verify.foreign import answers_of_program, verify_program

    def answers(requests: Sequence[Request]) -> Answers:
        results = answers_of_program(program, requests, timeout)
        by_id = {request.id: result for request, result in zip(requests, results, strict=True)}
        return lambda request: by_id[request.id]

    report = verify_program(stand, program, wants=wants, seed=seed, count=count, timeout=timeout, tolerance=tolerance)
    return Judged(report, answers, tolerance, program=program)


def _takes_actuators(stand: CoreStand, program: Program, timeout: float) -> bool:
    """Whether deflections and speeds can be varied; a warning where the stand has them and the program ignores them."""
    from mahovik.proof.verify.foreign import takes_actuators
    from mahovik.proof.verify.states import actuators_of

    if not actuators_of(stand):
        return False
    try:
        actuators = takes_actuators(stand, program, timeout)
    except CheckError:
        return False  # the table will say what is wrong with it
    if not actuators:
        warn(
            f"{program.name}: its answers do not depend on `actuators` of a state: deflections of fins and speeds of "
            "propellers are those of the stand file"
        )
    return actuators


def _judge_log(stand: CoreStand, path: Path, wants: tuple[str, ...], tolerance: float) -> Judged:
    """The verdict on a log."""
    from mahovik.proof.diagnose.diagnosis import Judged
    from mahovik.proof.verify.foreign import verify_log
    from mahovik.proof.verify.states import Request
    from mahovik.use.measured.state_log import read_state_log

    log = reading("data", path, read_state_log, stand)
    for note in log.notes:
        warn(note)
    if log.error and MARGIN * log.error > tolerance:
        tolerance = min(MARGIN * log.error, COARSEST)
        warn(f"{path}: accepted are differences of {tolerance:.0e}, as derived accelerations need")
    answered = [
        (Request(f"{name}, {want}", state, (want,)), rows[name])
        for name, state in log.states
        for want, rows in log.answers.items()
        if name in rows
    ]
    report = verify_log(stand, str(path), answered, len(log.states), wants=wants, tolerance=tolerance)
    by_id = {request.id: result for request, result in answered}
    return Judged(report, lambda _: lambda request: by_id.get(request.id, {}), tolerance, log.states)


def _explained(
    stand: CoreStand, judged: Judged, explain: bool, seed: int, junit: FilePath | None, progress: Progressing
) -> Result:
    """The verdict; with its diagnosis in JSON and in sentences, where one is asked for and possible."""
    report, more, words = judged.report, dict[str, Any](), tuple[str, ...]()
    if explain and not report.error:
        from mahovik.out.api.stands import Stand
        from mahovik.proof.diagnose.diagnosis import as_object, diagnose_fault, sentences

        notify(progress, Progress("distinguish faults"))
        try:
            diagnosis = diagnose_fault(stand, Stand.of(stand).to_dict(), judged, seed)
        except CheckError as error:
            report = replace(report, error=str(error))
        else:
            more, words = {"diagnosis": as_object(diagnosis)}, tuple(sentences(diagnosis))
    return report_result(report, more=more, words=words, everything=True, junit=junit, command="judge")
