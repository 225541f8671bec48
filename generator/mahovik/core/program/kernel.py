"""Kernels: functions of the program, written as Python functions of a small subset.

    @kernel(equation="(8)")
    def total(a: Reals = argument("summands", N)) -> float:
        \"""The sum of all elements.\"""
        # from the first to the last
        whole: float = 0.0
        for i in range(N):
            whole += a[i]
        return whole  # comments at the end of a line stay there

What the text may hold, and what it becomes:

* `x = e` a named temporary; `x: float = e` and `x: int = e` variables that change; `x = reals(n, m)`, `ints(n)` and
  `record(struct)` local arrays and structs; `x = reals()` a variable without a first value.
* `=`, `+=`, `-=` to variables, elements `a[i]` and members `a.b`; calls of functions, as statements or in expressions.
  A call that returns a status, as a statement: where that is not OK, the function returns it.
* Vectors (program/vector): arrays, slices `V[0:3]`, columns `I[:, s]` with + - * @, `C.T @ a`, `cross`, `dot`. Assigned
  to an array or a slice, one statement an element; `a[:] = b` of structs is a copy. `x: Reals = e` is a local array;
  `x = e` of what is computed are temporaries x1, x2, ...; of places, a name for them.
* `for i in range(...)` a loop; over anything else the body is repeated, with the value in its place. `if` and `else`,
  `return`; where the condition is a truth value of Python, one branch is taken, and its names stay. A status that an
  inline kernel returns is what the function returns, any other value that of its call.
* `let(name, e)` and `local(name, e)` where a name is computed; `with block():` a scope of its own for names.
* Numbers, + - * / % and those of words; comparisons; `and`, `or`, `not`, `a if c else b`, `abs`, `float` of an int.
* Names from around the function (counts, numbers, functions, structs): their values now. Other Python functions are
  called while the text is compiled, with expressions as arguments; those that are `inline` are kernels that are put in.
* An argument whose default value is None is not there. Calls by position leave out what a function does not take.
* The docstring is the purpose, its further lines the notes. Comments become comments; a line of its own, or more, those
  before the next statement. Of a name that Python has, `pass_` or `sum_`, the last underscore goes.

Kernels are never run by Python: their types are those that mypy checks, `float`, `int`, `bool`, Reals and Ints.
"""

from __future__ import annotations

import ast
import builtins
import inspect
import keyword
import linecache
import re
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass, replace
from functools import cache
from types import CodeType
from typing import Any, Literal, Protocol, TypeVar, cast

from mahovik.core.program import vector
from mahovik.core.program.build import CHECKED, Body, returns
from mahovik.core.program.call import Argument, Call
from mahovik.core.program.expression import (
    OPERANDS,
    BitCast,
    Convert,
    Expr,
    Not,
    Place,
    Status,
    and_,
    as_expr,
    compare,
    condition,
    integer,
    magnitude,
    or_,
    select,
)
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind, NamedCount, ProgramError, Struct

KINDS = {
    "float": Kind.REAL,
    "int": Kind.INT,
    "Reals": Kind.REAL,
    "Ints": Kind.INT,
    "Result": Kind.REAL,
    "IntResult": Kind.INT,
    "Status": Kind.STATUS,
}
"""Kinds of scalars, and of elements, by the annotation."""

OK, NOT_FINITE, RANGE, NOT_POSITIVE_DEFINITE, BAD_ARGUMENT = map(
    Status, ("OK", "NOT_FINITE", "RANGE", "NOT_POSITIVE_DEFINITE", "BAD_ARGUMENT")
)
"""What kernels return."""


Found = TypeVar("Found")


class KernelError(ProgramError):
    """A construct that no kernel has: file, line, what it is."""


class Reals(Protocol):
    """An array of reals in the text of a kernel, with one index or more, or a vector of what is computed."""

    def __getitem__(self, index: Any) -> Any: ...
    def __setitem__(self, index: Any, value: Any) -> None: ...
    def __len__(self) -> int: ...
    def __iter__(self) -> Iterator[Any]: ...
    def __add__(self, other: Any) -> Any: ...
    def __radd__(self, other: Any) -> Any: ...
    def __sub__(self, other: Any) -> Any: ...
    def __rsub__(self, other: Any) -> Any: ...
    def __mul__(self, other: Any) -> Any: ...
    def __rmul__(self, other: Any) -> Any: ...
    def __truediv__(self, other: Any) -> Any: ...
    def __matmul__(self, other: Any) -> Any: ...
    def __neg__(self) -> Any: ...
    @property
    def T(self) -> Any: ...
    @property
    def square(self) -> Any: ...


