"""manifest.json of a delivered folder: its origin, and the SHA-256 of every file. No dates."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from mahovik import __version__
from mahovik.contract.functions import ALL
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand

if TYPE_CHECKING:
    from mahovik.core.emit.generate import Generated

NAME = "manifest.json"
"""File name of the manifest."""

FORMAT = 1
"""Version of the format; raised when the meaning of a key changes."""


def digest(content: str | bytes) -> str:
    """SHA-256 of a file's content, in hexadecimal."""
    return hashlib.sha256(content.encode("utf-8") if isinstance(content, str) else content).hexdigest()


def manifest(
    stand: Stand,
    real: str,
    files: Mapping[str, str],
    project: str = "",
    only: Sequence[str] = ALL,
) -> str:
    """Text of the manifest of files, name to content.

    `project`: the target whose exported project they are; `only`: public functions of the C, or ALL.
    The stand's name is the prefix of the C.
    """
    more: dict[str, Any] = {"only": list(only)}
    more |= {"project": project} if project else {}
    return manifest_with(stand, real, files, more)


def with_manifest(stand: Stand, generated: Generated, files: Mapping[str, str], project: str = "") -> dict[str, str]:
    """The files of a folder, which have the C of `generated`, and their manifest at the end."""
    return {**files, NAME: manifest(stand, generated.program.precision.name, files, project, generated.only)}


def manifest_with(stand: Stand, real: str, files: Mapping[str, str], more: Mapping[str, Any]) -> str:
    """Manifest of any files of a stand, with more facts about them."""
    found = identities(stand)
    return as_text(
        {
            "format": FORMAT,
            "generator": f"mahovik {__version__}",
            "stand": stand.name,
            "structure": found.structure,
            "physics": found.physics,
            "real": real,
            **more,
            "files": {name: digest(files[name]) for name in sorted(files)},
        }
    )


def as_text(content: Mapping[str, Any]) -> str:
    """Text of a manifest's content."""
    return json.dumps(content, indent=2) + "\n"
