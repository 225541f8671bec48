"""Functions of the program on columns: of many samples at once, every real is an array of NumPy.

They are run operation by operation, as the interpreter does: + - * / and square roots have the interpreter's bits. What
samples do by a condition on reals is done for all of them, and selected; other branches, loops and indices are those of
Python.
"""

from __future__ import annotations

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
            case Compare() if e.left.kind is Kind.REAL:
                return f"compared({super()._expr(e)}, {self._expr(e.left)}, {self._expr(e.right)})"
        return super()._expr(e)


ROUTINES = {"sqrt": np.sqrt, "atan2": np.arctan2, "exp": np.exp}
"""Functions of the program that NumPy has."""


class Columns(Interpreter):
    """The functions of a program on columns.

    refused  truth values of the samples that functions have refused
    ties     those of comparisons of equal numbers; with `turned` these have the other answer
    """

    def __init__(self, program: Program) -> None:
        names = {f.name for f in program.functions}
        super().__init__(program, {name: routine for name, routine in ROUTINES.items() if name in names})
        self.refused, self.ties, self.turned = list[Any](), list[Any](), False
        self._scope |= {"select": _select, "magnitude": abs, "opposite": _opposite, "divided": _divide}
        self._scope |= {"compared": self._compared, "refused": self.refused.append}

    def begin(self, turned: bool = False) -> None:
        """Forget what was refused, and the ties, before a call."""
        self.refused.clear()
        self.ties.clear()
        self.turned = turned

    def _source(self, function: Function) -> str:
        return _Selecting(self._scope, self._precision).function(function)

    def _compared(self, answer: Any, a: Any, b: Any) -> Any:
        if not isinstance(answer, np.ndarray):
            return answer
        self.ties.append(a == b)
        return answer ^ self.ties[-1] if self.turned else answer


def _on_reals(condition: Expr) -> bool:
    return any(isinstance(e, Compare) and e.left.kind is Kind.REAL for e in inside(condition))


def _select(where: Any, yes: Any, no: Any) -> Any:
    return (yes if where else no) if isinstance(where, bool) else np.where(where, yes, no)


def _opposite(where: Any) -> Any:
    return not where if isinstance(where, bool) else ~where


def _divide(a: Any, b: Any) -> Any:
    """The quotient; where nothing can be divided, a number that no sample takes."""
    return a / (np.where(b == 0.0, 1.0, b) if isinstance(b, np.ndarray) else np.float64(b))
