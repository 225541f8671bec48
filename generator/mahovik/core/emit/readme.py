"""README.md of a delivered folder: what it is, how to call it, what was verified and how to repeat that."""

from __future__ import annotations

from typing import Any

from mahovik.contract.quantities import TABLES
from mahovik.core.emit.calls import argument_text, call
from mahovik.core.emit.code import Code
from mahovik.core.emit.declaration import purpose_with_number
from mahovik.core.emit.generate import Generated, describe_bodies, statuses
from mahovik.core.emit.names import member
from mahovik.core.program.cost import cost
from mahovik.core.program.types import Kind, Shape, Struct
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import identities

_VALUES = {"dt": "1e-3", "order": "4", "angles": "{ 0, 0.5, 0 }", "orientation": "{ 1, 0, 0, 0 }"}
"""Inputs of the example that are not zero."""


def readme(stand: Stand, generated: Generated, additions: tuple[str, ...] = ()) -> str:
    """Text of README.md of a folder with these additions (delivery.ADDITIONS)."""
    code = Code(generated.program, identities(stand))
    return code.render(
        "delivery.md.j2",
        part=f" --only {','.join(generated.chosen)}" if generated.chosen else "",
        bodies=describe_bodies(stand),
        additions=additions,
        flywheel=stand.flywheels[0].name if stand.flywheels else "",
        held=generated.layout.held,
        V=generated.layout.twist,
        freedoms=generated.layout.freedoms,
        functions=[
            (f.name, purpose_with_number(f).replace("|", "\\|"), cost(f, code.program.functions).total)
            for f in code.public
        ],
        statuses=statuses(code.names, generated.layout, generated.part),
        **_example(code),
    )


def _example(code: Code) -> dict[str, Any]:
    """Values of the template for a program that calls `forward`, else the first function that needs no mountings."""
    names = code.names
    needy = {f.name for f in code.public if any(a.name == "mounting" and a.direction == "in" for a in f.arguments)}
    called = min(code.public, key=lambda f: (f.name != "forward", f.name in needy))
    texts, lines = {}, []
    for a in called.arguments:
        table = TABLES.get(a.type.name) if isinstance(a.type, Struct) else None
        default = names.function(table.default) if table and table.default else ""
        if a.optional:
            texts[a.name] = "NULL"
            continue
        if default and a.direction == "in":
            texts[a.name] = f"&{default}"
            continue
        texts[a.name] = argument_text(a, a.name)
        text, about = names.declaration(a.name, a.type, a.shape), f"  /* {a.unit} */" if a.unit else ""
        if a.name == "x":
            text += " = { .attitude = { 1 } }"
            about = "  /* level and at rest at the origin; w comes first */"
        elif a.direction == "inout":
            text += f" = {default or '{ 0 }'}"
        elif a.direction == "in":
            text = f"const {text} = {_VALUES.get(a.name) or ('{ 0 }' if a.shape else '0')}"
        else:
            about = ""
        lines.append(f"{text};{about}")
    result = next(a for a in called.arguments if a.direction != "in" and not a.optional)
    answer, shape, unit = _first_numbers(result.name, result.type, result.shape, result.unit)
    return {
        "declarations": lines,
        "moves": any(a.name == "x" for a in called.arguments),
        "call": call(names, called, texts),
        "answer": answer,
        "count": names.length(shape[0]) if shape else "",
        "unit": unit,
    }


def _first_numbers(place: str, type_: Kind | Struct, shape: Shape, unit: str) -> tuple[str, Shape, str]:
    """The first row of reals of a result: its place, its length or (), its unit."""
    rows = shape if isinstance(type_, Struct) else shape[:-1]
    place += "[0]" * len(rows)
    if not isinstance(type_, Struct):
        return place, shape[-1:], unit
    field = next((f for f in type_.fields if f.type is not Kind.INT), type_.fields[0])
    return _first_numbers(f"{place}.{member(field.name)}", field.type, field.shape, field.unit)