Ints = Reals
"""An array of ints."""


class Record(Protocol):
    """A struct in the text of a kernel: its members."""

    def __getattr__(self, name: str) -> Any: ...
    def member(self, name: str) -> Any: ...


class Result(Protocol):
    """A number that a function gives through a pointer, or a variable that an inline kernel changes."""

    value: Any


IntResult = Result
"""An int that a function gives through a pointer."""


@dataclass(frozen=True)
class Local:
    """A local array or struct."""

    shape: tuple[int | NamedCount, ...]
    type: Kind | Struct


def argument(
    purpose: str = "",
    *shape: int | NamedCount,
    struct: Struct | None = None,
    direction: str = "in",
    unit: str = "",
    optional: Literal["", "zeros", "missing"] = "",
    overlaps: bool = False,
) -> Any:
    """An argument, in place of its default value: see `Argument`. Its kind is the annotation's, if it is no struct."""
    return Argument("", struct or Kind.REAL, shape, direction, unit, purpose, optional, overlaps)


def result(purpose: str = "", *shape: int | NamedCount, **more: Any) -> Any:
    """An argument that the function writes."""
    return argument(purpose, *shape, direction="out", **more)


def changed(purpose: str = "", *shape: int | NamedCount, **more: Any) -> Any:
    """An argument that the function reads and writes."""
    return argument(purpose, *shape, direction="inout", **more)


def reals(*shape: int | NamedCount) -> Any:
    """A local array of reals; without a length a variable that has no first value."""
    return Local(shape, Kind.REAL)


def ints(*shape: int | NamedCount) -> Any:
    """A local array of ints, or a variable."""
    return Local(shape, Kind.INT)


def words(*shape: int | NamedCount) -> Any:
    """A local array of words, or a variable."""
    return Local(shape, Kind.WORD)


def record(struct: Struct, *shape: int | NamedCount) -> Any:
    """A local struct, or an array of them."""
    return Local(shape, struct)


class _Open(threading.local):
    """The bodies that a thread compiles into, the innermost last."""

    def __init__(self) -> None:
        self.bodies: list[Body] = []


_open = _Open()


def let(name: str, value: Any, comment: str = "") -> Any:
    """A named temporary whose name is computed."""
    return _body("let").let(name, value if isinstance(value, Expr) else as_expr(value, Kind.REAL), comment)


def local(name: str, *shape: int | NamedCount, comment: str = "") -> Any:
    """A local array whose name is computed."""
    return _body("local").local(name, shape, comment=comment)


def shortcut() -> AbstractContextManager[None]:
    """`with shortcut():` a quick way to return what the statements after it would return as well."""
    return _body("shortcut").shortcut()


def block() -> AbstractContextManager[None]:
    """`with block():` statements whose names end with them."""
    return _body("block").block()


def check_as(status: Status, call: Any) -> None:
    """A call of a function that returns a status; where that is not OK, `status` is returned."""
    _body("check_as").check(call, status.name)


def status_of(bits: int) -> Status:
    """The status of bits."""
    return cast(Status, Convert(cast(Expr, bits), Kind.STATUS))


def body() -> Body:
    """The statements so far, for functions that add to them."""
    return _body("body")


def refuse(test: Any, status: Status) -> None:
    """Returns `status` where the test holds."""
    with body().when(test):
        body().ret(status)


def _body(name: str) -> Body:
    if not _open.bodies:
        raise ProgramError(f"`{name}` is called in the text of a kernel")
    return _open.bodies[-1]


def bits_of(value: float) -> int:
    """The bits of a real as a word."""
    return cast(int, BitCast(cast(Expr, value), Kind.WORD))


def real_of_bits(value: int) -> float:
    """The real with the bits of a word."""
    return cast(float, BitCast(cast(Expr, value), Kind.REAL))


