"""Problems of a stand file in words: file, key path, what was found, what was expected. One line each."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import Any, TypeVar

from mahovik.core.stand.tables import Problem, Way, read_table

T = TypeVar("T")
_ELEMENT = re.compile(r"((?:\[\d+\])+): (.*)", re.DOTALL)  # what `shapes` says of one element


@dataclass
class Problems:
    """Collects the problems of one file, so that all are reported together."""

    source: str
    lines: list[str] = field(default_factory=list)

    def add(self, *words: str) -> None:
        """Note a problem; `words` are the parts of the key path, the last the reason."""
        *path, reason = (word for word in words if word)
        element = _ELEMENT.fullmatch(reason)
        if element is not None and path:
            path[-1], reason = path[-1] + element[1], element[2]
        line = f"{self.source}: " + (f"{', '.join(path)}: {reason}" if path else reason)
        if line not in self.lines:
            self.lines.append(line)

    def valid(self, table: type[T], raw: Any, where: str = "", **context: Any) -> T | None:
        """The table that `raw` holds; None if it has problems, which are noted. Some keys use the `context`."""
        result, problems = read_table(table, raw, context)
        self.add_all(where, problems)
        return result

    def add_all(self, where: str, problems: list[Problem]) -> None:
        """Note the problems of a table that `where` names."""
        for way, key, reason in problems:
            self.add(where, *_words(way), key, reason)


def _words(way: Way) -> list[str]:
    """`("damping", "terms", 0, "value")` as `["damping", "terms[0]", "value"]`."""
    words: list[str] = []
    for step in way:
        if isinstance(step, int) and words:
            words[-1] += f"[{step}]"
        else:
            words.append(str(step))
    return words
