"""`verify`: our C by two derivations, a delivered folder, a programme, the log of a board; what calls cost."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict
from functools import partial
from pathlib import Path
from textwrap import shorten
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np

from mahovik.contract.functions import ALL_WANTS, is_public
from mahovik.errors import CheckError, ToolchainError, UsageError, library, whole_number
from mahovik.nearest import names_in
from mahovik.out.arguments import (
    FileGiven,
    FilePath,
    Names,
    Progressing,
    StandGiven,
    Text,
    command,
    motion_of,
    programme_of,
    servo_of,
)
from mahovik.out.notices import Progress, notify, warn
from mahovik.out.plots import Line, Panel
from mahovik.out.result import Column, Result, column, columns_of
from mahovik.writing import probe, write

if TYPE_CHECKING:
    from mahovik.core.motion.programme import Programme
    from mahovik.core.motion.required import RequiredMotion
    from mahovik.core.motion.servo import Servo
    from mahovik.core.stand.model import Stand
    from mahovik.proof.verify.check import Check, Report

MOST_FUNCTIONS = 22
"""Functions in the short table; a check that failed is always there."""

MOST_BARS, LEAST_SHARE = 60, 1e-8
"""Functions in the picture, and the share of its limit that a difference is drawn with at least."""

CHECK_COLUMNS = (
    "judged", "quantity", "states", "skipped", "value", "limit", "second", "state", "verdict", "words",
)  # fmt: skip
"""All there is to say of a check."""

WAYS = ("targets", "cost", "judges", "rigorous")
"""Verifications of the C of their own."""


@command(
    needs={
        "subject": ("servo",),
        "motion": ("programme",),
        "subject=*.json or programme": ("tolerance",),
        "subject=*.json or programme or servo": ("motion", "name"),
    },
    excludes={
        "subject=*.json": ("servo", "only", "states", "seed", "real", *WAYS, "all", "worst"),
        "cost": ("states", "seed", "all", "junit", "worst", "programme", "motion"),
    },
)
def verify(
    stand: StandGiven,
    subject: Annotated[FilePath, "FOLDER|PROGRAMME.json|LOG"] | None = None,
    *,
    motion: FileGiven | None = None,
    programme: FileGiven | None = None,
    servo: FilePath | None = None,
    name: Text = "programme",
    only: Names = (),
    states: int = 200,
    seed: int = 1,
    real: Literal["double", "float"] | None = None,
    tolerance: float | None = None,
    targets: Text | None = None,
    cost: bool = False,
    judges: bool = False,
    rigorous: bool = False,
    all: bool = False,
    junit: FilePath | None = None,
    worst: FilePath | None = None,
    progress: Progressing = None,
) -> Result:
    """Judge the C of a stand, a programme or a board's log.

    Without a second argument, generates the C, compiles it with warnings as errors, evaluates random and extreme
    states, and compares every quantity with the literal reference (worst), and that with the second derivation,
    relative to its measured scale. A FOLDER of `mahovik generate` is judged as it is, with the name, element type and
    functions that it has; with --programme or --servo the C of these there: every function by the law in plain NumPy.
    A PROGRAMME.json is judged with its --motion by the literal reference and an adaptive integration, independent of
    planning. A LOG is what the self-test printed on a board: every function must report PASS, and have the bits of this
    machine.

    --targets runs the self-test on emulated processors: the same bits? --cost counts instructions, stack, code and
    constants there, into COST.md of FOLDER.

    Exit status: 0 only if all agree; 2 also where a compiler or an emulator is missing.

    Args:
        stand: the stand file.
        subject: folder, programme or log; default a fresh copy of the C.
        motion: required motion of a programme.
        programme: judge this programme, and its C in FOLDER; or along it the servos.
        servo: judge the C of these servos in FOLDER.
        name: name of the programme in C.
        only: functions that a LOG has, as `generate --only` was given; default those of its default.
        states: number of states.
        seed: seed of the random states.
        real: element type; default that of FOLDER, else double; of --targets both, of --cost that of each FPU.
        tolerance: accepted relative residual of a programme, and 20 times it in simulation; default 1e-6, with damping
            of V|V| 1e-5.
        targets: processors, all, quick or m7,rv64gc,...; of --cost m4, m7, rv32imafc, rv64gc by default.
        cost: measure what calls cost.
        judges: judge by Pinocchio and MuJoCo, without the laws that they do not know.
        rigorous: bound the true error of the C by enclosures of the exact answer.
        all: print every check, not a line for each function.
        junit: write the table as JUnit XML too.
        worst: write the states of the largest differences, for `eval`.

    Raises:
        UsageError: options that contradict one another.
        ToolchainError: the C does not compile, or a tool is missing.
        CheckError: C of another stand in FOLDER.
    """
    from mahovik.out.api.stands import Stand

    machine = Stand.of(stand)
    whole_number("states", states)
    whole_number("seed", seed, 0)
    for file in (junit, worst):
        if file is not None:
            probe(Path(file))
    ways = dict(zip((*WAYS, "servo"), (targets, cost, judges, rigorous, servo), strict=True))
    chosen = [way for way, value in ways.items() if value and not (way == "targets" and cost)]
    if len(chosen) > 1:
        raise UsageError(f"{', '.join(chosen)}: each is a verification of its own, expected one of them")
    path = None if subject is None else Path(subject)
    if path is not None and path.suffix == ".json":
        return report_result(_programme(machine, path, motion, tolerance, None, name, progress), junit=junit)
    if path is not None and path.is_file():
        return _log(machine, path, names_in("only", only))
    if path is not None and not path.is_dir() and not cost:
        raise UsageError(f"{path}: no such file or folder, expected a folder of C, a programme or a log")
    if only:
        raise UsageError("only: of a LOG, which is missing")
    if cost:
        return _cost(machine, path, targets, real, progress)
    if servo is not None and path is not None:
        report = _servo(machine, path, servo, programme, motion, name, seed, states)
        return report_result(report, by="part", everything=True, junit=junit)
    if programme is not None:
        return report_result(_programme(machine, programme, motion, tolerance, path, name, progress), junit=junit)
    report = _c(machine, stand, path, ways, states, seed, real, progress)
    if targets and not report.passed and not any(row.verdict == "FAILED" for row in report.rows):
        from mahovik.proof.verify.check import conclusion

        raise ToolchainError(f"{machine.name}: {conclusion(report)}")
    by = "target" if targets else ""
    return report_result(report, by=by, everything=all or judges or bool(targets), junit=junit, worst=worst)


def _c(
    machine: Stand, stand: Any, folder: Path | None, ways: Mapping[str, Any], states: int, seed: int, real: str | None,
    progress: Progressing,
) -> Report:  # fmt: skip
    """The report on the C, of a folder or a fresh copy. Raises CheckError, ToolchainError, UsageError."""
    from mahovik.core.emit.delivered import Options, delivered_options, stand_in
    from mahovik.out.api.stands import Stand

    document: Mapping[str, Any] = Stand.of(machine).to_dict()
    if isinstance(stand, str | Path):
        from mahovik.proof.second.reading import load_tables

        document = load_tables(Path(stand))
    machine = machine if folder is None else stand_in(folder, machine)
    there = (folder and delivered_options(folder)) or Options()
    chosen = real or there.real

    def on_state(done: float, *_: object) -> None:
        notify(progress, Progress(f"verify {machine.name}", done, states))

    if ways["judges"]:
        if folder is not None or real == "float":
            raise UsageError("judges: judge a fresh copy in double, not a FOLDER")
        from mahovik.proof.verify.judges import verify_judges

        return verify_judges(machine, seed=seed, count=states, progress=on_state)
    if ways["targets"]:
        from mahovik.proof.verify.selftest import SWEEP, parse_targets, verify_targets

        reals = (chosen,) if real or folder is not None else None
        pairs = parse_targets(ways["targets"], reals)
        return verify_targets(machine, pairs, SWEEP if states == 200 else states, on_state, there.only or None)
    if ways["rigorous"]:
        library("flint", "rigorous")
        from mahovik.proof.verify.rigorous import measure_rounding

        return measure_rounding(machine, seed=seed, count=states, real=chosen, against=folder, progress=on_state)
    from mahovik.proof.verify.harness import verify_c

    return verify_c(machine, seed=seed, count=states, against=folder, real=chosen, progress=on_state, document=document)


def _servo(
    stand: Stand, folder: Path, servo: Any, programme: Any, motion: Any, name: str, seed: int, states: int
) -> Report:
    """The report on the C of servos in a folder."""
    from mahovik.core.emit.delivered import stand_in
    from mahovik.proof.verify.functions.table import verify_servo

    stand = stand_in(folder, stand)
    course = None if programme is None else programme_of(programme)
    required, servos = None if motion is None else motion_of(motion, stand, course), servo_of(servo, stand)
    generate = None if course is None or required is None else partial(_generate, stand, course, required, servos, name)
    return verify_servo(
        stand, servos, folder, motion=required, programme=course, name=name, seed=seed, count=states, generate=generate
    )


def _generate(
    stand: Stand, course: Programme, motion: RequiredMotion, servo: Servo | None, name: str, real: str, kind: str,
    torques: bool,
) -> Mapping[str, str]:  # fmt: skip
    """The C of a programme, or of its servo, as this version generates it, with tables of a kind."""
    if servo is None:
        from mahovik.out.export.programme import export_programme

        return export_programme(stand, course, motion if torques else None, kind, real=real, called=name).files
    from mahovik.out.export.servo import export_servo

    return export_servo(stand, course, motion, servo, real, kind, called=name).servo


def _programme(
    stand: Stand, programme: Any, motion: Any, tolerance: float | None, folder: Path | None, name: str,
    progress: Progressing,
) -> Report:  # fmt: skip
    """The report on a programme, and with `folder` on its C there."""
    from mahovik.core.emit.delivered import stand_in
    from mahovik.proof.verify.check import report
    from mahovik.proof.verify.programme.verification import ProgrammeCase, verify_programme

    stand = stand if folder is None else stand_in(folder, stand)
    if motion is None:
        raise UsageError("motion: missing, expected motion=M.json, the required motion of the programme")
    if tolerance is not None and not 1e-12 <= tolerance <= 0.1:
        raise UsageError(f"tolerance {tolerance:g}: expected 1e-12 to 0.1")
    course = programme_of(programme)
    required = motion_of(motion, stand, course)
    notify(progress, Progress("by the reference"))
    checks = verify_programme(stand, required, course, tolerance=tolerance)
    if folder is not None and not any(item.failed for item in checks):
        from mahovik.proof.verify.functions.table import verify_compiled

        case = ProgrammeCase.of(stand, required, course, tolerance)
        generate = partial(_generate, stand, course, required, None, name)
        checks += verify_compiled(stand, case, folder, name, generate)
    return report(stand, f"programme of {required.name}", None, len(checks), tolerance or 0.0, checks)


def _log(stand: Stand, path: Path, only: tuple[str, ...]) -> Result:
    """The result on the output of the self-test of a board. Raises CheckError with every problem."""
    from mahovik.core.stand.files import TABLE, content
    from mahovik.proof.verify.selftest import judge_log

    log_verdict = judge_log(content(path, TABLE).decode("utf-8", "replace"), str(path), stand, only)
    if log_verdict.problems:
        raise CheckError("\n".join(f"{path}: {line}" for line in log_verdict.problems))
    return Result(
        f"{'PASS' if not log_verdict.unchecked else 'not all of it was checked'}   {path}",
        (
            *columns_of(log_verdict.runs, dict.fromkeys(("stand", "real", "structure", "physics"), "")),
            column("functions", "", [len(run.functions) for run in log_verdict.runs]),
            column("sweep", "", [run.sweep for run in log_verdict.runs]),
        ),
        rows="runs",
        meta={"checked": log_verdict.checked, "unchecked": log_verdict.unchecked},
        messages=[f"not checked: {line}" for line in log_verdict.unchecked],
        ok=not log_verdict.unchecked,
        details=("unchecked",),
    )


def _cost(stand: Stand, folder: Path | None, targets: str | None, real: str | None, progress: Progressing) -> Result:
    """What calls cost on processors; written into a folder of the stand's C."""
    from mahovik.core.emit.delivered import COST_PAGE, Options, delivered_options, stand_in
    from mahovik.proof import cost

    options = Options()
    if folder is not None:
        stand, options = stand_in(folder, stand, UsageError), delivered_options(folder) or options
        cost.require_place(folder, stand)
    chosen = "float" if real is None and options.real == "float" else real
    pairs, absent = cost.available(cost.parse_targets(targets, chosen))
    for line in absent:
        warn(f"left out: {line}")
    notify(progress, Progress(f"cost of {stand.name}"))
    costs = cost.measure(stand, pairs, lambda *_: None, options.only, "recorder" in options.additions)
    if folder is not None:
        write(folder / COST_PAGE, cost.page(costs))
    figures = asdict(costs)
    rows = [(target, function) for target in figures["targets"] for function in target["functions"]]
    names = [key for key in (rows[0][1] if rows else {}) if key != "function"]
    cells = {
        key: [", ".join(x) if isinstance(x := function[key], tuple) else x for _, function in rows] for key in names
    }
    return Result(
        f"cost of {stand.name}: instructions and bytes",
        (
            *columns_of([target for target, _ in rows], {"target": "", "real": ""}),
            column("function", "", [function["function"] for _, function in rows]),
            *(column(key, "", values) for key, values in cells.items()),
        ),
        rows="functions",
        meta=figures,
        details=tuple(figures),
    )


