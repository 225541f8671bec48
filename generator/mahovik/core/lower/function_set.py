"""The functions of a program while it is being built, as far as a law of `laws/` needs them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

from mahovik.core.lower.limits import Limit, Thresholds, limits, thresholds
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Expr, Operand
from mahovik.core.program.function import Function
from mahovik.core.program.kernel import kernel
from mahovik.core.program.simplify import prune
from mahovik.core.program.types import Precision, Struct
from mahovik.core.routines import exponential
from mahovik.core.stand.model import Structure


class Structs(Protocol):
    """The part of a stand's layout that laws see: its structure, and the structs that their functions take."""

    @property
    def structure(self) -> Structure: ...

    @property
    def precision(self) -> Precision: ...

    @property
    def state(self) -> Struct: ...

    @property
    def table(self) -> Struct: ...

    @property
    def damper(self) -> Struct: ...


class FunctionSet:
    """The functions built so far by name, each after those it calls; structs and bounds for the next ones."""

    layout: Structs

    def __init__(self, layout: Structs) -> None:
        self.layout = layout
        self.limits: dict[str, Limit] = limits(layout.precision)
        self.thresholds: Thresholds = thresholds(layout.precision)
        self._functions: dict[str, Function] = {}

    @property
    def largest(self) -> Expr:
        """The largest finite number."""
        return self.limits["LARGEST"].expression

    def limit(self, name: str) -> Any:
        """The bound of that name, a named constant."""
        return self.limits[name].expression

    def add(self, function: Function) -> Function:
        """Adds a function; later ones may call it. An internal function loses the arguments that it does not use."""
        assert function.name not in self._functions
        function = prune(function)
        self._functions[function.name] = function
        return function

    def kernel(self, name: str = "", **options: Any) -> Callable[[Callable[..., Any]], Function]:
        """Adds the function whose text a Python function is: see `kernel`."""
        return lambda function: self.add(kernel(name, **options)(function))

    def add_exponential(self) -> None:
        """Adds the function `exp`, for a law that needs it, unless it is there."""
        if "exp" not in self:
            self.add(exponential(self.layout.precision))

    def __getitem__(self, name: str) -> Function:
        return self._functions[name]

    def __contains__(self, name: str) -> bool:
        return name in self._functions

    @property
    def functions(self) -> tuple[Function, ...]:
        return tuple(self._functions.values())

    @property
    def table(self) -> Any:
        """The prepared stand."""
        return Argument("table", self.layout.table, purpose="the prepared table")

    @property
    def x(self) -> Any:
        """The state."""
        return Argument("x", self.layout.state, purpose="state; its attitude within 1e-3 of unit length")

    @property
    def damper(self) -> Any:
        """What the table has of a body for the laws of its own twist."""
        return Argument("damper", self.layout.damper)

    def arguments_of(self, function: str, **named: Operand | None) -> list[Operand]:
        """The arguments of a function in its order, by name; unused ones are left out."""
        values = [named[a.name] for a in self[function].arguments]
        if any(value is None for value in values):
            raise TypeError(f"{function} needs an argument that the caller does not give")
        return [value for value in values if value is not None]

    def taken(self, function: str) -> list[str]:
        """Names of the arguments of a function."""
        return [a.name for a in self[function].arguments]
