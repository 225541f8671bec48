"""All pieces of evidence, in the order in which they are run and shown."""

from __future__ import annotations

import json
import re
import shlex
import subprocess
from collections import Counter
from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from mahovik.contract.functions import ROWS, row_of
from mahovik.core.emit.eva import drivers
from mahovik.core.emit.generate import generate_all
from mahovik.core.emit.names import VERIFICATION
from mahovik.core.emit.reading import spans
from mahovik.core.program.function import Function
from mahovik.core.toolchain.branches import FLAGS as FLAGS_OF_COVERAGE
from mahovik.core.toolchain.branches import Line, measure_branches
from mahovik.core.toolchain.static_checks import (
    ANALYSER,
    CPPCHECK,
    DEVIATIONS,
    STANDING_FINDINGS,
    count_by_rule,
    findings,
    warnings_of,
)
from mahovik.core.toolchain.static_checks import WARNINGS as WARNING_FLAGS
from mahovik.errors import StateError
from mahovik.proof.diagnose.answers import Precision
from mahovik.proof.diagnose.diagnosis import Diagnoser
from mahovik.proof.diagnose.readings import READINGS
from mahovik.proof.diagnose.words import as_object, sentences
from mahovik.proof.evidence.piece import (
    Need,
    Outcome,
    Piece,
    Subject,
    Table,
    last_words,
    library,
    module,
    program,
    verdict_of,
)
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.states import Request
from mahovik.proof.verify.targets import as_json, parse_targets, verify_targets

DELIVERY = Piece(
    name="delivery",
    title="The C is what the stand file gives",
    shows=(
        "The folder `c/` was generated from the stand file beside it, and again by another process that derived every "
        "formula again: the same bytes. All other pieces are about these files."
    ),
    limits="That the stand file describes the real machine: masses, mountings, unbalances are taken as it has them.",
    command=lambda s: f"mahovik generate {s.stand_file} -o c{s.option} --check --no-cache",
    figure=lambda text: re.sub(r"^c +as", "every byte is as", last_words(text)),
)


def _equations(function: Function) -> list[str]:
    """Numbers of the paper, or the section of a public function that has none."""
    numbers = re.findall(r"\(\d+\)", function.equation)
    section = row_of(function.name).equation if function.public and not numbers else ""
    return numbers or ([section] if section else [])


def _list_equations(subject: Subject) -> Outcome:
    name = subject.stand.name
    lines = spans((subject.c / f"{name}.c").read_text(encoding="ascii"), name)
    functions = generate_all(subject.stand, subject.real, subject.only).program.functions
    lost = [f.name for f in functions if f.name not in lines]
    table: list[dict[str, Any]] = [
        {
            "function": f"{name}_{f.name}",
            "equations": _equations(f),
            "purpose": f.purpose,
            "public": f.public,
            "lines": list(lines[f.name]),
        }
        for f in functions
        if f.name in lines
    ]
    untraced = [f["function"] for f in table if f["public"] and not f["equations"]]
    # by number; what has none comes last in the order of the C: sections, then own mathematics and checks
    order = sorted(table, key=lambda f: [int(n[1:-1]) for n in f["equations"] if n[0] == "("] or [99])
    rows = tuple((", ".join(f["equations"]), f["function"], f["purpose"], "{}-{}".format(*f["lines"])) for f in order)
    numbers, public = {n for f in table for n in f["equations"]}, sum(f["public"] for f in table)
    inner, rest = sum(bool(f["equations"]) for f in table if not f["public"]), len(table) - public
    figure = f"{len(numbers)} equations: each of {public} public functions has one, and {inner} of {rest} others"
    if untraced:
        figure = f"public functions without an equation: {', '.join(untraced)}"
    notes = (f"Not found in the source: {', '.join(lost)}.",) if lost else ()
    head = ("equations", "function", "what it computes", f"lines of {name}.c>")
    files = {"functions.json": json.dumps(table, indent=1) + "\n"}
    return Outcome(verdict_of(not lost and not untraced), figure, (), Table(head, rows), notes, files)


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


def _selftest_command(subject: Subject) -> str:
    name = subject.stand.name
    build = (
        f"cc -std=c99 -O2 -ffp-contract=off -D{name.upper()}_SELFTEST_MAIN c/{name}.c c/{subject.selftest} -o selftest"
    )
    some = f" --only {','.join(subject.only)}" if subject.only else ""
    return f"{build} && ./selftest > selftest.log; mahovik judge-log {subject.stand_file} --log selftest.log{some}"


