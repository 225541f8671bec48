"""The reference of the Python interface on docs/python.md, made of signatures and docstrings."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterator
from typing import Any

from reference_tables import table

import mahovik
from mahovik.out.commands import COMMANDS

CLASSES = ("Model", "States", "Stand", "Result", "Progress")
FUNCTIONS = ("load", "example", "examples", "build", "status_words")
ITEM = re.compile(r"^(\S+(?:, \S+)*) {2,}(.*)$")
"""A line `name  meaning` of a docstring."""


def python_lines() -> Iterator[str]:
    """Functions, classes with their methods, errors, and the commands as functions."""
    yield from ("### Functions", "")
    for name in FUNCTIONS:
        yield from entry(f"mahovik.{name}", getattr(mahovik, name))
    for name in CLASSES:
        value = getattr(mahovik, name)
        yield from (f"### {name}", "", *markdown(value))
        for member, attribute in members(value):
            yield from entry(f"{name}.{member}", attribute)
    yield from ("### Errors and warnings", "")
    known = ((name, getattr(mahovik, name)) for name in dir(mahovik))
    yield from table(
        ("class", "base", "meaning"),
        (
            (f"`{name}`", f"`{value.__bases__[0].__name__}`", summary(value))
            for name, value in known
            if inspect.isclass(value) and issubclass(value, Exception)
        ),
    )
    yield from ("", "### Commands", "")
    names = (name for section in COMMANDS.values() for name in section)
    yield from table(
        ("function", "what it does"),
        ((f"[`{name}`](commands.md#mahovik-{name})", summary(getattr(mahovik, name))) for name in names),
    )


def members(value: type) -> Iterator[tuple[str, Any]]:
    """Public methods and properties that the Python interface itself defines, by name."""
    named: dict[str, Any] = {}
    for base in reversed(value.__mro__):
        if base.__module__.startswith("mahovik.out."):
            named.update(vars(base))
    for name, attribute in sorted(named.items()):
        callable_or_property = inspect.isfunction(attribute) or isinstance(attribute, property | staticmethod)
        if callable_or_property and not name.startswith("_") and inspect.getdoc(attribute):
            yield name, attribute


def entry(name: str, value: Any) -> Iterator[str]:
    """A heading, the call, and what the docstring says."""
    yield from (f"#### {name}", "")
    if not isinstance(value, property):
        yield from (f"`{name.rpartition('.')[2]}({arguments(getattr(value, '__func__', value))})`", "")
    yield from markdown(value)


def arguments(function: Any) -> str:
    """Names of arguments, with defaults; `...` for those that all methods have."""
    words, star = [], False
    for parameter in inspect.signature(function).parameters.values():
        if parameter.name == "self":
            continue
        if parameter.kind is parameter.VAR_KEYWORD:
            words.append("...")
            continue
        if parameter.kind is parameter.KEYWORD_ONLY and not star:
            words, star = [*words, "*"], True
        default = "" if parameter.default is parameter.empty else f"={parameter.default!r}"
        words.append(parameter.name + default)
    return ", ".join(words)


def summary(value: Any) -> str:
    """First paragraph of a docstring, on one line."""
    return " ".join((inspect.getdoc(value) or "").partition("\n\n")[0].split())


def markdown(value: Any) -> Iterator[str]:
    """A docstring as Markdown: its lines `name  meaning` become lists."""
    for paragraph in (inspect.getdoc(value) or "").split("\n\n"):
        lines: list[str] = []
        for line in paragraph.splitlines():
            item = ITEM.match(line)
            if item:
                lines.append(f"* `{item[1]}`: {item[2]}")
            elif lines:
                lines[-1] += f" {line.strip()}"
            else:
                lines.append(line.strip())
        yield from (*lines, "")
