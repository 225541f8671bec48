"""Forward-mode derivatives of functions of the program: beside every variable x that changes stands its derivative d_x.

`Tangents.change` makes the function of the change of what a function gives with changes of its inputs: loops stay
loops, branches are taken as the function takes them, where it calls others their tangents are called. `partials` makes
that of the columns of a Jacobian: derivatives along several directions side by side, named x_by_DIRECTION.

What does not change is computed as the function computes it, once, and left out where no derivative needs it. Zeros and
ones are not computed with. A tangent returns no status: it is called with inputs which the function has taken.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Protocol

from mahovik.core.program.call import Argument, Call
from mahovik.core.program.expression import Binary, Const, Expr, Negate, Not, Place, Select, Variable, binary, real
from mahovik.core.program.function import Function
from mahovik.core.program.simplify import prune
from mahovik.core.program.statement import Copy, Declare, Do, Let, Loop, Note, Return, Set, Statement, Statements, When
from mahovik.core.program.types import Kind
from mahovik.core.program.walk import (
    FreshNames,
    are_same,
    blocks,
    direct_expressions,
    expressions,
    inside,
    statements,
    used_variables,
    with_blocks,
)

ONE = real(1)
Derivative = Expr | None
"""An expression, or None for zero."""
Key = tuple[Any, ...]
"""A place: `id` of its variable, members and indices; None for an index that is not known."""
Seed = Callable[[Place], Derivative]
"""Derivative of an element of an input."""


class Functions(Protocol):
    """The functions of a program by name, to which tangents are added."""

    def __getitem__(self, name: str) -> Function: ...
    def __contains__(self, name: str) -> bool: ...
    def add(self, function: Function) -> Function: ...


class Tangents:
    """Tangents of functions, each made once, and added to the functions after those that it calls."""

    def __init__(self, functions: Functions) -> None:
        self._functions = functions
        self._inputs: dict[str, Mapping[str, Sequence[str]]] = {}

    def change(self, name: str, changes: Mapping[str, Sequence[str]]) -> Function:
        """NAME_by_V of {"V": ["V", "x.V"]}: takes the change d_V of the inputs V and x.V, gives changes of the results.

        Results of the function itself are left out; inputs remain where a derivative needs them.
        """
        function, direction, arguments = self._functions[name], _Direction(), []
        for what, inputs in changes.items():
            places = [_input(function, i) for i in inputs]
            assert isinstance(places[0].type, Kind)
            arguments.append(Argument(f"d_{what}", places[0].type, places[0].shape, purpose=f"change of {what}"))
            direction.twins |= {_key(place): arguments[-1].place for place in places}
        direction.active = set(direction.twins)
        what = "_".join(changes)
        if self._inputs.setdefault(f"{name}_by_{what}", changes) != changes:
            raise TypeError(f"{name}_by_{what} is there already, by other inputs")
        return self._add(function, what, f"Change of what {name} gives, with changes of {what}.", direction, arguments)

    def derivative(self, name: str, what: str, seeds: Mapping[str, Seed]) -> Function:
        """NAME_by_WHAT: derivatives by a number of which the derivatives of inputs are known, by the inputs' names."""
        function, direction = self._functions[name], _Direction()
        direction.seeds = {_key(_input(function, i)): seed for i, seed in seeds.items()}
        return self._add(function, what, f"Derivatives of what {name} gives by {what}.", direction, [])

    def _add(
        self, function: Function, what: str, purpose: str, direction: _Direction, arguments: list[Argument]
    ) -> Function:
        name = f"{function.name}_by_{what}"
        if name not in self._functions:
            self._functions.add(_Pass(function, [direction], self).function(name, purpose, arguments))
        return self._functions[name]

    def of_call(self, call: Call, direction: _Direction) -> Call | None:
        """The call of the tangent beside that of the function; None where it gives nothing that changes."""
        function = self._functions[call.signature.name]
        used = [_key(e) for e in expressions(function.body) if isinstance(e, Place)]
        changes: dict[str, list[str]] = {}
        named: dict[str, Expr] = {}
        for parameter, value in call.pairs:
            named[parameter.name] = value
            if parameter.direction != "in":
                assert isinstance(value, Place)
                named[f"d_{parameter.name}"] = direction.twin(value)
            elif not isinstance(value, Place) or value.is_scalar:
                derivative = direction.of(value) if value.kind is Kind.REAL else None
                if derivative is not None:
                    changes[parameter.name] = [parameter.name]
                    named[f"d_{parameter.name}"] = derivative
            else:
                for path, twin in direction.twins_within(value):
                    if any(_meet((id(parameter.variable), *path), key) for key in used):
                        what = path[-1] if path else parameter.name
                        changes.setdefault(what, []).append(".".join((parameter.name, *path)))
                        named[f"d_{what}"] = twin
        if not changes:
            return None
        tangent = self.change(function.name, changes)
        return Call(tangent.signature, tuple(named[a.name] for a in tangent.arguments))