SELFTEST = Piece(
    name="selftest",
    title="Self-test that travels with the C",
    shows=(
        "Every public function gives, bit for bit, what the interpreter of the program gave at generation: compiler "
        "and processor have changed nothing. The same test runs on the real board; `mahovik judge-log` judges its log."
    ),
    limits="That the equations are right: it compares the C with its own program. Other pieces judge the equations.",
    command=_selftest_command,
    figure=lambda text: text.partition("\n")[0].removeprefix("PASS").strip(),
    kept=("selftest.log",),
    needs=lambda _: (program("gcc"),),
)

LEAST_BRANCHES = 0.85
"""Least share taken of the branches that a caller can reach: an active set of one flywheel never exchanges any."""

_PIVOT = "a pivot of a mass matrix: what `prepare` lets through is positive definite"
UNREACHABLE = {
    **dict.fromkeys(("factor3", "factor_schur", "solve_carrier_once", "factor", "torque_demand_turning"), _PIVOT),
    **dict.fromkeys(("sqrt", "atan2"), "a magnitude beyond every range of inputs, or a guard against 0/0"),
}
"""Functions whose other branches no caller can reach, and why."""

_HANDED_ON = re.compile(r"if \(status != \w+_OK\) \{ return \w+; \}")
"""A refusal that is handed on, of a function that cannot refuse what was checked before."""


def why_unreachable(line: Line) -> str:
    """Why no caller can make a line take its other branch; "" where one can."""
    if line.function in UNREACHABLE:
        return UNREACHABLE[line.function]
    checks = line.function.startswith(("check_", "within"))
    return "a refusal that nothing checked can cause" if _HANDED_ON.search(line.text) and not checks else ""


def _run_branches(subject: Subject) -> Outcome:
    lines = measure_branches(subject.c / f"{subject.stand.name}.c", subject.c / subject.selftest, subject.scratch)
    left = [line for line in lines if line.taken < line.ways]
    rows = tuple((line.function, str(line.number), line.text, why_unreachable(line)) for line in left)
    ways, taken = sum(line.ways for line in lines), sum(line.taken for line in lines)
    beyond = sum(line.ways - line.taken for line in left if why_unreachable(line))
    figure = f"{taken} of {ways} branches taken, {taken / ways:.1%}; of the others {beyond} are out of a caller's reach"
    table = Table(("function", "line>", "a branch that is not taken", "why no caller can"), rows)
    text = json.dumps([asdict(line) for line in lines], indent=1) + "\n"
    good = taken >= LEAST_BRANCHES * (ways - beyond)
    return Outcome(verdict_of(good), figure, (), table, files={"branches.json": text})


def _branches_command(subject: Subject) -> str:
    name = subject.stand.name
    files = f"-D{name.upper()}_SELFTEST_MAIN c/{name}.c c/{subject.selftest}"
    return f"gcc {shlex.join(FLAGS_OF_COVERAGE)} {files} -o branches && ./branches && gcov -b -c branches-{name}.gcda"


BRANCHES = Piece(
    name="branches",
    title="Branches that the self-test takes",
    shows=(
        "How much of the C the self-test alone enters: each way out of each condition is counted, "
        f"and at least {LEAST_BRANCHES:.0%} of those that a caller can reach are taken. What is left is listed by name."
    ),
    limits="That the answers are right: the self-test compares them with the interpreter; other pieces judge them.",
    command=_branches_command,
    run=_run_branches,
    needs=lambda _: (program("gcc"), program("gcov", "apt-get install gcc")),
)

COMPARISON = Piece(
    name="comparison",
    title="Three derivations",
    shows=(
        "At random and extreme states every quantity of the C agrees with the literal equations (1)-(12) of the paper "
        "in NumPy, and, where a figure stands in its column, with a second derivation that knows only energies, by "
        "CasADi's differentiation. Only the latter differs in kind from what the C is made of. Bad inputs are refused "
        "and leave outputs untouched; the interpreter of the program has the same bits. Masses, inertia and mountings "
        "are those of a second reading of the stand file."
    ),
    limits=(
        "States between the sampled ones; (13), which is checked programme by programme; an error of the paper's in a "
        "quantity that the second derivation does not have; that the equations describe a machine that bends, leaks or "
        "slips. Errors are relative to the natural scale: the largest terms that a quantity is a sum of."
    ),
    command=lambda s: (
        f"mahovik verify {s.stand_file} --states {s.choose(200, 2000)} --junit junit.xml{s.option}{s.of_part}"
    ),
    kept=("junit.xml", "*-worst.jsonl"),
    needs=lambda _: (program("gcc"), *map(library, ("numpy", "casadi", "sympy"))),
)

