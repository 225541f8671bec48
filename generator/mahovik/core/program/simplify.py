"""Takes out of a program what it does not need, operations and their order stay.

* `prune`: locals that are only written, and calls that only write such; a structure without some kind of wrench leaves
  them, and C compilers would warn.
* `without_short_loops`: loops of no turn; of one turn what it does. Of one freedom, flywheel or row of a task loops
  over the rows of a matrix would count from 0 to 0 or run once, which a reader has to work out and MISRA C rejects as
  dead code (rule 2.2).
* `without_idle_calls`: calls of functions that do nothing but return OK.
* `restrict_program`: functions that nobody asked for.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace

from mahovik.core.program.call import Call
from mahovik.core.program.expression import Binary, Const, Expr, Place, Select, Status, Variable, literal
from mahovik.core.program.function import Function, Program
from mahovik.core.program.statement import Declare, Do, Let, Loop, Note, Return, Set, Statement, Statements, When
from mahovik.core.program.types import Kind
from mahovik.core.program.walk import (
    FreshNames,
    are_same,
    blocks,
    direct_expressions,
    expressions,
    inside,
    map_expressions,
    reachable,
    rebuilt,
    statements,
    substitution,
    used_structs,
    used_variables,
    with_blocks,
)

Meanings = dict[int, Expr]
Range = tuple[int, int]
"""Least and largest value of an integer."""


def prune(function: Function) -> Function:
    """The function without dead locals and without arguments that it has no use for."""
    body = function.body
    while True:
        alive = {id(p.root) for p in _used_places(body)} | {id(a.variable) for a in function.arguments}
        shorter = _pruned(body, alive, alive | _written_by_calls(body, alive))
        if len(list(statements(shorter))) == len(list(statements(body))):
            break
        body = shorter
    used = {id(e.root) for e in expressions(body) if isinstance(e, Place)}
    kept = tuple(a for a in function.arguments if id(a.variable) in used)
    names = function.parameters or tuple(a.name for a in function.arguments)
    return replace(function, arguments=kept, body=body, parameters=names)


def _used_places(body: Statements) -> Iterator[Place]:
    """Places whose value is used: all but targets of Set and output arguments of calls that are statements."""
    for s in body:
        match s:
            case Set(place, value):
                yield from _places(value)
                yield from (p for step in place.path if isinstance(step, Expr) for p in _places(step))
            case Do(call):
                for parameter, value in call.pairs:
                    whole = isinstance(value, Place) and parameter.direction != "in"
                    yield from list(_places(value))[1 if whole else 0 :]
            case _:
                yield from (p for e in direct_expressions(s) for p in _places(e))
        for inner in blocks(s):
            yield from _used_places(inner)


def _written_by_calls(body: Statements, alive: set[int]) -> set[int]:
    """Variables that a call which stays writes, read or not."""
    calls = (s.call for s in statements(body) if isinstance(s, Do) and not _dead(s.call, alive))
    return {id(v.root) for call in calls for v in call.arguments if isinstance(v, Place)}


def _places(e: Expr) -> Iterator[Place]:
    return (x for x in inside(e) if isinstance(x, Place))


def _pruned(body: Statements, alive: set[int], kept_variables: set[int]) -> Statements:
    kept: list[Statement] = []
    for s in body:
        match s:
            case Let(variable) | Declare(variable) if id(variable) not in kept_variables:
                continue
            case Set(place) if id(place.root) not in kept_variables:
                continue
            case Do(call) if _dead(call, alive):
                continue
            case _:
                kept.append(with_blocks(s, lambda inner: _pruned(inner, alive, kept_variables)))
    return tuple(kept)


def _dead(call: Call, alive: set[int]) -> bool:
    """A call without status all of whose results nobody reads."""
    if call.signature.returns is not None:
        return False
    results = [v for p, v in call.pairs if p.direction != "in"]
    return all(isinstance(v, Place) and id(v.root) not in alive for v in results)


def without_idle_calls(functions: Sequence[Function]) -> tuple[Function, ...]:
    """The functions without calls of those that only return OK, and without the checks of their status.

    A clamped carrier has no equations to solve. Without such calls the functions are the same.
    """
    idle = {f.name for f in functions if not f.public and _only_ok(f.body)}
    return tuple(_leave_out(f, idle) for f in functions) if idle else tuple(functions)


def _only_ok(body: Statements) -> bool:
    match body:
        case (Return(Status(name="OK")),):
            return True
    return False


def _leave_out(function: Function, idle: set[str]) -> Function:
    def block(body: Statements) -> Statements:
        kept: list[Statement] = []
        checked = False
        for s in body:
            if checked and isinstance(s, When):
                checked = False
                continue
            checked = isinstance(s, Set) and isinstance(s.value, Call) and s.value.signature.name in idle
            if not checked:
                kept.append(with_blocks(s, block))
        return tuple(kept)

    body = block(function.body)
    unused = used_variables(function.body) - used_variables(body)
    return replace(function, body=tuple(s for s in body if not (isinstance(s, Declare) and id(s.variable) in unused)))


def without_short_loops(function: Function) -> Function:
    """The function without loops of no turn, nor of one turn between literal bounds; itself if it has none."""
    loops = [s for s in statements(function.body) if isinstance(s, Loop)]
    if not any(loops_of_no_turn(function.body)) and all(_turns(loop.start, loop.stop) != 1 for loop in loops):
        return function
    return replace(function, body=_ShortLoops(function).block(function.body, {}))


def loops_of_no_turn(body: Statements) -> Iterator[Loop]:
    """Outermost loops whose bounds leave no turn, whatever the indices of the loops around them are."""
    return _loops_of_no_turn(body, {})


def _loops_of_no_turn(body: Statements, ranges: dict[int, Range]) -> Iterator[Loop]:
    """`ranges`: least and largest value of variables, by their `id`."""
    for s in body:
        if isinstance(s, Let) and (among := range_of(s.value, ranges)):
            ranges[id(s.variable)] = among
        if isinstance(s, Loop):
            first, last = range_of(s.start, ranges), range_of(s.stop, ranges)
            if first and last and last[1] <= first[0]:
                yield s
                continue
            if first and last:
                ranges[id(s.index)] = first[0], last[1] - 1
        for inner in blocks(s):
            yield from _loops_of_no_turn(inner, ranges)


def range_of(e: Expr, ranges: dict[int, Range]) -> Range | None:
    """Least and largest value of an integer expression, or None where that is not known."""
    if isinstance(e, Const) and e.kind is Kind.INT:
        return int(e.value), int(e.value)
    if isinstance(e, Place) and not e.path:
        return ranges.get(id(e.root))
    if isinstance(e, Binary) and e.kind is Kind.INT and e.operator in "+-":
        left, right = range_of(e.left, ranges), range_of(e.right, ranges)
        if left and right:
            low, high = right if e.operator == "+" else (-right[1], -right[0])
            return left[0] + low, left[1] + high
    return None


def _turns(start: Expr, stop: Expr) -> int | None:
    """Number of turns between literal bounds, or None."""
    first, last = literal(start), literal(stop)
    return None if first is None or last is None else max(last - first, 0)


class _ShortLoops:
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
            statement = self._statement(s, meanings, moved)
            if not statement and isinstance(s, Loop) and kept and isinstance(kept[-1], Note):
                kept.pop()
            for new in statement:
                if kept and _is_overwritten(kept[-1], new):
                    kept.pop()
                kept.append(new)
        return tuple(kept)

    def _statement(self, s: Statement, meanings: Meanings, moved: bool) -> Statements:
        if isinstance(s, Loop):
            return self._loop(s, meanings)
        new = map_expressions(s, lambda e: _expr(e, meanings))
        if isinstance(new, Let) and (number := literal(new.value)) is not None:
            meanings[id(new.variable)] = Const(number, Kind.INT)
            return ()
        if isinstance(new, Let | Declare):
            return (replace(new, variable=self._rename(new.variable, meanings, moved)),)
        return (with_blocks(new, lambda inner: self.block(inner, meanings)),)

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
        return new.yes if are_same(new.yes, new.no) else new
    return new


def _is_overwritten(s: Statement, later: Statement) -> bool:
    """Does the next statement give another value to what this one sets to a literal?"""
    if not (isinstance(s, Set) and isinstance(later, Set)) or s.add or later.add:
        return False
    return isinstance(s.value, Const) and isinstance(later.value, Const) and are_same(s.place, later.place)


def restrict_program(program: Program, names: Collection[str], kept: Collection[str]) -> Program:
    """The program with the public functions `names`, and those that they call; structs of `kept` stay as well."""
    functions = reachable(tuple(f if f.name in names else replace(f, public=False) for f in program.functions))
    structs = {held for struct in program.structs if struct.name in kept for held in struct.inner_structs()}
    structs |= {*used_structs(functions)}
    return replace(program, functions=functions, structs=tuple(s for s in program.structs if s in structs))
