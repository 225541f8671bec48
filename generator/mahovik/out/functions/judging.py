"""`judge`: a program, an FMU or a log against the reference; the fault in its equations."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from mahovik.contract.functions import ALL_WANTS
from mahovik.core.stand.model import Stand as CoreStand
from mahovik.core.stand.state import State
from mahovik.errors import CheckError, UsageError, above_zero
from mahovik.nearest import suggestion
from mahovik.out.api.stands import Stand
from mahovik.out.arguments import Number, time
from mahovik.out.functions.evidence import Verification
from mahovik.out.notices import OnProgress, Progress, tell, warn

if TYPE_CHECKING:
    from mahovik.proof.diagnose.diagnosis import Diagnosis
    from mahovik.proof.verify.check import Report
    from mahovik.proof.verify.foreign import Attitude, Program
    from mahovik.proof.verify.states import Request

States = Sequence[tuple[str, State]]
Answers = Callable[["Request"], Mapping[str, Any]]

ROWS_OF_FAULTS = 14
"""Rows of a log at which its error is compared with that of each fault."""

MARGIN = 10.0
"""Accepted difference over the error of derived accelerations."""

COARSEST = 0.01
"""Largest accepted difference of derived accelerations."""

ROWS_OF_TERMS = 3
"""Rows of a log for each product whose factor is looked for, at most."""

STATES = 200
"""Number of states by default."""


@dataclass(frozen=True)
class Judged:
    """A verdict, and what can be asked to find its fault.

    answers    of requests
    tolerance  accepted difference, relative to the natural scale
    states     the only ones with answers, those of a log; None: any
    program    that answers; None of a log
    """

    found: Report
    answers: Callable[[Sequence[Request]], Answers]
    tolerance: float
    states: States | None = None
    program: Program | None = None


def judge(
    stand: str | Path,
    command: str | None = None,
    *,
    log: str | Path | None = None,
    fmu: str | Path | None = None,
    variables: str | Path | None = None,
    attitude: Attitude | None = None,
    explain: bool = False,
    want: Sequence[str] = (),
    states: int = STATES,
    seed: int = 1,
    tolerance: float = 1e-12,
    timeout: Number = 300.0,
    progress: OnProgress | None = None,
) -> Verification:
    """Judge a program that implements the contract of `eval`, an FMU, or a log of states, and find its fault.

    stand      path of the stand file, which the program reads; `{stand}` in `command` stands for it
    log        CSV or Parquet file in place of a program, with the columns of `simulate`; all its rows are judged
    fmu        FMU in place of a program; variables: the file that maps its variables
    attitude   how a program is given attitudes, "quaternion" or "angles"; default: some states each way
    explain    name the fault where it differs; want: wants it must offer, default those that it offers
    tolerance  relative to the natural scale; timeout of the program, s, or a text with a unit

    A program that dies or hangs gives a result with an `error`. Raises StandError, DataError, UsageError where it
    cannot start.
    """
    own, longest, wants = Stand.of(stand), time("timeout", timeout), tuple(want)
    for name, value in (("tolerance", tolerance), ("timeout", longest)):
        above_zero(name, value)
    if unknown := [each for each in want if each not in ALL_WANTS]:
        raise UsageError(f'want: unknown "{unknown[0]}"{suggestion(unknown[0], ALL_WANTS)}')
    judged = [name for name, each in (("--with", command), ("--log", log), ("--fmu", fmu)) if each is not None]
    if len(judged) != 1:
        raise UsageError(f"--with, --log, --fmu: found {' and '.join(judged) or 'none'}, expected one of them")
    if (fmu is None) != (variables is None):
        raise UsageError("--fmu, --map: one is missing, expected both")
    if attitude is not None and command is None:
        raise UsageError("--attitude: only of a program, --with; a map and a log have their own attitudes")
    if attitude not in (None, "quaternion", "angles"):
        raise UsageError(f'attitude: found "{attitude}", expected "quaternion" or "angles"')
    from mahovik.proof.verify.fmu import fmu_program
    from mahovik.proof.verify.foreign import answers_of_program, program_of, verify_program

    with TemporaryDirectory(prefix="mahovik-") as unpacked:
        tell(progress, Progress(f"judge {next(x for x in (command, log, fmu) if x is not None)}"))
        if log is not None:
            return _explained(own, _judge_log(own, Path(log), wants, tolerance), explain, seed, progress)
        if fmu is not None and variables is not None:
            program = fmu_program(Path(fmu), Path(unpacked), Path(variables), own, str(stand))
        else:
            program = program_of(str(command), str(stand), attitude)
            program = replace(program, actuators=_takes_actuators(own, program, longest))
        found = verify_program(own, program, wants=wants, seed=seed, count=states, timeout=longest, tolerance=tolerance)

        def answers(requests: Sequence[Request]) -> Answers:
            results = answers_of_program(program, requests, longest)
            by_id = {request.id: result for request, result in zip(requests, results, strict=True)}
            return lambda request: by_id[request.id]

        return _explained(own, Judged(found, answers, tolerance, program=program), explain, seed, progress)


def _takes_actuators(stand: CoreStand, program: Program, timeout: float) -> bool:
    """Whether deflections and speeds can be varied; a warning where the stand has them and the program ignores them."""
    from mahovik.proof.verify.foreign import takes_actuators
    from mahovik.proof.verify.states import actuators_of

    if not actuators_of(stand):
        return False
    try:
        found = takes_actuators(stand, program, timeout)
    except CheckError:
        return False  # the table will say what is wrong with it
    if not found:
        warn(
            f"{program.name}: its answers do not depend on `actuators` of a state: deflections of fins and speeds of "
            "propellers are those of the stand file"
        )
    return found


def _judge_log(stand: CoreStand, path: Path, wants: tuple[str, ...], tolerance: float) -> Judged:
    """The verdict on a log."""
    from mahovik.proof.verify.foreign import verify_log
    from mahovik.proof.verify.states import Request
    from mahovik.use.measured.state_log import read_state_log

    log = read_state_log(path, stand)
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
    found = verify_log(stand, str(path), answered, len(log.states), wants=wants, tolerance=tolerance)
    by_id = {request.id: result for request, result in answered}
    return Judged(found, lambda _: lambda request: by_id.get(request.id, {}), tolerance, log.states)


def _explained(stand: CoreStand, judged: Judged, explain: bool, seed: int, progress: OnProgress | None) -> Verification:
    """The verdict with its diagnosis, where one is asked for and possible."""
    if not explain or judged.found.error:
        return Verification(judged.found)
    tell(progress, Progress("distinguish faults"))
    try:
        return Verification(judged.found, _diagnosis(stand, judged, seed))
    except CheckError as error:
        return Verification(replace(judged.found, error=str(error)))


def _diagnosis(stand: CoreStand, judged: Judged, seed: int) -> Diagnosis:
    """Diagnosis of what differs, for the wants that it offers. Raises CheckError, UsageError."""
    from mahovik.proof.diagnose.answers import spread_rows
    from mahovik.proof.diagnose.columns import count
    from mahovik.proof.diagnose.diagnosis import Diagnoser, Diagnosis
    from mahovik.proof.diagnose.search import WANTS, TermSearch

    found, states, program = judged.found, judged.states, judged.program
    if found.passed:
        return Diagnosis("none")
    offered = tuple(dict.fromkeys(row.judged for row in found.rows if row.verdict in ("ok", "FAILED")))
    if not offered:
        return Diagnosis("unnamed", unexplained=1.0, failed=_failure_words(found))
    rows = None if states is None else spread_rows(states, ROWS_OF_FAULTS + len(stand.flywheels))
    document = Stand.of(stand).to_dict()
    diagnoser = Diagnoser(
        stand, document, seed=seed, wants=offered, states=rows, tolerance=judged.tolerance, program=program
    )
    diagnosed = diagnoser.diagnose(judged.answers(diagnoser.requests))
    diagnosed = replace(diagnosed, failed=_failure_words(found, diagnosed.wrong))
    precision = diagnosed.precision
    if precision is None or not diagnosed.wrong or (diagnosed.verdict == "named" and len(diagnosed.causes) < 2):
        if diagnosed.verdict == "none" and diagnosed.failed:
            return replace(diagnosed, verdict="unnamed")
        return diagnosed
    if not set(offered) & set(WANTS):
        return diagnosed
    if states is not None:
        states = spread_rows(states, ROWS_OF_TERMS * count(stand))
    terms = TermSearch(stand, seed, offered, states, precision, program, diagnosed.wrong)
    try:
        return diagnosed.with_terms(terms.find(judged.answers(terms.requests)))
    except CheckError as error:
        if not (diagnosed.missing or diagnosed.causes):
            raise
        return diagnosed if diagnosed.verdict == "named" else replace(diagnosed, hindrance=str(error))


def _failure_words(found: Report, compared: Sequence[str] = ()) -> tuple[str, ...]:
    """What failed in the table, with its reason; without what a diagnosis has `compared`, as want: quantity."""
    return tuple(
        f"{row.judged} {row.quantity}".strip() + (f" ({row.words})" if row.words else "")
        for row in found.failures
        if not any(f"{each}.".startswith(f"{row.judged}: {row.quantity}.") for each in compared)
    )
