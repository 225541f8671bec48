"""`<stand>.hpp`: the functions of `<stand>.h` for C++17, with std::array, references and an enum class."""

from __future__ import annotations

from collections.abc import Sequence

from mahovik.core.emit.calls import argument_text, call
from mahovik.core.emit.code import INDENT, Code
from mahovik.core.emit.declaration import contract
from mahovik.core.emit.generate import Generated, header_structs
from mahovik.core.emit.layout import hanging, wrap_statement
from mahovik.core.emit.names import Names
from mahovik.core.emit.status import statuses
from mahovik.core.program.call import Argument
from mahovik.core.program.function import Function, Program
from mahovik.core.program.types import Kind, NamedCount, Struct
from mahovik.core.stand.hold import freedom_labels, twists
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand

_NO_NAMESPACE = frozenset(
    ("std", "linux", "unix", "i386", "I", "near", "far", "interface", "cdecl", "pascal", "hyper", "environ")
)
"""Names of stands that cannot be namespaces inside `mahovik`: they would hide std, or are macros."""

_TABLES = {
    "default_table": ("default", "Table"),
    "default_parameters": ("default_parameters", "Parameters"),
    "default_options": ("default_options", "InverseOptions"),
}
"""Constant tables of the C: name in C++, name in C without prefix, type."""


def cpp_header(stand: Stand, generated: Generated) -> dict[str, str]:
    """The C++17 header of generated C, by its file name."""
    code = Code(generated.program, identities(stand))
    program, names = code.program, code.names
    absent = "" if any(struct.name == "inverse_options" for struct in program.structs) else "default_options"
    listed = [
        (name.removeprefix(names.constant("")), value, meaning)
        for name, value, meaning in statuses(names, generated.layout, generated.part)
    ]
    text = code.render(
        "stand.hpp.j2",
        namespace=namespace(stand),
        flywheels=bool(generated.layout.flywheels),
        ints=any(a.shape and _kind(a, names) == "int" for f in code.public for a in f.arguments),
        statuses=listed,
        refusals=[name for name, value, _ in listed if value < 0],
        bits=[name for name, value, _ in listed if value > 0],
        counts=[(c.name, names.constant(c.name), c.comment) for c in program.counts],
        structs=[(_struct(s), names.type(s), s.purpose) for s in header_structs(program) if s.name != "state"],
        tables=[(name, of, names.function(c)) for name, (c, of) in _TABLES.items() if name != absent],
        functions=[_function(f, names, program) for f in code.public],
        held=stand.hold is not None,
        sums=any(f.name == "momentum" for f in code.public),
        twist=_first_twist(stand, code)[0],
        members=[(f.name, "; ".join(p for p in (f.unit, f.comment) if p)) for f in generated.layout.state.fields],
    )
    return {f"{stand.name}.hpp": text}


def namespace(stand: Stand) -> str:
    """The namespace of a stand inside `mahovik`: its name, with an underscore where C++ would not have it."""
    return f"{stand.name}_" if stand.name in _NO_NAMESPACE else stand.name


def _function(f: Function, names: Names, program: Program) -> dict[str, list[str]]:
    """An inline function that only passes on: no copy, no exception."""
    result = "Status" if f.returns is Kind.STATUS else "Real"
    head = hanging(f"inline {result} {f.name}(", [_parameter(a, names) for a in f.arguments], " noexcept")
    text = call(names, f, _argument_text)
    returned = f"return status_of({text});" if f.returns is Kind.STATUS else f"return {text};"
    return {"comment": contract(f, names, program), "lines": [*head, "{", *wrap_statement(returned, INDENT), "}"]}


def _parameter(a: Argument, names: Names) -> str:
    """An argument as C++ declares it: arrays, structs by reference, numbers by value; by address what may be null."""
    const = "const " if a.direction == "in" else ""
    held = _variable_type(a, names)
    if a.optional == "missing":
        return f"{const}{held}* {a.name}"
    if a.shape or isinstance(a.type, Struct):
        return f"{const}{held}& {a.name}"
    return f"{held} {a.name}" if a.direction == "in" else f"{held}& {a.name}"