ROUNDING = Piece(
    name="rounding",
    title="Rounding, bounded",
    shows=(
        "At each sampled state the exact answer of the literal equations is enclosed by ball arithmetic, so that the "
        "error of the C is known and not estimated: from the numbers of the stand file and the state to the answer."
    ),
    limits="States that were not sampled: it is a measurement with a rigorous ruler, not a bound for all inputs.",
    command=lambda s: f"mahovik verify {s.stand_file} --rigorous --states {s.choose(60, 300)}{s.option}{s.of_part}",
    needs=lambda _: (program("gcc"), module("flint", "python-flint", "rigorous")),
)


def _without_judges(subject: Subject) -> str:
    if subject.real != "double":
        return "the judges calculate in double: collect the evidence of the C in double"
    return "" if any(body.mass > 0.0 for body in subject.stand.bodies) else "no body of the stand has a mass"


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
    idle=_without_judges,
    needs=lambda _: (program("gcc"), module("pinocchio", "pin", "judges"), module("mujoco", "mujoco", "judges")),
)


def _plant_readings(subject: Subject) -> Outcome:
    """Make each wrong reading on this stand, and look for them in the C, which must have none."""
    backend = CBackend(subject.stand, subject.real, subject.c if subject.only else None)
    diagnoser = Diagnoser(subject.stand, wants=backend.wants)

    def answer(request: Request) -> Mapping[str, Any]:
        try:
            return backend.evaluate(request.state, request.want)
        except StateError:
            return {}

    diagnosis, whole = diagnoser.diagnose(answer), diagnoser.whole
    noise = Precision.of(whole.fill(answer)).noise(whole.expected, whole.scale)
    rows: list[tuple[str, str, str]] = []
    for reading in READINGS:
        error = np.abs(np.nan_to_num(whole.of_model(reading.model(subject.stand)) - whole.expected, nan=0.0))
        worst = float((error / whole.scale).max(initial=0.0))
        word = "seen" if (error > noise).any() else "within rounding" if worst else "no effect here"
        rows.append((reading.name, f"{worst:.0e}" if worst else "0", word))
    counts, clear = Counter(word for *_, word in rows), diagnosis.verdict == "none"
    words = ", ".join(f"{count} {word}" for word, count in counts.items())
    figure = f"the C has none; of {len(rows)} wrong readings {words}"
    notes = tuple(line.strip() for line in sentences(diagnosis))
    table = Table(("reading", "largest error, of scale>", "outcome"), tuple(rows))
    files = {"diagnosis.json": json.dumps({"C": as_object(diagnosis), "readings": rows}, indent=1) + "\n"}
    return Outcome(verdict_of(clear), figure if clear else notes[0], (), table, notes, files)


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
    run=_plant_readings,
    idle=lambda s: "" if s.stand.hold is None else "wrong readings take free carriers only, and this one has [hold]",
    needs=lambda _: (program("gcc"), library("numpy")),
)


def _compile_strictly(subject: Subject) -> Outcome:
    files = [*subject.sources, subject.selftest]
    complaints = warnings_of(subject.c, files)
    figure = f"{len(complaints)} complaints" if complaints else f"{len(files)} files, no complaint"
    output = {"output.txt": "".join(f"{line}\n" for line in complaints) or "no complaint\n"}
    return Outcome(verdict_of(not complaints), figure, notes=tuple(complaints[:20]), files=output)


def _compile_command(subject: Subject) -> str:
    files, flags = " ".join(f"c/{name}" for name in subject.sources), shlex.join(WARNING_FLAGS)
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


def _check_misra(subject: Subject) -> Outcome:
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
    return Outcome(verdict_of(not unlisted), figure, (), table, files={"findings.json": text})


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

_QUICK_DRIVERS = ("any_wrap", "any_forward", "any_torque", "normal_prepare", "routine_sincos", "routine_sqrt")


def _eva_command(subject: Subject) -> str:
    every = drivers(generate_all(subject.stand, subject.real, subject.only).program)
    claimed = [f"{driver.set}_{driver.function}" for driver in every if driver.claimed]
    chosen = "" if subject.full else "".join(f" {name}" for name in claimed if name in _QUICK_DRIVERS)
    limit = subject.choose(300, 1800)  # s a driver may take
    return f"EVA_LIMIT={limit} EVA_LOGS=$PWD sh c/{VERIFICATION}{subject.stand.name}_eva.sh{chosen}"


def _eva_figure(output: str) -> str:
    alarms = re.findall(r"^\S+ +alarms +(\S+)", output, re.MULTILINE)
    return (
        f"{sum(int(n) for n in alarms if n.isdigit())} alarms in {len(alarms)} drivers"
        if alarms
        else last_words(output)
    )


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
        f"{_UNCLAIMED}, of which nothing is claimed; tables that firmware prepares of other parameters. Without "
        "`--full` a selection of the drivers is run. "
        "Sine, cosine, square root and arc tangent are seen by a contract, which Eva does not prove."
    ),
    command=_eva_command,
    figure=_eva_figure,
    kept=("*.log",),
    needs=lambda _: (program("frama-c", "apt-get install frama-c-base"),),
)


