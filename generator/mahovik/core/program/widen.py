"""The wide form of a function: the same operations for many states side by side, in loops that compilers vectorise.

As ISPC does it: what varies from state to state gets an array of lanes, what is the same for all stays. Straight
stretches of code become one loop over the lanes; loops over flywheels and calls stay around them. A condition that
varies becomes a choice between values. So each state gets the bits of the narrow function, whatever its neighbours do.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace

from mahovik.core.program.call import Argument, Call
from mahovik.core.program.expression import Expr, Not, Place, Variable, and_, select, unequal, word
from mahovik.core.program.function import Function
from mahovik.core.program.prune import prune
from mahovik.core.program.refusal import REFUSED
from mahovik.core.program.rewrite import FreshNames
from mahovik.core.program.statement import Copy, Declare, Do, Let, Loop, Note, Set, Statement, Statements, When
from mahovik.core.program.stretch import LANE, Stretches
from mahovik.core.program.types import Kind
from mahovik.core.program.varying import Varying
from mahovik.core.program.walk import inside, statements
from mahovik.core.program.wide import Wide

RESERVED = (LANE, "where", "any")
"""Names that locals of narrow functions must not have."""


class Widener:
    """Makes wide functions, each once for a set of varying arguments; `functions` has them after those they call."""

    def __init__(self, wide: Wide, narrow: Callable[[str], Function]) -> None:
        """`narrow`: finds a function that is called, by its name."""
        self.wide = wide
        self.narrow = narrow
        self._done: dict[tuple[str, frozenset[str]], Function] = {}

    @property
    def functions(self) -> tuple[Function, ...]:
        return tuple(self._done.values())

    def function(self, narrow: Function, varying: Iterable[str]) -> Function:
        """The wide form of a function without returns, of which those arguments vary (results do always)."""
        names = frozenset({*varying, *(a.name for a in narrow.arguments if a.direction != "in")})
        key = (narrow.name, names)
        if key not in self._done:
            made = _Widening(self, narrow, names).function()
            self._done[key] = replace(made, name=self._name(narrow.name), body=prune(made).body, apart=False)
        return self._done[key]

    def _name(self, name: str) -> str:
        """A name for a wide function; the second of a narrow one has other varying arguments."""
        taken = {f.name for f in self._done.values()}
        return FreshNames(taken)(f"{name}_wide")


class _Widening:
    """One function on its way."""

    def __init__(self, widener: Widener, narrow: Function, names: frozenset[str]) -> None:
        self._widener = widener
        self._narrow = narrow
        self._names = names
        self._varying = Varying(narrow, names)
        local = {s.variable.name for s in statements(narrow.body) if isinstance(s, Let | Declare)}
        local |= {s.index.name for s in statements(narrow.body) if isinstance(s, Loop)}
        self._fresh = FreshNames(local | {a.name for a in narrow.arguments})
        self._unset: set[int] = set()
        self._scopes: dict[int, Expr | None] = {}

    def function(self) -> Function:
        wide = self._widener.wide
        arguments: list[Argument] = []
        variables: dict[int, Variable] = {}
        for a in self._narrow.arguments:
            argument = wide.argument(a) if self._varying.variable(id(a.variable)) else a
            arguments.append(argument)
            variables[id(a.variable)] = argument.variable
        plain = self._select(self._narrow.body, None)
        body = Stretches(wide, self._varying, variables, self._calls, self._fresh).body(tuple(plain))
        return replace(self._narrow, arguments=tuple(arguments), body=body)

    def _calls(self, call: Call) -> Function:
        """The wide form of a function that is called."""
        return self._widener.function(self._widener.narrow(call.signature.name), self._varying.arguments(call))

    # -- conditions that vary become choices ---------------------------------------------------------------------------

    def _select(self, body: Statements, where: Expr | None) -> list[Statement]:
        """Statements under the condition `where` that varies, without conditions that vary."""
        found: list[Statement] = []
        for s in body:
            match s:
                case Set(place, value) if where is not None and not self._is_own(place, where):
                    new = place + value if s.add else value
                    found.append(Set(place, select(where, new, place), s.comment))
                case Set(place):
                    self._unset.discard(id(place.root))
                    found.append(s)
                case When(condition) if self._varying.expression(condition):
                    found += self._when(s, where)
                case When(condition) if where is not None and not _on_ints(condition):
                    found += self._when(s, where)
                case When() if where is None:
                    yes, no = self._select(s.body, None), self._select(s.otherwise, None)
                    found.append(replace(s, body=tuple(yes), otherwise=tuple(no)))
                case Loop() if where is None:
                    # What was declared before the loop may have a value from the turn before.
                    before, self._unset = self._unset, set()
                    found.append(replace(s, body=tuple(self._select(s.body, None))))
                    self._unset = before
                case Declare(variable):
                    if variable.written:  # its first value is every state's: none reads it before its own
                        self._unset.add(id(variable))
                    self._scopes[id(variable)] = where
                    found.append(s)
                case Let() | Note():
                    found.append(s)
                case Do(call) if where is None:
                    self._unset -= {id(a.root) for a in call.arguments if isinstance(a, Place)}
                    found.append(s)
                case Copy() if where is None:
                    found.append(s)
                case _:
                    raise TypeError(f"{self._narrow.name}: {type(s).__name__} under a condition that varies")
        return found

    def _is_own(self, place: Place, where: Expr) -> bool:
        """May all states set a variable where it has no value yet, or where only states under `where` ever read it?"""
        root = id(place.root)
        return root in self._unset or self._scopes.get(root) is where

    def _when(self, s: When, where: Expr | None) -> list[Statement]:
        """Both branches of a condition that varies."""
        if where is None and not s.otherwise and any(isinstance(x, Do) for x in s.body) and _only_refuse(s.body):
            return self._anywhere(s)
        condition = s.condition if where is None else and_(where, s.condition)
        if len(s.body) == 1 and not s.otherwise:
            return self._select(s.body, condition)
        kept = self._condition(s.condition if where is None else condition)
        found: list[Statement] = [kept, *self._select(s.body, kept.variable.place)]
        if s.otherwise:
            otherwise: Expr = Not(kept.variable.place)
            found += self._select(s.otherwise, otherwise if where is None else and_(where, otherwise))
        return found

    def _condition(self, condition: Expr) -> Let:
        kept = Let(Variable(self._fresh("where"), Kind.BOOL), condition)
        self._varying.add(kept.variable)
        return kept

    def _anywhere(self, s: When) -> list[Statement]:
        """Calls that do nothing but refuse, of every state that they have to: done for all where one state needs it."""
        flag = Variable(self._fresh("any"), Kind.WORD, written=True)
        bit = select(s.condition, word(1), word(0))
        gathered = Set(flag.place, flag.place | bit)
        body = tuple(self._select(s.body, None))
        return [Declare(flag), Set(flag.place, word(0)), gathered, When(unequal(flag.place, word(0)), body)]


def _on_ints(condition: Expr) -> bool:
    """Is a condition about ints? It may guard an index, so that its body must not be done for all states."""
    return any(isinstance(x, Place) and x.kind is Kind.INT for x in inside(condition))


def _only_refuse(body: Statements) -> bool:
    """Do statements write nothing but `refused`?"""
    for s in statements(body):
        match s:
            case Do(call):
                fine = [a.name for a in call.signature.arguments if a.direction != "in"] == [REFUSED]
            case Set(place):
                fine = place.root.name == REFUSED
            case _:
                fine = isinstance(s, Let | Declare | Note | When)
        if not fine:
            return False
    return True
