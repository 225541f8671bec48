"""The wide form of a function: the same operations for many states side by side, in loops that compilers vectorise.

As ISPC does it: what varies from state to state gets an array of lanes, what is the same for all stays. A condition
that varies becomes a choice between values; what it guards is left out where no state needs it, if it has loops. Then
straight stretches of code become one loop over the lanes; loops over flywheels and calls stay around them. So each
state gets the bits of the narrow function, whatever its neighbours do.

A variable that one stretch alone uses stays a scalar inside its loop, where it is a register; one that several use, or
that is passed to a function, gets an array of lanes. What is the same in all lanes is computed once, before the loop.

Results that are read again stay scalars until the end of a loop over lanes, where they are stored: a compiler may not
move a load across a store that could meet it. So numbers of the table are operands of the vector operations that use
them, and none waits in a register.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import cast

from mahovik.core.program.call import Argument, Call
from mahovik.core.program.expression import (
    Binary,
    Choice,
    Const,
    Convert,
    Expr,
    Logic,
    Negate,
    Not,
    Place,
    Select,
    Variable,
    and_,
    integer,
    select,
    unequal,
    word,
)
from mahovik.core.program.function import Function
from mahovik.core.program.refusal import REFUSED, on_ints
from mahovik.core.program.simplify import prune
from mahovik.core.program.statement import Copy, Declare, Do, Let, Loop, Note, Set, Statement, Statements, When
from mahovik.core.program.types import Field, Kind, Precision, Struct
from mahovik.core.program.walk import (
    FreshNames,
    are_same,
    blocks,
    direct_expressions,
    inside,
    map_expressions,
    rebuilt,
    statements,
    used_variables,
    with_blocks,
)

BYTES = 64
"""Size of one wide value, bytes: a line of the cache, a register of AVX-512, two of AVX2, four of SSE2 or NEON."""

LANE = "k"
"""Index of the lanes."""

RESERVED = (LANE, "where", "any")
"""Names that locals of narrow functions must not have."""


class Wide:
    """The wide forms of the types of one program.

    Ints of a struct are those of the stand, the same in all lanes, and stay as they are; those of a result are reals.
    """

    def __init__(self, precision: Precision, results: Collection[str] = ()) -> None:
        """`results`: names of the structs that are results of functions with a batch."""
        self._results = results
        self.lanes = BYTES * 8 // precision.width
        purpose = f"{self.lanes} reals, one a state"
        self.real = Struct("wide", purpose, (Field("at", Kind.REAL, (self.lanes,)),))
        self.int = Struct("wide_int", f"{self.lanes} ints, one a state", (Field("at", Kind.INT, (self.lanes,)),))
        self.word = Struct("wide_word", f"{self.lanes} words, one a state", (Field("at", Kind.WORD, (self.lanes,)),))
        self._structs: dict[str, Struct] = {}

    def of(self, type_: Kind | Struct) -> Kind | Struct:
        """The wide form of a type; of a condition words 1 and 0."""
        if isinstance(type_, Struct):
            return self._struct(type_)
        return {Kind.REAL: self.real, Kind.INT: self.int}.get(type_, self.word)

    def _struct(self, struct: Struct) -> Struct:
        if struct.name not in self._structs:
            fields = tuple(replace(f, type=self._of_field(f, struct)) for f in struct.fields)
            purpose = f"{struct.purpose.rstrip('.')}; of {self.lanes} states side by side."
            self._structs[struct.name] = Struct(f"wide_{struct.name}", purpose, fields)
        return self._structs[struct.name]

    def _of_field(self, f: Field, struct: Struct) -> Kind | Struct:
        if f.type is Kind.INT:
            return self.real if self.is_result(struct) else f.type
        return self.of(f.type)

    def is_result(self, type_: Kind | Struct) -> bool:
        """Is a type a struct of results, whose ints vary?"""
        return isinstance(type_, Struct) and type_.name in self._results

    def argument(self, a: Argument) -> Argument:
        """An argument in its wide form."""
        return Argument(a.name, self.of(a.type), a.shape, a.direction, a.unit, a.purpose)


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
            # the second of a narrow one has other varying arguments
            name = FreshNames(f.name for f in self._done.values())(f"{narrow.name}_wide")
            self._done[key] = replace(made, name=name, body=prune(made).body, apart=False)
        return self._done[key]


class Varying:
    """The variables of one function that vary, from its varying arguments; the others are the same for all states."""

    def __init__(self, function: Function, arguments: Iterable[str], wide: Wide) -> None:
        self._wide = wide
        self._found = {id(a.variable) for a in function.arguments if a.name in arguments}
        while self._spread(function.body, False):
            pass

    def variable(self, identity: int) -> bool:
        """Does the variable with that `id` vary?"""
        return identity in self._found

    def add(self, variable: Variable) -> None:
        """One more varying variable."""
        self._found.add(id(variable))

    def expression(self, e: Expr) -> bool:
        """Does an expression vary?"""
        return any(isinstance(x, Place) and self.place(x) for x in inside(e))

    def place(self, place: Place) -> bool:
        """Does a place, whole or scalar, vary? Ints of a struct do in results only."""
        if id(place.root) not in self._found:
            return False
        return place.type is not Kind.INT or isinstance(place.root.type, Kind) or self._wide.is_result(place.root.type)

    def index(self, place: Place) -> bool:
        """Does an index of a place vary?"""
        return any(isinstance(step, Expr) and self.expression(step) for step in place.path)

    def arguments(self, call: Call) -> frozenset[str]:
        """Names of the parameters of a call that get something that varies, results included."""
        return frozenset(p.name for p, value in call.pairs if p.direction != "in" or self.expression(value))

    def _spread(self, body: Statements, condition: bool) -> bool:
        """One pass over a body; `condition`: it is done by some states only. True where something new was found."""
        before = len(self._found)
        for s in body:
            match s:
                case Let(variable, value) if self.expression(value):
                    self._found.add(id(variable))
                case Set(place, value) | Copy(place, value) if condition or self.expression(value):
                    self._found.add(id(place.root))
                case Do(call):
                    results = (value for p, value in call.pairs if p.direction != "in")
                    self._found |= {id(value.root) for value in results if isinstance(value, Place)}
            now = condition or (isinstance(s, When) and self.expression(s.condition))
            for inner in blocks(s):
                self._spread(inner, now)
        return len(self._found) > before


@dataclass(eq=False)
class _Stretch:
    """Statements for every lane, those that are the same for all and come before them, and notes that come after."""

    before: list[Statement] = field(default_factory=list)
    lanes: list[Statement] = field(default_factory=list)
    after: list[Statement] = field(default_factory=list)


@dataclass(eq=False)
class _Nested:
    """A loop, a condition that is the same for all, a call or a copy, with the stretches in the bodies inside."""

    statement: Statement
    bodies: list[list[_Item]] = field(default_factory=list)


_Item = _Stretch | _Nested


class _Widening:
    """One function on its way."""

    def __init__(self, widener: Widener, narrow: Function, names: frozenset[str]) -> None:
        self._widener, self._wide = widener, widener.wide
        self._narrow = narrow
        self._varying = Varying(narrow, names, self._wide)
        local = {s.variable.name for s in statements(narrow.body) if isinstance(s, Let | Declare)}
        local |= {s.index.name for s in statements(narrow.body) if isinstance(s, Loop)}
        self._fresh = FreshNames(local | {a.name for a in narrow.arguments})
        self._unset: set[int] = set()
        self._never_set: set[int] = set()
        self._read_unset: set[int] = set()
        self._scopes: dict[int, Expr | None] = {}
        self._variables: dict[int, Variable] = {}
        self._users: dict[int, set[int]] = {}
        self._waiting: dict[int, list[Variable]] = {}

    def function(self) -> Function:
        arguments: list[Argument] = []
        for a in self._narrow.arguments:
            argument = self._wide.argument(a) if self._varying.variable(id(a.variable)) else a
            arguments.append(argument)
            self._variables[id(a.variable)] = argument.variable
        items = self._split(self._with_zeros(tuple(self._select(self._narrow.body, None))))
        self._count(items)
        return replace(self._narrow, arguments=tuple(arguments), body=tuple(self._join(items)))

    # -- conditions that vary become choices ---------------------------------------------------------------------------

    def _select(self, body: Statements, where: Expr | None) -> list[Statement]:
        """Statements under the condition `where` that varies, without conditions that vary."""
        statements: list[Statement] = []
        for s in body:
            match s:
                case Set(place, value) if where is not None and not self._is_private(place, where):
                    if id(place.root) in self._never_set:
                        self._read_unset.add(id(place.root))
                    place = self._guarded(place, where)
                    new = place + value if s.add else value
                    statements.append(Set(place, select(where, new, place), s.comment))
                case Set(place):
                    self._unset.discard(id(place.root))
                    self._never_set.discard(id(place.root))
                    statements.append(s)
                case When(condition) if self._varying.expression(condition):
                    statements += self._when(s, where)
                case When(condition) if where is not None and not on_ints(condition):
                    statements += self._when(s, where)
                case When():
                    yes, no = self._select(s.body, where), self._select(s.otherwise, where)
                    statements.append(replace(s, body=tuple(yes), otherwise=tuple(no)))
                case Loop():
                    # What was declared before the loop may have a value from the turn before.
                    before, self._unset = self._unset, set()
                    statements.append(replace(s, body=tuple(self._select(s.body, where))))
                    self._unset = before
                case Declare(variable):
                    if (
                        variable.written and variable.place.is_scalar
                    ):  # its first value is every state's: none reads it before its own
                        self._unset.add(id(variable))
                    if isinstance(variable.type, Kind) and all(int(length) == 1 for length in variable.shape):
                        self._never_set.add(id(variable))
                    self._scopes[id(variable)] = where
                    statements.append(s)
                case Let() | Note():
                    statements.append(s)
                case Do(call) if where is None:
                    passed = {id(a.root) for a in call.arguments if isinstance(a, Place)}
                    self._unset -= passed
                    self._never_set -= passed
                    statements.append(s)
                case Copy() if where is None:
                    statements.append(s)
                case _:
                    raise TypeError(f"{self._narrow.name}: {type(s).__name__} under a condition that varies")
        return statements

    def _is_private(self, place: Place, where: Expr) -> bool:
        """May all states set a variable where it has no value yet, or where only states under `where` ever read it?"""
        root = id(place.root)
        return root in self._unset or self._scopes.get(root) is where

    def _with_zeros(self, body: Statements) -> Statements:
        """A body where single numbers are 0 at first that a choice reads before they have a value."""
        made: list[Statement] = []
        for s in body:
            made.append(with_blocks(s, self._with_zeros))
            if isinstance(s, Declare) and id(s.variable) in self._read_unset:
                place = s.variable.place
                while place.shape:
                    place = place[0]
                made.append(Set(place, Const(0, place.kind)))
        return tuple(made)

    def _when(self, s: When, where: Expr | None) -> list[Statement]:
        """Both branches of a condition that varies."""
        if where is None and not s.otherwise and any(isinstance(x, Do) for x in s.body) and _only_refuse(s.body):
            return self._anywhere(s)
        condition = s.condition if where is None else and_(where, s.condition)
        cut = self._is_cut(s)
        if len(s.body) == 1 and not s.otherwise and not cut:
            return self._select(s.body, condition)
        kept = Let(Variable(self._fresh("where"), Kind.BOOL), condition)
        self._varying.add(kept.variable)
        applies = kept.variable.place
        if cut and not s.otherwise:
            return [kept, *self._if_any(applies, self._select(s.body, applies))]
        statements: list[Statement] = [kept, *self._select(s.body, applies)]
        if s.otherwise:
            otherwise: Expr = Not(applies)
            statements += self._select(s.otherwise, otherwise if where is None else and_(where, otherwise))
        return statements

    def _is_cut(self, s: When) -> bool:
        """Are there several stretches under a condition, because of a loop or of a condition on ints of the stand?"""
        return any(
            isinstance(x, Loop)
            or (isinstance(x, When) and on_ints(x.condition) and not self._varying.expression(x.condition))
            for x in statements((*s.body, *s.otherwise))
        )

    def _if_any(self, condition: Expr, body: list[Statement]) -> list[Statement]:
        """Statements that are done for all states where the condition holds for one of them."""
        flag = Variable(self._fresh("any"), Kind.WORD, written=True)
        gathered = Set(flag.place, flag.place | select(condition, word(1), word(0)))
        return [Declare(flag), Set(flag.place, word(0)), gathered, When(unequal(flag.place, word(0)), tuple(body))]

    def _guarded(self, place: Place, where: Expr) -> Place:
        """A place whose index is 0 where it has no meaning: of states that are not under `where`."""
        if not self._varying.index(place):
            return place
        steps = (select(where, step, integer(0)) if isinstance(step, Expr) else step for step in place.path)
        return Place(place.root, tuple(steps), place.type, place.shape)

    def _anywhere(self, s: When) -> list[Statement]:
        """Calls that do nothing but refuse, of every state that they have to: done for all where one state needs it."""
        return self._if_any(s.condition, self._select(s.body, None))

    # -- cutting into stretches ----------------------------------------------------------------------------------------

    def _split(self, body: Statements) -> list[_Item]:
        items: list[_Item] = []
        stretch = _Stretch()
        for s in body:
            if self._into(s, stretch):
                continue
            while stretch.lanes and isinstance(stretch.lanes[-1], Note):
                stretch.after.insert(0, stretch.lanes.pop())
            items += [stretch, _Nested(s, [self._split(inner) for inner in blocks(s)])]
            stretch = _Stretch()
        return [*items, stretch]

    def _into(self, s: Statement, stretch: _Stretch) -> bool:
        """Adds a statement to a stretch; False where it ends the stretch."""
        match s:
            case Let(variable) | Declare(variable) if not self._varying.variable(id(variable)):
                stretch.before.append(s)
            case Note() | Let() | Declare():
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
                let = {id(s.variable) for s in item.lanes if isinstance(s, Let)}
                self._use(id(item), used_variables(item.lanes) | let)
            elif isinstance(item.statement, Do | Copy):
                for user in (id(item), 0):  # a second user: what is passed on needs all its lanes
                    self._use(user, used_variables([item.statement]))
            else:
                for body in item.bodies:
                    self._count(body)

    def _use(self, user: int, variables: set[int]) -> None:
        for identity in variables:
            self._users.setdefault(identity, set()).add(user)

    # -- joining them in lanes -----------------------------------------------------------------------------------------

    def _join(self, items: list[_Item]) -> Iterator[Statement]:
        """Statements in lanes."""
        for item in items:
            if isinstance(item, _Stretch):
                yield from self._loop(item)
                continue
            s = item.statement
            if isinstance(s, Do):
                yield replace(s, call=self._call(s.call))
                continue
            names = ("body", "otherwise")
            inner = {name: tuple(self._join(body)) for name, body in zip(names, item.bodies, strict=False)}
            yield map_expressions(s, lambda e: self._expr(e, None), **inner)

    def _call(self, call: Call) -> Call:
        """The wide form of a function is called."""
        callee = self._widener.function(self._widener.narrow(call.signature.name), self._varying.arguments(call))
        return Call(callee.signature, tuple(self._expr(a, None) for a in call.arguments))

    def _loop(self, stretch: _Stretch) -> Iterator[Statement]:
        """A stretch as a loop over lanes, after what is the same for all and the arrays that it needs."""
        yield from (map_expressions(s, lambda e: self._expr(e, None)) for s in stretch.before)
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
                    lanes = self._widen_variable(variable)
                    outer.append(Declare(lanes, s.comment))
                    if variable.type is Kind.BOOL:
                        value = select(value, word(1), word(0))
                    inner.append(Set(lanes.place.at[index.place], self._expr(value, index.place)))
                case Set(place, value) if place.type is Kind.INT and self._wide.is_result(place.root.type):
                    whole = cast(Place, self._leaf(place, index.place))
                    inner.append(Set(whole, Convert(self._expr(value, index.place), Kind.REAL)))
                case _:
                    inner.append(map_expressions(s, lambda e: self._expr(e, index.place)))
        yield from outer
        if all(isinstance(s, Note) for s in inner):
            yield from inner
        else:
            yield Loop(index, integer(0), integer(self._wide.lanes), late(inner, index, self._fresh))
        yield from stretch.after

    def _widen_variable(self, v: Variable) -> Variable:
        self._variables[id(v)] = Variable(v.name, self._wide.of(v.type), v.shape)
        return self._variables[id(v)]

    def _expr(self, e: Expr, lane: Place | None) -> Expr:
        expression = rebuilt(e, lambda place: self._leaf(place, lane))
        return expression if lane is None else _without_branches(expression)

    def _leaf(self, place: Place, lane: Place | None) -> Expr:
        """A place after its root has become wide; for a scalar, its element at `lane`."""
        variable = self._variables.get(id(place.root))
        if variable is None or variable is place.root:
            return place
        type_ = place.type
        if self._varying.place(place):
            type_ = (
                self._wide.real if isinstance(place.root.type, Struct) and type_ is Kind.INT else self._wide.of(type_)
            )
        whole = Place(variable, place.path, type_, place.shape)
        if place.shape or type_ is place.type or lane is None or not isinstance(place.type, Kind):
            return whole
        return unequal(whole.at[lane], word(0)) if place.type is Kind.BOOL else whole.at[lane]


def _without_branches(e: Expr) -> Expr:
    """The same value where both sides of `&&`, `||` and of a choice of reals are computed: no loop has a branch."""
    if isinstance(e, Logic):
        return Binary(e.operator[0], _without_branches(e.left), _without_branches(e.right))
    if isinstance(e, Select) and e.kind is Kind.REAL and not _is_magnitude(e):
        return Choice(_without_branches(e.condition), _without_branches(e.yes), _without_branches(e.no))
    return e.with_operands(_without_branches)


def _is_magnitude(e: Select) -> bool:
    """Is a choice one between an element of an array and its negative, of which compilers make no branch?"""
    number = e.yes.operand if isinstance(e.yes, Negate) else None
    return isinstance(number, Place) and bool(number.path) and are_same(number, e.no)


def _only_refuse(body: Statements) -> bool:
    """Do statements write nothing but `refused` and variables of their own?"""
    local = {id(s.variable) for s in statements(body) if isinstance(s, Declare)}
    for s in statements(body):
        match s:
            case Do(call):
                fine = [a.name for a in call.signature.arguments if a.direction != "in"] == [REFUSED]
            case Set(place):
                fine = place.root.name == REFUSED or id(place.root) in local
            case _:
                fine = isinstance(s, Let | Declare | Note | When)
        if not fine:
            return False
    return True


Step = str | int
Key = tuple[Step, ...]
"""A place in words: its root's `id`, members, numbers of constant indices, and of others the `id` of a variable."""


