"""Bounds of the stack that a function of a program takes: from its own tree, without a compiler.

What a compiler makes of a function is not known here, so a bound is generous: measured frames of gcc and clang, at -O1
to -O3 and -Os, 32 and 64 bits, stay below it; tests/emit/test_stack.py compares.
"""

from __future__ import annotations

from functools import lru_cache

from mahovik.core.program.cost import cost
from mahovik.core.program.function import Function, Program
from mahovik.core.program.statement import Declare, Let, Loop
from mahovik.core.program.types import Struct, numbers
from mahovik.core.program.walk import called_names, statements

FRAME = 48
"""Stack of a call itself, bytes: return address and saved registers."""

SCALAR = 8
"""Stack of a scalar local, an argument or an index, bytes: a compiler may keep each of them in memory."""

SHARE = 1.25
"""Factor on both and on arrays: copies that a compiler makes where it inlines, unrolls and forms vectors."""

START = 128
"""Stack that is added once, bytes: a function may save all registers of a processor."""

TEMPORARIES = 56
"""Results of operations without a name that a compiler keeps at once, where it unrolls a loop; each as a scalar."""

_STEP = 16
"""A bound is a multiple of this, to which compilers align frames."""


def stack_bound(function: Function, program: Program) -> int:
    """Upper bound of the stack that a call takes, with all functions that it calls; bytes."""
    deepest = SHARE * _deepest(function, program.precision.width // 8, _depths(program)) + START
    deepest += SCALAR * min(cost(function, program.whole).total, TEMPORARIES)
    return -int(-deepest // _STEP) * _STEP


@lru_cache(maxsize=8)
def _depths(program: Program) -> dict[str, int]:
    """Stack of the deepest chain of calls from each function, bytes. Functions come after those that they call."""
    found: dict[str, int] = {}
    for function in program.whole:
        found[function.name] = _deepest(function, program.precision.width // 8, found)
    return found


def _deepest(function: Function, width: int, below: dict[str, int]) -> int:
    return _frame(function, width) + max((below[name] for name in called_names(function.body)), default=0)


def _frame(function: Function, width: int) -> int:
    """Arrays and structs in full, side by side, and all else."""
    large, scalars = 0, len(function.arguments)
    for s in statements(function.body):
        match s:
            case Let(variable) | Declare(variable) if variable.shape or isinstance(variable.type, Struct):
                large += numbers(variable.type, variable.shape) * width
            case Let() | Declare() | Loop():
                scalars += 1
    return large + SCALAR * scalars + FRAME
