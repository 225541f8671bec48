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
* `for i in range(...)` a loop; over anything else the body is repeated, with the value in its place. `if` and `else`,
  `return`; where the condition is a truth value of Python, one branch is taken.
* Numbers, + - * / % and those of words; comparisons; `and`, `or`, `not`, `a if c else b`, `abs`, `float` of an int.
* Names from around the function (counts, numbers, functions, structs): their values now. Other Python functions are
  called while the text is compiled, with expressions as arguments; those that are `inline` are kernels that are put in.
* The docstring is the purpose, its further lines the notes. Comments become comments; a line of its own, or more, those
  before the next statement. Of a name that Python has, `pass_` or `sum_`, the last underscore goes.

Kernels are never run by Python: their types are those that mypy checks, `float`, `int`, `bool`, Reals and Ints.
"""

from __future__ import annotations

import ast
import builtins
import copy
import inspect
import io
import keyword
import textwrap
import tokenize
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, Protocol, cast

from mahovik.core.program.build import CHECKED, Body
from mahovik.core.program.call import Argument, Call
from mahovik.core.program.expression import (
    BitCast,
    Const,
    Convert,
    Expr,
    Not,
    Operand,
    Place,
    Status,
    and_,
    as_expr,
    compare,
    integer,
    magnitude,
    or_,
    select,
)
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind, NamedCount, Struct

KINDS = {"float": Kind.REAL, "int": Kind.INT, "Reals": Kind.REAL, "Ints": Kind.INT, "Result": Kind.REAL}
"""Kinds of scalars, and of elements, by the annotation."""


class KernelError(TypeError):
    """A construct that no kernel has: file, line, what it is."""


class Reals(Protocol):
    """An array of reals in the text of a kernel, with one index or more."""

    def __getitem__(self, index: int) -> Any: ...
    def __setitem__(self, index: int, value: Any) -> None: ...
    def __len__(self) -> int: ...
    def __iter__(self) -> Iterator[Any]: ...


Ints = Reals
"""An array of ints."""


class Result(Protocol):
    """A number that a function gives through a pointer, or a variable that an inline kernel changes."""

    value: Any


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
    optional: bool = False,
    overlaps: bool = False,
) -> Any:
    """An argument, in place of its default value: see `Argument`. Its kind is the annotation's, if it is no struct."""
    return Argument("", struct or Kind.REAL, shape, direction, unit, purpose, optional, overlaps)


def reals(*shape: int | NamedCount) -> Any:
    """A local array of reals; without a length a variable that has no first value."""
    return Local(shape, Kind.REAL)


def ints(*shape: int | NamedCount) -> Any:
    """A local array of ints, or a variable."""
    return Local(shape, Kind.INT)


def record(struct: Struct) -> Any:
    """A local struct."""
    return Local((), struct)


def let(name: str, value: float, comment: str = "") -> float:
    """A named temporary whose name is computed, in what is repeated."""
    raise TypeError("`let` is called in the text of a kernel")


def bits_of(value: float) -> int:
    """The bits of a real as a word."""
    return cast(int, BitCast(cast(Expr, value), Kind.WORD))


def real_of_bits(value: int) -> float:
    """The real with the bits of a word."""
    return cast(float, BitCast(cast(Expr, value), Kind.REAL))


def word(value: int) -> int:
    """An unsigned literal of the element type's width."""
    return cast(int, Const(value, Kind.WORD))


def kernel(
    name: str = "",
    equation: str = "",
    notes: Sequence[str] = (),
    statuses: Sequence[str] = CHECKED,
    **flags: bool,
) -> Callable[[Callable[..., Any]], Function]:
    """The function of the program that this Python function is the text of. Raises KernelError.

    `name`: in C, if it is another; `notes`: further lines of its contract, after those of the docstring; `statuses`: of
    a function that returns one, "OK" where nothing else was returned; `flags`: fields of `Function` that are true.
    """

    def compiled(function: Callable[..., Any]) -> Function:
        text = _Text(function)
        arguments = text.arguments()
        body = Body()
        returns = {"None": None, "float": Kind.REAL, "Status": Kind.STATUS}[text.returns]
        places = [_Pointed(a.place) if a.variable.pointer and a.place.is_scalar else a.place for a in arguments]
        _Compilation(text, body, dict(zip(text.defaults, places, strict=True))).block(text.statements)
        if returns is Kind.STATUS:
            body.ret(Status("OK"))
        purpose, *lines = (line for line in text.docstring.splitlines() if line)
        return Function(
            name or function.__name__, purpose, arguments, body.statements, equation, returns,
            tuple(statuses) if returns is Kind.STATUS else (), (*lines, *notes), **flags,
        )  # fmt: skip

    return compiled


