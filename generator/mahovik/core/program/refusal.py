"""Functions without early returns: what they would return becomes a number, `refused`, and computing goes on.

States side by side cannot leave a function one by one. So a function of a status becomes one without result, and gets
an argument `refused`: 0 for a good state, else the negative of the first status that it would have returned. All
statuses that are returned so are OK or negative. After a refusal numbers without meaning are computed, which nobody
reads; bounds of loops and indices never depend on them.

Checks that only look at inputs are done twice. First a `probe`: is anything wrong, in any order? It costs less, and
mostly all is well; only where not the check itself says what.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from mahovik.contract.status import STATUS_VALUES
from mahovik.core.program.call import Argument, Call, Signature
from mahovik.core.program.expression import Compare, Expr, Place, Status, Variable, equal, select, unequal, word
from mahovik.core.program.function import Function
from mahovik.core.program.statement import Block, Declare, Do, Let, Loop, Note, Return, Set, Statement, When
from mahovik.core.program.types import Kind
from mahovik.core.program.walk import called

REFUSED = "refused"
"""Name of the argument."""


def without_returns(functions: tuple[Function, ...]) -> dict[str, Function]:
    """Functions, each after those it calls, by name: those of a status with `refused`, the others as they are."""
    done: dict[str, Function] = {}
    for function in functions:
        done[function.name] = _Refusing(done).function(function) if function.returns is Kind.STATUS else function
        if _only_looks(function):
            done[_probe_name(function)] = _Probing(done).function(function)
    return done


def _only_looks(function: Function | Signature) -> bool:
    """Does a function of a status write nothing?"""
    return function.returns is Kind.STATUS and all(a.direction == "in" for a in function.arguments)


def _probe_name(function: Function | Signature) -> str:
    return f"{function.name}_probe"


def _checks(body: tuple[Statement, ...]) -> Iterator[tuple[Call | None, Statement]]:
    """Statements one by one; `status = f(..); if (status != OK) return status;` comes as the call."""
    position = 0
    while position < len(body):
        s = body[position]
        following = body[position + 1] if position + 1 < len(body) else None
        if isinstance(s, Set) and isinstance(s.value, Call) and s.place.kind is Kind.STATUS:
            if not _returns_it(following, s.place):
                raise TypeError(f"the status of {s.value.signature.name} is not returned at once")
            yield s.value, s
            position += 2
            continue
        yield None, s
        position += 1


def _returns_it(s: Statement | None, status: Place) -> bool:
    """Is it `if (status != OK) return status`?"""
    if not isinstance(s, When) or not isinstance(s.condition, Compare) or s.condition.operator != "!=":
        return False
    left, right = s.condition.left, s.condition.right
    same = isinstance(left, Place) and left.root is status.root and isinstance(right, Status) and right.name == "OK"
    return same and len(s.body) == 1 and isinstance(s.body[0], Return) and not s.otherwise


class _Refusing:
    """Makes the function with `refused`."""

    def __init__(self, done: dict[str, Function]) -> None:
        self._done = done
        self._refused = Argument(REFUSED, Kind.WORD, (), "inout", "", "0, or the negative of the status")

    def function(self, function: Function) -> Function:
        if function.returns is not Kind.STATUS:
            return function
        self._probes = not _only_looks(function)
        arguments = (*function.arguments, self._refused)
        return replace(
            function, arguments=arguments, body=self._body(function.body), returns=None, statuses=(), public=False
        )

    def _body(self, body: tuple[Statement, ...]) -> tuple[Statement, ...]:
        found: list[Statement] = []
        looks: list[Call] = []
        for call, s in _checks(body):
            if call is not None and self._probes and _only_looks(call.signature):
                looks.append(call)
                continue
            found += self._looked(looks)
            looks = []
            if call is not None:
                found.append(self._do(call))
            else:
                found += self._statement(s)
        return (*found, *self._looked(looks))

    def _do(self, call: Call) -> Do:
        return Do(Call(self._done[call.signature.name].signature, (*call.arguments, self._refused.place)))

    def _looked(self, looks: list[Call]) -> Iterator[Statement]:
        """Probes of checks that follow one another; the checks themselves where one of them finds something."""
        if not looks:
            return
        suspect = Variable("suspect", Kind.WORD, written=True)
        yield Declare(suspect, "not 0: something is wrong with the inputs")
        yield Set(suspect.place, word(0))
        for call in looks:
            yield Do(Call(self._done[_probe_name(call.signature)].signature, (*call.arguments, suspect.place)))
        yield When(unequal(suspect.place, word(0)), tuple(self._do(call) for call in looks))

    def _statement(self, s: Statement) -> Iterator[Statement]:
        match s:
            case Declare(variable) if variable.type is Kind.STATUS:
                return
            case Return(value):
                if not isinstance(value, Status):
                    raise TypeError("only a status by name can be returned here")
                code = -STATUS_VALUES[value.name]
                if code:
                    place = self._refused.place
                    yield Set(place, select(equal(place, word(0)), word(code), place))
            case Loop():
                yield replace(s, body=self._body(s.body))
            case Block():
                yield replace(s, body=self._body(s.body))
            case When():
                yield replace(s, body=self._body(s.body), otherwise=self._body(s.otherwise))
            case _:
                yield s


class _Probing:
    """Makes the probe of a function that only looks: `suspect` becomes 1 where it would not return OK."""

    def __init__(self, done: dict[str, Function]) -> None:
        self._done = done
        self._suspect = Argument("suspect", Kind.WORD, (), "inout")

    def function(self, function: Function) -> Function:
        return replace(
            function,
            name=_probe_name(function),
            purpose=f"{function.purpose} Here only whether something is wrong.",
            arguments=(*function.arguments, self._suspect),
            body=tuple(self._body(function.body)),
            returns=None,
            statuses=(),
            public=False,
        )

    def _body(self, body: tuple[Statement, ...]) -> Iterator[Statement]:
        for call, s in _checks(body):
            if call is not None:
                yield Do(
                    Call(self._done[_probe_name(call.signature)].signature, (*call.arguments, self._suspect.place))
                )
                continue
            match s:
                case Declare(variable) if variable.type is Kind.STATUS:
                    pass
                case Return(value) if isinstance(value, Status) and value.name == "OK":
                    pass
                case When(condition, inner, ()) if isinstance(inner[-1], Return):
                    yield Set(self._suspect.place, self._suspect.place | _bit(condition))
                case Loop():
                    yield replace(s, body=tuple(self._body(s.body)))
                case Let() | Note():
                    yield s
                case _:
                    raise TypeError(f"a check that only looks has no {type(s).__name__}: {sorted(called(body))}")


def _bit(condition: Expr) -> Expr:
    return select(condition, word(1), word(0))
