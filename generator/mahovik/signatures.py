"""Arguments of a function, checked by its annotations, and by which of them need or exclude one another.

`needs` names the arguments that mean nothing without another, `excludes` those that mean nothing beside it: `improve`
is another that is given, `project=fmu` one of this value, `subject=*.json` one that ends so; ` or ` is between several.
"""

from __future__ import annotations

import builtins
import inspect
import os
import sys
import types
import typing
from collections.abc import Callable, Iterable, Mapping, Sequence
from fnmatch import fnmatch
from functools import cache, wraps
from numbers import Integral, Real
from typing import Any, TypeVar, cast

from mahovik.errors import UsageError

Rules = Mapping[str, Sequence[str]]
Kinds = Mapping[str, tuple[str, list[Any]]]
"""What each argument takes: a word for its value, as "speed" or "" for none, and its types beside None."""

Function = TypeVar("Function", bound=Callable[..., Any])

HIDDEN = "hidden"
"""Word of an argument that the command line does not have."""

FILES = (".csv", ".json", ".parquet", ".svg", ".png", ".html", ".toml")
"""Ends of names of files, which no folder to write has."""

WORDS: dict[Any, str] = {
    bool: "True or False", int: "a whole number", float: "a number", str: "a text", os.PathLike: "a path",
    Mapping: "a mapping", tuple: "a list", Sequence: "a list", Iterable: "a list", Callable: "a function",
}  # fmt: skip
"""Kinds of values that arguments take, in words."""


def check_arguments(
    function: Callable[..., Any], args: Sequence[Any], keywords: Mapping[str, Any], needs: Rules, excludes: Rules
) -> None:
    """Raise UsageError for an argument that is of no kind that the function takes, or means nothing beside the others.

    What the function does not have at all, or lacks, is left to Python.
    """
    parameters, kinds = inspect.signature(function).parameters, kinds_of(function)
    arguments = {key: x for key, x in (*zip(parameters, args, strict=False), *keywords.items()) if key in parameters}
    for name, value in arguments.items():
        if name in kinds and value is not parameters[name].default:
            _check(name, value, *kinds[name])
    meant = {name: x for name, x in arguments.items() if _says_more(x, parameters[name].default)}
    values = {name: one.default for name, one in parameters.items()} | meant
    _check_together(kinds, meant, values, needs, excludes)


def checked(function: Function) -> Function:
    """A function of which the arguments are checked before it runs."""

    @wraps(function)
    def checking(*args: Any, **values: Any) -> Any:
        check_arguments(function, args, values, {}, {})
        return function(*args, **values)

    return cast("Function", checking)


# ---- what the annotations of a function say


class _Unloaded:
    """Base of classes that stand for those that are imported for type checkers alone: their objects have the name."""


class _Names(dict[str, Any]):
    """Names in annotations."""

    def __missing__(self, name: str) -> Any:
        return type(name, (_Unloaded,), {})


@cache
def kinds_of(function: Callable[..., Any]) -> Kinds:
    """What the annotations of a function say."""
    inner = inspect.unwrap(function)
    names = _Names(vars(builtins) | vars(sys.modules[inner.__module__]))
    hints = typing.get_type_hints(inner, None, names, include_extras=True)
    return {name: alternatives(hint) for name, hint in hints.items()}


def alternatives(hint: Any) -> tuple[str, list[Any]]:
    """Word for the value of an annotation, and its alternatives without None."""
    if typing.get_origin(hint) is typing.Annotated:
        inside, *_, word = typing.get_args(hint)
        return word, alternatives(inside)[1]
    if typing.get_origin(hint) in (typing.Union, types.UnionType):
        parts = [alternatives(part) for part in typing.get_args(hint) if part is not type(None)]
        return next((word for word, _ in parts if word), ""), [kind for _, kinds in parts for kind in kinds]
    return "", [hint]


# ---- checks