def partials(function: Function, name: str, what: str, directions: Mapping[str, Mapping[str, Seed]]) -> Function:
    """Derivatives by several numbers of what a function gives: of a result (n) an array d_RESULT (directions x n).

    `directions`: for each, by its name, the derivatives of inputs by it. The function calls no other.
    """
    rows = []
    for number, (suffix, seeds) in enumerate(directions.items()):
        rows.append(_Direction(suffix, (Const(number, Kind.INT),)))
        rows[-1].seeds = {_key(_input(function, i)): seed for i, seed in seeds.items()}
    purpose = f"Derivatives of what {function.name} gives, row by row by {what}."
    return _Pass(function, rows, None).function(name, purpose, [])


@dataclass(eq=False)
class _Direction:
    """One direction of change: what changes along it, and the derivatives of variables.

    suffix  end of the names of its derivatives, where there are several directions
    row     its index in the derivatives of results, likewise
    seeds   derivatives of inputs
    twins   places that hold derivatives of places, by the keys of these
    active  keys of variables that change
    rows    `id` of the variables of results
    known   derivatives of temporaries that need no variable of their own, by their keys
    zeros   statements that set a derivative to zero, by the keys of what it is the derivative of, not yet made
    values  variables that have the value of an expression, by its `id`
    """

    suffix: str = ""
    row: tuple[Expr, ...] = ()
    seeds: dict[Key, Seed] = field(default_factory=dict)
    twins: dict[Key, Place] = field(default_factory=dict)
    active: set[Key] = field(default_factory=set)
    rows: set[int] = field(default_factory=set)
    known: dict[Key, Expr] = field(default_factory=dict)
    zeros: dict[Key, Set] = field(default_factory=dict)
    values: dict[int, Expr] = field(default_factory=dict)

    def depends(self, key: Key) -> bool:
        """Does a place, or a part of it, change?"""
        return any(_meet(key, k) for known in (self.active, self.seeds) for k in known)

    def changes(self, e: Expr) -> bool:
        """Does what is passed or assigned change?"""
        if isinstance(e, Select):
            return self.changes(e.yes) or self.changes(e.no)
        if not isinstance(e, Place):
            return any(self.changes(x) for x in e.operands)
        if not e.is_scalar or e.kind is not Kind.REAL:
            return e.type is not Kind.INT and self.depends(_key(e))
        seed = self._seed(e)
        return self.depends(_key(e)) if seed is None else seed(e) is not None

    def _seed(self, place: Place) -> Seed | None:
        return next((seed for key, seed in self.seeds.items() if _meet(key, _key(place))), None)

    def twin(self, place: Place) -> Place:
        """The place of its derivative."""
        key = _key(place)
        for length in range(len(key), 0, -1):
            if (twin := self.twins.get(key[:length])) is not None:
                row = self.row if id(place.root) in self.rows else ()
                return Place(twin.root, (*twin.path, *row, *place.path[length - 1 :]), place.type, place.shape)
        raise TypeError(f"{place!r} depends on the input, but nothing holds its derivative")

    def twins_within(self, place: Place) -> Iterator[tuple[tuple[str, ...], Place]]:
        """Paths from a place to the parts of it that change, with the places of their derivatives."""
        key = _key(place)
        if self._seed(place) is not None:
            raise TypeError(f"{place!r} is passed to a function, but its derivatives are in no place")
        for k, twin in self.twins.items():
            if len(k) > len(key) and _meet(k, key):
                yield k[len(key) :], twin
            elif _meet(k, key) and self.depends(key):
                yield (), self.twin(place)

    def of(self, e: Expr) -> Derivative:
        """The derivative of an expression."""
        match e:
            case Place() if e.is_scalar and e.kind is Kind.REAL:
                return self._of_place(e)
            case Negate():
                return _minus(self.of(e.operand))
            case Select() if e.kind is Kind.REAL:
                yes, no = self.of(e.yes), self.of(e.no)
                if yes is None and no is None:
                    return None
                return type(e)(e.condition, real(0) if yes is None else yes, real(0) if no is None else no)
            case Binary() if e.kind is Kind.REAL:
                return self._of_binary(e)
            case Call() if e.signature.returns is Kind.REAL:
                return self._of_call(e)
        return None

    def _of_place(self, place: Place) -> Derivative:
        key, seed = _key(place), self._seed(place)
        if seed is not None:
            return seed(place)
        if key in self.known or key in self.zeros:
            return self.known.get(key)
        return self.twin(place) if self.depends(key) else None

    def _of_binary(self, e: Binary) -> Derivative:
        left, right = self.of(e.left), self.of(e.right)
        if e.operator in "+-":
            return _sum(left, right if e.operator == "+" else _minus(right))
        if e.operator == "*" and left is not None and are_same(e.left, e.right):
            return _product(real(2), _product(e.left, left))
        if e.operator == "*":
            return _sum(_product(left, e.right), _product(e.left, right))
        top = _sum(left, _minus(_product(self.values.get(id(e), e), right)))
        if isinstance(top, Negate):
            return Negate(binary("/", top.operand, e.right))
        return None if top is None else binary("/", top, e.right)

    def _of_call(self, e: Call) -> Derivative:
        changes = [self.of(a) for a in e.arguments]
        if all(change is None for change in changes):
            return None
        value = self.values.get(id(e))
        match e.signature.name, e.arguments, changes:
            case "exp", _, (change,) if value is not None:
                return _product(value, change)
            case "sqrt", _, (change,) if value is not None and change is not None:
                return change / Select(value > 0, 2 * value, ONE)  # the square of a length does not change at zero
            case "atan2", (y, x), (dy, dx):
                square = x * x + y * y
                turned = _sum(_product(x, dy), _minus(_product(y, dx)))
                return None if turned is None else turned / Select(square > 0, square, ONE)
        raise TypeError(f"{e.signature.name}: there is no rule for its derivative, or its value has no name")


