"""Facts read from generated C: those in a header, and where functions stand in a source."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Header:
    """Facts of a stand's header; None where it does not name them."""

    real: str | None
    structure: str | None
    physics: str | None


def read_header(folder: Path, stand_name: str) -> Header | None:
    """The header of a stand in a folder; None where there is none."""
    path = folder / f"{stand_name}.h"
    if not path.is_file():
        return None
    text = path.read_text(encoding="utf-8", errors="replace")

    def first_match(pattern: str) -> str | None:
        found = re.search(pattern, text, re.MULTILINE)
        return found[1] if found else None

    macro = f"^#define {stand_name.upper()}_"
    return Header(
        real=first_match(rf"^typedef (\w+) {stand_name}_real;"),
        structure=first_match(rf"{macro}STRUCTURE +0x([0-9a-f]+)u"),
        physics=first_match(rf"{macro}PHYSICS +0x([0-9a-f]+)u"),
    )


def spans(source: str, name: str) -> dict[str, tuple[int, int]]:
    """First and last line of every function defined in a stand's C, by its name without prefix."""
    found = {}
    attributes = r"^(?:\w+_CODE )?(?:\w+_APART )?(?:static )?(?:inline |\w+_COPIED )?"
    head = rf"\w+ {name}_(\w+)\([^;{{]*\)\n"
    definition = re.compile(attributes + head + r"\{\n.*?^\}\n", re.DOTALL | re.MULTILINE)
    for match in definition.finditer(source):
        first = source.count("\n", 0, match.start()) + 1
        found[match[1]] = (first, first + match[0].count("\n") - 1)
    return found
