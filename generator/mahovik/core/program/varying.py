"""Variables of a function that differ between states side by side (vary), or are the same for all."""

from __future__ import annotations

from collections.abc import Iterable

from mahovik.core.program.call import Call
from mahovik.core.program.expression import Expr, Place, Variable
from mahovik.core.program.function import Function
from mahovik.core.program.statement import Copy, Do, Let, Set, Statements, When
from mahovik.core.program.types import Kind
from mahovik.core.program.walk import blocks, inside


class Varying:
    """The varying variables of one function, from its varying arguments. Results vary always."""

    def __init__(self, function: Function, arguments: Iterable[str]) -> None:
        names = set(arguments)
        self._found = {id(a.variable) for a in function.arguments if a.name in names or a.direction != "in"}
        while self._spread(function.body, False):
            pass

    def variable(self, identity: int) -> bool:
        """Does the variable with that `id` vary?"""
        return identity in self._found

    def add(self, variable: Variable) -> None:
        """One more varying variable."""
        self._found.add(id(variable))

    def expression(self, e: Expr) -> bool:
        """Does an expression vary? Ints never do: they are the table's, of the structure."""
        return any(isinstance(x, Place) and self.place(x) for x in inside(e))

    def place(self, place: Place) -> bool:
        """Does a place, whole or scalar, vary?"""
        return id(place.root) in self._found and place.type is not Kind.INT

    def arguments(self, call: Call) -> frozenset[str]:
        """Names of the parameters of a call that get something that varies, results included."""
        return frozenset(p.name for p, value in call.pairs if p.direction != "in" or self.expression(value))

    def _mark(self, place: Expr) -> bool:
        assert isinstance(place, Place)
        if id(place.root) in self._found:
            return False
        self._found.add(id(place.root))
        return True

    def _spread(self, body: Statements, condition: bool) -> bool:
        """One pass over a body; `condition`: it is done by some states only. True where something new was found."""
        new = False
        for s in body:
            match s:
                case Let(variable, value) if condition or self.expression(value):
                    new |= self._mark(variable.place)
                case Set(place, value) if condition or self.expression(value):
                    new |= self._mark(place)
                case Copy(target, source) if condition or self.expression(source):
                    new |= self._mark(target)
                case Do(call):
                    for parameter, value in call.pairs:
                        if parameter.direction != "in":
                            new |= self._mark(value)
            now = condition or (isinstance(s, When) and self.expression(s.condition))
            for inner in blocks(s):
                new |= self._spread(inner, now)
        return new