def report_result(
    report: Report, *, by: str = "", more: Mapping[str, Any] | None = None, words: Sequence[str] = (),
    everything: bool = False, junit: Any = None, worst: Any = None, command: str = "verify",
) -> Result:  # fmt: skip
    """The result of a report: a line for each function, and `rows` with every check.

    by          head of the column of what is judged; more, words: further entries and sentences
    everything  a line for each check instead
    """
    from mahovik.proof.verify.check import as_junit, conclusion, summary, worst_lines

    about = summary(report)
    named = {row.judged for row in report.rows if row.judged}
    by = by or ("want" if named <= {*ALL_WANTS} else "function" if all(map(is_public, named)) else "judge")
    if junit is not None:
        write(Path(junit), as_junit(report, command, words))
    messages = [f"error: {report.error}"] if report.error else []
    if report.left_out:
        messages.append(f"the stand without: {', '.join(report.left_out)}")
    messages += [*words, "FAILED" if report.error else conclusion(report)]
    if worst is not None and (lines := worst_lines(report)):
        write(Path(worst), lines)
        messages.append(f"worst states: {worst}")
    checks = Result("", columns_of(report.rows, dict.fromkeys(CHECK_COLUMNS, "")))
    hidden = () if not everything or checks.count else CHECK_COLUMNS
    short, absent = _shortest(report.rows)
    if not everything and absent:
        text = f"not compared, all=True says why: {', '.join(dict.fromkeys(absent))}"
        messages.insert(0, shorten(text, 100, placeholder=" ..."))
    return Result(
        f"{report.judged} of {report.stand}   structure {report.structure}, physics {report.physics}"
        + ("" if report.seed is None else f"   seed {report.seed}"),
        checks.columns if everything else _short_columns(short, by),
        rows="rows" if everything else "nearest",
        meta=about | {"rows": checks} | dict(more or {}),
        messages=messages,
        ok=report.passed,
        whole=True,
        details=(*about, "rows", *hidden, *(more or {})),
        drawings=[_shares(report.rows)] if any(row.limit for row in report.rows) else [],
    )


