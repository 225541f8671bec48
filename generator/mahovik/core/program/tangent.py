"""Forward-mode derivatives of functions of the program: beside every variable x that depends on the input stands d_x.

`Tangents.change` gives the change of what a function gives with a change of some of its inputs: loops stay loops,
branches are taken as the function takes them, of functions that it calls the tangents are called. `partials` gives the
columns of a matrix of derivatives, one for each direction, of a function without loops and calls.

What does not depend on the input is computed as the function computes it, and left out where no derivative needs it.
Zeros and ones are not computed with. A tangent returns no status: it belongs to inputs which its function has taken.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Protocol

from mahovik.core.program.call import Argument, Call
from mahovik.core.program.expression import Binary, Const, Expr, Negate, Not, Place, Select, Variable, binary, real
from mahovik.core.program.function import Function
from mahovik.core.program.prune import prune
from mahovik.core.program.rewrite import FreshNames
from mahovik.core.program.statement import (
    Block,
    Copy,
    Declare,
    Do,
    Let,
    Loop,
    Note,
    Return,
    Set,
    Shortcut,
    Statement,
    Statements,
    When,
)
from mahovik.core.program.types import Kind
from mahovik.core.program.walk import blocks, expressions, statements, used_variables, with_blocks

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

    def change(self, name: str, changes: Mapping[str, Sequence[str]]) -> Function:
        """NAME_by_V of {"V": ["V", "x.V"]}: takes the change d_V of the inputs V and x.V, gives changes of the results.

        Results of the function itself are left out; inputs remain where a derivative needs them.
        """
        function = self._functions[name]
        twins = []
        for what, inputs in changes.items():
            like = _input(function, inputs[0])
            assert isinstance(like.type, Kind)
            twins.append(Argument(f"d_{what}", like.type, like.shape, purpose=f"change of {what}"))
        seeds = {i: twin.place for twin, inputs in zip(twins, changes.values(), strict=True) for i in inputs}
        return self._add(function, "_".join(changes), seeds, {}, tuple(twins))

    def derivative(self, name: str, what: str, seeds: Mapping[str, Seed]) -> Function:
        """NAME_by_WHAT: derivatives by a number of which the derivatives of inputs are known, by the inputs' names."""
        return self._add(self._functions[name], what, {}, seeds, ())

    def _add(
        self,
        function: Function,
        what: str,
        twins: Mapping[str, Place],
        seeds: Mapping[str, Seed],
        arguments: tuple[Argument, ...],
    ) -> Function:
        name = f"{function.name}_by_{what}"
        if name in self._functions:
            return self._functions[name]
        direction = _Direction()
        direction.twins = {_key(_input(function, i)): twin for i, twin in twins.items()}
        direction.seeds = {_key(_input(function, i)): seed for i, seed in seeds.items()}
        body, results = _Pass(function, [direction], self).body(lambda a: (f"d_{a.name}", a.shape))
        kept = [a for a in function.arguments if a.direction == "in"]
        said = f"Change of what {function.name} gives, with the change of {what}."
        if not arguments:
            said = f"Derivatives of what {function.name} gives by {what}."
        return self._functions.add(
            _finished(function, name, said, (*kept, *arguments, *results), body),
        )

    def of_call(self, call: Call, direction: _Direction) -> Call | None:
        """The call of the tangent in place of that of the function; None where it gives nothing that changes."""
        function = self._functions[call.signature.name]
        used = [e for e in expressions(function.body) if isinstance(e, Place)]
        changes: dict[str, list[str]] = {}
        given: dict[str, Expr] = {}
        for parameter, value in call.pairs:
            if parameter.direction != "in":
                continue
            if not isinstance(value, Place) or value.is_scalar:
                derivative = direction.of(value) if value.kind is Kind.REAL else None
                if derivative is not None:
                    changes.setdefault(parameter.name, []).append(parameter.name)
                    given[f"d_{parameter.name}"] = derivative
                continue
            for path, twin in direction.twins_within(value):
                inner = Place(parameter.variable, path, twin.type, ())
                if any(_meet(_key(inner), _key(u)) for u in used):
                    what = path[-1] if path else parameter.name
                    changes.setdefault(what, []).append(".".join((parameter.name, *path)))
                    given[f"d_{what}"] = twin
        if not changes:
            return None
        tangent = self.change(function.name, changes)
        for parameter, value in call.pairs:
            given[parameter.name] = value
            if parameter.direction != "in":
                assert isinstance(value, Place)
                given[f"d_{parameter.name}"] = direction.twin(value)
        return Call(tangent.signature, tuple(given[a.name] for a in tangent.arguments))


