"""The laws of wrenches, a folder of `laws/` each: stages ask these lists, and load their own part of each law by name.

The order of each list is the order in which the wrenches are added up, hence part of the bits of the emitted C.
"""

from __future__ import annotations

from functools import cache
from importlib import import_module
from importlib.util import find_spec
from typing import Any

BODY_LAWS = ("weight", "buoyancy", "damping", "cross_flow", "fin", "propeller", "fading", "control")
"""Folders of the laws that act on every body in its own frame."""

LAWS = ("suspension", "leg", "torquer", "friction", "stop")
"""Folders of the laws between E0 and the carrier; they come after those of the bodies."""


@cache
def part(law: str, name: str) -> Any:
    """The module `name` of a law's folder; None where the law needs no such part."""
    module = f"mahovik.laws.{law}.{name}"
    return None if find_spec(module) is None else import_module(module)


@cache
def parts(name: str, laws: tuple[str, ...] = LAWS) -> tuple[Any, ...]:
    """The modules `name` of those laws that have one, in their order."""
    return tuple(found for law in laws if (found := part(law, name)) is not None)


@cache
def of_bodies(name: str, content: str) -> tuple[Any, ...]:
    """What those modules have under the name `content`, where they have it."""
    return tuple(getattr(module, content) for module in parts(name, BODY_LAWS) if hasattr(module, content))
