"""TOML with every digit of its numbers."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping, Sequence
from decimal import Decimal, InvalidOperation
from itertools import starmap
from typing import Any

_DEEPEST = 50
"""Parts of a dotted key. tomllib's time grows with their square: a line of 100 kB would take an hour."""

_DEEP_KEY = re.compile(rf"(?<![\w'\"-])(?:['\"\w-]++[ \t]*+\.[ \t]*+){{{_DEEPEST}}}")


def parse(text: str) -> dict[str, Any]:
    """The document, floats as Decimal so that a unit can be applied before they are rounded.

    Raises ValueError (TOMLDecodeError is one; an integer of 5000 digits is another) and RecursionError.
    """
    deep = _DEEP_KEY.search(text)
    if deep is not None:
        line = text.count("\n", 0, deep.start()) + 1
        raise ValueError(f"a key of more than {_DEEPEST} parts (at line {line})")
    return tomllib.loads(text, parse_float=exact)


def exact(text: str) -> Decimal:
    """A float literal with every digit it has."""
    try:
        return Decimal(text)
    except InvalidOperation:  # an exponent too long even for Decimal
        return Decimal("Infinity") if "e-" not in text.lower() else Decimal(0)


def value_of(value: Any) -> str:
    """A value in TOML, a number with all its digits."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return repr(value)
    if isinstance(value, Mapping):
        return f"{{ {', '.join(line_of(key, item) for key, item in value.items())} }}"
    if isinstance(value, Sequence) and not isinstance(value, str):
        return "[" + ", ".join(value_of(item) for item in value) + "]"
    return f'"{value}"' if isinstance(value, str) else str(value)


def line_of(key: str, value: Any) -> str:
    """`key = value` in TOML."""
    return f"{key} = {value_of(value)}"


def text_of(document: Mapping[str, Any], comments: Mapping[str, Sequence[str]]) -> str:
    """The text of a document; `comments`: lines over the tables, by their names.

    Keys outside any table come first. A table of nothing but tables has none of its own: [task.pointing].
    """
    lines = [line_of(key, value) for key, value in document.items() if not _is_table(value) and not _tables(value)]
    for key, value in document.items():
        if _is_table(value):
            inner = value and all(map(_is_table, value.values()))
            for title, table in ((f"{key}.{name}", part) for name, part in value.items()) if inner else [(key, value)]:
                lines += _table(f"[{title}]", title, table, comments)
        else:
            lines += [line for item in _tables(value) for line in _table(f"[[{key}]]", key, item, comments)]
    return "\n".join(lines) + "\n"


def _table(head: str, title: str, table: Mapping[str, Any], comments: Mapping[str, Sequence[str]]) -> list[str]:
    """The lines of a table, and those of the arrays of tables inside it."""
    above = [f"# {line}" for line in comments.get(table.get("name", title), ())]
    inner = {key: value for key, value in table.items() if _tables(value)}
    lines = ["", *above, head, *(line_of(key, value) for key, value in table.items() if key not in inner)]
    for key, items in inner.items():
        lines += [line for item in items for line in ("", f"[[{title}.{key}]]", *starmap(line_of, item.items()))]
    return lines


def _is_table(value: Any) -> bool:
    return isinstance(value, Mapping)


def _tables(value: Any) -> list[Mapping[str, Any]]:
    """The tables of an array of them; empty of anything else."""
    return value if isinstance(value, list) and value and all(map(_is_table, value)) else []
