"""Structs, prototypes and their comments: the contract a firmware engineer reads."""

from __future__ import annotations

from collections.abc import Iterable

from mahovik.core.emit.layout import WIDTH, comment_lines, filled, hanging, paragraph, wrap_statement
from mahovik.core.emit.names import Names, member
from mahovik.core.program.call import Argument
from mahovik.core.program.cost import cost, stack_bound
from mahovik.core.program.function import Function, Program
from mahovik.core.program.types import Struct


def struct_lines(struct: Struct, names: Names) -> list[str]:
    """A struct definition with one comment per member."""
    head = [*comment_lines(struct.purpose), f"typedef struct {names.type(struct)} {{"]
    comments = ["; ".join(part for part in (f.unit, f.comment) if part) for f in struct.fields]
    declarations = [f"{names.declaration(member(f.name), f.type, f.shape)};" for f in struct.fields]
    width = max(len(d) for d in declarations)
    lines: list[str] = []
    for number, (declaration, comment, f) in enumerate(zip(declarations, comments, struct.fields, strict=True)):
        if not comment:
            if number and not comments[number - 1] and struct.fields[number - 1].type == f.type:
                lines[-1] = f"{lines[-1][:-1]}, {member(f.name)}{names.lengths(f.shape)};"
            else:
                lines.append(f"    {declaration}")
            continue
        lead = f"    {declaration:<{width}}  "
        lines += comment_lines(comment, lead, " " * len(lead))
    return [*head, *lines, f"}} {names.type(struct)};"]


def prototype(function: Function, names: Names, restrictable: frozenset[tuple[str, str]] = frozenset()) -> str:
    """Storage, return type, name and arguments, wrapped under the opening parenthesis.

    `restrictable`: (function, argument) of results that overlap no other argument; C calls them `restrict`.
    """
    head, arguments = _head(function, names, restrictable)
    return "\n".join(hanging(head, arguments))


def definition(function: Function, names: Names, restrictable: frozenset[tuple[str, str]]) -> str:
    """The same where a function is defined: after its attributes for sections, arguments on lines of their own."""
    head, arguments = _head(function, names, restrictable)
    head = f"{names.constant('CODE')} {names.constant('APART') + ' ' if function.apart else ''}{head}"
    whole = f"{head}{', '.join(arguments)})"
    return whole if len(whole) <= WIDTH else "\n".join([head, *filled(arguments, "    ", ")")])


def _head(function: Function, names: Names, restrictable: frozenset[tuple[str, str]]) -> tuple[str, list[str]]:
    """A function up to the parenthesis, and its arguments."""
    storage = "" if function.public else "static "
    if not function.public and function.short:
        storage += "inline "
    elif function.copied:
        storage += f"{names.constant('COPIED')} "
    returns = names.type(function.returns) if function.returns is not None else "void"
    arguments = [_argument(a, names, (function.name, a.name) in restrictable) for a in function.arguments] or ["void"]
    return f"{storage}{returns} {names.function(function.name)}(", arguments


def _argument(a: Argument, names: Names, restrictable: bool) -> str:
    const = "const " if a.direction == "in" and (a.shape or isinstance(a.type, Struct)) else ""
    sizes = names.lengths(a.shape)
    if restrictable and sizes:
        rest = names.lengths(a.shape[1:])
        name = f"(*restrict {a.name}){rest}" if rest else f"*restrict {a.name}"
        return f"{names.type(a.type)} {name} /* {sizes} */"
    star = ("*restrict " if restrictable else "*") if a.variable.pointer else ""
    return f"{const}{names.type(a.type)} {star}{a.name}{sizes}"


