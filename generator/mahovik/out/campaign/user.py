"""Functions of the user: named arrays of one sample in, one number out."""

from __future__ import annotations

import importlib
import importlib.util
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from mahovik.core.stand.content import is_file
from mahovik.errors import UsageError
from mahovik.nearest import suggestion


@dataclass(frozen=True)
class UserFunction:
    """A function by its text in the campaign file."""

    text: str
    call: Callable[[Mapping[str, Any]], float]

    def __reduce__(self) -> Any:
        return type(self), (self.text, self.call)

    def number(self, arrays: Mapping[str, Any]) -> tuple[float, str]:
        """Number for one sample, and why there is none, or ""."""
        try:
            found = self.call(arrays)
        except Exception as error:  # anything the user's code may raise is the reason of this sample
            return np.nan, f"{self.text}: {type(error).__name__}: {error}"
        try:
            return float(found), ""
        except (TypeError, ValueError):
            return np.nan, f"{self.text}: gives {type(found).__name__}, expected a number"


def find_function(text: str, folder: Path, given: Mapping[str, Callable[[Mapping[str, Any]], float]]) -> UserFunction:
    """The function that a text names: `package.module:function`, or `file.py:function` beside the campaign file.

    Raises UsageError.
    """
    if text in given:
        return UserFunction(text, given[text])
    place, colon, name = text.rpartition(":")
    if not colon or not place or not name:
        raise UsageError(f'function: "{text}": expected "package.module:function" or "file.py:function"')
    module = _module(place, folder)
    if not hasattr(module, name):
        known = [each for each, value in vars(module).items() if callable(value) and not each.startswith("_")]
        raise UsageError(f'function: {place} has no "{name}"{suggestion(name, known)}')
    found = getattr(module, name)
    if not callable(found):
        raise UsageError(f"function: {text} is no function, but {type(found).__name__}")
    return UserFunction(text, found)


def _module(place: str, folder: Path) -> ModuleType:
    try:
        if not place.endswith(".py"):
            return importlib.import_module(place)
        path = (folder / place).resolve()
        if not is_file(path):
            raise UsageError(f"function: {place}: no such file in {folder}")
        spec = importlib.util.spec_from_file_location(f"mahovik_campaign_{path.stem}", path)
        assert spec is not None and spec.loader is not None
        module = importlib.util.module_from_spec(spec)
        sys.modules[spec.name] = module
        spec.loader.exec_module(module)
        return module
    except UsageError:
        raise
    except Exception as error:  # an import runs code of the user
        raise UsageError(f"function: {place} cannot be imported: {type(error).__name__}: {error}") from None
