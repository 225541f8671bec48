"""Rebuilds expressions and statements with other variables: what every pass over a program needs."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping

from mahovik.core.program.call import Call
from mahovik.core.program.expression import Binary, Expr, Logic, Place, Variable

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


def unbranched(e: Expr) -> Expr:
    """The same value where `&&` and `||` become `&` and `|`: both sides are computed, so a loop has no branch."""
    if isinstance(e, Logic):
        return Binary(e.operator[0], unbranched(e.left), unbranched(e.right))
    return e.with_operands(unbranched)


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