class _Pass:
    """One function while its derivatives along some directions are put beside it."""

    def __init__(self, function: Function, directions: list[_Direction], tangents: Tangents | None) -> None:
        self._function, self._directions, self._tangents = function, directions, tangents
        body = function.body
        names = [s.variable.name for s in statements(body) if isinstance(s, Let | Declare)]
        names += [s.index.name for s in statements(body) if isinstance(s, Loop)]
        self._fresh = FreshNames([*names, *(a.name for a in function.arguments)])
        self._results = [a for a in function.arguments if a.direction != "in"]
        self._constant = {id(a.variable) for a in function.arguments if a.direction == "in"}
        self._constant |= {id(s.variable) for s in statements(body) if isinstance(s, Let)}
        # what is used whole, or with an index that is not known, changes as a whole
        self._whole = {
            id(p.root) for e in expressions(body) for p in _places_in(e) if not p.is_scalar or None in _key(p)
        }
        self._whole |= {id(a.variable) for a in self._results}

    def function(self, name: str, purpose: str, arguments: Sequence[Argument]) -> Function:
        """The tangent, which takes `arguments` after the function's own inputs."""
        for direction in self._directions:
            while self._spread(self._function.body, direction):
                pass
        results, rows = [], (len(self._directions),) if self._directions[0].row else ()
        for a in self._results:
            if any(d.depends((id(a.variable),)) for d in self._directions):
                seeded = any((id(a.variable),) in d.seeds for d in self._directions)
                way = "out" if seeded else a.direction
                words = f"change of {a.name}" + ("" if way == "out" else "; it is added to this")
                results.append(Argument(f"d_{a.name}", a.type, (*rows, *a.shape), way, purpose=words))
                for d in self._directions:
                    d.rows.add(id(a.variable))
                    d.twins[(id(a.variable),)] = results[-1].place
        body = tuple(self._block(self._function.body))
        inputs = [a for a in self._function.arguments if a.direction == "in"]
        local = [Declare(a.variable) for a in self._results if a.direction == "out"]
        result = Function(name, purpose, (*inputs, *arguments, *results), (*local, *body), self._function.equation)
        kept = {id(a.variable) for a in results}
        before = 0
        while before != (before := len(list(statements(result.body)))):
            result = prune(replace(result, body=_tidy(_without_idle(result.body, kept))))
        used = used_variables(result.body)
        if any(a.direction == "inout" and id(a.variable) in used for a in self._results):
            raise TypeError(f"{name} needs what {self._function.name} adds to its results")
        return result

    # -- what changes ------------------------------------------------------------------------------------------------

    def _target(self, place: Place) -> Key:
        """The key of a place that is written."""
        return (id(place.root),) if id(place.root) in self._whole else _key(place)

    def _spread(self, body: Statements, direction: _Direction) -> bool:
        """One pass over a body; True where something new was found to change."""
        new = False
        for s in statements(body):
            for target in self._changed(s, direction):
                new |= target not in direction.active
                direction.active.add(target)
        return new

    def _changed(self, s: Statement, direction: _Direction) -> Iterator[Key]:
        match s:
            case Let(variable, value) if direction.changes(value):
                yield (id(variable),)
            case Do(call) | Set(value=call) if isinstance(call, Call) and call.signature.returns is not Kind.REAL:
                if any(p.direction != "out" and direction.changes(v) for p, v in call.pairs):
                    yield from (self._target(v) for p, v in call.pairs if p.direction != "in" and isinstance(v, Place))
            case Set(place, value) if direction.changes(value):
                yield self._target(place)
            case Copy(target, source) if direction.depends(_key(source)):
                yield self._target(target)

    # -- statements --------------------------------------------------------------------------------------------------

    def _block(self, body: Statements) -> Iterator[Statement]:
        """The statements, each with the derivatives of what it changes; notes before those that have some."""
        notes: list[Statement] = []
        for group in _runs(body):
            s = group[0]
            if isinstance(s, Note):
                notes.append(s)
                continue
            if not isinstance(s, Let | Set) or _is_check(s):
                yield from self._zeros()
            beside = list(self._set(group) if isinstance(s, Set) and not _is_check(s) else self._statement(s))
            if len(beside) > len(group) or any(blocks(s)):
                yield from notes
            yield from beside
            notes.clear()
        yield from self._zeros()

    def _zeros(self) -> Iterator[Statement]:
        """The statements that set derivatives to zero which nothing has replaced."""
        for d in self._directions:
            yield from d.zeros.values()
            d.zeros.clear()

    def _statement(self, s: Statement) -> Iterator[Statement]:
        """A statement other than Set, and the derivatives of what it changes; a returned status is left out."""
        match s:
            case Let():
                yield s
                yield from self._let(s)
            case Declare(variable):
                yield s
                for d in self._directions:
                    if d.depends((id(variable),)):
                        yield Declare(self._twin(variable, d))
            case Do(call):
                yield s
                yield from self._call(call)
            case Set(_, Call() as call) if _is_check(s):
                results = [v.root for p, v in call.pairs if p.direction != "in" and isinstance(v, Place)]
                if any(id(root) not in {id(a.variable) for a in self._results} for root in results):
                    raise TypeError(f"{call.signature.name} returns a status, and its results are used")
                yield from self._call(call)
            case Copy(target, source):
                yield s
                for d in self._directions:
                    if d.depends(self._target(target)):
                        yield Copy(d.twin(target), d.twin(source))
            case Return():
                return
            case _:
                yield with_blocks(s, lambda inner: tuple(self._block(inner)))

    def _twin(self, variable: Variable, direction: _Direction) -> Variable:
        name = self._fresh(f"{variable.name}_by_{direction.suffix}" if direction.suffix else f"d_{variable.name}")
        twin = Variable(name, variable.type, variable.shape, written=variable.written)
        direction.twins[(id(variable),)] = twin.place
        return twin

    def _let(self, s: Let) -> Iterator[Statement]:
        for d in self._directions:
            d.values[id(s.value)] = s.variable.place
            derivative = d.of(s.value)
            if derivative is not None and self._is_constant(derivative):
                d.known[(id(s.variable),)] = derivative
            elif derivative is not None:
                yield Let(self._twin(s.variable, d), derivative)

    def _is_constant(self, e: Expr) -> bool:
        """Is it a number, or what is not written again?"""
        if isinstance(e, Negate):
            return self._is_constant(e.operand)
        return isinstance(e, Const) or (isinstance(e, Place) and id(e.root) in self._constant)

    def _set(self, group: list[Any]) -> Iterator[Statement]:
        """Derivatives come after a local that has the value of a quotient or call, else before what they may read."""
        s = group[0]
        first = len(group) == 1 and not s.add and _has_named_value(s.value)
        first &= id(s.place.root) not in self._whole and s.place.root not in {p.root for p in _places_in(s.value)}
        if first:
            yield s
        for d in self._directions:
            if first:
                d.values[id(s.value)] = s.place
            for one in group:
                yield from self._derivative(one, d)
        if not first:
            yield from group

    def _derivative(self, s: Set, d: _Direction) -> Iterator[Statement]:
        if not d.depends(self._target(s.place)):
            return
        derivative, key = d.of(s.value), _key(s.place)
        if derivative is not None:
            was_zero = d.zeros.pop(key, None) is not None
            yield Set(d.twin(s.place), derivative, add=s.add and not was_zero)
        elif not s.add:
            d.zeros[key] = Set(d.twin(s.place), real(0))

    def _call(self, call: Call) -> Iterator[Statement]:
        """The call of the tangent."""
        for d in self._directions:
            if call.signature.name == "sincos":
                angle, sine, cosine = call.arguments
                change = d.of(angle)
                if change is not None and isinstance(sine, Place) and isinstance(cosine, Place):
                    yield Set(d.twin(sine), change * cosine)
                    yield Set(d.twin(cosine), -(change * sine))
            elif any(d.changes(v) for p, v in call.pairs if p.direction != "out"):
                if self._tangents is None:
                    raise TypeError(f"{self._function.name} calls {call.signature.name}: put it in first")
                tangent = self._tangents.of_call(call, d)
                if tangent is not None:
                    yield Do(tangent)


