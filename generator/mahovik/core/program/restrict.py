"""A part of a program: some of its public functions, and what they need."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

from mahovik.core.program.function import Function, Program
from mahovik.core.program.statement import Declare
from mahovik.core.program.types import Struct
from mahovik.core.program.walk import reachable, statements


def restrict_program(program: Program, names: Collection[str], kept: Collection[str]) -> Program:
    """The program with the public functions `names`, and those that they call; structs of `kept` stay as well."""
    functions = reachable(tuple(f if f.name in names else replace(f, public=False) for f in program.functions))
    found = {struct for f in functions for struct in _used_structs(f)}
    found |= {held for struct in program.structs if struct.name in kept for held in struct.inner_structs()}
    return replace(program, functions=functions, structs=tuple(s for s in program.structs if s in found))


def _used_structs(f: Function) -> set[Struct]:
    """Struct types of arguments and locals, with those that they hold."""
    types = [a.type for a in f.arguments]
    types += [s.variable.type for s in statements(f.body) if isinstance(s, Declare)]
    return {held for type_ in types if isinstance(type_, Struct) for held in type_.inner_structs()}
