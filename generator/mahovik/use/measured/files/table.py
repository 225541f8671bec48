"""A table: columns of a file under their headers, all with one column of time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from importlib import import_module
from types import ModuleType

from mahovik.errors import UsageError
from mahovik.use.measured.recording import Array


@dataclass(frozen=True, eq=False)
class Table:
    """Columns of a file.

    source   name of the file, and of the part of it
    columns  (T,) numbers under each header, in the unit of the file; one is the time
    notes    what was found while reading
    """

    source: str
    columns: Mapping[str, Array]
    notes: tuple[str, ...] = ()


def package(name: str, extra: str, source: str) -> ModuleType:
    """A package that only an extra installs. Raises UsageError with the command that installs it."""
    try:
        return import_module(name)
    except ImportError:
        raise UsageError(f'{source}: needs {name}; `pip install "mahovik[{extra}]"`') from None
