"""From an equation to lines of C."""

from __future__ import annotations

import json
import re
from typing import Any

from mahovik.proof.evidence.piece import Outcome, Piece, Subject, Table, Tell, judged


def _run(subject: Subject, tell: Tell) -> Outcome:
    from mahovik.core.emit.generate import generate_all
    from mahovik.core.emit.spans import spans

    tell("read the C")
    name = subject.stand.name
    where = spans((subject.c / f"{name}.c").read_text(encoding="ascii"), name)
    functions = generate_all(subject.stand, subject.real).program.functions
    lost = [f.name for f in functions if f.name not in where]
    found: list[dict[str, Any]] = [
        {
            "function": f"{name}_{f.name}",
            "equations": re.findall(r"\(\d+\)", f.equation),
            "purpose": f.purpose,
            "public": f.public,
            "lines": list(where[f.name]),
        }
        for f in functions
        if f.name in where
    ]
    # by equation; what has none, own mathematics and checks, comes last in the order of the C
    order = sorted(found, key=lambda each: [int(n[1:-1]) for n in each["equations"]] or [99])
    rows = tuple((", ".join(f["equations"]), f["function"], f["purpose"], "{}-{}".format(*f["lines"])) for f in order)
    numbers = {n for each in found for n in each["equations"]}
    figure = f"{len(numbers)} equations in {sum(bool(f['equations']) for f in found)} of {len(found)} functions"
    notes = (f"Not found in the source: {', '.join(lost)}.",) if lost else ()
    table = Table(("equations", "function", "what it computes", f"lines of {name}.c>"), rows)
    return Outcome(judged(not lost), figure, (), table, notes, {"functions.json": json.dumps(found, indent=1) + "\n"})


PIECE = Piece(
    name="equations",
    title="From equation to lines of C",
    shows="Which function computes which equation of the paper, and where it stands: what to read beside the paper.",
    limits=(
        "That the lines are right: other pieces judge that. Which tests notice a change in each function was found by "
        "mutation, for the example stands: `docs/results/traceability.md` of the project."
    ),
    command=lambda s: f"mahovik evidence {s.stand_file} --only equations -o again{s.option}",
    run=_run,
)
