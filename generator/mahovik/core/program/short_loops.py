"""Removes loops of no turn, and prints those of one turn as what they do: matrices of one row need none.

Lowering code loops over the rows of a matrix. Of one freedom, flywheel or row of a task these loops would count from 0
to 0 or run once, which a reader has to work out and MISRA C rejects as dead code (rule 2.2). Operations and their order
stay.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from mahovik.core.program.call import Call
from mahovik.core.program.expression import Binary, Const, Expr, Place, Select, Variable, literal
from mahovik.core.program.function import Function
from mahovik.core.program.rewrite import FreshNames, rebuilt, substitution
from mahovik.core.program.statement import Copy, Declare, Do, Let, Loop, Note, Return, Set, Statement, Statements, When
from mahovik.core.program.types import Kind
from mahovik.core.program.walk import blocks, statements, with_blocks

Meanings = dict[int, Expr]


def without_short_loops(function: Function) -> Function:
    """The function without loops of no turn, nor of one turn between literal bounds; itself if it has none."""
    loops = [s for s in statements(function.body) if isinstance(s, Loop)]
    if not any(loops_of_no_turn(function.body)) and all(_turns(loop.start, loop.stop) != 1 for loop in loops):
        return function
    return replace(function, body=_Rewriter(function).block(function.body, {}))


def loops_of_no_turn(body: Statements) -> Iterator[Loop]:
    """Outermost loops whose bounds leave no turn, whatever the indices of the loops around them are."""
    return _loops_of_no_turn(body, {})


def _loops_of_no_turn(body: Statements, ranges: dict[int, tuple[int, int]]) -> Iterator[Loop]:
    """`ranges`: least and largest value of variables, by their `id`."""
    for s in body:
        if isinstance(s, Let) and (among := _range(s.value, ranges)):
            ranges[id(s.variable)] = among
        if isinstance(s, Loop):
            first, last = _range(s.start, ranges), _range(s.stop, ranges)
            if first and last and last[1] <= first[0]:
                yield s
                continue
            if first and last:
                ranges[id(s.index)] = first[0], last[1] - 1
        for inner in blocks(s):
            yield from _loops_of_no_turn(inner, ranges)


def _range(e: Expr, ranges: dict[int, tuple[int, int]]) -> tuple[int, int] | None:
    """Least and largest value of an integer expression, or None where that is not known."""
    if isinstance(e, Const) and e.kind is Kind.INT:
        return int(e.value), int(e.value)
    if isinstance(e, Place) and not e.path:
        return ranges.get(id(e.root))
    if isinstance(e, Binary) and e.kind is Kind.INT and e.operator in "+-":
        left, right = _range(e.left, ranges), _range(e.right, ranges)
        if left and right:
            low, high = right if e.operator == "+" else (-right[1], -right[0])
            return left[0] + low, left[1] + high
    return None


def _turns(start: Expr, stop: Expr) -> int | None:
    """Number of turns between literal bounds, or None."""
    first, last = literal(start), literal(stop)
    return None if first is None or last is None else max(last - first, 0)


class _Rewriter:
    """One function while it is rewritten. `meanings`: what stands in place of variables, by their `id`."""

    def __init__(self, function: Function) -> None:
        names = [argument.name for argument in function.arguments]
        for s in statements(function.body):
            match s:
                case Let(variable) | Declare(variable) | Loop(variable):
                    names.append(variable.name)
        self._shared = {name for name in names if names.count(name) > 1}
        self._fresh = FreshNames(names)
        self._idle = {id(loop) for loop in loops_of_no_turn(function.body)}

    def block(self, body: Statements, meanings: Meanings, moved: bool = False) -> Statements:
        """The statements without short loops; a note before a loop that is gone goes with it.

        `moved`: the block becomes a part of another, where its locals need names of their own.
        """
        kept: list[Statement] = []
        for s in body:
            found = self._statement(s, meanings, moved)
            if not found and isinstance(s, Loop) and kept and isinstance(kept[-1], Note):
                kept.pop()
            for new in found:
                if kept and _is_overwritten(kept[-1], new):
                    kept.pop()
                kept.append(new)
        return tuple(kept)

    def _statement(self, s: Statement, meanings: Meanings, moved: bool) -> Statements:
        match s:
            case Let(variable, value):
                new = _expr(value, meanings)
                number = literal(new)
                if number is not None:
                    meanings[id(variable)] = Const(number, Kind.INT)
                    return ()
                return (replace(s, variable=self._rename(variable, meanings, moved), value=new),)
            case Declare(variable):
                return (replace(s, variable=self._rename(variable, meanings, moved)),)
            case Set(place, value):
                return (replace(s, place=_place(place, meanings), value=_expr(value, meanings)),)
            case Copy(target, source):
                return (replace(s, target=_place(target, meanings), source=_place(source, meanings)),)
            case Do(called):
                new = _expr(called, meanings)
                assert isinstance(new, Call)
                return (replace(s, call=new),)
            case Return(value):
                return (Return(_expr(value, meanings)),)
            case When(condition):
                within = with_blocks(s, lambda inner: self.block(inner, meanings))
                assert isinstance(within, When)
                return (replace(within, condition=_expr(condition, meanings)),)
            case Loop():
                return self._loop(s, meanings)
        return (with_blocks(s, lambda inner: self.block(inner, meanings)),)

    def _loop(self, s: Loop, meanings: Meanings) -> Statements:
        start, stop = _expr(s.start, meanings), _expr(s.stop, meanings)
        turns, first = _turns(start, stop), literal(start)
        if id(s) in self._idle:
            return ()
        if turns == 1 and first is not None:
            meanings[id(s.index)] = Const(first, Kind.INT)
            said = (Note(s.comment),) if s.comment else ()
            inside = self.block(s.body, meanings, moved=True)
            return (*said, *inside) if inside else ()
        inner = self.block(s.body, meanings)
        return (replace(s, start=start, stop=stop, body=inner),) if inner else ()

    def _rename(self, variable: Variable, meanings: Meanings, moved: bool) -> Variable:
        if not moved or variable.name not in self._shared:
            return variable
        new = self._fresh.like(variable)
        meanings[id(variable)] = new.place
        return new


def _expr(e: Expr, meanings: Meanings) -> Expr:
    """The expression with the meanings of its variables."""
    return _without_idle_choices(rebuilt(e, substitution(meanings)))


def _without_idle_choices(e: Expr) -> Expr:
    """The expression without choices between a place and the same place."""
    new = e.with_operands(_without_idle_choices)
    if isinstance(new, Select) and isinstance(new.yes, Place) and isinstance(new.no, Place):
        return new.yes if _are_same(new.yes, new.no) else new
    return new


def _place(place: Place, meanings: Meanings) -> Place:
    found = _expr(place, meanings)
    assert isinstance(found, Place)
    return found


def _is_overwritten(s: Statement, later: Statement) -> bool:
    """Does the next statement give another value to what this one sets to a literal?"""
    if not (isinstance(s, Set) and isinstance(later, Set)) or s.add or later.add:
        return False
    return isinstance(s.value, Const) and isinstance(later.value, Const) and _are_same(s.place, later.place)


def _are_same(a: Place, b: Place) -> bool:
    if a.root is not b.root or len(a.path) != len(b.path):
        return False
    for one, two in zip(a.path, b.path, strict=True):
        if isinstance(one, str) or isinstance(two, str):
            if one != two:
                return False
        elif (number := literal(one)) is None or number != literal(two):
            return False
    return True