class inline:  # noqa: N801
    """A kernel without arguments of its own in C: its statements are put in where it is called."""

    def __init__(self, function: Callable[..., Any]) -> None:
        self.text = _Text(function)
        self.signature = inspect.signature(function)

    def __call__(self, *arguments: Any, **named: Any) -> Any:
        raise TypeError("an inline kernel is called in the text of a kernel")

    def put_into(self, body: Body, *arguments: Any, **named: Any) -> Any:
        """Its statements in a body; what it returns."""
        bound = self.signature.bind(*arguments, **named)
        bound.apply_defaults()
        scope = bound.arguments
        for name in scope:
            if self.text.annotations.get(name) == "Result":
                scope[name] = _Pointed(scope[name])
        return _Compilation(self.text, body, scope, inlined=True).block(self.text.statements)


@dataclass(frozen=True)
class _Pointed:
    """A scalar result of a function."""

    value: Place


class _Text:
    """The text of a kernel: its tree, its comments, and the names around it."""

    def __init__(self, function: Callable[..., Any]) -> None:
        lines, self.line = inspect.getsourcelines(function)
        self.file = inspect.getsourcefile(function)
        source = textwrap.dedent("".join(lines))
        tree = ast.parse(source).body[0]
        assert isinstance(tree, ast.FunctionDef)
        self.docstring = ast.get_docstring(tree) or ""
        self.statements = tree.body[1:] if self.docstring else tree.body
        self.returns = ast.unparse(tree.returns) if tree.returns else "None"
        around = inspect.getclosurevars(function)
        self.names: dict[str, Any] = {**around.globals, **around.nonlocals}
        self.annotations = {node.arg: ast.unparse(node.annotation) for node in tree.args.args if node.annotation}
        self.defaults = {p.name: p.default for p in inspect.signature(function).parameters.values()}
        self.beside: dict[int, str] = {}  # comment at the end of a line
        self.before: dict[int, str] = {}  # comment on a line of its own
        for token in tokenize.generate_tokens(io.StringIO(source).readline):
            if token.type == tokenize.COMMENT:
                alone = not token.line[: token.start[1]].strip()
                words = token.string.lstrip("# ").split("# noqa")[0].strip()
                if words and not words.startswith("noqa"):
                    (self.before if alone else self.beside)[token.start[0]] = words

    def arguments(self) -> tuple[Argument, ...]:
        """The arguments of the function, from the default values of its parameters."""
        arguments = []
        for name, declared in self.defaults.items():
            if not isinstance(declared, Argument):
                raise KernelError(f"{self.file}:{self.line}: {name}: expected argument(...) as its default value")
            type_ = declared.type if isinstance(declared.type, Struct) else KINDS[self.annotations[name]]
            arguments.append(declared if declared.name else replace(declared, name=_in_c(name), type=type_))
        return tuple(arguments)

    def error(self, node: ast.AST, words: str) -> KernelError:
        """The error at a place of the text."""
        line = self.line + getattr(node, "lineno", 1) - 1
        return KernelError(f"{self.file}:{line}: {words}")


def _in_c(name: str) -> str:
    """A name in C."""
    short = name.removesuffix("_")
    return short if keyword.iskeyword(short) or hasattr(builtins, short) else name


