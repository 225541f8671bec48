"""`<stand>.hpp`: the functions of `<stand>.h` for C++17, with std::array, references and an enum class."""

from __future__ import annotations

from dataclasses import dataclass

from mahovik import __version__
from mahovik.contract.status import BITS, REFUSALS
from mahovik.core.emit.declaration import contract
from mahovik.core.emit.generate import Generated, internal
from mahovik.core.emit.layout import hanging, wrapped
from mahovik.core.emit.names import Names
from mahovik.core.emit.status import statuses
from mahovik.core.emit.templates import template
from mahovik.core.program.call import Argument
from mahovik.core.program.function import Function, Program
from mahovik.core.program.types import Kind, NamedCount, Struct
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand

_NO_NAMESPACE = frozenset(("std", "linux", "unix", "i386"))
"""Names of stands that cannot be namespaces inside `mahovik`: they would hide std, or are macros of compilers."""

_TABLES = {
    "default_table": ("default", "Table"),
    "default_parameters": ("default_parameters", "Parameters"),
    "default_options": ("default_options", "InverseOptions"),
}
"""Constant tables of the C: name in C++, name in C without prefix, type."""


@dataclass(frozen=True)
class _Printed:
    """A function of the header: comment and inline definition, line by line."""

    comment: list[str]
    lines: list[str]


def cpp_header(stand: Stand, generated: Generated) -> dict[str, str]:
    """The C++17 header of generated C, by its file name."""
    program = generated.program
    names = Names(program.name)
    found = identities(stand)
    absent = "default_options" if generated.values.options is None else ""
    text = template("stand.hpp.j2").render(
        name=stand.name,
        NAME=stand.name.upper(),
        namespace=namespace(stand),
        version=__version__,
        structure=found.structure,
        physics=found.physics,
        real=program.precision.name,
        flywheels=bool(generated.layout.flywheels),
        ints=any(a.shape and _kind(a, names) == "int" for f in program.functions if f.public for a in f.arguments),
        statuses=[(c.removeprefix(names.constant("")), *more) for c, *more in statuses(names, generated.layout)],
        refusals=REFUSALS,
        bits=BITS,
        counts=[(_count(c), names.constant(c.name), c.comment) for c in program.counts],
        structs=[
            (_struct(s), names.type(s), s.purpose)
            for s in program.structs
            if not internal(generated.layout, s) and s.name != "state"
        ],
        tables=[(name, of, names.function(c)) for name, (c, of) in _TABLES.items() if name != absent],
        functions=[_function(f, names, program) for f in program.functions if f.public],
        members=[(f.name, "; ".join(p for p in (f.unit, f.comment) if p)) for f in generated.layout.state.fields],
    )
    return {f"{stand.name}.hpp": text}


def namespace(stand: Stand) -> str:
    """The namespace of a stand inside `mahovik`: its name, with an underscore where C++ would not have it."""
    return f"{stand.name}_" if stand.name in _NO_NAMESPACE else stand.name


def _function(f: Function, names: Names, program: Program) -> _Printed:
    """An inline function that only passes on: no copy, no exception."""
    result = "Status" if f.returns is Kind.STATUS else "Real"
    head = hanging(f"inline {result} {f.name}(", [_taken(a, names) for a in f.arguments], " noexcept")
    call = f"{names.function(f.name)}({', '.join(_passed(a) for a in f.arguments)})"
    returned = f"return status_of({call});" if f.returns is Kind.STATUS else f"return {call};"
    lines = [*head, "{", *wrapped(returned, "    "), "}"]
    return _Printed(contract(f, names, program), lines)


def _taken(a: Argument, names: Names) -> str:
    """An argument as C++ declares it: arrays and structs by reference, numbers by value."""
    const = "const " if a.direction == "in" else ""
    held = _held(a, names)
    if a.shape or isinstance(a.type, Struct):
        return f"{const}{held}& {a.name}"
    return f"{held} {a.name}" if a.direction == "in" else f"{held}& {a.name}"


def _held(a: Argument, names: Names, scope: str = "") -> str:
    """The type of a variable for an argument; `scope`: `stand::` where the namespace has to be named."""
    kind = _kind(a, names)
    own = scope if kind not in ("int", names.type(a.type)) else ""
    if not a.shape:
        return f"{own}{kind}"
    size = f"{scope if isinstance(a.shape[0], NamedCount) else ''}{_count(a.shape[0])}"
    array = {"Real": "Reals", "int": "Ints"}.get(kind)
    return f"{scope}{array}<{size}>" if array else f"std::array<{own}{kind}, {size}>"


def _kind(a: Argument, names: Names) -> str:
    """The type of an argument, of an array that of its elements. A state is the C's, so that either can be given."""
    if isinstance(a.type, Struct):
        return names.type(a.type) if a.type.name == "state" else _struct(a.type)
    return "int" if a.type in (Kind.INT, Kind.BOOL) else "Real"


def _passed(a: Argument) -> str:
    """The same argument as the C takes it."""
    if a.shape:
        return f"{a.name}.data()"
    return f"&{a.name}" if a.variable.pointer else a.name


def _count(size: int | NamedCount) -> str:
    """A length: a number, or its constant in the namespace."""
    return size.name if isinstance(size, NamedCount) else str(size)


def _struct(struct: Struct) -> str:
    """InverseOptions of inverse_options."""
    return "".join(part.capitalize() for part in struct.name.split("_"))


def cpp_example(stand: Stand, generated: Generated) -> dict[str, str]:
    """A whole program in C++17 that calls `forward`, by its file name."""
    names = Names(generated.program.name)
    forward = generated.program.function("forward")
    given = {"table": "stand::default_table", "x": "x"}
    zeroed = [a for a in forward.arguments if a.direction == "in" and a.name not in given]
    text = template("cmake/example.cpp.j2").render(
        name=stand.name,
        namespace=namespace(stand),
        generator=f"mahovik {__version__}",
        structure=identities(stand).structure,
        physics=identities(stand).physics,
        flywheel=stand.flywheels[0].name if stand.flywheels else "",
        declarations=[
            f"const {_held(a, names, 'stand::')} {a.name}{{}};" + (f"  // {a.unit}" if a.unit else "") for a in zeroed
        ],
        call=f"stand::forward({', '.join(given.get(a.name, a.name) for a in forward.arguments)})",
    )
    return {"example.cpp": text}