def contract(function: Function, program: Program) -> list[str]:
    """The comment above a public prototype: purpose, equation, arguments, statuses, cost, stack."""
    lines = paragraph(f"{function.name}: {purpose_with_number(function)}", "/* ", " * ")
    width = max((len(_shape_text(a)) for a in function.arguments), default=0)
    for a in function.arguments:
        direction = {"in": "", "out": "out: ", "inout": "in and out: "}[a.direction]
        meaning = direction + "; ".join(part for part in (a.unit, a.purpose) if part)
        lead = f" *   {_shape_text(a):<{width}}  "
        lines += paragraph(meaning, lead, " *   " + " " * (width + 2))
    for note in function.notes:
        lines += paragraph(note, " * ", " * ")
    if function.statuses:
        statuses = list(function.statuses)
        if pointer_arguments(function) and "BAD_ARGUMENT" not in statuses:
            statuses.append("BAD_ARGUMENT")
        text = f"Returns {', '.join(statuses)}."
        if any(a.direction != "in" for a in function.arguments):
            text += " Nothing is written when the status is negative."
        lines += paragraph(text, " * ", " * ")
    text = f"{operation_counts(function, program)} Stack: at most {stack_bound(function, program)} bytes."
    lines += paragraph(text, " * ", " * ")
    lines[-1] += " */"
    return lines


def null_check(function: Function, names: Names) -> list[str]:
    """The first lines of a public function with a status: no pointer may be null, but for optional ones."""
    pointers = pointer_arguments(function)
    if not pointers or function.returns is None:
        return []
    condition = " || ".join(f"{a.name} == NULL" for a in pointers)
    refused = wrap_statement(f"if ({condition}) {{ return {names.constant('BAD_ARGUMENT')}; }}", "    ")
    return refused + [f"    {line}" for line in zeros_for_null(function, names)]


def zeros_for_null(function: Function, names: Names) -> list[str]:
    """Statements that put zeros in the place of arrays that are zeros where their address is null."""
    return [f"if ({a.name} == NULL) {{ {a.name} = {zeros_of(a, names)}; }}" for a in optional(function)]


def zeros_of(a: Argument, names: Names) -> str:
    """Name of the constant that stands for such an array."""
    return names.function(f"none_{a.name}")


def zeros(functions: Iterable[Function], names: Names) -> list[str]:
    """Definitions of these constants, without their value."""
    arguments = {a.name: a for f in functions for a in optional(f)}
    return [f"static const {names.declaration(zeros_of(a, names), a.type, a.shape)}" for a in arguments.values()]


def pointer_arguments(function: Function) -> list[Argument]:
    """Arguments of a public function that are addresses, and must not be null."""
    return (
        [a for a in function.arguments if (a.variable.pointer or a.shape) and not a.optional] if function.public else []
    )


def optional(function: Function) -> list[Argument]:
    """Arguments of a public function that are arrays, or null for zeros."""
    return [a for a in function.arguments if a.optional == "zeros"] if function.public else []


def summary(function: Function) -> list[str]:
    """The comment above an internal function."""
    text = purpose_with_number(function)
    if function.purpose[1:2].islower():
        text = text[0].upper() + text[1:]
    lines = paragraph(text, "/* ", " * ")
    for note in function.notes:
        lines += paragraph(note, " * ", " * ")
    lines[-1] += " */"
    return lines


def purpose_with_number(function: Function) -> str:
    """Purpose with the equation's number."""
    purpose = function.purpose.rstrip(".")
    if purpose[1:2].islower():
        purpose = purpose[0].lower() + purpose[1:]
    if function.equation:
        purpose += f", {function.equation}"
    return purpose if purpose.endswith("?") else f"{purpose}."


def operation_counts(function: Function, program: Program) -> str:
    """`1216 operations, 2 divisions.`: counts of real arithmetic by the program itself."""
    result = cost(function, program.whole)
    if not result.total:
        return "No operation on reals."
    divisions = {0: "no division", 1: "1 of them a division"}.get(
        result.divisions, f"{result.divisions} of them divisions"
    )
    noun = "operation" if result.total == 1 else "operations"
    return f"At most {result.total} {noun} on reals, {divisions}."


def _shape_text(a: Argument) -> str:
    return a.name + "".join(f"[{int(n)}]" for n in a.shape)
