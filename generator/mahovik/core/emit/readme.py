"""README.md of a delivered folder: what it is, how to call it, what was verified and how to repeat that."""

from __future__ import annotations

from typing import Any

from mahovik import __version__
from mahovik.core.emit.calls import call, declaration
from mahovik.core.emit.declaration import titled
from mahovik.core.emit.eva import provable
from mahovik.core.emit.generate import Generated, described
from mahovik.core.emit.names import Names
from mahovik.core.emit.status import statuses
from mahovik.core.emit.templates import template
from mahovik.core.program.call import Argument
from mahovik.core.program.cost import cost
from mahovik.core.program.function import Function, Program
from mahovik.core.program.types import Struct
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand


def readme(stand: Stand, generated: Generated, batch: bool = False) -> str:
    """Text of README.md; `batch`: of a folder with the functions for many states."""
    program = generated.program
    names = Names(program.name)
    found = identities(stand)
    lanes = generated.layout.lanes
    forward = program.function("forward")
    default = f"&{names.function('default')}"
    zeroed = [a for a in forward.arguments if a.direction == "in" and not isinstance(a.type, Struct)]
    return template("delivery.md.j2").render(
        name=stand.name,
        NAME=stand.name.upper(),
        bodies=described(stand),
        real=program.precision.name,
        option="" if program.precision.name == "double" else f" --real {program.precision.name}",
        made_by=f"{f' --lanes {lanes}' if lanes > 1 or generated.fast else ''}{' --fast' if generated.fast else ''}",
        lanes=lanes,
        wide=lanes > 1,
        fast=generated.fast,
        batch=batch,
        proofs=provable(generated),
        generator=f"mahovik {__version__}",
        structure=found.structure,
        physics=found.physics,
        flywheel=stand.flywheels[0].name if stand.flywheels else "",
        declarations=[_zeroed(a, names) for a in zeroed],
        call=call(names, forward, {a.name: a.name for a in forward.arguments} | {"table": default, "x": "&x"}),
        functions=[_row(f, program) for f in program.functions if f.public],
        statuses=statuses(names, generated.layout),
    )


def _zeroed(a: Argument, names: Names) -> str:
    unit = f"  /* {a.unit} */" if a.unit else ""
    return f"const {declaration(names, a.name, a.type, a.shape)} = {{ 0 }};{unit}"


def _row(function: Function, program: Program) -> dict[str, Any]:
    purpose = titled(function).replace("|", "\\|")
    return {"name": function.name, "purpose": purpose, "operations": cost(function, program.functions).total}
