"""Pieces on the source: it is what the stand file gives, which equation each line is of, and what analysers find."""

from __future__ import annotations

import json
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path
from typing import Any

import mahovik
from mahovik.contract.functions import ROWS, row_of
from mahovik.core.emit.eva import drivers
from mahovik.core.emit.generate import generate_all
from mahovik.core.emit.manifest import digest
from mahovik.core.emit.names import VERIFICATION
from mahovik.core.emit.reading import spans
from mahovik.core.program.function import Function
from mahovik.core.toolchain.eva import prove_each
from mahovik.core.toolchain.eva import version as eva_version
from mahovik.core.toolchain.static_checks import (
    ANALYSER,
    COMPILERS,
    CPPCHECK,
    DEVIATIONS,
    STANDING_FINDINGS,
    count_by_rule,
    findings,
    version,
    warnings_of,
)
from mahovik.core.toolchain.static_checks import WARNINGS as WARNING_FLAGS
from mahovik.proof.evidence.piece import Outcome, Piece, Subject, Table, Tell, program, verdict_of

_QUICK_DRIVERS = ("any_wrap", "any_forward", "any_torque", "normal_prepare", "routine_sincos", "routine_sqrt")


def _generate_command(subject: Subject) -> str:
    return f"mahovik generate {subject.stand_file} -o c{subject.option} --check --no-cache"


def _generate_again(subject: Subject, tell: Tell) -> Outcome:
    """Generate the C in another process, without a cache, and compare."""
    tell("generate again")
    words = _generate_command(subject).split()
    package = str(Path(mahovik.__file__).resolve().parent.parent)
    path = os.pathsep.join(filter(None, (package, os.environ.get("PYTHONPATH"))))
    # another seed of hashes: an order that depends on it would show
    environment = os.environ | {"PYTHONPATH": path, "PYTHONHASHSEED": "20260"}
    done = subprocess.run(
        [sys.executable, "-m", *words], cwd=subject.folder, env=environment, capture_output=True, text=True, check=False
    )
    files = sorted(each for each in subject.c.rglob("*") if each.is_file())
    rows = tuple((each.relative_to(subject.folder).as_posix(), digest(each.read_bytes())) for each in files)
    good = done.returncode == 0
    figure = f"{len(files)} files, byte for byte" if good else "the C is not what the stand file gives"
    output = done.stdout + done.stderr
    notes = () if good else tuple(output.splitlines())
    tools = (f"mahovik {mahovik.__version__}", f"Python {sys.version.split()[0]}")
    return Outcome(verdict_of(good), figure, tools, Table(("file", "SHA-256"), rows), notes, {"output.txt": output})


DELIVERY = Piece(
    name="delivery",
    title="The C is what the stand file gives",
    shows=(
        "The folder `c/` was generated from the stand file beside it, and again by another process that derived every "
        "formula again: the same bytes. All other pieces are about these files."
    ),
    limits="That the stand file describes the real machine: masses, mountings, unbalances are taken as it has them.",
    command=_generate_command,
    run=_generate_again,
)


def _equations(function: Function) -> list[str]:
    """Numbers of the paper, or the section of a public function that has none."""
    numbers = re.findall(r"\(\d+\)", function.equation)
    section = row_of(function.name).equation if function.public and not numbers else ""
    return numbers or ([section] if section else [])


def _list_equations(subject: Subject, tell: Tell) -> Outcome:
    tell("read the C")
    name = subject.stand.name
    where = spans((subject.c / f"{name}.c").read_text(encoding="ascii"), name)
    functions = generate_all(subject.stand, subject.real, subject.only).program.functions
    lost = [f.name for f in functions if f.name not in where]
    found: list[dict[str, Any]] = [
        {
            "function": f"{name}_{f.name}",
            "equations": _equations(f),
            "purpose": f.purpose,
            "public": f.public,
            "lines": list(where[f.name]),
        }
        for f in functions
        if f.name in where
    ]
    untraced = [each["function"] for each in found if each["public"] and not each["equations"]]
    # by number; what has none comes last in the order of the C: sections, then own mathematics and checks
    order = sorted(found, key=lambda each: [int(n[1:-1]) for n in each["equations"] if n[0] == "("] or [99])
    rows = tuple((", ".join(f["equations"]), f["function"], f["purpose"], "{}-{}".format(*f["lines"])) for f in order)
    numbers = {n for each in found for n in each["equations"]}
    public = sum(each["public"] for each in found)
    inner, others = sum(bool(each["equations"]) for each in found if not each["public"]), len(found) - public
    figure = f"{len(numbers)} equations: each of {public} public functions has one, and {inner} of {others} others"
    if untraced:
        figure = f"public functions without an equation: {', '.join(untraced)}"
    notes = (f"Not found in the source: {', '.join(lost)}.",) if lost else ()
    table = Table(("equations", "function", "what it computes", f"lines of {name}.c>"), rows)
    files = {"functions.json": json.dumps(found, indent=1) + "\n"}
    return Outcome(verdict_of(not lost and not untraced), figure, (), table, notes, files)


EQUATIONS = Piece(
    name="equations",
    title="From equation to lines of C",
    shows=(
        "Which function computes which equation of the paper, or of which section of `docs/model.md` or "
        "`docs/c-interface.md` of the project, and where it stands: what to read beside them. Every public function "
        "has one."
    ),
    limits=(
        "That the lines are right: other pieces judge that. That tests notice a change in them, `make faults` of the "
        "project shows by planted faults, for its example stands."
    ),
    command=lambda s: s.again("equations"),
    run=_list_equations,
)


