"""Rebuilds expressions and statements with other variables: what every pass over a program needs."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping

from mahovik.core.program.call import Call
from mahovik.core.program.expression import Binary, Choice, Expr, Logic, Negate, Place, Select, Variable
from mahovik.core.program.types import Kind

Leaf = Callable[[Place], Expr]


def rebuilt(e: Expr, leaf: Leaf, call: Callable[[Call], Expr] | None = None) -> Expr:
    """The same tree with `leaf` of every place (its indices done already), and with `call` of every call."""

    def again(inner: Expr) -> Expr:
        return rebuilt(inner, leaf, call)

    if isinstance(e, Place):
        steps = tuple(again(step) if isinstance(step, Expr) else step for step in e.path)
        return leaf(Place(e.root, steps, e.type, e.shape))
    found = e.with_operands(again)
    return call(found) if call is not None and isinstance(found, Call) else found


def without_branches(e: Expr) -> Expr:
    """The same value where both sides of `&&`, `||` and of a choice of reals are computed: no loop has a branch."""
    if isinstance(e, Logic):
        return Binary(e.operator[0], without_branches(e.left), without_branches(e.right))
    if isinstance(e, Select) and e.kind is Kind.REAL and not _is_magnitude(e):
        return Choice(without_branches(e.condition), without_branches(e.yes), without_branches(e.no))
    return e.with_operands(without_branches)


def _is_magnitude(e: Select) -> bool:
    """Is a choice one between an element of an array and its negative, of which compilers make no branch?"""
    number = e.yes.operand if isinstance(e.yes, Negate) else None
    if not isinstance(number, Place) or not isinstance(e.no, Place):
        return False
    return bool(number.path) and number.root is e.no.root and repr(number) == repr(e.no)


def substitution(meanings: Mapping[int, Expr]) -> Leaf:
    """Replace the root of a place by its meaning (by `id` of the variable), keep the path; other places stay."""

    def leaf(place: Place) -> Expr:
        meant = meanings.get(id(place.root))
        if meant is None:
            return place
        if isinstance(meant, Place):
            return Place(meant.root, (*meant.path, *place.path), place.type, place.shape)
        assert not place.path
        return meant

    return leaf


class FreshNames:
    """Names that no other variable of a function has."""

    def __init__(self, taken: Iterable[str]) -> None:
        self._taken = set(taken)

    def __call__(self, wish: str) -> str:
        """`wish` itself, or with the least number that makes it new, in place of the number that it has."""
        name, number = wish, 1
        stem = re.sub(r"_\d+$", "", wish)
        while name in self._taken:
            number += 1
            name = f"{stem}_{number}"
        self._taken.add(name)
        return name

    def copy(self) -> FreshNames:
        """The same names taken; what is taken of the copy is not taken here."""
        return FreshNames(self._taken)

    def like(self, variable: Variable) -> Variable:
        """A variable of the same type under a name of its own."""
        return Variable(
            self(variable.name), variable.type, variable.shape, pointer=variable.pointer, written=variable.written
        )
