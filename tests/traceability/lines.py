"""Functions of the example stands: their programs, and where they stand in generated/."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from emit.stands import generated
from mahovik import stands
from mahovik.core.emit.reading import spans as emitted
from mahovik.core.program.function import Function

GENERATED = Path(__file__).resolve().parents[2] / "generated"
FIRST = "bench8"
"""The stand whose lines are given, where it has the function."""


def names() -> list[str]:
    """The example stands, FIRST first."""
    return sorted(stands.names(), key=lambda name: (name != FIRST, name))


@cache
def functions() -> dict[str, Function]:
    """Every function of the example stands' programs by name, in the order of the C."""
    found: dict[str, Function] = {}
    for name in names():
        for function in generated(name).program.functions:
            found.setdefault(function.name, function)
    return found


@cache
def spans() -> dict[str, tuple[str, int, int]]:
    """First stand that has it, first and last line of its definition, for every function in generated/."""
    found: dict[str, tuple[str, int, int]] = {}
    for name in names():
        text = (GENERATED / name / f"{name}.c").read_text(encoding="ascii")
        for function, (first, last) in emitted(text, name).items():
            found.setdefault(function, (name, first, last))
    return found
