"""Pieces on agreement: with two other derivations, with exact answers, with programs of others, and with no fault."""

from __future__ import annotations

import json
from collections.abc import Mapping
from importlib.metadata import PackageNotFoundError, version
from typing import Any

import numpy as np

from mahovik.core.toolchain.board import version as compiler
from mahovik.errors import StateError
from mahovik.proof.diagnose.answers import Precision
from mahovik.proof.diagnose.diagnosis import Diagnoser
from mahovik.proof.diagnose.readings import READINGS
from mahovik.proof.diagnose.words import as_object, sentences
from mahovik.proof.evidence.piece import (
    Outcome,
    Piece,
    Subject,
    Table,
    Tell,
    Verdict,
    count_to,
    module,
    program,
    verdict_of,
)
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.harness import verify_c
from mahovik.proof.verify.judges import verify_judges
from mahovik.proof.verify.report import Report, as_json, as_junit, conclusion, worst_lines
from mahovik.proof.verify.states import Request

_PACKAGES = (("Pinocchio", "pin"), ("MuJoCo", "mujoco"))


def _table(report: Report) -> Table:
    """The table that `mahovik verify` prints."""
    third = any(row.second is not None for row in report.rows)
    head = ("quantity", "by", "states>", "worst>", *(("second>",) if third else ()), "verdict")
    return Table(head, tuple(_row(row, third) for row in report.rows))


def _row(row: Check, third: bool) -> tuple[str, ...]:
    figures = bool(row.judged) and row.verdict in ("ok", "FAILED")
    second = ("" if row.second is None else f"{row.second:.1e}",) if third else ()
    verdict = f"{row.verdict} {row.words}".rstrip()
    states = str(row.states) if row.states else ""
    return (row.quantity, row.judged, states, f"{row.value:.1e}" if figures else "", *second, verdict)


def _compare(subject: Subject, tell: Tell) -> Outcome:
    progress = count_to(tell, "state ")
    found = verify_c(
        subject.stand,
        seed=1,
        count=subject.choose(200, 2000),
        real=subject.real,
        against=subject.part,
        progress=progress,
    )
    files = {"report.json": as_json(found), "junit.xml": as_junit(found), "worst.jsonl": worst_lines(found)}
    tools = (compiler("gcc"), f"NumPy {version('numpy')}", f"CasADi {version('casadi')}", f"SymPy {version('sympy')}")
    return Outcome(verdict_of(found.passed), conclusion(found), tools, _table(found), files=files)


COMPARISON = Piece(
    name="comparison",
    title="Three derivations",
    shows=(
        "At random and extreme states every quantity of the C agrees with the literal equations (1)-(12) of the paper "
        "in NumPy, and, where a figure stands in its column, with a second derivation that knows only energies, by "
        "CasADi's differentiation. Only the latter differs in kind from what the C is made of. Bad inputs are refused "
        "and leave outputs untouched; the interpreter of the program has the same bits."
    ),
    limits=(
        "States between the sampled ones; (13), which is checked programme by programme; an error of the paper's in a "
        "quantity that the second derivation does not have; that the equations describe a machine that bends, leaks or "
        "slips. Errors are relative to the natural scale: the largest terms that a quantity is a sum of."
    ),
    command=lambda s: f"mahovik verify {s.stand_file} --states {s.choose(200, 2000)}{s.option}{s.of_part}",
    run=_compare,
    needs=lambda _: (program("gcc"),),
)


def _of_free_carriers(what: str) -> Outcome:
    """Outcome of a piece that a held carrier does not have yet."""
    return Outcome(Verdict.NOTHING, f"{what} take free carriers only, and this one has [hold]")


def _measure_rounding(subject: Subject, tell: Tell) -> Outcome:
    from mahovik.proof.verify.rounding.measure import (
        as_json,
        conclusion,
        measure_rounding,  # needs python-flint, which may be missing
    )

    progress = count_to(tell, "state ")
    found = measure_rounding(
        subject.stand, count=subject.choose(60, 300), real=subject.real, against=subject.part, progress=progress
    )
    rows = tuple(
        (
            line.row.quantity,
            line.row.judged,
            str(line.row.states),
            f"{line.ulps:.2g}",
            f"{line.row.value:.1e}",
            f"{line.typical:.1e}",
            line.row.verdict,
        )
        for line in found.lines
    )
    table = Table(("quantity", "by", "states>", "ulp>", "of scale>", "relative>", "verdict"), rows)
    tools = (f"python-flint {version('python-flint')}",)
    files = {"rounding.json": as_json(found)}
    return Outcome(verdict_of(found.report.passed), conclusion(found), tools, table, files=files)


ROUNDING = Piece(
    name="rounding",
    title="Rounding, bounded",
    shows=(
        "At each sampled state the exact answer of the literal equations is enclosed by ball arithmetic, so that the "
        "error of the C is known and not estimated: from the numbers of the stand file and the state to the answer."
    ),
    limits="States that were not sampled: it is a measurement with a rigorous ruler, not a bound for all inputs.",
    command=lambda s: f"mahovik verify {s.stand_file} --rigorous --states {s.choose(60, 300)}{s.option}{s.of_part}",
    run=_measure_rounding,
    needs=lambda _: (program("gcc"), module("flint", "pip install 'mahovik[rigorous]'")),
)


