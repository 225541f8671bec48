"""An object of a file of what a design may choose: its keys, with where they stand, for messages."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from mahovik.core.stand.problems import Problems
from mahovik.core.stand.units import Dimension, QuantityError, number, show
from mahovik.nearest import meant


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