def word(value: int) -> int:
    """An int, or a literal, as an unsigned integer of the element type's width."""
    return cast(int, Convert(value, Kind.WORD) if isinstance(value, Expr) else as_expr(value, Kind.WORD))


def int_of(value: int) -> int:
    """An unsigned integer as an int."""
    return cast(int, Convert(cast(Expr, value), Kind.INT))


def kernel(
    name: str = "",
    equation: str = "",
    notes: Sequence[str] = (),
    statuses: Sequence[str] = CHECKED,
    purpose: str = "",
    **flags: bool,
) -> Callable[[Callable[..., Any]], Function]:
    """The function of the program that this Python function is the text of. Raises KernelError.

    `name`: in C, if it is another; `notes`: further lines of its contract, after those of the docstring; `statuses`: of
    a function that returns one, "OK" where nothing else was returned; `purpose`: in place of the docstring's first
    line; `flags`: fields of `Function` that are true.
    """

    def compiled(function: Callable[..., Any]) -> Function:
        text = _Text(function)
        if not text.docstring:
            raise text.error(text.tree, "expected a docstring, whose first line is the purpose")
        arguments = text.arguments()
        body = Body()
        places = {
            parameter: _Pointed(a.place) if a.variable.pointer and a.place.is_scalar else a.place
            for parameter, a in arguments.items()
            if a is not None
        }
        kind = text.kind_of_result(Kind.STATUS if statuses else None)
        absent = {parameter: None for parameter, a in arguments.items() if a is None}
        _Compilation(text, body, places | absent, returns=kind).block(text.statements)
        if kind is Kind.STATUS and not returns(body.statements):
            body.ret(OK)
        if kind is not None and not returns(body.statements):
            raise text.error(text.tree.body[-1], f"{{}}: a way through it returns nothing, expected {text.returns}")
        first, *lines = (line for line in text.docstring.splitlines() if line)
        return Function(
            name or function.__name__, purpose or first, tuple(a for a in arguments.values() if a is not None),
            body.statements, equation, kind, tuple(statuses) if kind is Kind.STATUS else (), (*lines, *notes),
            parameters=tuple(_in_c(parameter) if a is None else a.name for parameter, a in arguments.items()), **flags,
        )  # fmt: skip

    return compiled


class inline:  # noqa: N801  # a decorator
    """A kernel without arguments of its own in C: its statements are put in where it is called."""

    def __init__(self, function: Callable[..., Any]) -> None:
        self.text = _Text(function)
        self.signature = inspect.signature(function)

    def __call__(self, *arguments: Any, **named: Any) -> Any:
        """Its statements where it is called; what it returns."""
        bound = self.signature.bind(*arguments, **named)
        bound.apply_defaults()
        scope = bound.arguments
        for name, value in scope.items():
            if self.text.annotations.get(name) == "Result" and isinstance(value, Place):
                scope[name] = _Pointed(value)
        compilation = _Compilation(self.text, _body(self.text.name), scope, inlined=True)
        compilation.block(self.text.statements)
        return compilation.result


@dataclass
class _Pointed:
    """A scalar result of a function."""

    value: Place


@dataclass(frozen=True)
class _Module:
    """The text of a file: its functions by the line at which they begin, its comments by line."""

    functions: dict[int, ast.FunctionDef]
    beside: dict[int, str]  # comment at the end of a line
    before: dict[int, str]  # comment on a line of its own


_COMMENT = re.compile(r"""((?:[^#"']|"[^"]*"|'[^']*')*)#\s*(.*?)\s*$""")


@cache
def _module(file: str) -> _Module:
    """The parsed text of a file."""
    lines = linecache.getlines(file)
    functions = {}
    waiting: list[Any] = [ast.parse("".join(lines))]
    while waiting:
        node = waiting.pop()
        if isinstance(node, ast.FunctionDef):
            functions[min((node.lineno, *(d.lineno for d in node.decorator_list)))] = node
        waiting += [*getattr(node, "body", []), *getattr(node, "orelse", [])]
    beside: dict[int, str] = {}
    before: dict[int, str] = {}
    for number, line in enumerate(lines, 1):
        if "#" in line and (comment := _COMMENT.match(line)) and not comment[2].startswith("fmt: "):
            (beside if comment[1].strip() else before)[number] = comment[2]
    return _Module(functions, beside, before)


