"""Functions of the program on columns: of many samples at once, every real is an array of NumPy.

`Columns` runs them operation by operation, as the interpreter does: + - * / and square roots have the interpreter's
bits. What samples do by a condition on reals is done for all of them, and selected; other branches, loops and indices
are those of Python.

`Arrays` are functions whose other inputs are numbers, those of a stand: they are run once on `Sum`s, which remember
what is done. Zeros fall out, sums of multiples become rows of a matrix, and what does not depend on one another is done
by one operation of NumPy on an array (k, M). So values agree to rounding, and the operations of NumPy are few.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cached_property
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from mahovik.core.program.expression import Compare, Const, Expr, Logic, Negate, Not, Select, Status
from mahovik.core.program.function import Function, Program
from mahovik.core.program.interpret import Interpreter, Transpiler
from mahovik.core.program.statement import Declare, Let, Loop, Note, Return, Set, Statement, Statements, When
from mahovik.core.program.types import Kind
from mahovik.core.program.walk import inside

Array: TypeAlias = NDArray[np.float64]


class _Selecting(Transpiler):
    """Conditions on reals become selections."""

    def _statement(self, s: Statement, indent: str) -> None:
        if isinstance(s, When) and _on_reals(s.condition):
            self._when(s, indent, "")
        else:
            super()._statement(s, indent)

    def _when(self, s: When, indent: str, where: str) -> None:
        """Both branches, of what is done where the variable `where` is true; "": everywhere."""
        name = f"where_{len(self._lines)}"
        condition = self._expr(s.condition)
        self._lines.append(f"{indent}{name} = {f'({where} & {condition})' if where else condition}")
        self._selected(s.body, indent, name)
        if s.otherwise:
            opposite = f"opposite({name})"
            self._lines.append(f"{indent}{name} = {f'({where} & {opposite})' if where else opposite}")
            self._selected(s.otherwise, indent, name)

    def _selected(self, body: Statements, indent: str, where: str) -> None:
        for s in body:
            match s:
                case Set(place, value, _, add):
                    target = self._place(place)
                    new = f"({target} + {self._expr(value)})" if add else self._expr(value)
                    self._lines.append(f"{indent}{target} = select({where}, {new}, {target})")
                case Return(Status(name=status)) if status != "OK":
                    self._lines.append(f"{indent}refused({where})")
                case When():
                    self._when(s, indent, where)
                case Loop():
                    self._lines.append(f"{indent}{self._head(s)}")
                    self._selected(s.body, f"{indent}    ", where)
                case Let() | Declare() | Note():
                    self._statement(s, indent)
                case _:
                    raise TypeError(f"{type(s).__name__} under a condition on reals: it is done for all samples")

    def _expr(self, e: Expr) -> str:
        match e:
            case Select(condition=Compare(operator="<", left=x, right=Const(value=0)), yes=Negate(operand=y), no=z) if (
                x is y is z
            ):
                return f"magnitude({self._expr(x)})"
            case Select():
                return f"select({', '.join(map(self._expr, e.operands))})"
            case Logic():
                return f"({self._expr(e.left)} {e.operator[0]} {self._expr(e.right)})"
            case Not():
                return f"opposite({self._expr(e.operand)})"
        return super()._expr(e)


class Columns(Interpreter):
    """The functions of a program on columns. `refused`: truth values of the samples that functions have refused."""

    def __init__(self, program: Program) -> None:
        names = {f.name for f in program.functions}
        routines = {name: _routine(name) for name in ("sqrt", "atan2", "exp")}
        super().__init__(program, {name: routine for name, routine in routines.items() if name in names})
        self.refused = list[Any]()
        self._scope |= {"select": _select, "magnitude": abs, "opposite": _opposite, "divided": _divide}
        self._scope["refused"] = self.refused.append

    def _source(self, function: Function) -> str:
        return _Selecting(self._scope, self._precision).function(function)


def _on_reals(condition: Expr) -> bool:
    return any(isinstance(e, Compare) and e.left.kind is Kind.REAL for e in inside(condition))


def _routine(name: str) -> Callable[..., Any]:
    """A function of reals, or what of sums remembers it."""

    def call(*numbers: Any) -> Any:
        traced = next((x for x in numbers if isinstance(x, Sum)), None)
        return OPERATIONS[name](*numbers) if traced is None else traced.trace.record(name, *numbers)

    return call


def _select(where: Any, yes: Any, no: Any) -> Any:
    if isinstance(where, bool):
        return yes if where else no
    return where.select(yes, no) if isinstance(where, Sum) else np.where(where, yes, no)


def _opposite(where: Any) -> Any:
    return 1.0 - where if isinstance(where, Sum) else not where if isinstance(where, bool) else ~where


def _divide(a: Any, b: Any) -> Any:
    return a / (np.float64(b) if isinstance(b, float) else b)


Row: TypeAlias = tuple[tuple[int, float], ...]
"""Rows and their coefficients; row 0 is 1."""


class Sum:
    """A real of every sample while a function is run to see what it does: a sum of multiples of rows of `trace`."""

    __slots__ = ("parts", "trace")

    def __init__(self, trace: Trace, parts: Mapping[int, float]) -> None:
        self.trace, self.parts = trace, parts

    def _plus(self, other: Any, sign: float) -> Sum | float:
        parts = dict(self.parts)
        for k, c in (other.parts if isinstance(other, Sum) else {0: float(other)}).items():
            parts[k] = parts.get(k, 0.0) + sign * c
        return self.trace.sum(parts)

    def _times(self, c: float) -> Sum | float:
        return self.trace.sum({k: c * x for k, x in self.parts.items()})

    def __add__(self, other: Any) -> Any:
        return self._plus(other, 1.0)

    def __sub__(self, other: Any) -> Any:
        return self._plus(other, -1.0)

    def __rsub__(self, other: Any) -> Any:
        return self._times(-1.0)._plus(other, 1.0)  # type: ignore[union-attr]  # a multiple of what is no number

    def __neg__(self) -> Any:
        return self._times(-1.0)

    def __mul__(self, other: Any) -> Any:
        return self.trace.record("*", self, other) if isinstance(other, Sum) else self._times(float(other))

    def __truediv__(self, other: Any) -> Any:
        return self.trace.record("/", self, other) if isinstance(other, Sum) else self._times(1.0 / float(other))

    def __rtruediv__(self, other: Any) -> Any:
        return self.trace.record("/", other, self)

    def __abs__(self) -> Any:
        return self.trace.record("abs", self)

    # a truth value is 1 or 0

    def __gt__(self, other: Any) -> Any:
        difference = self - other
        return self.trace.record("above", difference) if isinstance(difference, Sum) else difference > 0.0

    def __lt__(self, other: Any) -> Any:
        return -self > -other

    def __ge__(self, other: Any) -> Any:
        return _opposite(self < other)

    def __le__(self, other: Any) -> Any:
        return _opposite(self > other)

    def __and__(self, other: Any) -> Any:
        product = self * other
        return product if isinstance(product, Sum) else bool(product)

    def __or__(self, other: Any) -> Any:
        return _opposite(_opposite(self) & _opposite(other))

    __radd__, __rmul__, __rand__, __ror__ = __add__, __mul__, __and__, __or__

    def select(self, yes: Any, no: Any) -> Any:
        """`yes` where this is 1, `no` where it is 0."""
        if isinstance(yes, Sum) or isinstance(no, Sum):
            return self.trace.record("select", self, yes, no)
        return self * (yes - no) + no


SCALED = ("*", "/", "abs")
"""Operations that give a multiple of what they give of multiples."""

OPERATIONS: Mapping[str, Callable[..., Any]] = {
    "*": np.multiply,
    "abs": np.abs,
    "atan2": np.arctan2,
    "exp": np.exp,
    "select": lambda where, yes, no: np.where(where > 0.0, yes, no),
    "sqrt": np.sqrt,
    # where nothing can be divided, the answer is one that no sample takes
    "/": lambda a, b: a / np.where(b == 0.0, 1.0, b),
}


class Trace:
    """What is done to rows of numbers, each row once: its name and the rows that it takes."""

    def __init__(self) -> None:
        self.rows: list[tuple[str, tuple[Any, ...]]] = [("1", ())]
        self._known: dict[tuple[str, tuple[Any, ...]], int] = {}

    def inputs(self, count: int) -> list[Any]:
        """Sums of one input each."""
        first = len(self.rows)
        self.rows += [("input", ())] * count
        return [Sum(self, {first + k: 1.0}) for k in range(count)]

    def sum(self, parts: Mapping[int, float]) -> Sum | float:
        """A sum, or the number that it is."""
        kept = {k: c for k, c in parts.items() if c != 0.0}
        return Sum(self, kept) if kept.keys() - {0} else kept.get(0, 0.0)

    def record(self, name: str, *numbers: Any) -> Any:
        """What an operation gives of numbers, of which some are sums."""
        factor, rows = 1.0, list[int]()
        for x in numbers:
            parts = x.parts if isinstance(x, Sum) else {0: float(x)}
            row, c = next(iter(parts.items())) if name in SCALED and len(parts) == 1 else (self._row(parts), 1.0)
            factor = abs(c) * factor if name == "abs" else factor / c if name == "/" and rows else factor * c
            rows.append(row)
        key = tuple(sorted(rows)) if name == "*" else tuple(rows)
        return self.sum({self._new_row(name, key): factor})

    def _row(self, parts: Mapping[int, float]) -> int:
        """The row of a sum."""
        what = tuple(sorted(parts.items()))
        return what[0][0] if len(what) == 1 and what[0][1] == 1.0 else self._new_row("sum", what)

    def _new_row(self, name: str, what: tuple[Any, ...]) -> int:
        if (name, what) not in self._known:
            self._known[name, what] = len(self.rows)
            self.rows.append((name, what))
        return self._known[name, what]


class Arrays:
    """A function of arrays: of inputs (n, M) the results (M, m), by few operations of NumPy.

    Where a comparison is a tie, `mean` gives the mean of what both of its answers give: slopes at a kink.
    """

    def __init__(self, trace: Trace, results: Sequence[Any], refused: Sequence[Any] = (), mean: bool = False) -> None:
        self._trace, self._mean = trace, mean
        self._results = [x if isinstance(x, Sum) else Sum(trace, {0: float(x)} if x else {}) for x in results]
        self._refused = [x for x in refused if isinstance(x, Sum)]

    def takes(self, inputs: Iterable[int]) -> bool:
        """Does a result depend on any of those inputs?"""
        return any(k + 1 in self._needed for k in inputs)

    @cached_property
    def _needed(self) -> set[int]:
        """The rows on which results depend."""
        needed: set[int] = set()
        waiting = [k for x in (*self._results, *self._refused) for k in x.parts]
        while waiting:
            k = waiting.pop()
            if k not in needed:
                needed.add(k)
                waiting += _arguments(*self._trace.rows[k])
        return needed

    @cached_property
    def _steps(self) -> tuple[list[tuple[str, slice, Any]], Any, Any, int]:
        """Steps by rows that do not depend on one another: operation, rows that it gives, rows that it takes."""
        rows = self._trace.rows
        first = dict.fromkeys(k for k, (name, _) in enumerate(rows) if name in ("1", "input"))
        level = dict.fromkeys(first, 0)
        groups: dict[tuple[int, str], list[int]] = {}
        for k in sorted(self._needed - level.keys()):  # a row comes after those that it takes
            name, what = rows[k]
            level[k] = 1 + max(level[i] for i in _arguments(name, what))
            groups.setdefault((level[k], name), []).append(k)
        place, steps = {k: k for k in first}, list[tuple[str, slice, Any]]()
        for (_, name), members in sorted(groups.items()):
            start = len(place)
            place |= {k: start + i for i, k in enumerate(members)}
            taken = [rows[k][1] for k in members]
            how: Any = _matrix(taken, place) if name == "sum" else zip(*taken, strict=True)
            if name != "sum":
                how = [_index([place[i] for i in column]) for column in how]
            steps.append((name, slice(start, len(place)), how))
        results, refused = (
            _matrix([tuple(x.parts.items()) for x in some], place) for some in (self._results, self._refused)
        )
        return steps, results, refused, len(place)

    def __call__(self, inputs: Array) -> tuple[Array, bool]:
        """The results (M, m), and whether a sample was refused."""
        results, ties, bad = self._run(inputs, np.greater)
        if self._mean and ties.any():
            results[ties] = 0.5 * (results[ties] + self._run(inputs[:, ties], np.greater_equal)[0])
        return results, bad

    def _run(self, inputs: Array, above: Any) -> tuple[Array, NDArray[np.bool_], bool]:
        """The results, the samples with a comparison that is a tie, and whether one was refused."""
        steps, results, refused, count = self._steps
        W, ties = np.empty((count, inputs.shape[1])), np.zeros(inputs.shape[1], dtype=np.bool_)
        W[0], W[1 : 1 + len(inputs)] = 1.0, inputs
        for name, rows, how in steps:
            if name == "sum":
                W[rows] = _product(how, W).T
            elif name == "above":
                taken = W[how[0]]
                above(taken, 0.0, out=W[rows])
                ties |= (taken == 0.0).any(axis=0)
            else:
                W[rows] = OPERATIONS[name](*(W[i] for i in how))
        return _product(results, W), ties, bool(self._refused) and bool((_product(refused, W) > 0.0).any())


def _arguments(name: str, what: tuple[Any, ...]) -> tuple[int, ...]:
    """Rows that a row takes."""
    return tuple(k for k, _ in what) if name == "sum" else what


def _index(rows: list[int]) -> Any:
    """Rows as a slice where they follow one another."""
    return slice(rows[0], rows[-1] + 1) if rows == list(range(rows[0], rows[-1] + 1)) else np.array(rows)


def _matrix(sums: Sequence[Row], place: Mapping[int, int]) -> tuple[Array, Any]:
    """Sums as a matrix, and the rows that it multiplies."""
    used = sorted({place[k] for parts in sums for k, _ in parts}) or [0]
    column, A = {k: j for j, k in enumerate(used)}, np.zeros((len(sums), len(used)))
    for i, parts in enumerate(sums):
        for k, c in parts:
            A[i, column[place[k]]] = c
    return A, _index(used)


def _product(matrix: tuple[Array, Any], W: Array) -> Array:
    """The sums (M, k) of a matrix, some samples at a time: more would wait for threads."""
    A, rows = matrix
    sums, taken, some = np.empty((W.shape[1], len(A))), W[rows].T, max(64, 200_000 // A.size)
    for k in range(0, len(sums), some):
        np.matmul(taken[k : k + some], A.T, out=sums[k : k + some])
    return sums
