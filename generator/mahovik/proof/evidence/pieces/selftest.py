"""The delivered self-test: golden vectors and a sweep."""

from __future__ import annotations

from mahovik.proof.evidence.piece import Outcome, Piece, Subject, Table, Tell, judged, program


def _command(subject: Subject) -> str:
    name = subject.stand.name
    build = f"cc -std=c99 -O2 -ffp-contract=off c/{name}.c c/{name}_selftest.c -o selftest"
    return f"{build} && ./selftest > selftest.log; mahovik judge-log selftest.log {subject.stand_file}"


def _run(subject: Subject, tell: Tell) -> Outcome:
    from mahovik.core.toolchain.board import run, version
    from mahovik.core.toolchain.compiler import BITS, find_compiler, run_compiler
    from mahovik.core.toolchain.targets import TARGETS
    from mahovik.proof.verify.judge_log import judge_log

    tell("compile and run")
    name = subject.stand.name
    sources = [str(subject.c / f"{name}.c"), str(subject.c / f"{name}_selftest.c")]
    made = subject.scratch / "selftest"
    run_compiler(["-std=c99", "-O2", *BITS, *sources, "-o", str(made)], f"{name}_selftest.c")
    text = run(TARGETS["host"], made, 300.0)
    found = judge_log(text, "selftest.log", subject.stand)
    rows = tuple(("checked", line) for line in found.checked) + tuple(("not checked", line) for line in found.unchecked)
    functions = sum(len(each.functions) for each in found.runs)
    states = " and ".join(str(each.sweep or 0) for each in found.runs)
    good = not found.problems and not found.unchecked
    figure = f"{functions} functions, {states} states of the sweep" if good else "bits differ, or something is missing"
    tools = (version(find_compiler()[0]),)
    return Outcome(judged(good), figure, tools, Table(("", "what"), rows), found.problems, {"selftest.log": text})


PIECE = Piece(
    name="selftest",
    title="Self-test that travels with the C",
    shows=(
        "Every public function gives, bit for bit, what the interpreter of the program gave at generation: compiler "
        "and processor have changed nothing. The same test runs on the real board; `mahovik judge-log` judges its log."
    ),
    limits="That the equations are right: it compares the C with its own program. Other pieces judge the equations.",
    command=_command,
    run=_run,
    needs=lambda _: (program("gcc"),),
)