def partials(function: Function, name: str, what: str, directions: Mapping[str, Mapping[str, Seed]]) -> Function:
    """Derivatives of what a function gives by several numbers: of a result (n) an array d_RESULT (n x directions).

    `directions`: for each, by its name, the derivatives of inputs by it.
    """
    found = []
    for number, (suffix, seeds) in enumerate(directions.items()):
        direction = _Direction(suffix, (Const(number, Kind.INT),))
        direction.seeds = {_key(_input(function, i)): seed for i, seed in seeds.items()}
        found.append(direction)
    count = len(found)
    body, results = _Pass(function, found, None).body(lambda a: (f"d_{a.name}", (*a.shape, count)))
    said = f"Derivatives of what {function.name} gives by {what}, one column for each."
    kept = [a for a in function.arguments if a.direction == "in"]
    return _finished(function, name, said, (*kept, *results), body)


def _finished(
    function: Function, name: str, purpose: str, arguments: tuple[Argument, ...], body: Statements
) -> Function:
    """The tangent without what it has no use for; what the function itself gives becomes local, where it is needed."""
    local = tuple(Declare(a.variable) for a in function.arguments if a.direction == "out")
    found = prune(Function(name, purpose, arguments, (*local, *body), function.equation))
    found = prune(replace(found, body=_tidy(found.body)))
    used = used_variables(found.body)
    for a in function.arguments:
        if a.direction == "inout" and id(a.variable) in used:
            raise TypeError(f"{name} needs what {function.name} adds to {a.name}")
    return found


@dataclass(eq=False)
class _Direction:
    """One direction of change: what depends on it, and the derivatives of variables.

    suffix   end of the names of its derivatives, where there are several directions
    columns  its index in the derivatives of results, likewise
    seeds    derivatives of inputs
    twins    places that hold derivatives of places, by the keys of these
    active   keys of variables that change
    results  `id` of the variables of results
    known    derivatives of temporaries that need no variable of their own, by `id` of these
    values   variables that have the value of an expression, by its `id`
    """

    suffix: str = ""
    columns: tuple[Expr, ...] = ()
    seeds: dict[Key, Seed] = field(default_factory=dict)
    twins: dict[Key, Place] = field(default_factory=dict)
    active: set[Key] = field(default_factory=set)
    results: set[int] = field(default_factory=set)
    known: dict[int, Expr] = field(default_factory=dict)
    values: dict[int, Expr] = field(default_factory=dict)

    def depends(self, key: Key) -> bool:
        """Does a place, or a part of it, change?"""
        return any(_meet(key, k) for known in (self.active, self.twins, self.seeds) for k in known)

    def twin(self, place: Place) -> Place:
        """The place of its derivative."""
        key = _key(place)
        for length in range(len(key), 0, -1):
            if (twin := self.twins.get(key[:length])) is not None:
                column = self.columns if id(place.root) in self.results else ()
                return Place(twin.root, (*twin.path, *place.path[length - 1 :], *column), place.type, place.shape)
        raise TypeError(f"{place!r} depends on the input, but nothing holds its derivative")

    def twins_within(self, place: Place) -> Iterator[tuple[tuple[str, ...], Place]]:
        """Paths from a place to the parts of it that change, with the places of their derivatives."""
        key = _key(place)
        if any(_meet(key, k) for k in self.seeds):
            raise TypeError(f"{place!r} is passed to a function, but its derivatives are in no place")
        for k, twin in self.twins.items():
            if len(k) > len(key) and _meet(k, key):
                yield k[len(key) :], twin
            elif _meet(k, key) and self.depends(key):
                yield (), self.twin(place)

    def of(self, e: Expr) -> Derivative:
        """The derivative of an expression."""
        match e:
            case Place():
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
            case Call():
                return self._of_call(e)
        return None

    def _of_place(self, place: Place) -> Derivative:
        if not place.is_scalar or place.kind is not Kind.REAL:
            return None
        if not place.path and id(place.root) in self.known:
            return self.known[id(place.root)]
        key = _key(place)
        for k, seed in self.seeds.items():
            if _meet(k, key):
                return seed(place)
        return self.twin(place) if self.depends(key) else None

    def _value(self, e: Expr) -> Expr:
        """A quotient or what a function returns, by the variable that has it."""
        return self.values.get(id(e), e)

    def _of_binary(self, e: Binary) -> Derivative:
        left, right = self.of(e.left), self.of(e.right)
        if e.operator in "+-":
            return _sum(left, right if e.operator == "+" else _minus(right))
        if e.operator == "*":
            if left is not None and same(e.left, e.right):
                return 2 * _product(e.left, left)
            return _sum(
                None if left is None else _product(left, e.right), None if right is None else _product(e.left, right)
            )
        top = _sum(left, None if right is None else _minus(_product(self._value(e), right)))
        return None if top is None else _quotient(top, e.right)

    def _of_call(self, e: Call) -> Derivative:
        if e.signature.returns is not Kind.REAL:
            return None
        changes = [self.of(a) for a in e.arguments]
        if all(change is None for change in changes):
            return None
        value = self._value(e)
        match e.signature.name, e.arguments, changes:
            case "exp", _, (change,) if change is not None:
                return _product(value, change)
            case "sqrt", _, (change,) if change is not None:
                return _half(change) / Select(value > 0, value, ONE)  # at zero the square of a length cannot change
            case "atan2", (y, x), (dy, dx):
                turned = _sum(None if dy is None else _product(x, dy), None if dx is None else _minus(_product(y, dx)))
                assert turned is not None
                square = x * x + y * y
                return turned / Select(square > 0, square, ONE)
        raise TypeError(f"{e.signature.name} has no rule for its derivative")


