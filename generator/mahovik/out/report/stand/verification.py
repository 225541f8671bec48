"""Verification of the stand, run now, with results; and the checks that were not run, with their commands."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from importlib.metadata import version
from itertools import groupby

from markupsafe import Markup

from mahovik.contract.limits import DOUBLE
from mahovik.core.stand.model import Stand
from mahovik.core.toolchain.board import version as program_version
from mahovik.core.toolchain.compiler import find_compiler
from mahovik.errors import ToolchainError, UsageError
from mahovik.out.api.stands import Stand as StandWithKeys
from mahovik.out.report.stand.markup import Cell, markup_of, sentence, share, table, verdict
from mahovik.out.report.stand.material import Material, Section, generate_once
from mahovik.proof.second import Second
from mahovik.proof.verify.backends import NumpyBackend
from mahovik.proof.verify.c_backend import CBackend, InterpreterBackend
from mahovik.proof.verify.check import Check, Report, conclusion, report
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.harness import judge, verify_c
from mahovik.proof.verify.judges import PROGRAMS, missing, verify_judges
from mahovik.proof.verify.targets import TargetsReport, parse_targets, verify_targets

STATES = 16
"""Random and extreme, of three derivations; `mahovik verify` takes more."""

JUDGED_STATES = 8
"""States of each outside judge."""


def section(material: Material) -> Section | None:
    """Three derivations, judges that are installed, targets where they were asked for; then what was not run."""
    stand, file = material.stand, material.stand_file or f"{material.stand.name}.toml"
    open_ = list[tuple[str, str]]()
    three, reason = _compare_three(stand)
    if reason:
        open_.append((f"the compiled C: {reason}", f"mahovik verify {file}"))
    outside: dict[str, Report] = {}
    for name in PROGRAMS:
        found, reason = _outside(stand, name)
        if found is not None:
            outside[name] = found
        else:
            open_.append((f"{TITLES[name]}: {reason}", f"mahovik verify {file} --judges"))
    targets, reason = _on_targets(material)
    if targets is None:
        command = f"mahovik verify {file} --targets {material.targets or 'quick'}"
        open_.append((f"processors: the same bits as on the host{reason}", command))
    without = _group_by_feature(missing(stand))
    failures, summary = _summary(three, outside, targets, without)
    tools = [f"NumPy {version('numpy')}", f"CasADi {version('casadi')}"]
    if three.judged == "generated C":
        tools.insert(0, program_version(find_compiler()[0]))
    open_ += _checks_beyond(material, file)
    lines: list[list[Cell]] = [[sentence(what), Markup("<code>{}</code>").format(command)] for what, command in open_]
    html = markup_of(
        "verification",
        three=three,
        tools=tools,
        three_verdict=_verdict_line(three),
        three_table=derivations_table(three),
        without=without,
        judges_verdicts=[_verdict_line(found, f"{TITLES[name]}: ") for name, found in outside.items()],
        judges_table=judges_table(outside) if outside else "",
        targets=targets,
        targets_verdict="" if targets is None else _conclusion(targets.conclusion, targets.passed),
        targets_table="" if targets is None else targets_table(targets),
        not_run=table(("check", "command"), [lines], kind="verdicts"),
    )
    return Section("verification", "Verification", html, tuple(failures), "; ".join(summary))


def _summary(
    three: Report, outside: Mapping[str, Report], targets: TargetsReport | None, without: str
) -> tuple[list[str], list[str]]:
    """What failed, a line each, and what the head of the page says; `without`: what no outside judge has."""
    failures = failures_of(three, "three derivations")
    summary = ["three derivations disagree" if failures else f"three derivations agree at {three.states} states"]
    for name, against in outside.items():
        bad = failures_of(against, TITLES[name])
        failures += bad
        summary.append(f"{TITLES[name]} {'disagrees' if bad else 'agrees'}")
    if outside and without:
        summary.append(f"they know the stand without {without}")
    if targets is not None:
        failures += [f"{row.target}, {row.real}: {row.reason}" for row in targets.rows if row.failed]
        equal = sum(row.verdict == "ok" for row in targets.rows)
        summary.append(f"the same bits on {equal} of {len(targets.rows)} targets")
    return failures, summary


def _compare_three(stand: Stand) -> tuple[Report, str]:
    """Compiled C, reference and second derivation; without a compiler, the interpreted program and the reason."""
    try:
        find_compiler()
    except ToolchainError as error:
        states = draw(stand, 1, STATES, wrenches=False)
        backend = InterpreterBackend(generate_once(stand))
        wants = [want for want in backend.wants if want != "inverse"]  # tens of thousands of operations a state
        rows = judge(stand, backend, states, wants, DOUBLE, None, Second(stand), "program")
        return report(stand, "program, interpreted", 1, len(states), DOUBLE.value, rows), str(error)
    try:
        backend_c = CBackend(stand, generated=generate_once(stand))
    except ToolchainError as error:
        return report(stand, "generated C", 1, 0, DOUBLE.value, (), str(error)), ""
    document = StandWithKeys.of(stand).to_dict()
    return verify_c(stand, seed=1, count=STATES, backend=backend_c, document=document), ""


def _outside(stand: Stand, name: str) -> tuple[Report | None, str]:
    """The literal reference against a program of others; None and the reason where that does not take the stand."""
    try:
        found = verify_judges(
            stand, count=JUDGED_STATES, names=(name,), make=NumpyBackend, judged="the literal reference"
        )
    except UsageError as error:
        return None, str(error).removeprefix("--judges: ")
    refusal = next((row.words for row in found.rows if row.verdict == "not compared"), "")
    return (None, refusal) if refusal else (found, "")


def _on_targets(material: Material) -> tuple[TargetsReport | None, str]:
    """The self-test where `--targets` asked for it; else None, and why where that is not for want of asking."""
    if not material.targets:
        return None, ""
    try:
        return verify_targets(material.stand, parse_targets(material.targets)), ""
    except ToolchainError as error:
        return None, f": {error}"


def _checks_beyond(material: Material, file: str) -> list[tuple[str, str]]:
    """Checks that take too long for a report."""
    found = [
        ("the true error, by enclosures of the exact answer", f"mahovik verify {file} --rigorous"),
        ("more states, run-time wrenches on every body", f"mahovik verify {file} --states 2000"),
        ("everything else that speaks for the C", f"mahovik evidence {file}"),
    ]
    if material.programme is not None:
        motion = material.motion_file or "M.json"
        command = f"mahovik verify-programme {file} --motion {motion} --programme {material.programme_file}"
        found.append(("the programme, by the reference and an adaptive integration", command))
    return found


TITLES = {"pinocchio": "Pinocchio", "mujoco": "MuJoCo"}
"""Judges as their projects write them."""

_STYLE = {"ok": "good", "FAILED": "bad"}


def derivations_table(found: Report) -> Markup:
    """Differences of the three pairs, quantity by quantity."""
    judged = "C" if found.judged == "generated C" else "program"
    head = (
        "quantity", "by", "states>", f"{judged}, reference>", "reference, second>", "accepted>",
        "verdict",
    )  # fmt: skip
    groups = [list(rows) for _, rows in groupby(found.rows, key=lambda row: row.judged)]
    return table(head, [[_row(row) for row in rows] for rows in groups], kind="verdicts")


def judges_table(outside: Mapping[str, Report]) -> Markup:
    """One table of all judges; quantities that a judge does not have are blank."""
    names = {name: found.judged.rpartition(f"{name} ")[2] for name, found in outside.items()}
    judges = (f"{TITLES[name]}, {number}>" for name, number in names.items())
    head = ["quantity", "states>", *judges, "accepted>", "verdict"]
    by = {name: {row.quantity: row for row in found.rows} for name, found in outside.items()}
    lines: list[list[Cell]] = []
    for quantity in dict.fromkeys(quantity for rows in by.values() for quantity in rows):
        there = [rows.get(quantity) for rows in by.values()]
        given = [row for row in there if row is not None]
        bad = [f"{TITLES[row.judged]}: {row.words or 'differs'}" for row in given if row.failed]
        accepted = given[0].limit
        lines.append([
            quantity,
            str(max(row.states for row in given)),
            *("" if row is None else share(row.value) for row in there),
            share(accepted),
            verdict("FAILED", "bad") + Markup(" {}").format("; ".join(bad)) if bad else verdict("agrees", "good"),
        ])  # fmt: skip
    return table(head, [lines], kind="verdicts")


def _group_by_feature(left: Sequence[str]) -> str:
    """`w1: damping`, `w2: damping` as `damping (w1, w2)`."""
    found: dict[str, list[str]] = {}
    for each in left:
        body, _, what = each.rpartition(": ")
        found.setdefault(what.replace("_", " "), []).append(body)
    return ", ".join(f"{what} ({', '.join(bodies)})" if any(bodies) else what for what, bodies in found.items())


def _row(row: Check) -> list[Cell]:
    """One quantity of three derivations."""
    judged = bool(row.judged) and row.verdict in _STYLE
    differences: list[Cell] = [share(row.value) if judged else ""]
    differences.append("" if row.second is None or not judged else share(row.second))
    accepted: Cell = share(row.limit) if judged else ""
    said = row.words if row.verdict != "ok" else ""
    style = _STYLE.get(row.verdict, "bad" if row.failed else "warn")
    words = verdict("agrees" if row.verdict == "ok" else row.verdict, style)
    if said:
        words += Markup(" {}").format(said)
    return [row.quantity, row.judged, str(row.states) if row.states else "", *differences, accepted, words]


def _verdict_line(found: Report, by: str = "") -> Markup:
    return _conclusion(f"{by}{conclusion(found)}", found.passed)


def _conclusion(words: str, passed: bool) -> Markup:
    return verdict(sentence(words), "good" if passed else "bad")


def failures_of(found: Report, by: str) -> list[str]:
    """Messages about a comparison that did not pass, one line each; `by`: the judge."""
    if found.error:
        return [f"{by}: {found.error}"]
    lines = [f"{by}: {row.quantity}: {row.words or 'FAILED'}" for row in found.failures]
    return lines or ([] if found.passed else [f"{by}: nothing was compared"])


def targets_table(found: TargetsReport) -> Markup:
    """The self-test on processors."""
    lines: list[list[Cell]] = []
    for row in found.rows:
        words = verdict("same bits" if row.verdict == "ok" else row.verdict, _STYLE.get(row.verdict, "warn"))
        words += Markup(" {}").format(row.reason) if row.reason else Markup("")
        lines.append([row.target, row.title, row.real, row.built_with, str(row.functions), words])
    return table(("target", "processor", "type", "built with", "functions>", "verdict"), [lines], kind="verdicts")