def _runs(body: Statements) -> Iterator[list[Any]]:
    """Statements one by one; together those that set places which the others do not read, to no quotient or call."""
    run: list[Set] = []
    for s in body:
        if isinstance(s, Set) and not _has_named_value(s.value):
            read = [_key(p) for p in _places_in(s.value)] + ([_key(s.place)] if s.add else [])
            if any(_meet(key, _key(one.place)) for one in run for key in read):
                yield run
                run = []
            run.append(s)
            continue
        if run:
            yield run
            run = []
        yield [s]
    if run:
        yield run


def _has_named_value(e: Expr) -> bool:
    """A quotient or a call: its derivative takes its value from the variable that gets it."""
    return isinstance(e, Call) or (isinstance(e, Binary) and e.operator == "/")


def _is_check(s: Statement) -> bool:
    return isinstance(s, Set) and isinstance(s.value, Call) and s.value.signature.returns is Kind.STATUS


def _without_idle(body: Statements, kept: set[int]) -> Statements:
    """The statements without those that set elements of variables which no other reads; those of `kept` stay."""
    read = {
        _key(p)
        for s in statements(body)
        for e in direct_expressions(s)
        for p in inside(e)
        if isinstance(p, Place) and not (isinstance(s, Set) and _key(p) == _key(s.place))
    }

    def less(body: Statements) -> Statements:
        return tuple(with_blocks(s, less) for s in body if not is_idle(s))

    def is_idle(s: Statement) -> bool:
        if not isinstance(s, Set) or isinstance(s.value, Call) or id(s.place.root) in kept:
            return False
        return not any(_meet(_key(s.place), key) for key in read)

    return less(body)


