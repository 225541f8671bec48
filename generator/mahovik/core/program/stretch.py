"""Straight stretches of code become loops over lanes.

A variable that one stretch alone uses stays a scalar inside its loop, where it is a register; one that several use, or
that is passed to a function, gets an array of lanes. What is the same in all lanes is computed once, before the loop.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace

from mahovik.core.program.call import Call
from mahovik.core.program.expression import Expr, Place, Variable
from mahovik.core.program.function import Function
from mahovik.core.program.late import late
from mahovik.core.program.rewrite import FreshNames, rebuilt, without_branches
from mahovik.core.program.statement import Copy, Declare, Do, Let, Loop, Note, Set, Statement, When
from mahovik.core.program.types import Kind
from mahovik.core.program.varying import Varying
from mahovik.core.program.walk import used_variables
from mahovik.core.program.wide import Wide, lane_bounds

LANE = "k"
"""Index of the lanes."""


@dataclass(eq=False)
class _Stretch:
    """Statements for every lane, those that are the same for all and come before them, and notes that come after."""

    before: list[Statement] = field(default_factory=list)
    lanes: list[Statement] = field(default_factory=list)
    after: list[Statement] = field(default_factory=list)


@dataclass(eq=False)
class _Nested:
    """A loop, a condition that is the same for all, a call or a copy, with the stretches inside."""

    statement: Statement
    body: list[_Item] = field(default_factory=list)
    otherwise: list[_Item] = field(default_factory=list)


_Item = _Stretch | _Nested


class Stretches:
    """The body of one function in lanes."""

    def __init__(
        self,
        wide: Wide,
        varying: Varying,
        arguments: dict[int, Variable],
        callee: Callable[[Call], Function],
        fresh: FreshNames,
    ) -> None:
        """`arguments`: wide forms of the arguments by `id`; `callee`: the wide form of a function that is called."""
        self._fresh = fresh
        self._wide = wide
        self._varying = varying
        self._variables = dict(arguments)
        self._callee = callee
        self._users: dict[int, set[int]] = {}
        self._waiting: dict[int, list[Variable]] = {}

    def body(self, body: tuple[Statement, ...]) -> tuple[Statement, ...]:
        """Statements without conditions that vary, in lanes."""
        items = self._split(body)
        self._count(items)
        return tuple(self._join_lanes(items))

    # -- cutting -------------------------------------------------------------------------------------------------------

    def _split(self, body: tuple[Statement, ...]) -> list[_Item]:
        items: list[_Item] = []
        stretch = _Stretch()
        for s in body:
            if self._into(s, stretch):
                continue
            while stretch.lanes and isinstance(stretch.lanes[-1], Note):
                stretch.after.insert(0, stretch.lanes.pop())
            items.append(stretch)
            stretch = _Stretch()
            match s:
                case Loop():
                    items.append(_Nested(s, self._split(s.body)))
                case When():
                    items.append(_Nested(s, self._split(s.body), self._split(s.otherwise)))
                case _:
                    items.append(_Nested(s))
        return [*items, stretch]

    def _into(self, s: Statement, stretch: _Stretch) -> bool:
        """Adds a statement to a stretch; False where it ends the stretch."""
        match s:
            case Note():
                stretch.lanes.append(s)
            case Let(variable) | Declare(variable) if not self._varying.variable(id(variable)):
                stretch.before.append(s)
            case Let() | Declare():
                stretch.lanes.append(s)
            case Set(place, value) if self._varying.place(place) or self._varying.expression(value):
                stretch.lanes.append(s)
            case Set(place) if id(place.root) not in used_variables(stretch.lanes):
                stretch.before.append(s)
            case _:
                return False
        return True

    def _count(self, items: list[_Item]) -> None:
        """Record the stretches, calls and copies that use each variable."""
        for item in items:
            if isinstance(item, _Stretch):
                self._use(
                    id(item), used_variables(item.lanes) | {id(s.variable) for s in item.lanes if isinstance(s, Let)}
                )
            elif isinstance(item.statement, Do | Copy):
                self._use(id(item), used_variables([item.statement]))
                self._use(0, used_variables([item.statement]))  # a second user: what is passed on needs all its lanes
            else:
                self._count(item.body)
                self._count(item.otherwise)

    def _use(self, user: int, variables: set[int]) -> None:
        for identity in variables:
            self._users.setdefault(identity, set()).add(user)

    # -- joining -------------------------------------------------------------------------------------------------------

    def _join_lanes(self, items: list[_Item]) -> Iterator[Statement]:
        """Statements in lanes."""
        for item in items:
            if isinstance(item, _Stretch):
                yield from self._loop(item)
            else:
                yield self._widen_block(item)

    def _loop(self, stretch: _Stretch) -> Iterator[Statement]:
        """A stretch as a loop over lanes, after what is the same for all and the arrays that it needs."""
        yield from (self._uniform(s) for s in stretch.before)
        index = Variable(LANE, Kind.INT)
        outer: list[Statement] = []
        inner: list[Statement] = [Declare(v) for v in self._waiting.pop(id(stretch), [])]
        for s in stretch.lanes:
            match s:
                case Declare(variable):
                    users = self._users.get(id(variable), set())
                    if users == {id(stretch)}:
                        inner.append(s)
                    elif len(users) == 1:
                        self._waiting.setdefault(next(iter(users)), []).append(variable)
                    elif users:
                        outer.append(replace(s, variable=self._widen_variable(variable)))
                case Let(variable, value) if len(self._users[id(variable)]) > 1:
                    outer.append(Declare(self._widen_variable(variable), s.comment))
                    inner.append(Set(self._place(variable.place, index.place), self._expr(value, index.place)))
                case Let(_, value):
                    inner.append(replace(s, value=self._expr(value, index.place)))
                case Set(place, value):
                    new = self._place(place, index.place)
                    inner.append(replace(s, place=new, value=self._expr(value, index.place)))
                case _:
                    inner.append(s)
        yield from outer
        if all(isinstance(s, Note) for s in inner):
            yield from inner
        else:
            first, last = lane_bounds(self._wide)
            yield Loop(index, first, last, late(inner, index, self._fresh))
        yield from stretch.after

    def _widen_variable(self, variable: Variable) -> Variable:
        self._variables[id(variable)] = self._wide.variable(variable)
        return self._variables[id(variable)]

    def _uniform(self, s: Statement) -> Statement:
        """A statement that is the same for all lanes."""
        match s:
            case Let(_, value):
                return replace(s, value=self._expr(value, None))
            case Set(place, value):
                return replace(s, place=self._place(place, None), value=self._expr(value, None))
        return s

    def _widen_block(self, item: _Nested) -> Statement:
        s = item.statement
        match s:
            case Loop():
                start, stop = self._expr(s.start, None), self._expr(s.stop, None)
                return replace(s, start=start, stop=stop, body=tuple(self._join_lanes(item.body)))
            case When():
                yes, no = tuple(self._join_lanes(item.body)), tuple(self._join_lanes(item.otherwise))
                return replace(s, condition=self._expr(s.condition, None), body=yes, otherwise=no)
            case Copy(target, source):
                return replace(s, target=self._place(target, None), source=self._place(source, None))
            case Do(call):
                passed = tuple(self._expr(a, None) for a in call.arguments)
                return replace(s, call=Call(self._callee(call).signature, passed))
        return self._uniform(s)

    def _expr(self, e: Expr, lane: Place | None) -> Expr:
        found = rebuilt(e, lambda place: self._leaf(place, lane))
        return found if lane is None else without_branches(found)

    def _place(self, place: Place, lane: Place | None) -> Place:
        found = self._expr(place, lane)
        assert isinstance(found, Place)
        return found

    def _leaf(self, place: Place, lane: Place | None) -> Place:
        wide = self._variables.get(id(place.root))
        if wide is None or wide is place.root:
            return place
        return self._wide.place(place, wide, lane)
