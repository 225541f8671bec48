"""What a generated header says of its C: element type, lanes, identities, and whether it is for speed."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Header:
    """Facts of a stand's header.

    `real`, `structure`, `physics`: None where the header does not name them; `lanes`: 1 where it is older than lanes;
    `fast`: its bits are not reproducible.
    """

    real: str | None
    lanes: int
    fast: bool
    structure: str | None
    physics: str | None


def read_header(folder: Path, stand_name: str) -> Header | None:
    """The header of a stand in a folder; None where there is none."""
    path = folder / f"{stand_name}.h"
    if not path.is_file():
        return None
    text = path.read_text(encoding="utf-8", errors="replace")

    def said(pattern: str) -> str | None:
        found = re.search(pattern, text, re.MULTILINE)
        return found[1] if found else None

    macro = f"^#define {stand_name.upper()}_"
    return Header(
        real=said(rf"^typedef (\w+) {stand_name}_real;"),
        lanes=int(said(rf"{macro}LANES +(\d+)\b") or 1),
        fast=said(rf"{macro}FAST +(1)\b") is not None,
        structure=said(rf"{macro}STRUCTURE +0x([0-9a-f]+)u"),
        physics=said(rf"{macro}PHYSICS +0x([0-9a-f]+)u"),
    )