def _shortest(rows: Sequence[Check]) -> tuple[list[Check], list[str]]:
    """A check for each function, that nearest to its limit, and all that failed; names of what is not compared."""
    groups: dict[str, list[Check]] = {}
    for row in rows:
        groups.setdefault(row.judged, []).append(row)
    nearest: list[Check] = []
    failed = [row for row in rows if row.failed]
    absent = [row.judged or row.quantity for row in rows if row.verdict == "not compared"]
    for name, group in groups.items():
        good = [row for row in group if row.verdict == "ok"]
        if name and good and not any(row.failed for row in group):
            nearest.append(max(good, key=lambda row: row.share))
        elif not name:
            nearest += [row for row in good if not row.failed]
        if any(row.verdict != "not compared" for row in group):
            absent = [other for other in absent if other != name]
    nearest.sort(key=lambda row: -row.share)
    return [*failed, *nearest[:MOST_FUNCTIONS]], absent


def _short_columns(rows: Sequence[Check], by: str) -> tuple[Column, ...]:
    def cells(row: Check) -> tuple[Any, ...]:
        """The figures that are nearest to their limit are those of the C, or of the second derivation."""
        second = row.second is not None and row.second * row.limit > row.value * row.accepted_of_second
        figures = (row.second, row.accepted_of_second) if second else (row.value, row.limit)
        quantity = f"{row.quantity}{' of the second derivation' if second else ''}"
        verdict = f"{row.verdict} {row.words if row.failed else ''}".strip()
        return (row.judged, row.states, *figures, shorten(quantity, 40, placeholder=" ..."), verdict)

    heads = (by, "states", "worst", "limit", "nearest to its limit", "verdict")
    columns = list(zip(*map(cells, rows), strict=True)) or [()] * len(heads)
    shown = [column(head, "", values) for head, values in zip(heads, columns, strict=True)]
    if rows and not any(row.judged for row in rows):  # of a programme: what has no parts begins with what is checked
        return (column("check", "", columns[4]), shown[2], shown[3], shown[5])
    return tuple(shown)


def _shares(rows: Sequence[Check]) -> Panel:
    """The largest difference of each function as a share of its limit, a bar each; of what has none, of each check."""
    shares = dict[str, float]()
    for row in rows:
        if row.limit:
            name = row.judged or row.quantity
            shares[name] = max(shares.get(name, LEAST_SHARE), min(row.share, 1.0 / LEAST_SHARE))
    largest = sorted(shares.items(), key=lambda entry: -entry[1])[:MOST_BARS]
    bars = [
        Line("", np.array([LEAST_SHARE, share]), np.array([k, k]), width=5.0) for k, (_, share) in enumerate(largest)
    ]
    limit = Line("", np.ones(2), np.array([-1.0, len(bars)]), None, dashed=True)
    return Panel(
        "difference as a share of its limit", (*bars, limit), abscissa="share", height=0.3 + 0.085 * len(bars),
        log_abscissa=True, names=tuple(name for name, _ in largest),
    )  # fmt: skip
