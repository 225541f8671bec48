"""C of a unit test: one step of a flight log, its inputs and its result as hexadecimal constants."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from mahovik.contract.status import status_words
from mahovik.core.emit.code import INDENT, Code
from mahovik.core.emit.generate import Generated
from mahovik.core.emit.layout import wrap_statement
from mahovik.core.emit.literal import initialiser
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand

Numbers = Mapping[str, Sequence[float]]


def replay_test(
    stand: Stand,
    generated: Generated,
    file: str,
    count: int,
    function: str,
    inputs: Mapping[str, Any],
    before: Numbers,
    after: Numbers,
    status: int,
    table: Mapping[str, Any] | None,
    carry_after: Sequence[float] | None = None,
) -> str:
    """The text of a C program that makes step `count` again. It returns 0 where status and state have the same bits.

    `function` is that of the step, `inputs` what it takes beside table and state, by the names of its arguments;
    `table` None is the default. `carry_after`: numbers of the carry after a step that has one.
    """
    code, layout = Code(generated.program, identities(stand)), generated.layout
    names = code.names
    arguments = {a.name: a for a in code.program.function(function).arguments}
    variables = [
        {"declaration": names.declaration(title, layout.state), "lines": _members(numbers, code)}
        for title, numbers in (("before", before), ("after", after))
    ]
    passed = {"table": "&table" if table is not None else f"&{names.function('default')}", "x": "&x", "next": "&x"}
    if carry_after is not None:
        for title, carried in (("carry_before", inputs["carry"]), ("carry_after", carry_after)):
            variables.append(
                {
                    "declaration": names.declaration(title, layout.carry),
                    "lines": _members({"rounding": carried}, code),
                }
            )
        passed["carry"] = "&carry"
    for name, value in inputs.items():
        if name == "carry":
            continue
        if not arguments[name].shape:
            passed[name] = _number(value, code) if name == "dt" else str(value)
            continue
        passed[name] = name
        text = ", ".join(str(int(v)) if name == "locked" else _number(v, code) for v in value)
        declaration = names.declaration(name, arguments[name].type, (len(value),))
        variables.append({"declaration": declaration, "lines": wrap_statement(text, INDENT)})
    kept = {"carry_after": carry_after} if carry_after is not None else {}
    numbers = [v for group in (before, after, inputs, kept) for values in group.values() for v in np.atleast_1d(values)]
    return code.render(
        "replay_test.c.j2",
        file=file,
        count=count,
        special=not all(map(math.isfinite, numbers)),
        table=initialiser(layout.table, dict(table), code.real, {}) if table is not None else [],
        variables=variables,
        function=function,
        passed=[passed.get(a, "NULL") for a in arguments],
        status=names.constant(status_words(status)),
        members=list(after),
        carry=names.type(layout.carry) if carry_after is not None else "",
    )


def _members(numbers: Numbers, code: Code) -> list[str]:
    lines = []
    for name, values in numbers.items():
        lines += wrap_statement(f".{name} = {{ {', '.join(_number(v, code) for v in values)} }},", INDENT)
    return lines


def _number(value: float, code: Code) -> str:
    """A hexadecimal constant, or the macro for infinity or NaN."""
    if math.isfinite(value):
        return code.hex(value)
    sign = "-" if math.copysign(1.0, value) < 0 else ""
    return f"{sign}{'NAN' if math.isnan(value) else 'INFINITY'}"
