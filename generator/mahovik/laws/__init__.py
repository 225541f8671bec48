"""Laws of wrenches, a folder each: every stage asks this list, and loads only its own part of each law.

The order of LAWS is the order in which the wrenches are added up, hence part of the bits of the emitted C.
"""

from __future__ import annotations

from functools import cache
from importlib import import_module
from importlib.util import find_spec
from typing import Any

LAWS = ("suspension", "leg", "torquer")
"""Folders, in the order in which their wrenches are added."""


@cache
def part(law: str, name: str) -> Any:
    """The module `name` of a law's folder; None where the law needs no such part."""
    module = f"mahovik.laws.{law}.{name}"
    return None if find_spec(module) is None else import_module(module)


def parts(name: str) -> tuple[Any, ...]:
    """The modules `name` of all laws that have one, in the order of LAWS."""
    return tuple(found for law in LAWS if (found := part(law, name)) is not None)
