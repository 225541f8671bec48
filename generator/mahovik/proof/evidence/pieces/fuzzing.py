"""libFuzzer with sanitizers on every public function."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path

from mahovik.proof.evidence.piece import Need, Outcome, Piece, Subject, Table, Tell, Verdict, judged, program


def _links() -> bool:
    """Whether clang has its runtime: without it the harness does not link."""
    try:
        done = subprocess.run(["clang", "-print-runtime-dir"], capture_output=True, text=True, check=False)
    except OSError:
        return False
    return any(Path(done.stdout.strip()).glob("libclang_rt.fuzzer*.a"))


def _run(subject: Subject, tell: Tell) -> Outcome:
    from mahovik.core.toolchain.board import version
    from mahovik.core.toolchain.fuzz_project import fuzz_project, sources
    from mahovik.core.toolchain.fuzzing import FLAGS, compile_harness, fuzz
    from mahovik.errors import CheckError

    folder = subject.scratch / "fuzz"
    folder.mkdir()
    texts = fuzz_project(subject.stand, subject.real)
    for name, text in texts.items():
        (folder / name).write_text(text, encoding="utf-8")
    tools = (version("clang"),)
    tell("compile")
    harness = compile_harness(folder, sources(subject.stand.name))
    tell(f"{subject.seconds} s")
    try:
        found = fuzz(harness, folder / "corpus", seconds=subject.seconds)
    except CheckError as error:
        inputs = {each.name: each.read_bytes() for each in sorted(folder.glob("*-*")) if each.suffix == ""}
        said = str(error)
        return Outcome(
            Verdict.FAILED, "something was found", tools, notes=(said,), files={"found.txt": f"{said}\n", **inputs}
        )
    figures = {
        "seconds": subject.seconds,
        "executions": found.executions,
        "edges reached": found.edges,
        "features reached": found.features,
        "inputs kept": found.kept,
        "findings": 0,
    }
    table = Table(("", "count>"), tuple((key, f"{number:,}") for key, number in figures.items()))
    files = {"run.json": json.dumps({**figures, "flags": FLAGS}, indent=1) + "\n"}
    figure = f"{found.executions:,} executions in {subject.seconds} s, no finding"
    return Outcome(judged(found.executions > 0), figure, tools, table, files=files)


def _command(subject: Subject) -> str:
    return f"mahovik export fuzz {subject.stand_file} -o fuzz{subject.option} && make -C fuzz run"


def _needs(_: Subject) -> tuple[Need, ...]:
    return (program("clang"), Need("clang's runtime", _links, "apt-get install libclang-rt-14-dev"))


PIECE = Piece(
    name="fuzz",
    title="Arbitrary arguments",
    shows=(
        "Every public function was called with arbitrary bytes as arguments, NaN, infinities and null pointers among "
        "them, under clang's sanitizers: statuses as the header names them, nothing written on a refusal, finite "
        "results otherwise, the same bits twice."
    ),
    limits="Inputs that were not tried: it looks for counter-examples, for the time that it has, and proves nothing.",
    command=_command,
    run=_run,
    needs=_needs,
)
