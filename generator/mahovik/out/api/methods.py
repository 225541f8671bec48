"""Methods of a model for functions of the contract that have no typed method of their own."""

from __future__ import annotations

from collections.abc import Callable
from inspect import Parameter, Signature

from mahovik.contract.functions import FUNCTIONS, PublicFunction
from mahovik.contract.quantities import QUANTITIES, shared
from mahovik.out.api.core import Built
from mahovik.out.api.results import Result


def add_methods(model: type[Built]) -> None:
    """Give a class of models a method for each function of states that it has none for."""
    for row in FUNCTIONS.values():
        if row.python and "x" in row.takes and not hasattr(model, row.name):
            setattr(model, row.name, _method(row))


def _method(row: PublicFunction) -> Callable[..., Result]:
    inputs = [name for name in row.takes if name not in ("x", "wrench") and not shared(name)]
    positional, keyword = Parameter.POSITIONAL_OR_KEYWORD, Parameter.KEYWORD_ONLY
    parameters = [Parameter(name, positional) for name in ("self", "x")]
    parameters += [Parameter(name, positional, default=0.0) for name in inputs]
    parameters += [Parameter("wrench", keyword, default=None)] if "wrench" in row.takes else []
    signature = Signature([*parameters, Parameter("on_error", keyword, default="raise")])

    def method(*arguments: object, **named: object) -> Result:
        bound = signature.bind(*arguments, **named)
        bound.apply_defaults()
        given = dict(bound.arguments)
        model, x, on_error = (given.pop(name) for name in ("self", "x", "on_error"))
        found: Result = model._result(Result, row.name, x, on_error, given.pop("wrench", None), **given)
        return found

    results = (f"`{name}`" + (f", {q.unit}: {q.axes}" if (q := QUANTITIES.get(name)) else "") for name in row.gives)
    method.__doc__ = f"{'; '.join(results)}. State by state. Raises InputError, RefusedError."
    method.__name__ = row.name
    method.__signature__ = signature  # type: ignore[attr-defined]  # inspect reads it
    return method
