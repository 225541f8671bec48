"""README.md of a delivered folder: what it is, how to call it, what was verified and how to repeat that."""

from __future__ import annotations

from mahovik.core.emit.calls import call
from mahovik.core.emit.code import Code
from mahovik.core.emit.declaration import purpose_with_number
from mahovik.core.emit.generate import Generated, describe_bodies
from mahovik.core.emit.recorder import has_recorder
from mahovik.core.emit.status import statuses
from mahovik.core.program.cost import cost
from mahovik.core.program.types import Struct
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand


def readme(stand: Stand, generated: Generated, batch: bool = False) -> str:
    """Text of README.md; `batch`: of a folder with the functions for many states."""
    code = Code(generated.program, identities(stand))
    names, real = code.names, code.precision.name
    called = [f for f in code.public if f.name == "forward"]
    arguments = called[0].arguments if called else ()
    given = {a.name: a.name for a in arguments} | {"table": f"&{names.function('default')}", "x": "&x"}
    zeroed = [a for a in arguments if a.direction == "in" and not isinstance(a.type, Struct)]
    part = f" --only {','.join(generated.only)}" if generated.only else ""
    return code.render(
        "delivery.md.j2",
        part=part,
        bodies=describe_bodies(stand),
        option="" if real == "double" else f" --real {real}",
        batch=batch,
        flywheel=stand.flywheels[0].name if stand.flywheels else "",
        declarations=[(names.declaration(a.name, a.type, a.shape), a.unit) for a in zeroed],
        others=[
            (names.declaration(a.name, a.type, a.shape), a.unit)
            for a in arguments
            if a.direction == "out" and a.name != "V_dot"
        ],
        held=generated.layout.held,
        freedoms=generated.layout.freedoms,
        call=call(names, called[0], given) if called else "",
        only=generated.only,
        recorded=has_recorder(generated),
        functions=[
            (f.name, purpose_with_number(f).replace("|", "\\|"), cost(f, code.program.functions).total)
            for f in code.public
        ],
        statuses=statuses(names, generated.layout, generated.part),
    )
