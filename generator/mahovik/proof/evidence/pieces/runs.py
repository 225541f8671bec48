"""Pieces on the compiled C: its self-test, arbitrary arguments, other processors, and what a call costs there."""

from __future__ import annotations

import json
import re
import shlex
import subprocess
from dataclasses import asdict
from pathlib import Path

from mahovik.core.toolchain.board import run, version
from mahovik.core.toolchain.branches import FLAGS as FLAGS_OF_COVERAGE
from mahovik.core.toolchain.branches import Line, measure_branches
from mahovik.core.toolchain.branches import tools as coverage_tools
from mahovik.core.toolchain.compiler import BITS, find_compiler, run_compiler
from mahovik.core.toolchain.fuzz_project import fuzz_project, sources
from mahovik.core.toolchain.fuzzing import FLAGS, compile_harness, fuzz
from mahovik.core.toolchain.targets import TARGETS
from mahovik.errors import CheckError
from mahovik.proof.cost.measure import measure
from mahovik.proof.cost.measure import parse_targets as asked_for_cost
from mahovik.proof.cost.page import as_json as cost_json
from mahovik.proof.cost.page import page
from mahovik.proof.evidence.piece import (
    Need,
    Outcome,
    Piece,
    Subject,
    Table,
    Tell,
    Verdict,
    count_to,
    program,
    verdict_of,
)
from mahovik.proof.verify.selftest_log import judge_log
from mahovik.proof.verify.targets import as_json, parse_targets, verify_targets

_COST_TARGETS = {"double": "m7,rv64gc", "float": "m4,rv32imafc"}
"""Processors whose FPU calculates with that type."""

_QUICK_TARGETS = {"double": "host,m7,rv64gc", "float": "host,m4,rv64gc"}


def _selftest_command(subject: Subject) -> str:
    name = subject.stand.name
    build = (
        f"cc -std=c99 -O2 -ffp-contract=off -D{name.upper()}_SELFTEST_MAIN c/{name}.c c/{subject.selftest} -o selftest"
    )
    some = f" --only {','.join(subject.only)}" if subject.only else ""
    return f"{build} && ./selftest > selftest.log; mahovik judge-log {subject.stand_file} --log selftest.log{some}"


def _run_selftest(subject: Subject, tell: Tell) -> Outcome:
    tell("compile and run")
    name = subject.stand.name
    texts = [f"-D{name.upper()}_SELFTEST_MAIN", str(subject.c / f"{name}.c"), str(subject.c / subject.selftest)]
    made = subject.scratch / "selftest"
    run_compiler(["-std=c99", "-O2", *BITS, *texts, "-o", str(made)], subject.selftest)
    text = run(TARGETS["host"], made, 300.0)
    found = judge_log(text, "selftest.log", subject.stand, subject.only)
    rows = tuple(("checked", line) for line in found.checked) + tuple(("not checked", line) for line in found.unchecked)
    functions = sum(len(each.functions) for each in found.runs)
    states = " and ".join(str(each.sweep or 0) for each in found.runs)
    good = not found.problems and not found.unchecked
    figure = f"{functions} functions, {states} states of the sweep" if good else "bits differ, or something is missing"
    tools = (version(find_compiler()[0]),)
    return Outcome(verdict_of(good), figure, tools, Table(("", "what"), rows), found.problems, {"selftest.log": text})


