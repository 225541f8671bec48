"""What a function costs by its own tree, loops and calls included: operations, and a bound of its stack.

Operations are arithmetic on reals, the same for every compiler; instructions and cycles depend on it and are measured
elsewhere. Of two branches the more expensive one is counted, so a count is an upper bound.

What a compiler makes of a function is not known here, so a bound of the stack is generous: measured frames of gcc and
clang, at -O1 to -O3 and -Os, 32 and 64 bits, stay below it; tests/emit/test_stack.py compares.
"""

from __future__ import annotations

from functools import lru_cache
from operator import add
from typing import NamedTuple

from mahovik.core.program.call import Call
from mahovik.core.program.expression import Binary, Compare, Const, Expr, Place, Select
from mahovik.core.program.function import Function, Program
from mahovik.core.program.simplify import Range, range_of
from mahovik.core.program.statement import Block, Declare, Let, Loop, Set, Statement, Statements, When
from mahovik.core.program.types import Kind, Struct, numbers
from mahovik.core.program.walk import called_names, direct_expressions, inside, statements


class Cost(NamedTuple):
    """Real operations: additions and subtractions, multiplications, divisions, comparisons and selections."""

    additions: int = 0
    multiplications: int = 0
    divisions: int = 0
    comparisons: int = 0

    @property
    def total(self) -> int:
        return sum(self)

    def __add__(self, other: Cost) -> Cost:  # type: ignore[override]  # of numbers, not of their lists
        return self if other is ZERO else Cost(*map(add, self, other))

    def times(self, count: int) -> Cost:
        return Cost(*(number * count for number in self))


ZERO = Cost()


def cost(function: Function, functions: tuple[Function, ...] = ()) -> Cost:
    """Operations of one call of `function`. `functions`: a whole program's, among them those that it calls."""
    counter = _counter(functions)
    return counter.call(function.name, {}) if function in functions else counter.block(function.body, {})


@lru_cache(maxsize=8)
def _counter(functions: tuple[Function, ...]) -> _Counter:
    return _Counter(functions)


class _Counter:
    """Operations of calls within one program. Each function is counted once for each set of known integer arguments.

    `bound`: integers that are known, by the `id` of their variables, as ranges of one number.
    """

    def __init__(self, functions: tuple[Function, ...]) -> None:
        self._functions = {f.name: f for f in functions}
        self._done: dict[tuple[str, tuple[tuple[int, Range], ...]], Cost] = {}

    def call(self, name: str, bound: dict[int, Range]) -> Cost:
        """Operations of one call of a function of the program."""
        key = (name, tuple(bound.items()))
        if key not in self._done:
            self._done[key] = self.block(self._functions[name].body, bound)
        return self._done[key]

    def block(self, body: Statements, bound: dict[int, Range]) -> Cost:
        """Operations of statements, with these integer arguments known."""
        return sum((self._statement(s, bound) for s in body), ZERO)

    def _statement(self, s: Statement, bound: dict[int, Range]) -> Cost:
        cost = sum((self._expr(e, bound) for e in direct_expressions(s)), ZERO)
        match s:
            case Set(_, value, _, True) if value.kind is Kind.REAL:
                return cost + Cost(additions=1)
            case Block(body):
                return self.block(body, bound)
            case Loop():
                return cost + self._loop(s, bound)
            case When(_, body, otherwise):
                one, two = self.block(body, bound), self.block(otherwise, bound)
                return cost + (one if one.total >= two.total else two)
        return cost

    def _loop(self, loop: Loop, bound: dict[int, Range]) -> Cost:
        """Turns times body; turn by turn where an inner loop's bounds depend on the index."""
        first, last = range_of(loop.start, bound), range_of(loop.stop, bound)
        if first is None or last is None:
            return self.block(loop.body, bound).times(loop.most)
        start, stop, index = first[0], last[0], id(loop.index)
        if index in _variables_in_bounds(loop.body):
            turns = (self.block(loop.body, bound | {index: (turn, turn)}) for turn in range(start, stop))
            return sum(turns, ZERO)
        return self.block(loop.body, bound).times(max(0, stop - start))

    def _expr(self, e: Expr, bound: dict[int, Range]) -> Cost:
        cost = sum((self._expr(part, bound) for part in e.operands if not isinstance(e, Place)), ZERO)
        match e:
            case Binary() if e.kind is Kind.REAL:
                return cost + {"+": Cost(1), "-": Cost(1), "*": Cost(0, 1), "/": Cost(0, 0, 1)}[e.operator]
            case Compare() if e.left.kind is Kind.REAL:
                return cost + Cost(comparisons=1)
            case Select() if e.kind is Kind.REAL:
                return cost + Cost(comparisons=1)
            case Call():
                numbers = ((p, int(a.value)) for p, a in e.pairs if isinstance(a, Const) and a.kind is Kind.INT)
                return cost + self.call(e.signature.name, {id(p.variable): (n, n) for p, n in numbers})
        return cost


def _variables_in_bounds(body: Statements) -> set[int]:
    """`id` of the variables in the bounds of the loops of a body."""
    bounds = (side for s in statements(body) if isinstance(s, Loop) for side in (s.start, s.stop))
    return {id(e.root) for side in bounds for e in inside(side) if isinstance(e, Place)}


# ---- stack ----

FRAME = 48
"""Stack of a call itself, bytes: return address and saved registers."""

SCALAR = 8
"""Stack of a scalar local, an argument or an index, bytes: a compiler may keep each of them in memory."""

SHARE = 1.25
"""Factor on both and on arrays: copies that a compiler makes where it inlines, unrolls and forms vectors."""

START = 128
"""Stack that is added once, bytes: a function may save all registers of a processor."""

TEMPORARIES = 56
"""Results of operations without a name that a compiler keeps at once, where it unrolls a loop; each as a scalar."""

_STEP = 16
"""A bound is a multiple of this, to which compilers align frames."""


def stack_bound(function: Function, program: Program) -> int:
    """Upper bound of the stack that a call takes, with all functions that it calls; bytes."""
    deepest = SHARE * _deepest(function, program.precision.width // 8, _depths(program)) + START
    deepest += SCALAR * min(cost(function, program.whole).total, TEMPORARIES)
    return -int(-deepest // _STEP) * _STEP


@lru_cache(maxsize=8)
def _depths(program: Program) -> dict[str, int]:
    """Stack of the deepest chain of calls from each function, bytes. Functions come after those that they call."""
    depths: dict[str, int] = {}
    for function in program.whole:
        depths[function.name] = _deepest(function, program.precision.width // 8, depths)
    return depths


def _deepest(function: Function, width: int, below: dict[str, int]) -> int:
    return _frame(function, width) + max((below[name] for name in called_names(function.body)), default=0)


def _frame(function: Function, width: int) -> int:
    """Arrays and structs in full, side by side, and all else."""
    large, scalars = 0, len(function.arguments)
    for s in statements(function.body):
        match s:
            case Let(variable) | Declare(variable) if variable.shape or isinstance(variable.type, Struct):
                large += numbers(variable.type, variable.shape) * width
            case Let() | Declare() | Loop():
                scalars += 1
    return large + SCALAR * scalars + FRAME