def late(body: Sequence[Statement], lane: Variable, name: Callable[[str], str]) -> tuple[Statement, ...]:
    """The body of a loop over `lane` with stores of what it reads again at its end; `name`: makes a new name."""
    if not all(isinstance(s, Let | Set | Note) or not direct_expressions(s) for s in body):
        return tuple(body)
    scalars = _scalars(body, lane)
    values: dict[Key, Variable] = {}

    def leaf(place: Place) -> Expr:
        value = values.get(_key(place) or ())
        return place if value is None else value.place

    statements: list[Statement] = []
    for s in body:
        key = _key(s.place) if isinstance(s, Set) else None
        if isinstance(s, Set) and key in scalars:
            new = rebuilt(s.value, leaf)
            if s.add:
                new = values[key].place + new
            values[key] = Variable(name(_name(s.place)), s.place.kind)
            statements.append(Let(values[key], new, s.comment))
        else:
            statements.append(map_expressions(s, lambda e: rebuilt(e, leaf)))
    stores = (Set(place, values[key].place) for key, place in scalars.items() if key in values)
    return (*statements, *stores)


def _scalars(body: Sequence[Statement], lane: Variable) -> dict[Key, Place]:
    """Elements of arrays of lanes that a body sets first and reads again, and that no other place may meet."""
    places: dict[Key, Place] = {}
    set_first: set[Key] = set()
    read_again: set[Key] = set()
    unclear: set[int] = set()  # roots of elements whose index is computed

    def key_of(place: Place) -> Key | None:
        key = _key(place) if lane in _indices(place) else None
        if key is not None:
            places.setdefault(key, place)
        elif lane in _indices(place):
            unclear.add(id(place.root))
        return key

    for s in body:
        target = s.place if isinstance(s, Set) else None
        for x in (x for e in direct_expressions(s) for x in inside(e)):
            if isinstance(x, Place) and x is not target and (key := key_of(x)) is not None:
                read_again.add(key)
        if isinstance(s, Set) and (key := key_of(s.place)) is not None:
            if s.add:
                read_again.add(key)
            elif key not in read_again:
                set_first.add(key)
    return {
        key: place
        for key, place in places.items()
        if key in set_first
        and key in read_again
        and id(place.root) not in unclear
        and not any(_may_meet(key, other) for other in places)
    }


def _indices(place: Place) -> list[Variable]:
    """Variables that index a place."""
    return [step.root for step in place.path if isinstance(step, Place)]


def _key(place: Place) -> Key | None:
    """A place in words; None where an index is computed."""
    steps: list[Step] = [id(place.root)]
    for step in place.path:
        match step:
            case str():
                steps.append(step)
            case Const() if not step.name:
                steps.append(int(step.value))
            case Place(root=root, path=()):
                steps.append(f"[{id(root)}]")
            case _:
                return None
    return tuple(steps)


def _may_meet(one: Key, other: Key) -> bool:
    """Can two different places be the same number? Not where a member or a constant index differs."""
    if one == other or one[0] != other[0]:
        return False
    return not any(a != b and _is_fixed(a) and _is_fixed(b) for a, b in zip(one, other, strict=False))


def _is_fixed(step: Step) -> bool:
    return isinstance(step, int) or not step.startswith("[")


def _name(place: Place) -> str:
    """A name for the value of one lane."""
    steps = (str(int(step.value)) if isinstance(step, Const) else step for step in place.path)
    return "_".join(("lane", place.root.name, *(step for step in steps if isinstance(step, str) and step != "at")))
