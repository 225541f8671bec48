"""Verification of the stand, run now, with results; and the checks that were not run, with their commands."""

from __future__ import annotations

from collections.abc import Sequence

from markupsafe import Markup

from mahovik.core.stand.model import Stand
from mahovik.core.toolchain.compiler import find_compiler
from mahovik.errors import ToolchainError, UsageError
from mahovik.out.report.stand.generated import generated
from mahovik.out.report.stand.markup import Cell, paragraph, sentence, table
from mahovik.out.report.stand.material import Material
from mahovik.out.report.stand.section import Section
from mahovik.out.report.stand.verdicts import TITLES, derivations_table, failures_of, judges_table, targets_table
from mahovik.proof.second import Second
from mahovik.proof.verify.backends import NumpyBackend
from mahovik.proof.verify.bounds import DOUBLE
from mahovik.proof.verify.c_backend import CBackend, InterpreterBackend
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.harness import judge, report, verify_c
from mahovik.proof.verify.judges.compare import JUDGES, load_judges, verify_by
from mahovik.proof.verify.judges.rigid import stripped
from mahovik.proof.verify.report import Report
from mahovik.proof.verify.targets import TargetsReport, asked, verify_targets

STATES = 16
"""Random and extreme, of three derivations; `mahovik verify` takes more."""

JUDGED = 8
"""States of each outside judge."""


def section(material: Material) -> Section | None:
    """Three derivations, judges that are installed, targets where they were asked for; then what was not run."""
    stand, file = material.stand, material.stand_file or f"{material.stand.name}.toml"
    parts, failures, said, open_ = [_introduction()], list[str](), list[str](), list[tuple[str, str]]()
    found, without = _three(stand)
    parts.append(derivations_table(found))
    failures += failures_of(found, "three derivations")
    said.append("three derivations disagree" if failures else f"three derivations agree at {found.states} states")
    if without:
        open_.append((f"the compiled C: {without}", f"mahovik verify {file}"))
    outside = {}
    for name in JUDGES:
        try:
            outside[name] = _outside(stand, name)
        except UsageError as error:
            reason = str(error).removeprefix("--judges: ")
            open_.append((f"{TITLES[name]}: {reason}", f"mahovik verify {file} --judges --bare"))
    if outside:
        parts.append(judges_table(stand, outside))
    for name, against in outside.items():
        bad = failures_of(against, TITLES[name])
        failures += bad
        said.append(f"{TITLES[name]} {'disagrees' if bad else 'agrees'}")
    targets, reason = _on_targets(material)
    if targets is not None:
        parts.append(targets_table(targets))
        failures += [f"{row.target}, {row.real}: {row.reason}" for row in targets.rows if row.failed]
        equal = sum(row.verdict == "ok" for row in targets.rows)
        said.append(f"the same bits on {equal} of {len(targets.rows)} targets")
    else:
        command = f"mahovik verify {file} --targets {material.targets or 'quick'}"
        open_.append((f"processors: the same bits as on the host{reason}", command))
    open_ += _further(material, file)
    parts.append(_not_run(open_))
    return Section("verification", "Verification", Markup("").join(parts), tuple(failures), "; ".join(said))


def _introduction() -> Markup:
    return paragraph(
        "Measured when this report was made. A difference is relative to the natural scale of its quantity: the "
        "largest terms that it is a sum of. What is not listed here was not run."
    )


def _three(stand: Stand) -> tuple[Report, str]:
    """Compiled C, reference and second derivation; without a compiler, the interpreted program and the reason."""
    try:
        find_compiler()
    except ToolchainError as error:
        states = draw(stand, 1, STATES, wrenches=False)
        backend = InterpreterBackend(generated(stand))
        wants = [want for want in backend.wants if want != "inverse"]  # tens of thousands of operations a state
        rows = judge(stand, backend, states, wants, DOUBLE, None, Second(stand), "program")
        return report(stand, "program, interpreted", 1, len(states), DOUBLE.default, rows), str(error)
    try:
        backend_c = CBackend(stand, generated=generated(stand))
    except ToolchainError as error:
        return report(stand, "generated C", 1, 0, DOUBLE.default, (), str(error)), ""
    return verify_c(stand, seed=1, count=STATES, wrenches=False, backend=backend_c), ""


def _outside(stand: Stand, name: str) -> Report:
    """The literal reference of the stand, without what no judge has, against one of them. Raises UsageError."""
    bare = stripped(stand)
    judges = load_judges(bare, [name])
    return verify_by(bare, judges, count=JUDGED, until=0.0, backend=NumpyBackend(bare), judged="the literal reference")


def _on_targets(material: Material) -> tuple[TargetsReport | None, str]:
    """The self-test where `--targets` asked for it; else None, and why where that is not for want of asking."""
    if not material.targets:
        return None, ""
    try:
        return verify_targets(material.stand, asked(material.targets)), ""
    except ToolchainError as error:
        return None, f": {error}"


def _further(material: Material, file: str) -> list[tuple[str, str]]:
    """Checks that take too long for a report."""
    found = [
        ("the true error, by enclosures of the exact answer", f"mahovik verify {file} --rigorous"),
        ("more states, run-time wrenches on every body", f"mahovik verify {file} --states 2000"),
        ("everything else that speaks for the C", f"mahovik evidence {file}"),
    ]
    if material.programme is not None:
        motion = material.motion_file or "M.json"
        command = f"mahovik verify-programme {file} {motion} {material.programme_file}"
        found.append(("the programme, by the reference and an adaptive integration", command))
    return found


def _not_run(open_: Sequence[tuple[str, str]]) -> Markup:
    lines: list[list[Cell]] = [[sentence(what), Markup("<code>{}</code>").format(command)] for what, command in open_]
    return Markup("<h3>Not run here</h3>\n") + table(("check", "command"), [lines], kind="verdicts")
