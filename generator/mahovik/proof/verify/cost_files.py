"""The files of `mahovik cost` in a folder: by what they are known as ours."""

from __future__ import annotations

import json
from collections.abc import Mapping

from mahovik.core.emit.manifest import digest
from mahovik.core.stand.model import Stand

COST = "COST.md"
"""Measured cost: of the C whose SHA-256 it names. It is kept while that is the C of the folder."""

FIGURES = "cost.json"
"""Accepted figures: what later C is compared with, so it outlives the C."""


def is_page(text: str, stand: Stand) -> bool:
    """Is it a COST.md of this stand?"""
    return text.startswith(f"# Cost of {stand.name}\n\nWritten by `mahovik cost`")


def is_figures(text: str, stand: Stand) -> bool:
    """Is it a cost.json of this stand?"""
    try:
        found = json.loads(text)
    except (ValueError, RecursionError):
        return False
    return isinstance(found, dict) and found.get("stand") == stand.name and isinstance(found.get("targets"), list)


def speaks_of(cost: str, stand: Stand, files: Mapping[str, str]) -> bool:
    """Does a COST.md name the source of these files?"""
    return digest(files[f"{stand.name}.c"]) in cost
