"""JSON documents: read strictly, every digit kept; an object's keys with where they stand, for messages."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mahovik.core.stand.content import content
from mahovik.core.stand.problems import Problems
from mahovik.core.stand.shapes import vector
from mahovik.core.stand.toml import exact
from mahovik.core.stand.units import Dimension, QuantityError, number, show
from mahovik.nearest import meant


def text_of(path: Path, most: int) -> str:
    """The text of a file of at most so many bytes. Raises ValueError with one line that names the file."""
    try:
        return content(path, most).decode("utf-8-sig")
    except FileNotFoundError:
        raise ValueError(f"{path}: no such file") from None
    except OSError as error:
        raise ValueError(f"{path}: cannot be read: {error.strerror or error}") from None
    except ValueError as error:  # not UTF-8, or a NUL in the name
        raise ValueError(f"{show(str(path))}: not UTF-8 text: {error}") from None


def parse(text: str) -> Any:
    """The document, floats as Decimal. ValueError for a key that is there twice: JSON leaves open which counts."""

    def once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        found: dict[str, Any] = {}
        for key, value in pairs:
            if key in found:
                raise ValueError(f"key {show(key)} is there twice")
            found[key] = value
        return found

    return json.loads(text, parse_float=exact, object_pairs_hook=once)


def whole(text: str, source: str) -> dict[str, Any]:
    """The object of a file of schema 1. Raises ValueError with one line."""
    try:
        found = parse(text)
    except (RecursionError, ValueError) as error:
        raise ValueError(f"{source}: not JSON: {error}") from None
    if not isinstance(found, dict):
        raise ValueError(f"{source}: expected an object, found {show(found)}")
    if "schema" not in found:
        raise ValueError(f"{source}: schema: required, but missing")
    if isinstance(found["schema"], bool) or found["schema"] != 1:
        raise ValueError(f"{source}: schema: expected 1, found {show(found['schema'])}")
    return found


@dataclass(frozen=True)
class Section:
    """An object of a document. What cannot be read is noted among `problems`, and the answer is then None."""

    problems: Problems
    given: dict[str, Any]
    path: tuple[str, ...] = ()

    def __contains__(self, key: str) -> bool:
        return key in self.given

    def refuse(self, key: str, reason: str) -> None:
        """Note a problem of a key."""
        self.problems.add(*self.path, key, reason)

    def only(self, known: Sequence[str]) -> None:
        """Note every key that is not `known`."""
        for key in self.given:
            if key not in known:
                self.problems.add(*self.path, f"unknown key {show(key)}{meant(key, known)}")

    def has(self, *keys: str) -> bool:
        """Whether required keys are there; a problem is noted for each that is not."""
        missing = [key for key in keys if key not in self.given]
        for key in missing:
            self.refuse(key, "required, but missing")
        return not missing

    def section(self, key: str) -> Section | None:
        """An object; an empty one where there is none."""
        found = self.given.get(key, {})
        if isinstance(found, dict):
            return Section(self.problems, found, (*self.path, key))
        self.refuse(key, f"expected an object, found {show(found)}")
        return None

    def rows(self, key: str) -> list[Any]:
        """A list; an empty one where there is none."""
        found = self.given.get(key, [])
        if isinstance(found, list):
            return found
        self.refuse(key, f"expected a list, found {show(found)}")
        return []

    def text(self, key: str, default: str) -> str:
        """A string."""
        found = self.given.get(key, default)
        if not isinstance(found, str):
            self.refuse(key, f"expected a string, found {show(found)}")
            return default
        return found

    def integer(self, key: str, raw: Any) -> int | None:
        """A whole number of at most nine digits."""
        if isinstance(raw, bool) or not isinstance(raw, int) or abs(raw) >= 10**9:
            self.refuse(key, f"expected a whole number, found {show(raw)}")
            return None
        return raw

    def number(self, key: str, dimension: Dimension) -> float | None:
        """A number in SI."""
        try:
            return number(self.given[key], dimension)
        except QuantityError as error:
            self.refuse(key, str(error))
            return None

    def above_zero(self, key: str, dimension: Dimension) -> float | None:
        """A number above 0, in SI."""
        found = self.number(key, dimension)
        if found is not None and found <= 0.0:
            self.refuse(key, f"{found:g} {dimension.si} is not above 0")
            return None
        return found

    def numbers(self, key: str, raw: Any, count: int, dimension: Dimension) -> tuple[float, ...] | None:
        """As many numbers, in SI."""
        try:
            return vector(raw, (count,), dimension)
        except QuantityError as error:
            self.refuse(key, str(error))
            return None
