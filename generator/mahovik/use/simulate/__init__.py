"""Motion in time: a stand under a regime, by the generated C or, to judge it, by SciPy and the literal reference.

What it offers is loaded when it is asked for, so that studies which take parts of it start without the rest.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from mahovik.use.simulate.case import Case
    from mahovik.use.simulate.run import Run, simulate

__all__ = ["Case", "Run", "simulate"]

_PLACES = {"Case": "case", "Run": "run", "simulate": "run"}
"""Modules of the names."""


def __getattr__(name: str) -> Any:
    if name not in _PLACES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_PLACES[name]}"), name)
