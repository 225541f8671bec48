"""Stands: read from their files, the example stands, and what notebooks show of them."""

from __future__ import annotations

from pathlib import Path

from mahovik import stands
from mahovik.core.stand.model import Stand
from mahovik.core.stand.read import load as _load


def _notebook(stand: Stand) -> str:
    from mahovik.out.api.fields import bodies

    return bodies(stand)


type.__setattr__(Stand, "_repr_html_", _notebook)  # a class variable of the dataclass would count as a field


def load(path: str | Path) -> Stand:
    """The stand of a stand file, checked and in SI. Raises StandError with every problem of the file."""
    return _load(path)


def examples() -> tuple[str, ...]:
    """Names of the example stands."""
    return stands.names()


def example(name: str) -> Stand:
    """An example stand by its name. Raises UsageError for an unknown one."""
    return _load(stands.path(name))
