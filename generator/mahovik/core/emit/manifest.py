"""manifest.json of a delivered folder: its origin, and the SHA-256 of every file, no dates; facts read from its C."""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from mahovik import __version__
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import identities

if TYPE_CHECKING:
    from mahovik.core.emit.generate import Generated


NAME = "manifest.json"
"""File name of the manifest."""

FORMAT = 1
"""Version of the format; raised when the meaning of a key changes."""


def digest(content: str | bytes) -> str:
    """SHA-256 of a file's content, in hexadecimal."""
    return hashlib.sha256(content.encode("utf-8") if isinstance(content, str) else content).hexdigest()


def with_manifest(stand: Stand, generated: Generated, files: Mapping[str, str], project: str = "") -> dict[str, str]:
    """The files of a folder, which have the C of `generated`, and their manifest at the end.

    `project`: the target whose exported project they are.
    """
    more = {"only": list(generated.only)} | ({"project": project} if project else {})
    return {**files, NAME: manifest(stand, generated.program.precision.name, files, more)}


def manifest(stand: Stand, real: str, files: Mapping[str, str], more: Mapping[str, Any] = MappingProxyType({})) -> str:
    """Text of the manifest of files of a stand, name to content, with more facts about them."""
    hashes = identities(stand)
    return as_text(
        {
            "format": FORMAT,
            "generator": f"mahovik {__version__}",
            "stand": stand.name,
            "structure": hashes.structure,
            "physics": hashes.physics,
            "real": real,
            **more,
            "files": {name: digest(files[name]) for name in sorted(files)},
        }
    )


def as_text(content: Mapping[str, Any]) -> str:
    """Text of a manifest's content."""
    return json.dumps(content, indent=2) + "\n"


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
        match = re.search(pattern, text, re.MULTILINE)
        return match[1] if match else None

    macro = f"^#define {stand_name.upper()}_"
    return Header(
        real=first_match(rf"^typedef (\w+) {stand_name}_real;"),
        structure=first_match(rf"{macro}STRUCTURE +0x([0-9a-f]+)u"),
        physics=first_match(rf"{macro}PHYSICS +0x([0-9a-f]+)u"),
    )


def spans(source: str, name: str) -> dict[str, tuple[int, int]]:
    """First and last line of every function defined in a stand's C, by its name without prefix."""
    result = {}
    attributes = r"^(?:\w+_CODE )?(?:\w+_APART )?(?:static )?(?:inline |\w+_COPIED )?"
    head = rf"\w+ {name}_(\w+)\([^;{{]*\)\n"
    definition = re.compile(attributes + head + r"\{\n.*?^\}\n", re.DOTALL | re.MULTILINE)
    for match in definition.finditer(source):
        first = source.count("\n", 0, match.start()) + 1
        result[match[1]] = (first, first + match[0].count("\n") - 1)
    return result
