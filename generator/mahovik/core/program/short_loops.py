"""Removes loops of no turn, and prints those of one turn as what they do: matrices of one row need none.

Lowering code loops over the rows of a matrix. Of a carrier with one freedom these loops would count from 0 to 0 or run
once, which a reader has to work out and MISRA C rejects as dead code (rule 2.2). Operations and their order stay.
"""

from __future__ import annotations

from dataclasses import replace

from mahovik.core.program.call import Call
from mahovik.core.program.expression import Binary, Const, Expr, Place, Select, Variable
from mahovik.core.program.function import Function
from mahovik.core.program.rewrite import FreshNames, rebuilt, substitution
from mahovik.core.program.statement import Copy, Declare, Do, Let, Loop, Note, Return, Set, Statement, Statements, When
from mahovik.core.program.types import Kind
from mahovik.core.program.walk import statements, with_blocks

Meanings = dict[int, Expr]


def without_short_loops(function: Function) -> Function:
    """The function without loops whose literal bounds leave none or one turn; itself if it has none."""
    loops = [s for s in statements(function.body) if isinstance(s, Loop)]
    if not any(_turns(loop.start, loop.stop) in (0, 1) for loop in loops):
        return function
    return replace(function, body=_Rewriter(function).block(function.body, {}))


def _turns(start: Expr, stop: Expr) -> int | None:
    """Number of turns between literal bounds, or None."""
    first, last = _literal(start), _literal(stop)
    return None if first is None or last is None else max(last - first, 0)


def _literal(e: Expr) -> int | None:
    """Value of an integer expression of literals. A named constant is none: its loop is over what has that name."""
    if isinstance(e, Const) and e.kind is Kind.INT and not e.name:
        return int(e.value)
    if isinstance(e, Binary) and e.kind is Kind.INT and e.operator in "+-":
        left, right = _literal(e.left), _literal(e.right)
        if left is not None and right is not None:
            return left + right if e.operator == "+" else left - right
    return None


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
                number = _literal(new)
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
        turns, first = _turns(start, stop), _literal(start)
        if turns == 0:
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
    """The expression with the meanings of its variables, and with indices of literals as one literal."""
    substituted = substitution(meanings)

    def leaf(place: Place) -> Expr:
        path = tuple(_fold(step) if isinstance(step, Expr) else step for step in place.path)
        return substituted(Place(place.root, path, place.type, place.shape))

    return _without_idle_choices(rebuilt(e, leaf))


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


def _fold(e: Expr) -> Expr:
    number = _literal(e)
    return e if number is None else Const(number, Kind.INT)


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
        elif (number := _literal(one)) is None or number != _literal(two):
            return False
    return True
