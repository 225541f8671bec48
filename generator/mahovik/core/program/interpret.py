"""Runs a program operation by operation, in float32 or float64.

Each function is turned into a Python function that does the same operations in the same order; every real is a
`numpy.float32`, or a `float` of Python, which is IEEE double as well and much faster than NumPy's; or a column of them,
of many stands at once, which has the operators of numbers and `map`. Every word is reduced to its width.
The generator computes the tables of a stand with it, so that they are the same on every machine and equal to what
`prepare` computes on the target, and `verify` demands that the compiled C agrees with it bit for bit.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from struct import pack, unpack
from types import SimpleNamespace
from typing import Any

import numpy as np

from mahovik.contract.status import STATUS_VALUES
from mahovik.core.program.call import Argument, Call
from mahovik.core.program.expression import (
    BitCast,
    Const,
    Convert,
    Expr,
    Missing,
    Negate,
    Not,
    Pair,
    Place,
    Present,
    Select,
    Status,
    Variable,
)
from mahovik.core.program.function import Function, Program
from mahovik.core.program.statement import Block, Copy, Declare, Do, Let, Loop, Note, Return, Set, Statement, When
from mahovik.core.program.types import Field, Kind, Precision, Struct


class Interpreter:
    """The functions of a program, ready to be called from Python.

    Structs are records with attributes, arrays nested lists, scalar results lists of one; `new` makes them.
    """

    def __init__(self, program: Program, replaced: Mapping[str, Callable[..., Any]] | None = None) -> None:
        """`replaced`: Python functions to call in place of functions of the program, by their names."""
        self._functions = {f.name: f for f in program.functions}
        self._precision = program.precision
        self._scope: dict[str, Any] = _runtime(program.precision)
        self._scope |= {_function_name(f.name): self._compiled_at_first_call(f, program) for f in program.functions}
        self._scope |= {_function_name(name): function for name, function in (replaced or {}).items()}

    def _compiled_at_first_call(self, function: Function, program: Program) -> Callable[..., Any]:
        """What compiles a function, takes its own place by it, and calls it: most callers need few functions."""

        def first(*arguments: Any) -> Any:
            exec(compile(self._source(function), f"<program {program.name}.{function.name}>", "exec"), self._scope)
            return self._scope[_function_name(function.name)](*arguments)

        return first

    def _source(self, function: Function) -> str:
        """The text of a function in Python."""
        return Transpiler(self._scope, self._precision).function(function)

    def call(self, name: str, *arguments: Any) -> Any:
        """Calls a function; results are written into the records and lists given. Returns its real or status number."""
        implementation: Callable[..., Any] = self._scope[_function_name(name)]
        with np.errstate(all="ignore"):
            return implementation(*arguments)

    def new(self, type_: Kind | Struct, shape: tuple[Any, ...] = ()) -> Any:
        """Zeroed storage of that type; a scalar is a list of one."""
        return new_value(type_, shape, self._precision)

    def fill_storage(self, type_: Kind | Struct, value: Any, shape: tuple[Any, ...] = ()) -> Any:
        """Storage of that type, filled from plain numbers, dicts and lists."""
        return filled_value(type_, shape, value, self._precision)

    def argument(self, argument: Argument, value: Any = None) -> Any:
        """Storage for an argument, filled from plain numbers, dicts and lists where `value` is given.

        None: an argument that is missing.
        """
        if value is None and argument.optional == "missing":
            return None
        if value is None:
            filled = self.new(argument.type, argument.shape)
        else:
            filled = filled_value(argument.type, argument.shape, value, self._precision)
        return [filled] if _is_box(argument.variable) else filled

    def run(self, name: str, inputs: Mapping[str, Any]) -> tuple[Any, dict[str, Any]]:
        """Calls a function with inputs by argument name; returns its value and its outputs as plain data."""
        function = self._functions[name]
        storage = {a.name: self.argument(a, inputs.get(a.name)) for a in function.arguments}
        value = self.call(name, *storage.values())
        boxes = {a.name for a in function.arguments if _is_box(a.variable)}
        result = {name: place[0] if name in boxes else place for name, place in storage.items()}
        results = [a.name for a in function.arguments if a.direction != "in" and result[a.name] is not None]
        return value, {name: plain(result[name]) for name in results}


def new_value(type_: Kind | Struct, shape: tuple[Any, ...], precision: Precision) -> Any:
    """Zeroed storage."""
    if len(shape) == 1 and not isinstance(type_, Struct):
        return [new_value(type_, (), precision)] * int(shape[0])  # numbers never change: one stands for all
    if shape:
        return [new_value(type_, shape[1:], precision) for _ in range(int(shape[0]))]
    if isinstance(type_, Struct):
        return SimpleNamespace(**{f.name: new_value(f.type, f.shape, precision) for f in type_.fields})
    return _number(precision)(0) if type_ is Kind.REAL else 0


def filled_value(type_: Kind | Struct, shape: tuple[Any, ...], value: Any, precision: Precision) -> Any:
    """Storage filled from dicts (structs), sequences (arrays) and numbers."""
    if shape:
        count = int(shape[0])
        if count and len(value) != count:
            raise ValueError(f"{len(value)} elements given, {count} expected")
        return [filled_value(type_, shape[1:], v, precision) for v in value]
    if isinstance(type_, Struct):
        if isinstance(value, SimpleNamespace):
            return value

        def member(f: Field) -> Any:
            return filled_value(f.type, f.shape, value[f.name], precision)

        return SimpleNamespace(**{f.name: member(f) for f in type_.fields})
    if hasattr(value, "map"):
        return value.map(lambda numbers: numbers.astype(precision.scalar))
    return _number(precision)(value) if type_ is Kind.REAL else int(value)


def plain(value: Any) -> Any:
    """Records as dicts, lists as lists, scalars as they are."""
    if isinstance(value, SimpleNamespace):
        return {name: plain(v) for name, v in vars(value).items()}
    if isinstance(value, list):
        return [plain(v) for v in value]
    return value


def _number(precision: Precision) -> Any:
    """What makes a real of that precision."""
    return float if precision.scalar is np.float64 else precision.scalar


def _word_of_double(x: float) -> int:
    word: int = unpack("<Q", pack("<d", x))[0]
    return word


def _double_of_word(w: int) -> float:
    result: float = unpack("<d", pack("<Q", w))[0]
    return result


def _function_name(name: str) -> str:
    return f"function_{name}"


def _runtime(precision: Precision) -> dict[str, Any]:
    """Functions that the generated Python uses besides operators."""
    scalar, word, number = precision.scalar, precision.word, _number(precision)

    def copy_value(value: Any) -> Any:
        if isinstance(value, SimpleNamespace):
            return SimpleNamespace(**{k: copy_value(v) for k, v in vars(value).items()})
        if isinstance(value, list):
            return [copy_value(v) for v in value]
        return value

    def assign(target: SimpleNamespace, source: SimpleNamespace) -> None:
        for name, value in vars(source).items():
            setattr(target, name, copy_value(value))

    def quotient(a: int, b: int) -> int:
        """Towards zero, as in C; `//` of Python is towards minus infinity."""
        return abs(a) // abs(b) * (1 if (a < 0) == (b < 0) else -1)

    def divide(a: Any, b: Any) -> Any:
        """Quotient by IEEE 754, also where Python raises an error."""
        if hasattr(b, "map"):
            return a / b
        return a / b if b else number(scalar(a) / scalar(b))

    def bits_of(x: Any) -> Any:
        if hasattr(x, "map"):
            return x.map(lambda numbers: numbers.view(word))
        return _word_of_double(x) if number is float else int(scalar(x).view(word))

    def real_of_bits(w: Any) -> Any:
        if hasattr(w, "map"):
            return w.map(lambda words: words.view(scalar))
        return _double_of_word(w) if number is float else word(w).view(scalar)

    return {
        "quotient": quotient,
        "divided": divide,
        "bits_of": bits_of,
        "real_of_bits": real_of_bits,
        "scalar": number,
        "assign": assign,
        "new_value": new_value,
        "PRECISION": precision,
        "TYPES": {},
    }


class Transpiler:
    """Writes one function as Python. Every operation is parenthesised: the tree alone decides the order."""

    def __init__(self, scope: dict[str, Any], precision: Precision) -> None:
        self._scope = scope
        self._mask = (1 << precision.width) - 1
        self._precision = precision
        self._lines: list[str] = []

    def function(self, function: Function) -> str:
        names = ", ".join(_safe(a.name) for a in function.arguments)
        self._lines = [f"def {_function_name(function.name)}({names}):"]
        self._block(function.body, "    ")
        return "\n".join(self._lines)

    def _block(self, body: tuple[Statement, ...], indent: str) -> None:
        length = len(self._lines)
        for statement in body:
            self._statement(statement, indent)
        if len(self._lines) == length:
            self._lines.append(indent + "pass")

    def _statement(self, s: Statement, indent: str) -> None:
        emit = self._lines.append
        match s:
            case Note():
                pass
            case Let(variable, value):
                emit(f"{indent}{_safe(variable.name)} = {self._expr(value)}")
            case Declare(variable):
                self._scope["TYPES"][variable.name, id(variable)] = variable
                key = f"TYPES[{variable.name!r}, {id(variable)}]"
                made = f"new_value({key}.type, {key}.shape, PRECISION)"
                emit(f"{indent}{_safe(variable.name)} = {f'[{made}]' if _is_box(variable) else made}")
            case Set(place, value, _, add):
                target = self._place(place)
                right = self._expr(value)
                emit(f"{indent}{target} = {f'({target} + {right})' if add else right}")
            case Copy(target, source):
                emit(f"{indent}assign({self._place(target)}, {self._place(source)})")
            case Block(body):
                for inner in body:
                    self._statement(inner, indent)
            case Do(call):
                emit(f"{indent}{self._expr(call)}")
            case Loop():
                emit(indent + self._head(s))
                self._block(s.body, indent + "    ")
            case When(condition, body, otherwise):
                emit(f"{indent}if {self._expr(condition)}:")
                self._block(body, indent + "    ")
                if otherwise:
                    emit(f"{indent}else:")
                    self._block(otherwise, indent + "    ")
            case Return(value):
                emit(f"{indent}return {self._expr(value)}")

    def _head(self, s: Loop) -> str:
        return f"for {_safe(s.index.name)} in range({self._expr(s.start)}, {self._expr(s.stop)}):"

    def _place(self, place: Place) -> str:
        text = _safe(place.root.name)
        if _is_box(place.root):
            text += "[0]"
        for step in place.path:
            text += f".{step}" if isinstance(step, str) else f"[{self._expr(step)}]"
        return text

    def _constant(self, e: Const) -> str:
        if e.kind is not Kind.REAL:
            return repr(int(e.value))
        name = f"literal_{len(self._scope)}"
        self._scope[name] = _number(self._precision)(float(e.value))
        return name

    def _expr(self, e: Expr) -> str:
        match e:
            case Const():
                return self._constant(e)
            case Status():
                return repr(STATUS_VALUES[e.name])
            case Place():
                return self._place(e)
            case Negate():
                text = f"(-{self._expr(e.operand)})"
                return f"({text} & {self._mask})" if e.kind is Kind.WORD else text
            case Pair(operator="/"):
                return (
                    f"{'divided' if e.kind is Kind.REAL else 'quotient'}({self._expr(e.left)}, {self._expr(e.right)})"
                )
            case Pair():
                operator = {"&&": "and", "||": "or"}.get(e.operator, e.operator)
                text = f"({self._expr(e.left)} {operator} {self._expr(e.right)})"
                return f"({text} & {self._mask})" if e.kind is Kind.WORD else text
            case Missing():
                return "None"
            case Present(operand=Place(root=root)):
                return f"({_safe(root.name)} is not None)"
            case Not():
                return f"(not {self._expr(e.operand)})"
            case Select():
                return f"({self._expr(e.yes)} if {self._expr(e.condition)} else {self._expr(e.no)})"
            case Convert():
                inner = self._expr(e.operand)
                if e.kind is Kind.REAL:
                    return f"scalar({inner})"
                return f"({inner} & {self._mask})" if e.kind is Kind.WORD else f"int({inner})"
            case BitCast():
                return f"{'bits_of' if e.kind is Kind.WORD else 'real_of_bits'}({self._expr(e.operand)})"
            case Call():
                passed = ", ".join(self._argument(parameter, value) for parameter, value in e.pairs)
                return f"{_function_name(e.signature.name)}({passed})"
        raise TypeError(f"unknown expression {type(e).__name__}")

    def _argument(self, parameter: Argument, value: Expr) -> str:
        """An argument as passed: whole places as they are, a scalar result as a list of one."""
        if isinstance(value, Missing) or not (parameter.variable.pointer and not isinstance(parameter.type, Struct)):
            return self._expr(value)
        assert isinstance(value, Place)
        if value.path or not _is_box(value.root):
            raise TypeError(f"{value!r} is no local scalar: it cannot hold the result {parameter.name}")
        return _safe(value.root.name)


def _is_box(variable: Variable) -> bool:
    """A scalar that is written through its address is a list of one."""
    return (variable.pointer or variable.written) and not variable.shape and isinstance(variable.type, Kind)


def _safe(name: str) -> str:
    """Python's own words are no variable names."""
    return f"v_{name}"