def _compile_strictly(subject: Subject, tell: Tell) -> Outcome:
    tell("gcc, clang, clang --analyze")
    files = [*subject.sources, subject.selftest]
    found = warnings_of(subject.c, files)
    figure = f"{len(found)} complaints" if found else f"{len(files)} files, no complaint"
    output = {"output.txt": "".join(f"{line}\n" for line in found) or "no complaint\n"}
    tools = tuple(version(each) for each in COMPILERS)
    return Outcome(verdict_of(not found), figure, tools, notes=tuple(found[:20]), files=output)


def _compile_command(subject: Subject) -> str:
    files = " ".join(f"c/{each}" for each in subject.sources)
    flags = shlex.join(WARNING_FLAGS)
    both = " && ".join(f"{compiler} {flags} -O2 -fsyntax-only {files}" for compiler in ("gcc", "clang"))
    return f"{both} && {shlex.join(ANALYSER)} {files}"


WARNINGS = Piece(
    name="warnings",
    title="Compilers and an analyser are silent",
    shows="gcc and clang with strict warnings as errors, and clang's static analyser, have no complaint.",
    limits="What no warning is made for. Other compilers warn of other things.",
    command=_compile_command,
    run=_compile_strictly,
    needs=lambda _: (program("gcc"), program("clang")),
)


def _check_misra(subject: Subject, tell: Tell) -> Outcome:
    tell("cppcheck")
    found = findings(subject.c, subject.sources)
    reasons, counts = {**DEVIATIONS, **STANDING_FINDINGS}, count_by_rule(found)
    unlisted = sorted(rule for rule in counts if rule not in reasons)
    order = [*unlisted, *(rule for rule in reasons if rule in counts)]
    rows = tuple((rule, str(counts[rule]), reasons.get(rule, "NOT LISTED")) for rule in order)
    figure = f"{sum(counts.values())} findings under {len(counts)} rules, each listed with its reason"
    if unlisted:
        figure = f"findings that are not listed: {', '.join(unlisted)}"
    text = json.dumps([{"rule": f.rule, "file": f.file, "line": f.line} for f in found], indent=1) + "\n"
    table = Table(("rule", "times>", "why it stays"), rows)
    return Outcome(verdict_of(not unlisted), figure, (version("cppcheck"),), table, files={"findings.json": text})


MISRA = Piece(
    name="misra",
    title="cppcheck and its MISRA C:2012 addon",
    shows="Everything that they find is listed, with the reason why it stays; one that is not listed is a failure.",
    limits=(
        "MISRA compliance, which is not claimed: the addon checks a part of the rules, some more strictly or more "
        "loosely than their text."
    ),
    command=lambda s: f"cd c && {shlex.join(CPPCHECK)} {' '.join(s.sources)}",
    run=_check_misra,
    needs=lambda _: (program("cppcheck"),),
)


def _drivers(subject: Subject) -> list[str]:
    every = drivers(generate_all(subject.stand, subject.real, subject.only).program)
    claimed = [f"{each.set}_{each.function}" for each in every if each.claimed]
    return claimed if subject.full else [name for name in claimed if name in _QUICK_DRIVERS]


def _run_eva(subject: Subject, tell: Tell) -> Outcome:
    """Run the delivered script and its drivers."""
    script, logs = subject.c / f"{VERIFICATION}{subject.stand.name}_eva.sh", subject.scratch / "eva"
    wanted, proofs = _drivers(subject), []
    tell(wanted[0])
    for proof in prove_each(script, wanted, subject.choose(300, 1800), logs):  # s a driver may take
        proofs.append(proof)
        tell(f"{len(proofs)} of {len(wanted)} drivers")
    rows = tuple((p.function, p.set, "no end" if p.alarms is None else str(p.alarms), str(p.unproved)) for p in proofs)
    bad = [f"{p.set}_{p.function}" for p in proofs if not p.holds]
    alarms = sum(p.alarms or 0 for p in proofs)
    figure = f"0 alarms in {len(proofs)} drivers" if not bad else f"{alarms} alarms, {len(bad)} drivers without proof"
    notes = (f"Not proved: {', '.join(bad)}.",) if bad else ()
    if not subject.full:
        notes = (*notes, "A selection of the drivers: `--full`, or the script itself, runs all that is claimed.")
    files = {each.name: each.read_text(encoding="utf-8", errors="replace") for each in sorted(logs.iterdir())}
    table = Table(("function", "inputs", "alarms>", "unproved>"), rows)
    good = not bad and len(proofs) == len(wanted)
    return Outcome(verdict_of(good), figure, (f"Frama-C {eva_version()}",), table, notes, files)


def _eva_command(subject: Subject) -> str:
    chosen = "" if subject.full else f" {' '.join(_drivers(subject))}"
    return f"sh c/{VERIFICATION}{subject.stand.name}_eva.sh{chosen}"


_UNCLAIMED = ", ".join(f"`{row.name}`" for row in ROWS.values() if not row.claimed and not row.name.endswith("_at"))

EVA = Piece(
    name="eva",
    title="No undefined behaviour, by Frama-C Eva",
    shows=(
        "For whole sets of inputs at once, no operation that C leaves undefined: no index out of an array, nothing "
        "read before it was written, no overflow of integers. In `normal` and `any` also: results are finite, and "
        "written where the status is not negative, untouched where it is."
    ),
    limits=(
        f"{_UNCLAIMED}, of which nothing is claimed; tables that firmware prepares of other parameters. "
        "Sine, cosine, square root and arc tangent are seen by a contract, which Eva does not prove."
    ),
    command=_eva_command,
    run=_run_eva,
    needs=lambda _: (program("frama-c", "apt-get install frama-c-base"),),
)