class _Pass:
    """One function while its derivatives along some directions are put beside it."""

    def __init__(self, function: Function, directions: list[_Direction], tangents: Tangents | None) -> None:
        self._function, self._directions, self._tangents = function, directions, tangents
        named = [s.variable.name for s in statements(function.body) if isinstance(s, Let | Declare)]
        named += [s.index.name for s in statements(function.body) if isinstance(s, Loop)]
        self._fresh = FreshNames([*named, *(a.name for a in function.arguments)])
        self._results = {id(a.variable) for a in function.arguments if a.direction != "in"}
        self._constant = {id(a.variable) for a in function.arguments if a.direction == "in"}
        self._constant |= {id(s.variable) for s in statements(function.body) if isinstance(s, Let)}
        self._whole = _used_whole(function.body)

    def body(self, result: Callable[[Argument], tuple[str, tuple[Any, ...]]]) -> tuple[Statements, list[Argument]]:
        """Statements, and arguments for derivatives of the results."""
        for direction in self._directions:
            while self._spread(self._function.body, direction):
                pass
        results = []
        for a in self._function.arguments:
            if a.direction != "in" and any(d.depends((id(a.variable),)) for d in self._directions):
                name, shape = result(a)
                what = f"change of {a.name}" if a.direction == "out" else f"change of {a.name}; it is added to this"
                results.append(Argument(name, a.type, shape, a.direction, purpose=what))
                for d in self._directions:
                    d.results.add(id(a.variable))
                    d.twins[(id(a.variable),)] = results[-1].place
        return tuple(self._block(self._function.body)), results

    # -- what depends on the input -----------------------------------------------------------------------------------

    def _target(self, place: Place) -> Key:
        """The key of a place that is written: whole, where the variable is used whole or by unknown indices."""
        key = _key(place)
        if id(place.root) in self._whole or id(place.root) in self._results:
            return tuple(step for step in key[:1])
        return key

    def _spread(self, body: Statements, direction: _Direction) -> bool:
        """One pass over a body; True where something new was found to depend on the input."""
        new = False
        for s in body:
            for target in self._changed(s, direction):
                new |= target not in direction.active
                direction.active.add(target)
            for inner in blocks(s):
                new |= self._spread(inner, direction)
        return new

    def _changed(self, s: Statement, direction: _Direction) -> Iterator[Key]:
        match s:
            case Let(variable, value) if _changes(value, direction):
                yield (id(variable),)
            case Set(place, value) if not _is_check(s) and _changes(value, direction):
                yield self._target(place)
            case Copy(target, source) if direction.depends(_key(source)):
                yield self._target(target)
            case Do(call) | Set(value=call) if isinstance(call, Call):
                if any(p.direction != "out" and _changes(v, direction) for p, v in call.pairs):
                    yield from (self._target(v) for p, v in call.pairs if p.direction != "in" and isinstance(v, Place))

    # -- statements --------------------------------------------------------------------------------------------------

    def _block(self, body: Statements) -> Iterator[Statement]:
        notes: list[Statement] = []
        for s in body:
            if isinstance(s, Note):
                notes.append(s)
                continue
            beside = list(self._statement(s))
            if len(beside) > 1 or any(blocks(s)):
                yield from notes  # of what has a derivative
            yield from beside
            notes.clear()

    def _statement(self, s: Statement) -> Iterator[Statement]:
        match s:
            case Let(variable, value):
                yield from self._let(s, variable, value)
            case Declare(variable):
                yield s
                for d in self._directions:
                    if d.depends((id(variable),)):
                        yield Declare(self._twin(variable, d))
            case Set() if _is_check(s):
                assert isinstance(s.value, Call)
                yield from self._call(Do(s.value), with_status=True)
            case Set(place, value):
                yield from self._set(s, place, value)
            case Copy(target, source):
                yield s
                for d in self._directions:
                    if d.depends(self._target(target)):
                        yield Copy(d.twin(target), d.twin(source))
            case Do():
                yield from self._call(s)
            case Return():
                return
            case Loop() | Block() | Shortcut():
                yield replace(s, body=tuple(self._block(s.body)))
            case When():
                yield replace(s, body=tuple(self._block(s.body)), otherwise=tuple(self._block(s.otherwise)))
            case _:
                yield s

    def _twin(self, variable: Variable, direction: _Direction) -> Variable:
        name = f"{variable.name}_by_{direction.suffix}" if direction.suffix else f"d_{variable.name}"
        written = variable.written
        twin = Variable(self._fresh(name), variable.type, variable.shape, written=written)
        direction.twins[(id(variable),)] = twin.place
        return twin

    def _named(self, e: Expr, outer: bool = True) -> tuple[list[Statement], Expr]:
        """Quotients and calls inside an expression that change get names, as their derivatives need their values."""
        before: list[Statement] = []

        def part(inner: Expr) -> Expr:
            steps, found = self._named(inner, outer=False)
            before.extend(steps)
            return found

        if isinstance(e, Place | Const) or not any(_changes(e, d) for d in self._directions):
            return [], e
        found = e if isinstance(e, Select) else e.with_operands(part)
        name = _NAMES.get(e.signature.name if isinstance(e, Call) else e.operator if isinstance(e, Binary) else "")
        if outer or name is None:
            return before, found
        variable = Variable(self._fresh(name), Kind.REAL)
        before += self._let(Let(variable, found), variable, found)
        self._constant.add(id(variable))
        return before, variable.place

    def _let(self, s: Let, variable: Variable, value: Expr) -> Iterator[Statement]:
        before, value = self._named(value)
        yield from before
        yield replace(s, value=value)
        for d in self._directions:
            d.values[id(value)] = variable.place
            derivative = d.of(value)
            if derivative is not None and self._is_constant(derivative):
                d.known[id(variable)] = derivative
            elif derivative is not None:
                yield Let(self._twin(variable, d), derivative)

    def _is_constant(self, e: Expr) -> bool:
        """Is it a number, or what does not change once it is computed?"""
        if isinstance(e, Negate):
            return self._is_constant(e.operand)
        return isinstance(e, Const) or (isinstance(e, Place) and id(e.root) in self._constant)

    def _set(self, s: Set, place: Place, value: Expr) -> Iterator[Statement]:
        before, value = self._named(value)
        yield from before
        first = not s.add and id(place.root) not in self._results
        first &= all(not (isinstance(e, Place) and e.root is place.root) for e in expressions([Let(place.root, value)]))
        if first:
            yield replace(s, value=value)
        for d in self._directions:
            if not d.depends(self._target(place)):
                continue
            if first:
                d.values[id(value)] = place
            derivative = d.of(value)
            if derivative is not None:
                yield Set(d.twin(place), derivative, add=s.add)
            elif not s.add:
                yield Set(d.twin(place), real(0))
        if not first:
            yield replace(s, value=value)

    def _call(self, s: Do, with_status: bool = False) -> Iterator[Statement]:
        """The call, if it gives no status, and that of the tangent."""
        call = s.call
        results = [v for p, v in call.pairs if p.direction != "in"]
        if not with_status:
            yield s
        elif any(id(v.root) not in self._results for v in results if isinstance(v, Place)):
            raise TypeError(f"{call.signature.name} returns a status, and {self._function.name} uses its results")
        for d in self._directions:
            if call.signature.name == "sincos":
                angle, sine, cosine = call.arguments
                assert isinstance(sine, Place) and isinstance(cosine, Place)
                if (change := d.of(angle)) is not None:
                    yield Set(d.twin(sine), _product(cosine, change))
                    yield Set(d.twin(cosine), -_product(sine, change))
            elif any(_changes(v, d) for p, v in call.pairs if p.direction != "out"):
                assert self._tangents is not None
                tangent = self._tangents.of_call(call, d)
                if tangent is not None:
                    yield Do(tangent)


