"""Paths of free numbers: as a list, as text between commas, or in a file FREE.toml."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from mahovik.core.motion.document import document_of, text_of
from mahovik.core.stand.content import TEXT
from mahovik.core.stand.units import show
from mahovik.errors import DesignError, UsageError

UNBALANCES = "*.unbalance"
"""Unbalances of all flywheels."""


def free_paths(given: str | Path | Sequence[str]) -> tuple[str, ...]:
    """The paths. A file has `schema = 1` and `free`, a list of them. Raises UsageError, DesignError."""
    if isinstance(given, str | Path) and str(given).endswith(".toml"):
        return _of_file(Path(given))
    paths = str(given).split(",") if isinstance(given, str | Path) else list(given)
    found = tuple(dict.fromkeys(path.strip() for path in paths if path.strip()))
    if not found:
        raise UsageError("--free: nothing is free; expected at least one path, such as w*.unbalance")
    return found


def _of_file(path: Path) -> tuple[str, ...]:
    document = document_of(text_of(path, TEXT, DesignError), path.name, DesignError, is_json=False)
    paths = document.pop("free", None)
    if document:
        raise DesignError([f"{path.name}: unknown key {show(next(iter(document)))}; expected free"])
    if not (isinstance(paths, list) and all(isinstance(each, str) for each in paths) and paths):
        raise DesignError([f'{path.name}: free: expected a list of paths, such as ["w*.unbalance"]'])
    return free_paths(paths)
