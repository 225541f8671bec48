"""Where functions stand in emitted C."""

from __future__ import annotations

import re


def spans(source: str, name: str) -> dict[str, tuple[int, int]]:
    """First and last line of every function defined in a stand's C, by its name without prefix."""
    found = {}
    definition = re.compile(rf"^(?:static )?\w+ {name}_(\w+)\([^;{{]*\)\n{{\n.*?^}}\n", re.DOTALL | re.MULTILINE)
    for match in definition.finditer(source):
        first = source.count("\n", 0, match.start()) + 1
        found[match[1]] = (first, first + match[0].count("\n") - 1)
    return found