_NAMES = {"/": "ratio", "sqrt": "root", "exp": "power", "atan2": "turn"}
"""Names of quotients, and of what functions return, where they have none."""


def _is_check(s: Statement) -> bool:
    return isinstance(s, Set) and isinstance(s.value, Call) and s.value.signature.returns is Kind.STATUS


def _changes(e: Expr, direction: _Direction) -> bool:
    """Does what is passed or assigned change?"""
    if isinstance(e, Place) and not (e.is_scalar and e.kind is Kind.REAL):
        return e.type is not Kind.INT and direction.depends(_key(e))
    match e:
        case Place():
            return direction.depends(_key(e))
        case Select():
            return _changes(e.yes, direction) or _changes(e.no, direction)
    return any(_changes(x, direction) for x in e.operands)


def _used_whole(body: Statements) -> set[int]:
    """`id` of variables that are used whole, or with an index that is not known."""
    places = [e for e in expressions(body) if isinstance(e, Place)]
    return {id(p.root) for p in places if not p.is_scalar or None in _key(p)}


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


def same(a: Expr, b: Expr) -> bool:
    """Are two expressions the same tree?"""
    if type(a) is not type(b) or len(a.operands) != len(b.operands):
        return False
    if isinstance(a, Place) and isinstance(b, Place):
        members = ([step for step in place.path if isinstance(step, str)] for place in (a, b))
        return a.root is b.root and len({tuple(m) for m in members}) == 1 and _all_same(a, b)
    for name in ("value", "name", "operator"):
        if getattr(a, name, None) != getattr(b, name, None):
            return False
    if isinstance(a, Call) and isinstance(b, Call) and a.signature.name != b.signature.name:
        return False
    return _all_same(a, b)


