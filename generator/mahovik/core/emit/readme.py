"""README.md of a delivered folder: what it is, how to call it, what was verified and how to repeat that."""

from __future__ import annotations

from mahovik.contract.functions import is_default
from mahovik.core.emit.calls import call
from mahovik.core.emit.code import Code
from mahovik.core.emit.declaration import purpose_with_number
from mahovik.core.emit.generate import Generated, describe_bodies
from mahovik.core.emit.status import statuses
from mahovik.core.program.cost import cost
from mahovik.core.program.types import Struct
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand


def readme(stand: Stand, generated: Generated, additions: tuple[str, ...] = ()) -> str:
    """Text of README.md of a folder with these additions (delivery.ADDITIONS)."""
    code = Code(generated.program, identities(stand))
    names = code.names
    called = [f for f in code.public if f.name == "forward"]
    arguments = called[0].arguments if called else ()
    given = {a.name: a.name for a in arguments} | {"table": f"&{names.function('default')}", "x": "&x"}
    given |= {a.name: "NULL" for a in arguments if a.optional == "missing"}
    zeroed = [a for a in arguments if a.direction == "in" and not isinstance(a.type, Struct) and not a.optional]
    usual = generated.only == tuple(f.name for f in code.public if is_default(f.name))
    return code.render(
        "delivery.md.j2",
        part="" if usual else f" --only {','.join(generated.only)}",
        bodies=describe_bodies(stand),
        additions=additions,
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
        functions=[
            (f.name, purpose_with_number(f).replace("|", "\\|"), cost(f, code.program.functions).total)
            for f in code.public
        ],
        statuses=statuses(names, generated.layout, generated.part),
    )