def _variable_type(a: Argument, names: Names, scope: str = "") -> str:
    """The type of a variable for an argument; `scope`: `stand::` where the namespace has to be named."""
    kind = _kind(a, names)
    qualifier = scope if kind not in ("int", names.type(a.type)) else ""
    if not a.shape:
        return f"{qualifier}{kind}"
    size = f"{scope if isinstance(a.shape[0], NamedCount) else ''}{_count(a.shape[0])}"
    array = {"Real": "Reals", "int": "Ints"}.get(kind)
    return f"{scope}{array}<{size}>" if array else f"std::array<{qualifier}{kind}, {size}>"


def _kind(a: Argument, names: Names) -> str:
    """The type of an argument, of an array that of its elements. A state is the C's, so that either can be given."""
    if isinstance(a.type, Struct):
        return names.type(a.type) if a.type.name == "state" else _struct(a.type)
    return "int" if a.type in (Kind.INT, Kind.BOOL) else "Real"


def _argument_text(a: Argument) -> str:
    """The same argument as the C takes it."""
    if a.optional == "missing":
        return f"{a.name} ? {a.name}->data() : nullptr" if a.shape else a.name
    return f"{a.name}.data()" if a.shape else argument_text(a, a.name)


def _count(size: int | NamedCount) -> str:
    """A length: a number, or its constant in the namespace."""
    return size.name if isinstance(size, NamedCount) else str(size)


def _struct(struct: Struct) -> str:
    """Name of a struct in C++: `InverseOptions` for `inverse_options`."""
    return "".join(part.capitalize() for part in struct.name.split("_"))


def cpp_example(stand: Stand, generated: Generated) -> dict[str, str]:
    """A whole program in C++17 that calls `forward`, by its file name."""
    code = Code(generated.program, identities(stand))
    forward = code.program.function("forward")
    texts = {"table": "stand::default_table", "x": "x"}
    texts |= {a.name: "nullptr" for a in forward.arguments if a.optional == "missing"}
    zeroed = [a for a in forward.arguments if a.direction == "in" and a.name not in texts]
    twist, freedom = _first_twist(stand, code)
    text = code.render(
        "cmake/example.cpp.j2",
        namespace=namespace(stand),
        flywheel=stand.flywheels[0].name if stand.flywheels else "",
        home=_home_pose(stand, generated, code),
        held=stand.hold is not None,
        sums=any(f.name == "momentum" for f in code.public),
        twist=twist,
        freedom=freedom,
        declarations=[(f"{_variable_type(a, code.names, 'stand::')} {a.name}", a.unit) for a in zeroed],
        results=[
            f"{_variable_type(a, code.names, 'stand::')} {a.name}" for a in forward.arguments if a.direction == "out"
        ],
        call=f"stand::forward({', '.join(texts.get(a.name, a.name) for a in forward.arguments)})",
    )
    return {"example.cpp": text}


def _first_twist(stand: Stand, code: Code) -> tuple[str, str]:
    """V of a held carrier at u = 1 of its first freedom, as C++ lists it, and that freedom; empty without one."""
    if stand.hold is None or not stand.hold.freedoms:
        return "", ""
    column = twists(stand.hold)[:, 0].tolist()
    return ", ".join(code.real(x) if x else "0" for x in column), freedom_labels(stand.hold)[0]


def _home_pose(stand: Stand, generated: Generated, code: Code) -> list[tuple[str, str]]:
    """Members of a state and their values in C++ in the home pose of a held carrier; empty where a State begins so."""
    if stand.hold is None:
        return []
    home_pose: list[tuple[str, Sequence[float]]] = (
        [("position", stand.hold.position)] if any(stand.hold.position) else []
    )
    if any(stand.hold.angles):
        run = generated.values.interpreter.run
        home_pose.append(("attitude", run("quaternion", {"angles": stand.hold.angles})[1]["attitude"]))
    return [(name, ", ".join(map(code.real, values))) for name, values in home_pose]