class _Text:
    """The text of a kernel: its tree, its comments, and the names around it."""

    def __init__(self, function: Callable[..., Any]) -> None:
        code = function.__code__
        self.name, self.file = function.__name__, code.co_filename
        self.module = _module(code.co_filename)
        self.tree = tree = self.module.functions[code.co_firstlineno]
        self.docstring = ast.get_docstring(tree) or ""
        self.statements = tree.body[1:] if self.docstring else tree.body
        self.line = (tree.body[0].end_lineno or 0) if self.docstring else tree.lineno
        self.returns = ast.unparse(tree.returns) if tree.returns else "None"
        self.function = function
        arguments = (*tree.args.args, *tree.args.kwonlyargs)
        self.annotations = {n.arg: ast.unparse(n.annotation) if n.annotation else "nothing" for n in arguments}
        self.defaults = {p.name: p.default for p in inspect.signature(function).parameters.values()}

    def names(self) -> dict[str, Any]:
        """The names around the function, as they are now."""
        around = dict(inspect.getclosurevars(self.function).nonlocals)
        return self.function.__globals__ | around | OPERATORS | {"__builtins__": BUILTINS}

    def arguments(self) -> dict[str, Argument | None]:
        """The arguments of the function, from the default values of its parameters."""
        arguments: dict[str, Argument | None] = {}
        for name, declared in self.defaults.items():
            if declared is not None and not isinstance(declared, Argument):
                raise self.error(self.tree, f"{name}: expected argument(...) as its default value")
            if declared is None or declared.name:
                arguments[name] = declared and replace(declared)  # with a variable of its own
            else:
                type_ = declared.type if isinstance(declared.type, Struct) else self.kind(name)
                try:
                    arguments[name] = replace(declared, name=_in_c(name), type=type_)
                except ProgramError as error:
                    raise self.error(self.tree, str(error)) from None
        return arguments

    def kind(self, name: str) -> Kind:
        """The kind of an argument; REAL of one that is not always there."""
        return self._looked_up(name, self.annotations[name], {**KINDS, "Any": Kind.REAL, "Record": Kind.REAL})

    def kind_of_result(self, of_any: Kind | None) -> Kind | None:
        """What the function returns, `of_any` where its text leaves that open."""
        kinds = {"None": None, "float": Kind.REAL, "int": Kind.INT, "Status": Kind.STATUS, "Any": of_any}
        return self._looked_up("what it returns", self.returns, kinds)

    def _looked_up(self, what: str, annotation: str, kinds: Mapping[str, Found]) -> Found:
        if annotation not in kinds:
            raise self.error(self.tree, f"{what}: {annotation} found, expected one of {', '.join(kinds)}")
        return kinds[annotation]

    def error(self, node: ast.stmt, words: str) -> KernelError:
        """The error at a statement of the text."""
        line = linecache.getline(self.file, node.lineno).strip()
        return KernelError(f"{self.file}:{node.lineno}: {words.replace('{}', line, 1)}")


def _in_c(name: str) -> str:
    """A name in C."""
    short = name.removesuffix("_")
    return short if keyword.iskeyword(short) or hasattr(builtins, short) else name