def _fuzzer_links() -> bool:
    """Whether clang has its runtime: without it the harness does not link."""
    try:
        done = subprocess.run(["clang", "-print-runtime-dir"], capture_output=True, text=True, check=False)
    except OSError:
        return False
    return any(Path(done.stdout.strip()).glob("libclang_rt.fuzzer*.a"))


FUZZING = Piece(
    name="fuzz",
    title="Arbitrary arguments",
    shows=(
        "Every public function was called with arbitrary bytes as arguments, NaN, infinities and null pointers among "
        "them, under clang's sanitizers: statuses as the header names them, nothing written on a refusal, finite "
        "results otherwise, the same bits twice."
    ),
    limits="Inputs that were not tried: it looks for counter-examples, for the time that it has, and proves nothing.",
    command=lambda s: f"mahovik export fuzz {s.stand_file} -o fuzz{s.option} && make -C fuzz run SECONDS={s.seconds}",
    figure=lambda text: (
        "".join(re.findall(r"^Done (\d+ runs in \d+ second\S*)", text, re.MULTILINE)[-1:]) or last_words(text)
    ),
    kept=("fuzz/crash-*", "fuzz/leak-*", "fuzz/timeout-*", "fuzz/oom-*"),
    idle=lambda s: "the harness calls all functions, and this C has some of them" if s.only else "",
    needs=lambda _: (program("clang"), Need("clang's runtime", _fuzzer_links, "apt-get install libclang-rt-14-dev")),
)


def _target_tools(names: str, real: str) -> tuple[Need, ...]:
    """Compilers and emulators of targets."""
    needs: dict[str, Need] = {}
    for target, _ in parse_targets(names, (real,)):
        packages = " ".join(target.packages)
        for command in (target.compiler[0], target.link[0], *target.emulator[:1]):
            needs.setdefault(command, program(command, f"apt-get install {packages}" if packages else ""))
    return tuple(needs.values())


_QUICK_TARGETS = {"double": "host,m7,rv64gc", "float": "host,m4,rv64gc"}
_COST_TARGETS = {"double": "m7,rv64gc", "float": "m4,rv32imafc"}
"""Processors whose FPU calculates with that type."""


def _targets(subject: Subject) -> str:
    return "all" if subject.full else _QUICK_TARGETS[subject.real]


def _run_on_targets(subject: Subject) -> Outcome:
    found = verify_targets(subject.stand, parse_targets(_targets(subject), (subject.real,)), only=subject.only)
    rows = tuple((r.target, r.title, r.built_with, f"{r.verdict} {r.reason}".strip()) for r in found.rows)
    table = Table(("target", "processor", "compiler", "verdict"), rows)
    return Outcome(verdict_of(found.passed), found.conclusion, (), table, files={"targets.json": as_json(found)})


ON_TARGETS = Piece(
    name="targets",
    title="The same bits on processors",
    shows="The self-test and a sweep give on each of these, on emulators, the bits that they give on the host.",
    limits="Real silicon: run the self-test on the board, and judge its log by `mahovik judge-log`.",
    command=lambda s: (
        s.again("targets") if s.only else f"mahovik verify {s.stand_file} --targets {_targets(s)} --real {s.real}"
    ),
    run=_run_on_targets,
    needs=lambda s: _target_tools(_targets(s), s.real),
)


def _cost_figure(output: str) -> str:
    counted = re.search(r"^\| `forward` \| ([\d,]+) \|", output, re.MULTILINE)
    return f"forward {counted[1]} instructions" if counted else last_words(output)


COST = Piece(
    name="cost",
    title="Instructions, stack, code",
    shows="What a call costs at ordinary states, counted on emulators; the stack is bounded over the graph of calls.",
    limits="Time: instructions are not cycles. The worst case over all inputs, which branches on the state may exceed.",
    command=lambda s: f"mahovik cost {s.stand_file} -o c --targets {_COST_TARGETS[s.real]} --real {s.real}",
    figure=_cost_figure,
    needs=lambda s: _target_tools(_COST_TARGETS[s.real], s.real),
)

PIECES: tuple[Piece, ...] = (
    *(DELIVERY, EQUATIONS, SELFTEST, BRANCHES, COMPARISON, ROUNDING, JUDGES, FAULTS),
    *(WARNINGS, MISRA, EVA, FUZZING, ON_TARGETS, COST),
)
"""Each can be named by `--only` and `--without`."""