class _Compilation:
    """Compiles the statements of a text into a body.

    `scope`: arguments and locals by name; `inlined`: `return` ends no function of C.
    """

    def __init__(self, text: _Text, body: Body, scope: Mapping[str, Any], inlined: bool = False) -> None:
        self.text = text
        self.body = body
        self.scope = dict(scope)
        self.variables: set[str] = set()  # those that change
        self.inlined = inlined
        self.line = 0  # of the last statement

    # -- statements ----------------------------------------------------------------------------------------------

    def block(self, statements: Sequence[ast.stmt]) -> Any:
        """Compile the statements of a block, whose names end with it."""
        scope, variables = dict(self.scope), set(self.variables)
        value = self.statements(statements)
        self.scope, self.variables = scope, variables
        return value

    def statements(self, statements: Sequence[ast.stmt]) -> Any:
        """Compile statements; the value of a `return` at the end of an inline kernel."""
        value = None
        for statement in statements:
            self._notes(statement.lineno)
            self.line = statement.lineno
            try:
                value = self.statement(statement)
            except KernelError:
                raise
            except Exception as error:
                raise self.text.error(statement, f"{ast.unparse(statement).splitlines()[0]}: {error}") from error
            self.line = statement.end_lineno or 0
        return value

    def _notes(self, line: int) -> None:
        """Comments on lines of their own before a statement: one note, if they follow one another."""
        lines = [self.text.before[n] for n in range(self.line + 1, line) if n in self.text.before]
        if lines:
            self.body.note(" ".join(lines))

    def statement(self, node: ast.stmt) -> Any:
        """Compile a statement."""
        comment = self.text.beside.get(node.end_lineno or 0, "")
        match node:
            case ast.AnnAssign(ast.Name(name), annotation, ast.expr() as value):
                first = self.value(value)
                self.body.set(self._local(name, Local((), KINDS[ast.unparse(annotation)]), comment), first)
            case ast.Assign([ast.Tuple(targets)], value):
                for target, part in zip(targets, self.value(value), strict=True):
                    self._assign(target, part, comment)
            case ast.Assign([target], value):
                self._assign(target, self.value(value), comment, isinstance(value, ast.Call))
            case ast.AugAssign(target, ast.Add() | ast.Sub() as operator, value):
                place = self.value(target)
                change = as_expr(self.value(value), place.kind)
                self.body.add(place, -change if isinstance(operator, ast.Sub) else change, comment)
            case ast.Expr(value):
                result = self.value(value)
                if isinstance(result, Call):
                    self.body.do(result, comment)
            case ast.For(ast.Name(name), iterated, inner, []):
                self._loop(name, iterated, inner, self.text.beside.get(node.iter.end_lineno or 0, ""))
            case ast.If(test, inner, otherwise):
                self._when(test, inner, otherwise, self.text.beside.get(node.test.end_lineno or 0, ""))
            case ast.With([ast.withitem(context, None)], inner):
                with self.value(context):
                    self.block(inner)
            case ast.Return(value):
                result = None if value is None else self.value(value)
                if not self.inlined:
                    self.body.ret(as_expr(cast(Operand, result), Kind.REAL))
                return result
            case ast.Pass():
                pass
            case _:
                raise self.text.error(node, f"no statement of a kernel: {ast.unparse(node).splitlines()[0]}")
        return None

    def _local(self, name: str, local: Local, comment: str) -> Place:
        """A local variable, which is in scope from now on."""
        place = self.body.local(_in_c(name), local.shape, local.type, comment)
        self.scope[name] = place
        self.variables.add(name)
        return place

    def _assign(self, target: ast.expr, result: Any, comment: str, called: bool = False) -> None:
        """`x = e`, `a[i] = e`, `a.b = e`. A part that is no number, and a place that a call made, get a second name."""
        if not isinstance(target, ast.Name):
            self.body.set(self.value(target), result, comment)
        elif target.id in self.variables:
            self.body.set(self.scope[target.id], result, comment)
        elif isinstance(self.scope.get(target.id), Place) and not called:
            raise TypeError(f"{target.id} has a value already: what changes is declared, {target.id}: float = ...")
        elif isinstance(result, Local):
            self._local(target.id, result, comment)
        elif isinstance(result, Expr) and not (isinstance(result, Place) and (called or not result.is_scalar)):
            self.scope[target.id] = self.body.let(_in_c(target.id), result, comment)
        else:
            self.scope[target.id] = result

    def _loop(self, name: str, iterated: ast.expr, inner: Sequence[ast.stmt], comment: str) -> None:
        """A loop over `range(stop)` or `range(start, stop)`; a repetition for each value of anything else."""
        match iterated:
            case ast.Call(ast.Name("range"), [*bounds], []):
                start, stop = [integer(0), *map(self.value, bounds)][-2:]
                with self.body.loop(_in_c(name), stop, start, comment) as index:
                    scope = dict(self.scope)
                    self.scope[name] = index
                    self.block(inner)
                    self.scope = scope
            case _:
                for value in self.value(iterated):
                    self.line, self.scope[name] = iterated.lineno, value
                    self.statements(inner)

    def _when(self, test: ast.expr, inner: Sequence[ast.stmt], otherwise: Sequence[ast.stmt], comment: str) -> None:
        """`if`, and `else`; a branch alone, where Python knows which."""
        condition = self.value(test)
        if not isinstance(condition, Expr):
            self.block(inner if condition else otherwise)
            return
        with self.body.when(condition, comment):
            self.block(inner)
        if otherwise:
            with self.body.otherwise():
                self.block(otherwise)

    # -- expressions ---------------------------------------------------------------------------------------------

    def value(self, node: ast.expr) -> Any:
        """The value of an expression: an Expr, or a value of Python."""
        tree = ast.fix_missing_locations(ast.Expression(_Operators().visit(copy.deepcopy(node))))
        for part in ast.walk(tree):
            if isinstance(part, ast.Name | ast.Attribute | ast.Subscript):
                part.ctx = ast.Load()  # a target is a place as well
        names = self.text.names | OPERATORS | {"let": self.body.let} | self.scope
        for name, value in names.items():
            if isinstance(value, inline):
                names[name] = partial(value.put_into, self.body)
        return eval(compile(tree, "<kernel>", "eval"), names)  # text of the house, which is imported anyway