def _all_same(a: Expr, b: Expr) -> bool:
    return all(same(x, y) for x, y in zip(a.operands, b.operands, strict=True))


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
    return -a


def _sum(a: Derivative, b: Derivative) -> Derivative:
    if a is None or b is None:
        return b if a is None else a
    if isinstance(a, Negate):
        a, b = b, a
    return binary("-", a, b.operand) if isinstance(b, Negate) else binary("+", a, b)


def _product(a: Expr, b: Expr) -> Expr:
    """a * b, one of them a derivative."""
    for x, other in ((a, b), (b, a)):
        match x:
            case Const(value=1):
                return other
            case Const(value=-1):
                return -other
            case Negate():
                return -_product(x.operand, other) if x is a else -_product(other, x.operand)
    return binary("*", a, b)


def _quotient(a: Expr, b: Expr) -> Expr:
    return Negate(binary("/", a.operand, b)) if isinstance(a, Negate) else binary("/", a, b)


def _half(a: Expr) -> Expr:
    """a / 2."""
    exact = _exact_half(a)
    return 0.5 * a if exact is None else exact


def _exact_half(a: Expr) -> Derivative:
    """The half of twice something, or of a sum of such; else None."""
    match a:
        case Binary(operator="*", left=Const(value=2)):
            return a.right
        case Binary(operator="+"):
            left, right = _exact_half(a.left), _exact_half(a.right)
            return None if left is None or right is None else left + right
    return None


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
