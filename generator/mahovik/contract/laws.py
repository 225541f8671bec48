"""The laws of wrenches, a folder of `laws/` each: stages ask these lists, and load their own part of each law.

The order of each list is the order in which the wrenches are added up, hence part of the bits of the emitted C.
"""

from __future__ import annotations

from functools import cache
from importlib import import_module
from importlib.util import find_spec
from typing import TypeVar

BODY_LAWS = ("weight", "buoyancy", "damping", "cross_flow", "fin", "propeller", "fading", "control")
"""Folders of the laws that act on every body in its own frame."""

LAWS = ("suspension", "leg", "torquer", "friction", "stop")
"""Folders of the laws between E0 and the carrier; they come after those of the bodies."""

Part = TypeVar("Part")


@cache
def _part(folder: str, module: str) -> object:
    """LAW of a module of a law's folder; None where the law needs no such module."""
    name = f"mahovik.laws.{folder}.{module}"
    return None if find_spec(name) is None else import_module(name).LAW


@cache
def parts(module: str, kind: type[Part], laws: tuple[str, ...] = LAWS) -> tuple[Part, ...]:
    """What a stage needs of each law that has it, in their order: LAW of that module of its folder, a `kind`."""
    there = [law for folder in laws if (law := _part(folder, module)) is not None]
    result = tuple(law for law in there if isinstance(law, kind))
    assert len(result) == len(there), f"{module}: expected {kind.__name__}"
    return result
