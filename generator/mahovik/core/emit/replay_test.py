"""C of a unit test: one step of a flight log, its inputs and its result as hexadecimal constants."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from mahovik import __version__
from mahovik.contract.status import status_words
from mahovik.core.emit.constant import initialiser
from mahovik.core.emit.generate import Generated
from mahovik.core.emit.hexadecimal import hex_literal
from mahovik.core.emit.layout import wrapped
from mahovik.core.emit.names import Names
from mahovik.core.emit.templates import template
from mahovik.core.program.types import Precision
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
) -> str:
    """The text of a C program that makes step `count` again. It returns 0 where status and state have the same bits.

    `function` is step or step_driven, `inputs` what it takes beside table and state, by the names of its arguments;
    `table` None is the default.
    """
    program, layout, names = generated.program, generated.layout, Names(stand.name)
    precision, real = program.precision, names.function("real")
    arguments = {a.name: a for a in program.function(function).arguments}
    variables = [
        {"type": names.type(layout.state), "name": title, "lines": _members(numbers, precision)}
        for title, numbers in (("before", before), ("after", after))
    ]
    passed = {"table": "&table" if table is not None else f"&{names.function('default')}", "x": "&x", "next": "&x"}
    for name, value in inputs.items():
        if not arguments[name].shape:
            passed[name] = _number(value, precision) if name == "dt" else str(value)
            continue
        passed[name] = name
        whole = name == "locked"
        text = ", ".join(str(int(v)) if whole else _number(v, precision) for v in value)
        declared = {"type": "int" if whole else real, "name": f"{name}[{len(value)}]", "lines": wrapped(text, "    ")}
        variables.append(declared)
    found = identities(stand)
    numbers = [v for group in (before, after, _arrays(inputs)) for values in group.values() for v in values]
    return template("replay_test.c.j2").render(
        file=file,
        count=count,
        name=stand.name,
        NAME=stand.name.upper(),
        version=__version__,
        structure=found.structure,
        physics=found.physics,
        real_bytes=precision.width // 8,
        special=not all(map(math.isfinite, numbers)),
        table=initialiser(layout.table, dict(table), precision, {}) if table is not None else [],
        variables=variables,
        function=function,
        passed=[passed[a] for a in arguments],
        status=names.constant(status_words(status)),
        members=list(after),
    )


def _arrays(inputs: Mapping[str, Any]) -> dict[str, Sequence[float]]:
    """Inputs as sequences of numbers."""
    return {name: value if hasattr(value, "__len__") else [value] for name, value in inputs.items()}


def _members(numbers: Numbers, precision: Precision) -> list[str]:
    lines = []
    for name, values in numbers.items():
        lines += wrapped(f".{name} = {{ {', '.join(_number(v, precision) for v in values)} }},", "    ")
    return lines


def _number(value: float, precision: Precision) -> str:
    """A hexadecimal constant, or the macro of what has none."""
    if math.isfinite(value):
        return hex_literal(value, precision)
    sign = "-" if math.copysign(1.0, value) < 0 else ""
    return f"{sign}{'NAN' if math.isnan(value) else 'INFINITY'}"