def _check(name: str, value: Any, word: str, kinds: Sequence[Any]) -> None:
    """Raise UsageError unless a value is of one of the kinds."""
    if isinstance(value, str) and not value:
        raise UsageError(f"{name}: is empty")
    if word == "DIR" and str(value).endswith(FILES):
        raise UsageError(f"{name} {value}: expected a folder")
    if any(_is(kind, value) for kind in kinds):
        return
    for where, part, inner in (entry for kind in kinds for entry in _inside(kind, value) or ()):
        _check(f"{name}{where}", part, word, inner)
    choices = [word for kind in kinds if typing.get_origin(kind) is typing.Literal for word in typing.get_args(kind)]
    if choices:
        raise UsageError(f'{name}: unknown "{value}", expected one of {", ".join(map(str, choices))}')
    words = dict.fromkeys(_words(kind, word) for kind in kinds)
    shown = value if isinstance(value, str | Real | None) else f"of type {type(value).__name__}"
    raise UsageError(f"{name} {shown}: expected {' or '.join(words)}")


def _words(kind: Any, word: str) -> str:
    """A kind in words; of a mapping with its form on the command line."""
    origin = typing.get_origin(kind) or kind
    words = next((words for known, words in WORDS.items() if issubclass(origin, known)), origin.__name__)
    return f"{words} {word}" if origin is Mapping and "=" in word else words


def _is(kind: Any, value: Any) -> bool:
    """Whether a value is of a kind: texts are no lists, True is no number; what the package made is as it is."""
    origin = typing.get_origin(kind) or kind
    made = type(value).__module__.startswith("mahovik.") and not isinstance(value, Mapping)
    if made or origin in (Any, object):
        return True
    if origin is typing.Literal:
        return isinstance(value, str | int) and value in typing.get_args(kind)
    if origin in (int, float):
        return isinstance(value, Integral if origin is int else Real) and not isinstance(value, bool)
    if origin in (Mapping, Sequence, tuple):
        inside = _inside(kind, value)
        return inside is not None and all(any(_is(one, part) for one in kinds) for _, part, kinds in inside)
    if issubclass(origin, _Unloaded):
        return origin.__name__ in (base.__name__ for base in type(value).__mro__)
    return isinstance(value, origin)


def _inside(kind: Any, value: Any) -> list[tuple[str, Any, list[Any]]] | None:
    """What is in a mapping or a list of a kind: its place, the value, its kinds; None of what is not such a one."""
    origin, parts = typing.get_origin(kind) or kind, [part for part in typing.get_args(kind) if part is not ...]
    kinds = [one for part in parts[-1:] for one in alternatives(part)[1]] or [object]
    if isinstance(value, Mapping):
        return [(f" {key}", part, kinds) for key, part in value.items()] if origin is Mapping else None
    listed = hasattr(value, "__len__") and hasattr(value, "__getitem__") and not isinstance(value, str)
    return [(f"[{k}]", part, kinds) for k, part in enumerate(value)] if listed and origin in (Sequence, tuple) else None


def _says_more(value: Any, default: Any) -> bool:
    """Whether an argument is neither its default nor empty."""
    if value is None or value is False or (isinstance(value, str | Sequence | Mapping) and not len(value)):
        return False
    return not (isinstance(value, str | Real) and type(value) is type(default) and value == default)


def _check_together(
    kinds: Kinds, meant: Mapping[str, Any], values: Mapping[str, Any], needs: Rules, excludes: Rules
) -> None:
    """Raise UsageError for an argument that is given without one that it needs, or beside one that excludes it."""

    def word(condition: str) -> str:
        name, equals, _ = condition.partition("=")
        word, of = kinds[name]
        return condition if equals else f"{name}={word or {bool: 'True', int: 'N'}.get(of[0], name.upper())}"

    def holds(condition: str) -> bool:
        name, equals, wanted = condition.partition("=")
        return fnmatch(str(values[name]), wanted) if equals else name in meant

    for rules, wanted in ((needs, True), (excludes, False)):
        for condition, names in rules.items():
            alternatives = condition.split(" or ")
            holding = [one for one in alternatives if holds(one)]
            for name in names if bool(holding) is not wanted else ():
                if name in meant:
                    words = f"needs {' or '.join(map(word, alternatives))}"
                    raise UsageError(f"{name}: {words if wanted else f'not allowed with {word(holding[0])}'}")
