"""Tables of verdicts: three derivations, judges from outside, targets."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from importlib.metadata import version
from itertools import groupby

from markupsafe import Markup

from mahovik.core.stand.model import Stand
from mahovik.core.toolchain.board import version as program_version
from mahovik.core.toolchain.compiler import find_compiler
from mahovik.out.report.stand.markup import Cell, paragraph, sentence, share, table, verdict
from mahovik.proof.verify.compare import Row
from mahovik.proof.verify.judges.rigid import missing
from mahovik.proof.verify.report import Report, conclusion
from mahovik.proof.verify.targets import TargetsReport

TITLES = {"pinocchio": "Pinocchio", "mujoco": "MuJoCo"}
"""Judges as their projects write them."""

_STYLE = {"ok": "good", "FAILED": "bad"}


def derivations_table(found: Report) -> Markup:
    """Differences of the three pairs, quantity by quantity."""
    compiled = found.judged == "generated C"
    judged = "C" if compiled else "program"
    tools = [f"NumPy {version('numpy')}", f"CasADi {version('casadi')}"]
    if compiled:
        tools.insert(0, program_version(find_compiler()[0]))
    words = paragraph(
        f"The {found.judged}, the literal equations (1)-(13) in NumPy, and a second derivation from energies, "
        f"differentiated by CasADi: they share no formula. {found.states} random and extreme states, seed "
        f"{found.seed}; "
        f"{', '.join(tools)}. A blank: the second derivation has no such quantity."
    )
    head = (
        "quantity", "by", "states>", f"{judged}, reference>", "reference, second>", f"{judged}, second>", "accepted>",
        "verdict",
    )  # fmt: skip
    groups = [list(rows) for _, rows in groupby(found.rows, key=lambda row: row.want)]
    lines = [[_row(row, found.tolerance) for row in rows] for rows in groups]
    return Markup("<h3>Three derivations</h3>\n") + words + _verdict_line(found) + table(head, lines, kind="verdicts")


def judges_table(stand: Stand, outside: Mapping[str, Report]) -> Markup:
    """One table of all judges; quantities that a judge does not have are blank."""
    left = missing(stand)
    words = (
        "Programs of others that know nothing of this one, against the literal reference, with which the C was "
        "compared above."
    )
    if left:
        words += f" They have no {_listed(left)}: the stand is judged without."
    names = {name: found.judged.rpartition(f"{name} ")[2] for name, found in outside.items()}
    head = [
        "quantity",
        "states>",
        *(f"{TITLES[name]}, {number}>" for name, number in names.items()),
        "accepted>",
        "verdict",
    ]
    by = {name: {row.quantity: row for row in found.rows} for name, found in outside.items()}
    quantities = dict.fromkeys(quantity for rows in by.values() for quantity in rows)
    lines: list[list[Cell]] = []
    for quantity in quantities:
        there = [rows.get(quantity) for rows in by.values()]
        given = [row for row in there if row is not None]
        bad = [f"{TITLES[row.want]}: {row.reason or 'differs'}" for row in given if row.failed]
        accepted = given[0].tolerance
        lines.append([
            quantity,
            str(max(row.states for row in given)),
            *("" if row is None else share(row.worst) for row in there),
            "" if accepted is None else share(accepted),
            verdict("FAILED", "bad") + Markup(" {}").format("; ".join(bad)) if bad else verdict("agrees", "good"),
        ])  # fmt: skip
    parts = [Markup("<h3>Judges from outside</h3>\n"), paragraph(words)]
    for name, found in outside.items():
        parts.append(_verdict_line(found, f"{TITLES[name]}: "))
    return Markup("").join([*parts, table(head, [lines], kind="verdicts")])


def _listed(left: Sequence[str]) -> str:
    """`w1: damping`, `w2: damping` as `damping (w1, w2)`."""
    found: dict[str, list[str]] = {}
    for each in left:
        body, _, what = each.rpartition(": ")
        found.setdefault(what.replace("_", " "), []).append(body)
    return ", ".join(f"{what} ({', '.join(bodies)})" if any(bodies) else what for what, bodies in found.items())


def _row(row: Row, tolerance: float) -> list[Cell]:
    """One quantity of three derivations."""
    judged = bool(row.want) and row.verdict in _STYLE
    differences: list[Cell] = [share(row.worst) if judged else ""]
    differences += ["" if off is None or not judged else share(off) for off in (row.second, row.between)]
    accepted: Cell = share(row.tolerance or tolerance) if judged else ""
    said = " ".join(words for words in (row.disagreement, row.reason) if words and row.verdict != "ok")
    style = _STYLE.get(row.verdict, "bad" if row.failed else "warn")
    words = verdict("agrees" if row.verdict == "ok" else row.verdict, style)
    if said:
        words += Markup(" {}").format(said)
    return [row.quantity, row.want, str(row.states) if row.states else "", *differences, accepted, words]


def _verdict_line(found: Report, by: str = "") -> Markup:
    style = "good" if found.passed else "bad"
    return Markup("<p>{}</p>\n").format(verdict(sentence(f"{by}{conclusion(found)}"), style))


def failures_of(found: Report, by: str) -> list[str]:
    """Messages about a comparison that did not pass, one line each; `by`: the judge."""
    if found.error:
        return [f"{by}: {found.error}"]
    lines = [f"{by}: {row.quantity}: {row.disagreement or row.reason or 'FAILED'}" for row in found.failures]
    return lines or ([] if found.passed else [f"{by}: nothing was compared"])


def targets_table(found: TargetsReport) -> Markup:
    """The self-test on processors."""
    words = paragraph(
        f"The self-test of the C, built for each processor and run on its emulator: golden vectors and {found.sweep} "
        "pseudo-random states, whose bits must be those of the host."
    )
    styles = {"ok": "good", "FAILED": "bad"}
    lines: list[list[Cell]] = []
    for row in found.rows:
        said = verdict("same bits" if row.verdict == "ok" else row.verdict, styles.get(row.verdict, "warn"))
        said += Markup(" {}").format(row.reason) if row.reason else Markup("")
        lines.append([row.target, row.title, row.real, row.built_with, str(row.functions), said])
    head = ("target", "processor", "type", "built with", "functions>", "verdict")
    line = verdict(sentence(found.conclusion), "good" if found.passed else "bad")
    return (
        Markup("<h3>Targets</h3>\n")
        + words
        + Markup("<p>{}</p>\n").format(line)
        + table(head, [lines], kind="verdicts")
    )
