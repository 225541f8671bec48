"""Functions without early returns: what they would return becomes a number, `refused`, and computing goes on.

States side by side cannot leave a function one by one. So a function of a status becomes one without result, and gets
an argument `refused`: 0 for a good state, else a code of the first status that it would have returned. After a refusal
numbers without meaning are computed, which nobody reads; bounds of loops and indices never depend on them. A positive
status refuses nothing: it is returned last, after the results are written.

Checks that only look at inputs are done twice. First a `probe`: is anything wrong, in any order? It costs less, and
mostly all is well; only where not the check itself says what. It gathers words: of `suspect` the top bit counts.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from mahovik.contract.status import STATUS_VALUES
from mahovik.core.program.call import Argument, Call, Signature
from mahovik.core.program.expression import (
    BitCast,
    Compare,
    Const,
    Convert,
    Expr,
    Logic,
    Negate,
    Not,
    Place,
    Status,
    Variable,
    equal,
    integer,
    select,
    unequal,
    word,
)
from mahovik.core.program.function import Function
from mahovik.core.program.statement import (
    Declare,
    Do,
    Loop,
    Return,
    Set,
    Shortcut,
    Statement,
    Statements,
    When,
)
from mahovik.core.program.types import Kind, Precision
from mahovik.core.program.walk import are_same, blocks, called_names, inside, statements, used_variables, with_blocks

REFUSED = "refused"
"""Name of the argument."""

POSITIVE = 256
"""Codes: the negative of a negative status; this number and a positive status."""

_NO_STATUS: dict[str, Any] = {"returns": None, "statuses": (), "public": False}


def without_returns(functions: tuple[Function, ...], precision: Precision) -> dict[str, Function]:
    """Functions, each after those it calls, by name: those of a status with `refused`, the others as they are."""
    done: dict[str, Function] = {}
    looking: set[str] = set()
    for f in reversed(functions):
        if _only_looks(f) or f.name in looking:
            looking |= called_names(f.body)
    for function in functions:
        refusing = function.returns is Kind.STATUS
        if refusing and not _only_looks(function):
            done[_unchecked_name(function)] = _Rewriting(done, precision).unchecked(function)
        done[function.name] = _Rewriting(done, precision).refusing(function) if refusing else _with_result(function)
        if _only_looks(function) or (refusing and function.name in looking):
            done[_probe_name(function)] = _Rewriting(done, precision).probe(function)
    return done


def _with_result(function: Function) -> Function:
    """A function whose value is returned in several places, with a result in place of the value; others as they are."""
    if not any(isinstance(s, Return) for s in statements(function.body) if s is not function.body[-1]):
        return function
    assert function.returns is not None
    value = Argument("value", function.returns, (), "out")

    def body(block: Statements) -> Statements:
        for number, s in enumerate(block):
            if isinstance(s, Return):
                return (*block[:number], Set(value.place, s.value))
            if isinstance(s, When) and _returns((s,)):
                rest = block[number + 1 :]
                return (*block[:number], replace(s, body=body((*s.body, *rest)), otherwise=body((*s.otherwise, *rest))))
        return block

    return replace(function, arguments=(*function.arguments, value), body=body(function.body), returns=None)


def _only_looks(function: Function | Signature) -> bool:
    """Does a function of a status write nothing?"""
    return function.returns is Kind.STATUS and all(a.direction == "in" for a in function.arguments)


def _probe_name(function: Function | Signature) -> str:
    return f"{function.name}_probe"


def _unchecked_name(function: Function | Signature) -> str:
    return f"{function.name}_unchecked"


def _checks(body: Statements) -> Iterator[tuple[Call | None, Statement]]:
    """Statements one by one; `status = f(..); if (status != OK) return ..;` comes as the call and the return.

    Shortcuts are left out: without them all is the same, and a probe is one itself.
    """
    position = 0
    body = tuple(s for s in body if not isinstance(s, Shortcut))
    while position < len(body):
        s = body[position]
        following = body[position + 1] if position + 1 < len(body) else None
        if isinstance(s, Set) and isinstance(s.value, Call) and s.place.kind is Kind.STATUS:
            returned = _return_of(following, s.place)
            if returned is None:
                raise TypeError(f"the status of {s.value.signature.name} is not returned at once")
            yield s.value, returned
            position += 2
            continue
        yield None, s
        position += 1


def _return_of(s: Statement | None, status: Place) -> Return | None:
    """What `if (status != OK) return ..` returns: the status, or another one; None of another statement."""
    if not isinstance(s, When) or not isinstance(s.condition, Compare) or s.condition.operator != "!=":
        return None
    left, right = s.condition.left, s.condition.right
    same = isinstance(left, Place) and left.root is status.root and isinstance(right, Status) and right.name == "OK"
    only = s.body[0] if same and len(s.body) == 1 and not s.otherwise else None
    return only if isinstance(only, Return) else None


def _code(status: Expr) -> Expr:
    """The code of a status by name, or of one that is made of bits."""
    if isinstance(status, Convert):
        bits = status.operand
        return select(equal(bits, integer(0)), word(0), Convert(bits, Kind.WORD) + word(POSITIVE))
    if not isinstance(status, Status):
        raise TypeError("only a status by name, or one made of bits, can be returned here")
    value = STATUS_VALUES[status.name]
    return word(POSITIVE + value if value > 0 else -value)


class _Rewriting:
    """Makes of a function of a status the one with `refused`, the one that checks nothing, or the probe."""

    def __init__(self, done: dict[str, Function], precision: Precision) -> None:
        self._done, self._width = done, precision.width
        self._refused = Argument(REFUSED, Kind.WORD, (), "inout", "", "0, or the negative of the status")
        self._suspect = Argument("suspect", Kind.WORD, (), "inout")
        self._probes = False

    # -- with `refused` ------------------------------------------------------------------------------------------------

    def refusing(self, function: Function) -> Function:
        """The function with `refused`."""
        self._probes = not _only_looks(function)
        body, arguments = self._body(function.body), function.arguments
        if function.public or id(self._refused.variable) in used_variables(body):
            arguments = (*arguments, self._refused)  # others never refuse, such as the rates of a clamped carrier
        return replace(function, arguments=arguments, body=body, **_NO_STATUS)

    def _body(self, body: Statements) -> Statements:
        statements: list[Statement] = []
        looks: list[Call] = []
        for call, s in _checks(body):
            other = s if isinstance(s, Return) and isinstance(s.value, Status) else None
            if call is not None and other is None and self._probes and _only_looks(call.signature):
                looks.append(call)
                continue
            statements += self._merge_probes(looks)
            looks = []
            if call is None:
                statements += self._statement(s)
            elif other is not None and self._may_refuse(call):
                statements += self._rename_status(call, other)
            else:
                statements.append(self._do(call))
        return (*statements, *self._merge_probes(looks))

    def _do(self, call: Call, refused: Place | None = None) -> Do:
        signature, arguments = self._done[call.signature.name].signature, call.arguments
        if not self._may_refuse(call):
            return Do(Call(signature, arguments))
        return Do(Call(signature, (*arguments, self._refused.place if refused is None else refused)))

    def _may_refuse(self, call: Call) -> bool:
        """Whether the function that is called has `refused`."""
        return any(a.name == REFUSED for a in self._done[call.signature.name].arguments)

    def _rename_status(self, call: Call, s: Return) -> Iterator[Statement]:
        """A call after which another status is returned than its own."""
        failed = Variable("failed", Kind.WORD, written=True)
        yield Declare(failed, "not 0: without an answer")
        yield Set(failed.place, word(0))
        yield self._do(call, failed.place)
        yield When(unequal(failed.place, word(0)), tuple(self._statement(s)))  # of a refused state nothing changes

    def _merge_probes(self, looks: list[Call]) -> Iterator[Statement]:
        """Probes of checks that follow one another; the checks themselves where one of them finds something."""
        if not looks:
            return
        suspect = Variable("suspect", Kind.WORD, written=True)
        yield Declare(suspect, "top bit set: something is wrong with the inputs")
        yield Set(suspect.place, word(0))
        for call in looks:
            yield Do(Call(self._done[_probe_name(call.signature)].signature, (*call.arguments, suspect.place)))
        wrong = unequal(suspect.place >> (self._width - 1), word(0))
        yield When(wrong, tuple(self._do(call) for call in looks))

    def _statement(self, s: Statement) -> Iterator[Statement]:
        match s:
            case Declare(variable) if variable.type is Kind.STATUS:
                return
            case Return(Call() as call):
                yield self._do(call)
            case Do(call) if call.signature.returns is Kind.STATUS:  # it was checked before, and cannot refuse here
                yield Do(Call(self._done[_unchecked_name(call.signature)].signature, call.arguments))
            case Return(value):
                place, code = self._refused.place, _code(value)
                if not (isinstance(code, Const) and code.value == 0):
                    yield Set(place, select(equal(place, word(0)), code, place))
            case _:
                yield with_blocks(s, self._body)

    # -- without checks, for calls whose arguments were checked before -------------------------------------------------

    def unchecked(self, function: Function) -> Function:
        """The function that checks nothing."""
        body = tuple(self._unchecked_body(function.body))
        return replace(function, name=_unchecked_name(function), body=body, **_NO_STATUS)

    def _unchecked_body(self, body: Statements) -> Iterator[Statement]:
        for call, s in _checks(body):
            if call is not None:
                if not _only_looks(call.signature):
                    yield Do(Call(self._done[_unchecked_name(call.signature)].signature, call.arguments))
                continue
            match s:
                case Declare(variable) if variable.type is Kind.STATUS:
                    pass
                case Return():
                    pass
                case When(_, inner, ()) if isinstance(inner[-1], Return):
                    pass
                case When() | Loop():
                    kept = with_blocks(s, lambda inner: tuple(self._unchecked_body(inner)))
                    if any(blocks(kept)):
                        yield kept
                case Do(call) if call.signature.returns is Kind.STATUS:
                    yield Do(Call(self._done[_unchecked_name(call.signature)].signature, call.arguments))
                case _:
                    yield s

    # -- probes --------------------------------------------------------------------------------------------------------

    def probe(self, function: Function) -> Function:
        """The probe of a function that only looks: `suspect` gets its top bit set where it would not return OK."""
        return replace(
            function,
            name=_probe_name(function),
            purpose=f"{function.purpose} Here only whether something is wrong.",
            arguments=(*function.arguments, self._suspect),
            body=tuple(self._probe_body(function.body)),
            **_NO_STATUS,
        )

    def _probe_body(self, body: Statements) -> Iterator[Statement]:
        for call, s in _checks(body):
            if call is not None:
                yield self._probe(call)
                continue
            match s:
                case Declare(variable) if variable.type is Kind.STATUS:
                    pass
                case Return(Status(name="OK")):
                    pass
                case Return(Call() as last):
                    yield self._probe(last)
                case When(condition, inner, ()) if isinstance(inner[-1], Return) or _only_checks(inner):
                    yield Set(self._suspect.place, self._suspect.place | self._doubt(condition))
                case When(condition, inner, ()) if _returns(inner) and not on_ints(condition):
                    yield from self._probe_body(inner)  # more is suspected than is wrong
                case When() | Loop():
                    yield with_blocks(s, lambda inner: tuple(self._probe_body(inner)))
                case _:
                    yield s

    def _probe(self, call: Call) -> Do:
        return Do(Call(self._done[_probe_name(call.signature)].signature, (*call.arguments, self._suspect.place)))

    def _doubt(self, condition: Expr) -> Expr:
        """A word whose top bit is set where a condition holds; of limits without a comparison: loops over it vectorise.

        Without their signs, bits of reals are in the order of the reals, infinity and NaN last; so the difference of
        two is negative where the first is smaller.
        """
        outside = _outside(condition)
        if outside is None:
            return select(condition, word(1 << (self._width - 1)), word(0))
        value, limit = outside
        return BitCast(limit, Kind.WORD) - (BitCast(value, Kind.WORD) & word((1 << (self._width - 1)) - 1))


def _returns(body: Statements) -> bool:
    """Is there a return in a body?"""
    return any(isinstance(s, Return) for s in statements(body))


def _only_checks(body: Statements) -> bool:
    """Does a body nothing but call checks that only look?"""
    return all(call is not None and _only_looks(call.signature) for call, _ in _checks(body))


def on_ints(condition: Expr) -> bool:
    """Is a condition about ints? It may guard an index, so that its body must not be done for all states."""
    return any(isinstance(x, Place) and x.kind is Kind.INT for x in inside(condition))


def _outside(condition: Expr) -> tuple[Expr, Expr] | None:
    """Value and limit of `!(value >= -limit && value <= limit)`; None of another condition."""
    match condition:
        case Not(
            operand=Logic(
                operator="&&",
                left=Compare(operator=">=", left=Place() as value, right=Negate(operand=below)),
                right=Compare(operator="<=", left=same, right=limit),
            )
        ) if value is same and are_same(below, limit):
            return value, limit
    return None