def _ask_judges(subject: Subject, tell: Tell) -> Outcome:
    if subject.real != "double":
        return Outcome(Verdict.NOTHING, "the judges calculate in double: collect the evidence of the C in double")
    if not any(body.mass > 0.0 for body in subject.stand.bodies):
        return Outcome(Verdict.NOTHING, "no body of the stand has a mass")
    tell("equations")
    found = verify_judges(subject.stand, count=subject.choose(50, 200))
    if not any(row.verdict in ("ok", "FAILED") for row in found.rows):
        return Outcome(Verdict.NOTHING, "; ".join(dict.fromkeys(row.words for row in found.rows)), table=_table(found))
    without = f"The stand was judged without {', '.join(found.left_out)}: the judges do not know these."
    notes = (without,) if found.left_out else ()
    tools = tuple(f"{title} {_version(package)}" for title, package in _PACKAGES if _version(package))
    files = {"report.json": as_json(found)}
    return Outcome(verdict_of(found.passed), conclusion(found), tools, _table(found), notes, files)


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return ""


JUDGES = Piece(
    name="judges",
    title="Programs of others",
    shows=(
        "Mass matrix, bias forces, accelerations, drive torques, joint forces, points and, of a held carrier, the "
        "reaction agree with Pinocchio and MuJoCo: nobody of these projects knows this one."
    ),
    limits=(
        "Suspension, legs, fluid and stream, which they do not have: the stand is judged without. For these the three "
        "derivations above speak."
    ),
    command=lambda s: f"mahovik verify {s.stand_file} --judges --states {s.choose(50, 200)}",
    run=_ask_judges,
    needs=lambda _: (
        program("gcc"),
        module("pinocchio", "pip install 'mahovik[judges]'"),
        module("mujoco", "pip install 'mahovik[judges]'"),
    ),
)


def _plant_faults(subject: Subject, tell: Tell) -> Outcome:
    """Plant each wrong reading on this stand, and look for them in the C, which must have none."""
    if subject.stand.hold is not None:
        return _of_free_carriers("wrong readings")
    backend = CBackend(subject.stand, subject.real, subject.part)
    diagnoser = Diagnoser(subject.stand, wants=backend.wants)

    def answer(request: Request) -> Mapping[str, Any]:
        try:
            return backend.evaluate(request.state, request.want)
        except StateError:
            return {}

    tell("the C")
    diagnosis = diagnoser.diagnose(answer)
    whole = diagnoser.whole
    noise = Precision.of(whole.fill(answer)).noise(whole.expected, whole.scale)
    rows, largest = [], {}
    for number, reading in enumerate(READINGS):
        tell(f"reading {number + 1} of {len(READINGS)}")
        error = np.abs(np.nan_to_num(whole.of_model(reading.model(subject.stand)) - whole.expected, nan=0.0))
        worst = float((error / whole.scale).max(initial=0.0))
        word = "seen" if (error > noise).any() else "within rounding" if worst else "no effect here"
        largest[reading.name] = {"error": worst, "outcome": word}
        rows.append((reading.name, f"{worst:.0e}" if worst else "0", word))
    seen = sum(each["outcome"] == "seen" for each in largest.values())
    absent = sum(each["outcome"] == "no effect here" for each in largest.values())
    rest = len(largest) - seen - absent
    clear = diagnosis.verdict == "none"
    figure = (
        f"the C has none; of {len(largest)} wrong readings {seen} would be seen, {absent} have no effect on this stand"
    )
    figure += f", {rest} none beyond rounding" if rest else ""
    files = {"diagnosis.json": json.dumps({"C": as_object(diagnosis), "faults": largest}, indent=1) + "\n"}
    table = Table(("reading", "largest error, of scale>", "outcome"), tuple(rows))
    notes = tuple(line.strip() for line in sentences(diagnosis))
    tools = (f"NumPy {version('numpy')}",)
    return Outcome(verdict_of(clear), figure if clear else notes[0], tools, table, notes, files)


FAULTS = Piece(
    name="faults",
    title="Would a fault be seen?",
    shows=(
        "Each wrong reading of a table (an order, a frame, a unit, a sign, an inertia about the wrong point) is made "
        "on this stand; the table says how far its answers are from the right ones. The C is asked as a foreign "
        "program would be, and found to have none of them."
    ),
    limits=(
        "Faults that the table does not have, and faults of the C as C, such as a loop bound: these are planted "
        "in the emitted text by the project's own tests, for its example stands: `make faults`."
    ),
    command=lambda s: f'mahovik judge {s.stand_file} --with "mahovik eval {s.stand_file}{s.option}" --explain',
    run=_plant_faults,
    needs=lambda _: (program("gcc"),),
)