class _Compilation:
    """Compiles the statements of a text into a body.

    `scope`: arguments and locals by name; `inlined`: `return` ends no function of C; `returns`: what it returns there.
    """

    def __init__(
        self, text: _Text, body: Body, scope: dict[str, Any], inlined: bool = False, returns: Kind | None = None
    ) -> None:
        self.text = text
        self.body = body
        self.scope: dict[str, Any] = text.names() | scope
        self.variables: set[str] = set()  # those that change
        self.inlined, self.returns = inlined, returns
        self.line = text.line  # of the last statement
        self.returned = False  # no statement of the block is reached any more
        self.result: Any = None  # of an inline kernel

    # -- statements ----------------------------------------------------------------------------------------------

    def block(self, statements: Sequence[ast.stmt]) -> None:
        """Compile the statements of a block, whose names end with it."""
        scope, variables = dict(self.scope), set(self.variables)
        _open.bodies.append(self.body)
        try:
            self.statements(statements)
        finally:
            _open.bodies.pop()
        self.scope, self.variables = scope, variables

    def statements(self, statements: Sequence[ast.stmt]) -> None:
        """Compile statements up to a `return`."""
        for number, statement in enumerate(statements):
            if number and isinstance(statements[number - 1], ast.Return):
                raise self.text.error(statement, "{}: no state comes here, expected nothing after a return")
            if self.returned:
                break
            self._notes(statement.lineno)
            self.line = statement.lineno
            try:
                self.statement(statement)
            except KernelError:
                raise
            except Exception as error:
                python = "" if isinstance(error, ProgramError) else "no kernel computes this, see program/kernel.py: "
                raise self.text.error(statement, f"{{}}: {python}{error}") from error
            self.line = statement.end_lineno or 0

    def _notes(self, line: int) -> None:
        """Comments on lines of their own before a statement: one note, if they follow one another."""
        before = self.text.module.before
        lines = [before[n] for n in range(self.line + 1, line) if n in before]
        if lines:
            self.body.note(" ".join(lines))

    def statement(self, node: ast.stmt) -> None:
        """Compile a statement."""
        comment = self.text.module.beside.get(node.end_lineno or 0, "")
        match node:
            case ast.AnnAssign(ast.Name(name), annotation, ast.expr() as value):
                self._declare(name, ast.unparse(annotation), self.value(value), comment)
            case ast.Assign([ast.Tuple(targets)], value) if not isinstance(result := self.value(value), Expr):
                for target, part in zip(targets, result, strict=True):
                    self._assign(target, part, comment, called=True)
            case ast.Assign([target], value):
                self._assign(target, self.value(value), comment, isinstance(value, ast.Call))
            case ast.AugAssign(target, ast.Add() | ast.Sub() as operator, value):
                place = self.value(target)
                if not isinstance(place, Place | vector.Vector):
                    raise ProgramError("expected a variable or a place")
                self.body.add(place, self.value(value), comment, isinstance(operator, ast.Sub))
            case ast.Expr(value):
                if not isinstance(value, ast.Call):
                    raise ProgramError("nothing takes this value, expected a call or an assignment")
                result = self.value(value)
                if isinstance(result, Call) and result.signature.returns is Kind.STATUS:
                    self.body.check(result)
                elif isinstance(result, Call):
                    self.body.do(result, comment)
            case ast.For(target, iterated, inner, []):
                self._loop(target, iterated, inner, self.text.module.beside.get(iterated.end_lineno or 0, ""))
            case ast.If(test, inner, otherwise):
                self._when(test, inner, otherwise, self.text.module.beside.get(test.end_lineno or 0, ""))
            case ast.With([ast.withitem(context, None)], inner):
                with self.value(context):
                    self.block(inner)
                self.returned = False
            case ast.Return(value):
                result = None if value is None else self.value(value)
                if isinstance(result, Status) or not self.inlined:
                    self.body.ret(self._returned(result))
                self.result, self.returned = result, True
            case ast.Pass():
                pass
            case _:
                raise self.text.error(node, "no statement of a kernel: {}")

    def _returned(self, result: Any) -> Expr:
        """What a function of C returns. Raises ProgramError where the signature says another kind."""
        if self.returns is None and not self.inlined:
            raise ProgramError("the signature says that it returns None, expected no return")
        return as_expr(result, self.returns or Kind.STATUS)

    def _local(self, name: str, local: Local, comment: str) -> Place:
        """A local variable, which is in scope from now on."""
        place = self.body.local(_in_c(name), local.shape, local.type, comment)
        self.scope[name] = place
        self.variables.add(name)
        return place

    def _declare(self, name: str, annotation: str, first: Any, comment: str) -> None:
        """`x: float = e`, `x: Reals = e`."""
        shape = first.shape if isinstance(first, Place) else () if isinstance(first, OPERANDS) else (len(first),)
        fitting = ("Reals", "Ints") if shape else ("float", "int", "Status")
        if annotation not in fitting:
            raise ProgramError(f"{name}: {annotation} found, expected {' or '.join(fitting)}")
        self.body.set(self._local(name, Local(shape, KINDS[annotation]), comment), first)

    def _assign(self, target: ast.expr, result: Any, comment: str, called: bool = False) -> None:
        """`x = e`, `a[i] = e`, `a.b = e`. A part that is no number, and a place that a call made, get a second name."""
        if not isinstance(target, ast.Name):
            self.body.set(self.value(target), result, comment)
            return
        name, present = target.id, self.scope.get(target.id)
        if name in self.variables or (isinstance(present, Place) and not present.is_scalar):
            self.body.set(present, result, comment)
        elif isinstance(present, Place) and not called:
            raise ProgramError(f"{name} has a value already: what changes is declared, {name}: float = ...")
        elif isinstance(result, Local):
            self._local(name, result, comment)
        elif isinstance(result, vector.Vector) and not all(isinstance(x, Place | int) for x in result):
            self.scope[name] = vector.Vector(self._parts(name, result, comment))
        elif isinstance(result, Expr) and not (isinstance(result, Place) and (called or not result.is_scalar)):
            self.scope[name] = self.body.let(_in_c(name), result, comment)
        else:
            self.scope[name] = result

    def _parts(self, name: str, values: vector.Vector, comment: str) -> Iterator[Any]:
        """Temporaries of the elements that are no numbers of Python, numbered from 1."""
        for number, value in enumerate(values, 1):
            yield self.body.let(f"{name}{number}", value, comment) if isinstance(value, Expr) else value
            comment = ""

    def _loop(self, target: ast.expr, iterated: ast.expr, inner: Sequence[ast.stmt], comment: str) -> None:
        """A loop over `range(stop)` or `range(start, stop)`; a repetition for each value of anything else."""
        match target, iterated:
            case ast.Name(name), ast.Call(ast.Name("range"), [*bounds], []):
                if len(bounds) > 2:
                    raise ProgramError("a loop counts by 1: expected range(stop) or range(start, stop)")
                start, stop = [integer(0), *map(self.value, bounds)][-2:]
                with self.body.loop(_in_c(name), stop, start, comment) as index:
                    self._branch(inner, {name: index})
            case _:
                for value in self.value(iterated):
                    parts = zip(target.elts, value, strict=True) if isinstance(target, ast.Tuple) else [(target, value)]
                    self.scope |= {ast.unparse(name): part for name, part in parts}
                    self.line = iterated.lineno
                    self.statements(inner)
                    if self.returned:
                        break

    def _when(self, test: ast.expr, inner: Sequence[ast.stmt], otherwise: Sequence[ast.stmt], comment: str) -> None:
        """`if`, and `else`; a branch alone, where Python knows which."""
        decided = self.value(test)
        if not isinstance(decided, Expr):
            if not decided:
                self.line = inner[-1].end_lineno or 0  # comments of this branch are not those of the other
            self.statements(inner if decided else otherwise)
            return
        with self.body.when(decided, comment):
            self._branch(inner)
        if otherwise:
            with self.body.otherwise():
                self._branch(otherwise)

    def _branch(self, statements: Sequence[ast.stmt], names: dict[str, Any] | None = None) -> None:
        """A block that the program may not reach: a `return` in it ends only the block."""
        scope = self.scope
        self.scope = scope | (names or {})
        self.block(statements)
        self.scope = scope
        if self.returned and self.inlined and not isinstance(self.result, Status):
            raise ProgramError("an inline kernel returns a value at its end")
        self.returned = False

    # -- expressions ---------------------------------------------------------------------------------------------

    def value(self, node: ast.expr) -> Any:
        """The value of an expression: an Expr, a vector, or a value of Python."""
        return eval(_code(node), self.scope)  # text of the house, which is imported anyway


