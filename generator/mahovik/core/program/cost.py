"""Operation counts of a program: what a function costs by its own tree, loops and calls included.

These are counts of arithmetic on reals, the same for every compiler; instructions, cycles and stack depend on it
and are measured elsewhere. Of two branches the dearer is counted, so a count is an upper bound.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

from mahovik.core.program.call import Call
from mahovik.core.program.expression import (
    Binary,
    BitCast,
    Compare,
    Const,
    Convert,
    Expr,
    Logic,
    Negate,
    Not,
    Place,
    Select,
)
from mahovik.core.program.function import Function
from mahovik.core.program.statement import Block, Copy, Declare, Do, Let, Loop, Note, Return, Set, Statement, When
from mahovik.core.program.types import Kind
from mahovik.core.program.walk import inside


@dataclass(frozen=True)
class Cost:
    """Real operations: additions and subtractions, multiplications, divisions, comparisons and selections."""

    additions: int = 0
    multiplications: int = 0
    divisions: int = 0
    comparisons: int = 0

    @property
    def total(self) -> int:
        return self.additions + self.multiplications + self.divisions + self.comparisons

    def __add__(self, other: Cost) -> Cost:
        if other is ZERO:
            return self
        return Cost(
            self.additions + other.additions,
            self.multiplications + other.multiplications,
            self.divisions + other.divisions,
            self.comparisons + other.comparisons,
        )

    def times(self, count: int) -> Cost:
        return Cost(
            self.additions * count, self.multiplications * count, self.divisions * count, self.comparisons * count
        )


ZERO = Cost()


def cost(function: Function, functions: tuple[Function, ...] = ()) -> Cost:
    """Operations of one call of `function`. `functions`: a whole program's, among them those that it calls."""
    return _counter(functions).block(function.body, {})


@lru_cache(maxsize=8)
def _counter(functions: tuple[Function, ...]) -> _Counter:
    return _Counter(functions)


class _Counter:
    """Operations of calls within one program. Each function is counted once for each set of known integer arguments."""

    def __init__(self, functions: tuple[Function, ...]) -> None:
        self._functions = {f.name: f for f in functions}
        self._done: dict[tuple[str, tuple[tuple[str, int], ...]], Cost] = {}

    def _call(self, name: str, bound: dict[str, int]) -> Cost:
        key = (name, tuple(bound.items()))
        if key not in self._done:
            self._done[key] = self.block(self._functions[name].body, bound)
        return self._done[key]

    def block(self, body: tuple[Statement, ...], bound: dict[str, int]) -> Cost:
        """Operations of statements, with these integer arguments known."""
        return sum((self._statement(s, bound) for s in body), ZERO)

    def _statement(self, s: Statement, bound: dict[str, int]) -> Cost:
        match s:
            case Note() | Declare() | Copy():
                return ZERO
            case Let(_, value) | Return(value):
                return self._expr(value, bound)
            case Set(_, value, _, add):
                extra = Cost(additions=1) if add and value.kind is Kind.REAL else ZERO
                return self._expr(value, bound) + extra
            case Do(call):
                return self._expr(call, bound)
            case Block(body):
                return self.block(body, bound)
            case Loop():
                return self._loop(s, bound)
            case When(condition, body, otherwise):
                one, two = self.block(body, bound), self.block(otherwise, bound)
                return self._expr(condition, bound) + (one if one.total >= two.total else two)
        raise TypeError(f"unknown statement {type(s).__name__}")

    def _loop(self, loop: Loop, bound: dict[str, int]) -> Cost:
        """Turns times body; turn by turn where an inner loop's bounds depend on the index."""
        start, stop = _literal(loop.start, bound), _literal(loop.stop, bound)
        if start is None or stop is None:
            return self.block(loop.body, bound).times(loop.most)
        name = loop.index.name
        if name in _names_in_bounds(loop.body):
            return sum((self.block(loop.body, bound | {name: turn}) for turn in range(start, stop)), ZERO)
        return self.block(loop.body, bound).times(max(0, stop - start))

    def _expr(self, e: Expr, bound: dict[str, int]) -> Cost:
        match e:
            case Negate() | Not() | Convert() | BitCast():
                return self._expr(e.operand, bound)
            case Binary():
                inner = self._expr(e.left, bound) + self._expr(e.right, bound)
                if e.kind is not Kind.REAL:
                    return inner
                own = {"+": Cost(1), "-": Cost(1), "*": Cost(0, 1), "/": Cost(0, 0, 1)}[e.operator]
                return inner + own
            case Compare():
                own = Cost(comparisons=1) if e.left.kind is Kind.REAL else ZERO
                return own + self._expr(e.left, bound) + self._expr(e.right, bound)
            case Logic():
                return self._expr(e.left, bound) + self._expr(e.right, bound)
            case Select():
                own = Cost(comparisons=1) if e.kind is Kind.REAL else ZERO
                return own + self._expr(e.condition, bound) + self._expr(e.yes, bound) + self._expr(e.no, bound)
            case Call():
                passed = zip(e.signature.arguments, e.arguments, strict=True)
                known = {p.name: int(a.value) for p, a in passed if isinstance(a, Const) and a.kind is Kind.INT}
                inner = sum((self._expr(a, bound) for a in e.arguments if not isinstance(a, Place)), ZERO)
                return inner + self._call(e.signature.name, known)
        return ZERO


def _names_in_bounds(body: tuple[Statement, ...]) -> set[str]:
    """Names of the variables in the bounds of the loops of a body."""
    found: set[str] = set()
    for s in body:
        if isinstance(s, Loop):
            found |= {e.root.name for side in (s.start, s.stop) for e in inside(side) if isinstance(e, Place)}
            found |= _names_in_bounds(s.body)
        elif isinstance(s, Block):
            found |= _names_in_bounds(s.body)
        elif isinstance(s, When):
            found |= _names_in_bounds((*s.body, *s.otherwise))
    return found


def _literal(e: Expr, bound: dict[str, int]) -> int | None:
    """An integer expression of literals and known names."""
    if isinstance(e, Const):
        return int(e.value)
    if isinstance(e, Place):
        return bound.get(e.root.name) if not e.path else None
    if isinstance(e, Binary) and e.operator in "+-":
        left, right = _literal(e.left, bound), _literal(e.right, bound)
        if left is not None and right is not None:
            return left + right if e.operator == "+" else left - right
    return None
