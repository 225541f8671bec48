"""The modules of derive/, whose functions give formulas here: from the cache if they are there, else derived.

`carrier.momentum(True)` is `mahovik.core.derive.carrier.momentum(True)` with its operations in the order of
formula/ordered. Type checkers and editors see the module of derive/ itself, so that names and arguments are checked and
a definition is found. Arguments are names and flags, so that a call is a key of the cache. Without `use_cache`
everything is derived again.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import partial
from importlib import import_module
from typing import TYPE_CHECKING, Any

from mahovik.core.formula.cache import Cache
from mahovik.core.formula.tree import as_json, from_json


class FormulaModule:
    """A module of derive/, or the `derive` of a law: its functions give formulas and records of them."""

    def __init__(self, module: str) -> None:
        self._module = module

    def __getattr__(self, name: str) -> Callable[..., Any]:
        if name.startswith("_"):
            raise AttributeError(name)
        return partial(_recall, self._module, name)


MODULES = (
    *("accumulate", "attitude", "carrier", "carrying", "drive", "hold", "motion", "point", "regressor", "sensitivity"),
    "wrench",
)
"""Modules of derive/ that give formulas."""

if TYPE_CHECKING:
    from mahovik.core.derive import (
        accumulate,
        attitude,
        carrier,
        carrying,
        drive,
        hold,
        motion,
        point,
        regressor,
        sensitivity,
        wrench,
    )
else:  # without SymPy, until a formula has to be derived
    accumulate, attitude, carrier, carrying, drive, hold, motion, point, regressor, sensitivity, wrench = (
        FormulaModule(f"core.derive.{name}") for name in MODULES
    )

__all__ = [
    "FormulaModule", "accumulate", "attitude", "carrier", "carrying", "drive", "formula_cache", "hold", "leave_cache",
    "motion", "point", "regressor", "sensitivity", "use_cache", "without_cache", "wrench",
]  # fmt: skip


@dataclass
class _Session:
    """A cache in use, and what has been taken from it or derived since."""

    cache: Cache
    known: dict[str, Any] = field(default_factory=dict)


@dataclass
class _State:
    """The session of this process, if it has one."""

    session: _Session | None = None


_state = _State()


def use_cache(warn: Callable[[str], None]) -> None:
    """Take formulas from the cache on disk from now on; `warn` gets one line if that is damaged."""
    _state.session = _Session(Cache(warn))


def without_cache() -> None:
    """Derive everything from now on, and write nothing."""
    _state.session = None


def leave_cache() -> None:
    """Writes what was derived since `use_cache`; from now on everything is derived."""
    found, _state.session = _state.session, None
    if found is not None:
        found.cache.save()


@contextmanager
def formula_cache(warn: Callable[[str], None]) -> Iterator[None]:
    """Formulas are from the cache within, as between `use_cache` and `leave_cache`; a cache in use stays in use."""
    if _state.session is not None:
        yield
        return
    use_cache(warn)
    try:
        yield
    finally:
        leave_cache()


def _recall(module: str, name: str, *arguments: str | bool) -> Any:
    """One call of derive/: known, from the cache, or derived."""
    session = _state.session
    if session is None:
        return _derive(module, name, arguments)
    store, known = session.cache, session.known
    key = f"{module}.{name}({', '.join(map(repr, arguments))})"
    if key not in known:
        kept = store.get(key)
        if kept is None:
            known[key] = _derive(module, name, arguments)
            store.add(key, as_json(known[key]))
        else:
            known[key] = from_json(kept)
    return known[key]


def _derive(module: str, name: str, arguments: tuple[str | bool, ...]) -> Any:
    from mahovik.core.formula.ordering import to_formulas

    return to_formulas(getattr(import_module(f"mahovik.{module}"), name)(*arguments))