@cache
def _code(node: ast.expr) -> CodeType:
    """The code of an expression."""
    if isinstance(node, ast.Name | ast.Attribute | ast.Subscript):
        node.ctx = ast.Load()  # a target is a place as well
    return compile(ast.Expression(_Operators().visit(node)), "<kernel>", "eval")


class _Operators(ast.NodeTransformer):
    """Calls of functions in the place of operators whose meaning a Python class cannot give."""

    def visit_IfExp(self, node: ast.IfExp) -> ast.expr:
        return self._call(node, "_select", node.test, node.body, node.orelse)

    def visit_BoolOp(self, node: ast.BoolOp) -> ast.expr:
        return self._call(node, "_and" if isinstance(node.op, ast.And) else "_or", *node.values)

    def visit_UnaryOp(self, node: ast.UnaryOp) -> ast.AST:
        return self._call(node, "_not", node.operand) if isinstance(node.op, ast.Not) else self.generic_visit(node)

    def visit_Compare(self, node: ast.Compare) -> ast.AST:
        match node.ops:
            case [ast.Eq() | ast.NotEq() | ast.In() | ast.NotIn() as operator]:
                return self._call(node, f"_{type(operator).__name__}", node.left, node.comparators[0])
            case [_]:
                return self.generic_visit(node)
        raise ProgramError("a chain of comparisons: expected `a < b and b < c`")

    def visit_NamedExpr(self, node: ast.NamedExpr) -> ast.AST:
        raise ProgramError("`:=` in an expression: expected a statement of its own")

    def _call(self, node: ast.expr, name: str, *parts: ast.expr) -> ast.expr:
        """A call whose arguments are evaluated when they are needed: one of Python's truth values may decide."""
        nothing = ast.arguments([], [], None, [], [], None, [])
        late: list[ast.expr] = [ast.copy_location(ast.Lambda(nothing, self.visit(part)), node) for part in parts]
        return ast.copy_location(ast.Call(ast.copy_location(ast.Name(name, ast.Load()), node), late, []), node)


