"""Results of internal functions that never overlap another argument in any call: C may call them `restrict`.

Without that promise a compiler must assume that writing one result changes every input, and loads them all again.
It is proved here from the calls, not assumed. Public functions promise nothing to the compiler; that their arguments
lie apart is their contract with the user, so what they pass on lies apart as well. Results marked `overlaps` are the
exception.
"""

from __future__ import annotations

from collections.abc import Iterator

from mahovik.core.program.call import Argument, Call
from mahovik.core.program.expression import Const, Expr, Place
from mahovik.core.program.function import Function, Program
from mahovik.core.program.walk import expressions


def restrictable(program: Program) -> frozenset[tuple[str, str]]:
    """(function, argument) of all results of internal functions that lie apart from the function's other arguments."""
    internal = [f for f in program.functions if not f.public]
    candidates = {(f.name, a.name) for f in internal for a in f.arguments if a.direction != "in"}
    for caller in reversed(program.functions):  # each comes after all that call it
        for call in _calls(caller):
            for result in _overlapping(caller, call, candidates):
                candidates.discard((call.signature.name, result))
    return frozenset(candidates)


def _calls(function: Function) -> Iterator[Call]:
    return (e for e in expressions(function.body) if isinstance(e, Call))


def _overlapping(caller: Function, call: Call, candidates: set[tuple[str, str]]) -> Iterator[str]:
    """Results of a call that may overlap another of its arguments."""
    passed = list(call.pairs)
    for parameter, value in passed:
        if parameter.direction == "in" or not isinstance(value, Place):
            continue
        places = [v for p, v in passed if p is not parameter and isinstance(v, Place) and _by_address(p)]
        if any(_may_overlap(caller, value, other, candidates) for other in places):
            yield parameter.name


def _by_address(parameter: Argument) -> bool:
    """Arrays, structs and results; of a scalar that is read the function gets a copy."""
    return bool(parameter.shape) or parameter.variable.pointer


def _may_overlap(caller: Function, one: Place, two: Place, result: set[tuple[str, str]]) -> bool:
    if one.root is two.root:
        return not _disjoint(one.path, two.path)
    arguments = {id(a.variable): a for a in caller.arguments}
    if id(one.root) not in arguments or id(two.root) not in arguments:
        return False
    if caller.public:
        return any(arguments[id(place.root)].overlaps for place in (one, two))
    return not any((caller.name, place.root.name) in result for place in (one, two))


def _disjoint(one: tuple[str | Expr, ...], two: tuple[str | Expr, ...]) -> bool:
    """Do two paths from the same root part at a member or at a constant index?"""
    for a, b in zip(one, two, strict=False):
        if isinstance(a, str) and isinstance(b, str):
            if a != b:
                return True
        elif isinstance(a, Const) and isinstance(b, Const):
            if a.value != b.value:
                return True
        elif a is not b:
            return False
    return False
