"""Documents in JSON and TOML: read strictly, every digit kept; each problem is one line with file and key."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, TypeVar

from pydantic import ValidationError

from mahovik.core.stand import toml
from mahovik.core.stand.content import content
from mahovik.core.stand.fields import Table
from mahovik.core.stand.problems import Problems
from mahovik.core.stand.units import show
from mahovik.errors import FileError

AnyTable = TypeVar("AnyTable", bound=Table)


def text_of(path: Path, most: int, error: type[FileError]) -> str:
    """The text of a file of at most `most` bytes. Raises `error` with one line that names the file."""
    try:
        return content(path, most).decode("utf-8-sig")
    except FileNotFoundError:
        reason = f"{path}: no such file"
    except OSError as found:
        reason = f"{path}: cannot be read: {found.strerror or found}"
    except ValueError as found:  # not UTF-8, or a NUL in the name
        reason = f"{show(str(path))}: not UTF-8 text: {found}"
    raise error([reason])


def parse(text: str) -> Any:
    """The value of a JSON text, floats as Decimal. Raises ValueError; a repeated key is an error."""

    def once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        found: dict[str, Any] = {}
        for key, value in pairs:
            if key in found:
                raise ValueError(f"key {show(key)} appears twice")
            found[key] = value
        return found

    return json.loads(text, parse_float=toml.exact, object_pairs_hook=once)


def document_of(text: str, source: str, error: type[FileError], is_json: bool = True) -> dict[str, Any]:
    """The keys of a file of schema 1. Raises `error` with one line."""
    try:
        found = parse(text) if is_json else toml.parse(text)
        if is_json and "\\u" in text:  # half of a pair, such as \ud800, is no character
            json.dumps(found, ensure_ascii=False, default=str).encode()
    except (RecursionError, ValueError) as problem:
        raise error([f"{source}: not {'JSON' if is_json else 'TOML'}: {problem}"]) from None
    if not isinstance(found, dict):
        raise error([f"{source}: expected an object, found {show(found)}"])
    if "schema" not in found:
        raise error([f"{source}: schema: required, but missing"])
    if isinstance(found["schema"], bool) or found["schema"] != 1:
        raise error([f"{source}: schema: expected 1, found {show(found['schema'])}"])
    return {key: value for key, value in found.items() if key != "schema"}


def validate_table(
    table: type[AnyTable], raw: Any, problems: Problems, where: str = "", **context: Any
) -> AnyTable | None:
    """The table that `raw` holds; None if it has problems, which are noted. Some fields use the `context`."""
    try:
        return table.model_validate(raw, context=context)
    except ValidationError as error:
        problems.add_schema_errors(where, table, error)
        return None