SELFTEST = Piece(
    name="selftest",
    title="Self-test that travels with the C",
    shows=(
        "Every public function gives, bit for bit, what the interpreter of the program gave at generation: compiler "
        "and processor have changed nothing. The same test runs on the real board; `mahovik judge-log` judges its log."
    ),
    limits="That the equations are right: it compares the C with its own program. Other pieces judge the equations.",
    command=_selftest_command,
    run=_run_selftest,
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


def _run_branches(subject: Subject, tell: Tell) -> Outcome:
    tell("compile and run")
    name = subject.stand.name
    lines = measure_branches(subject.c / f"{name}.c", subject.c / subject.selftest, subject.scratch)
    left = [each for each in lines if each.taken < each.ways]
    rows = tuple((each.function, str(each.number), each.text, why_unreachable(each)) for each in left)
    ways, taken = sum(each.ways for each in lines), sum(each.taken for each in lines)
    beyond = sum(each.ways - each.taken for each in left if why_unreachable(each))
    figure = f"{taken} of {ways} branches taken, {taken / ways:.1%}; of the others {beyond} are out of a caller's reach"
    table = Table(("function", "line>", "a branch that is not taken", "why no caller can"), rows)
    text = json.dumps([asdict(each) for each in lines], indent=1) + "\n"
    good = taken >= LEAST_BRANCHES * (ways - beyond)
    return Outcome(verdict_of(good), figure, tuple(coverage_tools()), table, files={"branches.json": text})


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


def _fuzzer_links() -> bool:
    """Whether clang has its runtime: without it the harness does not link."""
    try:
        done = subprocess.run(["clang", "-print-runtime-dir"], capture_output=True, text=True, check=False)
    except OSError:
        return False
    return any(Path(done.stdout.strip()).glob("libclang_rt.fuzzer*.a"))


def _run_fuzzer(subject: Subject, tell: Tell) -> Outcome:
    """Run libFuzzer with sanitizers on every public function."""
    if subject.only:
        return Outcome(Verdict.NOTHING, "the harness calls all functions, and this C has some of them")
    folder = subject.scratch / "fuzz"
    folder.mkdir()
    for name, text in fuzz_project(subject.stand, subject.real).items():
        (folder / name).write_text(text, encoding="utf-8")
    tools = (version("clang"),)
    tell("compile")
    harness = compile_harness(folder, sources(subject.stand.name))
    tell(f"{subject.seconds} s")
    try:
        found = fuzz(harness, folder / "corpus", seconds=subject.seconds)
    except CheckError as error:
        inputs = {each.name: each.read_bytes() for each in sorted(folder.glob("*-*")) if each.suffix == ""}
        files: dict[str, str | bytes] = {"found.txt": f"{error}\n", **inputs}
        return Outcome(Verdict.FAILED, "something was found", tools, notes=(str(error),), files=files)
    figures = {
        "seconds": subject.seconds,
        "executions": found.executions,
        "edges reached": found.edges,
        "features reached": found.features,
        "inputs kept": found.kept,
        "findings": 0,
    }
    table = Table(("", "count>"), tuple((key, f"{number:,}") for key, number in figures.items()))
    kept = {"run.json": json.dumps({**figures, "flags": FLAGS}, indent=1) + "\n"}
    figure = f"{found.executions:,} executions in {subject.seconds} s, no finding"
    return Outcome(verdict_of(found.executions > 0), figure, tools, table, files=kept)


FUZZING = Piece(
    name="fuzz",
    title="Arbitrary arguments",
    shows=(
        "Every public function was called with arbitrary bytes as arguments, NaN, infinities and null pointers among "
        "them, under clang's sanitizers: statuses as the header names them, nothing written on a refusal, finite "
        "results otherwise, the same bits twice."
    ),
    limits="Inputs that were not tried: it looks for counter-examples, for the time that it has, and proves nothing.",
    command=lambda s: f"mahovik export fuzz {s.stand_file} -o fuzz{s.option} && make -C fuzz run",
    run=_run_fuzzer,
    needs=lambda _: (program("clang"), Need("clang's runtime", _fuzzer_links, "apt-get install libclang-rt-14-dev")),
)


def _target_tools(names: str, real: str) -> tuple[Need, ...]:
    """Compilers and emulators of targets."""
    found: dict[str, Need] = {}
    for target, _ in parse_targets(names, (real,)):
        packages = " ".join(target.packages)
        for command in (target.compiler[0], target.link[0], *target.emulator[:1]):
            found.setdefault(command, program(command, f"apt-get install {packages}" if packages else ""))
    return tuple(found.values())


def _targets(subject: Subject) -> str:
    return "all" if subject.full else _QUICK_TARGETS[subject.real]


def _run_on_targets(subject: Subject, tell: Tell) -> Outcome:
    tell("compile and run")
    pairs = parse_targets(_targets(subject), (subject.real,))
    found = verify_targets(subject.stand, pairs, progress=count_to(tell), only=subject.only)
    rows = tuple((r.target, r.title, r.built_with, f"{r.verdict} {r.reason}".strip()) for r in found.rows)
    tools = tuple(dict.fromkeys(r.built_with for r in found.rows if r.verdict == "ok"))
    table = Table(("target", "processor", "compiler", "verdict"), rows)
    return Outcome(verdict_of(found.passed), found.conclusion, tools, table, files={"targets.json": as_json(found)})


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


def _measure_cost(subject: Subject, tell: Tell) -> Outcome:
    tell("compile and run")
    pairs = asked_for_cost(_COST_TARGETS[subject.real], subject.real)
    found = measure(subject.stand, pairs, count_to(tell), subject.only)
    rows = tuple(
        (f.function, each.target, f"{f.instructions:,}" if f.instructions else "refused", f"{f.stack:,}", f"{f.code:,}")
        for each in found.targets
        for f in each.functions
    )
    table = Table(("function", "on", "instructions>", "stack, bytes>", "code, bytes>"), rows)
    deepest = max((f.stack for each in found.targets for f in each.functions), default=0)
    first = found.targets[0]
    forward = next((f.instructions for f in first.functions if f.function == "forward"), 0)
    figure = f"forward {forward:,} instructions on {first.target}; stack at most {deepest:,} bytes"
    tools = tuple(dict.fromkeys(t for each in found.targets for t in (each.compiler, each.emulator) if t))
    files = {"COST.md": page(found), "cost.json": cost_json(found)}
    return Outcome(Verdict.PASSED, figure, tools, table, files=files)


COST = Piece(
    name="cost",
    title="Instructions, stack, code",
    shows="What a call costs at ordinary states, counted on emulators; the stack is bounded over the graph of calls.",
    limits="Time: instructions are not cycles. The worst case over all inputs, which branches on the state may exceed.",
    command=lambda s: f"mahovik cost {s.stand_file} --targets {_COST_TARGETS[s.real]} --real {s.real} -o cost",
    run=_measure_cost,
    needs=lambda s: _target_tools(_COST_TARGETS[s.real], s.real),
)