class _Operators(ast.NodeTransformer):
    """Calls of functions in the place of operators whose meaning a Python class cannot give."""

    def visit_IfExp(self, node: ast.IfExp) -> ast.expr:
        return self._call("_select", node.test, node.body, node.orelse)

    def visit_BoolOp(self, node: ast.BoolOp) -> ast.expr:
        return self._call("_and" if isinstance(node.op, ast.And) else "_or", *node.values)

    def visit_UnaryOp(self, node: ast.UnaryOp) -> ast.AST:
        return self._call("_not", node.operand) if isinstance(node.op, ast.Not) else self.generic_visit(node)

    def visit_Compare(self, node: ast.Compare) -> ast.AST:
        match node.ops:
            case [ast.Eq() | ast.NotEq() as operator]:
                name = "_equal" if isinstance(operator, ast.Eq) else "_unequal"
                return self._call(name, node.left, node.comparators[0])
        return self.generic_visit(node)

    def _call(self, name: str, *parts: ast.expr) -> ast.expr:
        """A call whose arguments are evaluated when they are needed: one of Python's truth values may decide."""
        nothing = ast.arguments([], [], None, [], [], None, [])
        return ast.Call(ast.Name(name, ast.Load()), [ast.Lambda(nothing, self.visit(part)) for part in parts], [])


Late = Callable[[], Any]


def _select(condition: Late, yes: Late, no: Late) -> Any:
    test = condition()
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
            if not isinstance(value, Expr):
                if bool(value) is decides:
                    return decides
            else:
                result = value if result is None else join(result, value)
        return not decides if result is None else result

    return joined


def _not(operand: Late) -> Any:
    value = operand()
    return Not(value) if isinstance(value, Expr) else not value


def _compared(operator: str) -> Callable[[Late, Late], Any]:
    def compared(left: Late, right: Late) -> Any:
        a, b = left(), right()
        if isinstance(a, Expr) or isinstance(b, Expr):
            return compare(operator, a, b)
        return (a == b) is (operator == "==")

    return compared


OPERATORS: dict[str, Any] = {
    "_select": _select,
    "_and": _joined(and_, False),
    "_or": _joined(or_, True),
    "_not": _not,
    "_equal": _compared("=="),
    "_unequal": _compared("!="),
    "abs": lambda value: magnitude(value) if isinstance(value, Expr) else abs(value),
    "float": lambda value: Convert(value, Kind.REAL) if isinstance(value, Expr) else float(value),
}
"""What operators and built-in functions are in the text of a kernel."""
