"""`cost`: instructions, stack, code and constants."""

from __future__ import annotations

from collections.abc import Sequence

from mahovik.proof.evidence.piece import Need, Outcome, Piece, Subject, Table, Tell, Verdict
from mahovik.proof.evidence.pieces.targets import tools_of

_TARGETS = {"double": "m7,rv64gc", "float": "m4,rv32imafc"}
"""Processors whose FPU calculates with that type."""


def _needs(subject: Subject) -> Sequence[Need]:
    return tools_of(_TARGETS[subject.real], subject.real)


def _run(subject: Subject, tell: Tell) -> Outcome:
    from mahovik.proof.cost.measure import asked, measure
    from mahovik.proof.cost.page import as_json, page

    def progress(done: int, total: int) -> None:
        tell(f"{done} of {total}")

    tell("compile and run")
    found = measure(subject.stand, asked(_TARGETS[subject.real], subject.real), progress)
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
    files = {"COST.md": page(found), "cost.json": as_json(found)}
    return Outcome(Verdict.PASSED, figure, tools, table, files=files)


PIECE = Piece(
    name="cost",
    title="Instructions, stack, code",
    shows="What a call costs at ordinary states, counted on emulators; the stack is bounded over the graph of calls.",
    limits="Time: instructions are not cycles. The worst case over all inputs, which branches on the state may exceed.",
    command=lambda s: f"mahovik cost {s.stand_file} --targets {_TARGETS[s.real]} --real {s.real} -o cost",
    run=_run,
    needs=_needs,
)