def _tidy(body: Statements) -> Statements:
    """The statements without blocks and notes of which nothing is left."""
    kept: list[Statement] = []
    for s in (with_blocks(s, _tidy) for s in body):
        if blocks(s) and not any(blocks(s)):
            continue
        if isinstance(s, Note) and kept and isinstance(kept[-1], Note):
            kept.pop()
        if isinstance(s, When) and not s.body:
            kept.append(replace(s, condition=Not(s.condition), body=s.otherwise, otherwise=()))
        else:
            kept.append(s)
    while kept and isinstance(kept[-1], Note):
        kept.pop()
    return tuple(kept)


def _places_in(e: Expr) -> list[Place]:
    return [x for x in inside(e) if isinstance(x, Place)]


def _input(function: Function, name: str) -> Place:
    """An argument, or a member of one: "x.V"."""
    first, *path = name.split(".")
    place = next(a.place for a in function.arguments if a.name == first)
    for step in path:
        place = place.member(step)
    return place


def _key(place: Place) -> Key:
    steps = (int(s.value) if isinstance(s, Const) else s if isinstance(s, str) else None for s in place.path)
    return (id(place.root), *steps)


def _meet(a: Key, b: Key) -> bool:
    """Can one be a part of the other?"""
    return all(x == y or x is None or y is None for x, y in zip(a, b, strict=False))


# -- sums and products without zeros and ones --------------------------------------------------------------------------


def _minus(a: Derivative) -> Derivative:
    match a:
        case None:
            return None
        case Negate():
            return a.operand
        case Const():
            return real(-a.value)
        case Binary(operator="-"):
            return binary("-", a.right, a.left)
    return Negate(a)


def _sum(a: Derivative, b: Derivative) -> Derivative:
    if a is None or b is None:
        return b if a is None else a
    if isinstance(a, Negate):
        a, b = b, a
    return binary("-", a, b.operand) if isinstance(b, Negate) else binary("+", a, b)


def _product(a: Derivative, b: Derivative) -> Derivative:
    """a * b, in this order."""
    if a is None or b is None:
        return None
    for x, other in ((a, b), (b, a)):
        match x:
            case Const(value=1):
                return other
            case Const(value=-1):
                return Negate(other)
            case Const() if isinstance(other, Binary) and other.operator == "*" and isinstance(other.left, Const):
                return _product(real(x.value * other.left.value), other.right)
            case Negate():
                return _minus(_product(x.operand, other) if x is a else _product(other, x.operand))
    return binary("*", a, b)
