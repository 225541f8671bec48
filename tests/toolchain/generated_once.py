"""C of a stand, generated once a process for equal arguments, as long as the generator is as it was.

Tests plant faults in the derivation and in the lowering. So nothing is remembered, and nothing that is remembered is
given, while a name of the generator's modules, of their classes or of their tables is bound to anything else than at
the beginning of the test, or while the formulas have a cache of their own.
"""

from __future__ import annotations

import os
import pickle
import sys
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial, wraps
from importlib import import_module
from inspect import signature
from types import ModuleType
from typing import Any

GENERATOR = ("mahovik.core.", "mahovik.laws.", "mahovik.contract.")
DERIVATION = ("mahovik.core.derive.", "mahovik.core.formula.", "mahovik.laws.")


class Unchanged:
    """Modules as they are when they are first seen: objects by name."""

    def __init__(self, packages: tuple[str, ...] = GENERATOR) -> None:
        self._packages = packages
        self._seen: dict[str, list[tuple[Any, dict[Any, Any]]]] = {}
        self._listed: dict[tuple[str, ...], tuple[int, list[str]]] = {}

    def look(self) -> None:
        """Takes the modules that are new as they are: to be called while nothing is replaced."""
        for name, module in _modules(self._packages):
            if name not in self._seen:
                self._seen[name] = [(names, dict(names)) for names in _namespaces(module)]

    def holds(self, packages: tuple[str, ...] = GENERATOR) -> bool:
        """Whether all modules of the packages have been seen, and every name in them is bound to what it was."""
        count, listed = self._listed.get(packages, (0, []))
        if count != len(sys.modules):
            listed = [name for name, _ in _modules(packages)]
            self._listed[packages] = len(sys.modules), listed
        return all(
            name in self._seen and all(_same(names, before) for names, before in self._seen[name]) for name in listed
        )


def _modules(packages: tuple[str, ...]) -> list[tuple[str, ModuleType]]:
    return [(name, module) for name, module in sys.modules.copy().items() if name.startswith(packages)]


def _namespaces(module: ModuleType) -> Iterator[Any]:
    """The names of a module, and of the classes and tables that it has."""
    yield vars(module)
    for each in list(vars(module).values()):
        if isinstance(each, type) and each.__module__ == module.__name__:
            yield vars(each)
        elif type(each) is dict:
            yield each


def _same(names: Any, before: dict[Any, Any]) -> bool:
    """Whether names are bound to what they were; names that are new, and what Pydantic builds late, do not count."""
    try:
        if names == before:  # in most cases, and quick
            return True
    except ValueError:  # an array in place of another
        return False
    missing = object()
    return all(
        names.get(name, missing) is was for name, was in before.items() if not str(name).startswith("__pydantic")
    )


class Trust:
    """Whether a result is being made of a generator that was looked at: what it calls need not look again.

    A stand has hundreds of formulas, and a look costs as much as many of them.
    """

    def __init__(self) -> None:
        self.given = False

    def make(self, function: Callable[[], Any]) -> Any:
        before, self.given = self.given, True
        try:
            return function()
        finally:
            self.given = before


def once(make: Callable[..., Any], usable: Callable[[], bool], trust: Trust | None = None) -> Callable[..., Any]:
    """`make`, whose results are remembered by their arguments, however passed; files of C are the caller's own."""
    known: dict[bytes, Any] = {}
    parameters, inside = signature(make), trust or Trust()

    @wraps(make)
    def found(*arguments: Any, **named: Any) -> Any:
        if not (inside.given or usable()):
            return make(*arguments, **named)
        bound = parameters.bind(*arguments, **named)
        bound.apply_defaults()
        key = pickle.dumps(bound.arguments)
        if key not in known:
            known[key] = inside.make(partial(make, *arguments, **named))
        result = known[key]
        return replace(result, files=dict(result.files)) if hasattr(result, "files") else result

    return found


def install(formulas: str) -> Unchanged:
    """Generate and derive once from now on; the caller looks at the modules before each test.

    Imported here, as the generator loads NumPy.
    """
    unchanged = Unchanged()

    def usable(packages: tuple[str, ...]) -> bool:
        return os.environ.get("MAHOVIK_CACHE") == formulas and unchanged.holds(packages)

    trust = Trust()
    for module, name, packages in (
        ("core.emit.generate", "generate_all", GENERATOR),
        ("core.formula.derived", "_derive", DERIVATION),
    ):
        place = import_module(f"mahovik.{module}")
        setattr(place, name, once(getattr(place, name), partial(usable, packages), trust))
    return unchanged