Late = Callable[[], Any]


def _select(decides: Late, yes: Late, no: Late) -> Any:
    test = decides()
    if not isinstance(test, Expr):
        return yes() if test else no()
    a, b = yes(), no()
    if isinstance(a, int) and isinstance(b, int):
        a = as_expr(a, Kind.INT)
    return select(test, a, b)


def _joined(join: Callable[[Expr, Expr], Expr], decides: bool) -> Callable[..., Any]:
    """`and` or `or`: the truth value `decides` is the result, whatever the other operands are."""

    def joined(*operands: Late) -> Any:
        result: Any = None
        for operand in operands:
            value = operand()
            if isinstance(value, Expr):
                result = join(result, value) if isinstance(result, Expr) else condition(value)
            elif isinstance(result, Expr) and not isinstance(value, bool):
                condition(value)  # is none
            elif bool(value) is decides:
                return value
            elif not isinstance(result, Expr):
                result = value
        return result

    return joined


def _not(operand: Late) -> Any:
    value = operand()
    return Not(condition(value)) if isinstance(value, Expr) else not value


def _compared(operator: str) -> Callable[[Late, Late], Any]:
    def compared(left: Late, right: Late) -> Any:
        a, b = left(), right()
        if isinstance(a, Expr) or isinstance(b, Expr):
            return compare(operator, a, b)
        return (_of_python(a) == _of_python(b)) is (operator == "==")

    return compared


def _contained(left: Late, right: Late) -> bool:
    return _of_python(left()) in _of_python(right())


def _of_python(value: Any) -> Any:
    """A value that Python compares. Raises ProgramError where the program computes it, or a part of it."""
    parts = value if isinstance(value, Sequence) and not isinstance(value, str) else [value]
    if any(isinstance(part, Expr | vector.Matrix) for part in parts):
        raise ProgramError(f"{value!r} is known when the program runs: expected comparisons of its numbers")
    return int(value) if isinstance(value, NamedCount) else value


def _abs(value: Any) -> Any:
    return magnitude(value) if isinstance(value, Expr) else abs(value)


def _float(value: Any) -> Any:
    return Convert(value, Kind.REAL) if isinstance(value, Expr) else float(value)


OPERATORS: dict[str, Any] = {
    "_select": _select,
    "_and": _joined(and_, False),
    "_or": _joined(or_, True),
    "_not": _not,
    "_Eq": _compared("=="),
    "_NotEq": _compared("!="),
    "_In": _contained,
    "_NotIn": lambda left, right: not _contained(left, right),
    "abs": _abs,
    "float": _float,
}
"""What operators and built-in functions are in the text of a kernel."""

BUILTINS = {
    name: value
    for name, value in vars(builtins).items()
    if name not in ("breakpoint", "eval", "exec", "input", "open", "print")
}
"""What Python has while a text is compiled, without what acts outside it: a kernel is not run."""
