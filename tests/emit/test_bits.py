"""The same bits from the interpreter and from every compiler at every optimisation, in double and float."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from emit.compiled import QUANTITIES, Compiled, bits, compiled, compiled_float
from mahovik.core.program.types import DOUBLE
from mahovik.core.stand.model import Stand
from mahovik.core.stand.random import EXTREMES, extreme_state, random_state
from mahovik.core.stand.state import State
from toolchain.quick import quick
from toolchain.tools import require

Call = Callable[[str, dict[str, Any]], tuple[int, dict[str, Any]]]
"""Status and outputs of a function, for its inputs by name."""

NAME = "everything6"
SHIPPED = "-O2"
"""Optimisation of the libraries that commands build."""
NAMES = (NAME, "everything0", "bare5", "hung5", "stream1", "auv6")


def states(stand: Stand, count: int = 4, phase_limit: float = DOUBLE.max_phase) -> list[State]:
    """Ordinary states and one of each extreme kind."""
    rng = np.random.default_rng(11)
    ordinary = [random_state(stand, rng) for _ in range(count)]
    return ordinary + [extreme_state(stand, rng, kind, phase_limit) for kind in EXTREMES]


def all_bits(call: Call, c: Compiled, chosen: list[State]) -> dict[tuple[int, str], tuple[int, Any]]:
    """Statuses and bits of every quantity at every state."""
    found: dict[tuple[int, str], tuple[int, Any]] = {}
    for number, state in enumerate(chosen):
        for function in filter(c.has, QUANTITIES):
            status, outputs = call(function, c.inputs(state))
            found[number, function] = status, bits(outputs) if status >= 0 else None
    return found


@pytest.mark.slow
@pytest.mark.parametrize("build", [compiled, compiled_float], ids=["double", "float"])
@pytest.mark.parametrize("name", NAMES)
def test_interpreter_is_c(name: str, build: Callable[..., Compiled]) -> None:
    c = build(name, SHIPPED)
    chosen = states(c.stand, 2, c.program.precision.max_phase)
    found = all_bits(c.c, c, chosen)
    assert all_bits(c.interpreted, c, chosen) == found
    assert sum(status == 0 for status, _ in found.values()) > 0.8 * len(found)


@pytest.mark.slow
@pytest.mark.parametrize("build", [compiled, compiled_float], ids=["double", "float"])
@pytest.mark.parametrize(
    ("compiler", "optimisation"),
    [("clang", "-O0"), ("clang", "-O2"), ("clang", "-O3"), ("gcc", "-O0"), ("gcc", "-O3"), ("gcc", "-Os")],
)
def test_compilers_agree(compiler: str, optimisation: str, build: Callable[..., Compiled]) -> None:
    require(compiler, compiler)
    reference, other = build(NAME, SHIPPED), build(NAME, optimisation, compiler)
    chosen = states(reference.stand, phase_limit=reference.program.precision.max_phase)
    assert all_bits(reference.c, reference, chosen) == all_bits(other.c, other, chosen)
    assert bits(reference.table()) == bits(other.table())


@pytest.mark.parametrize("name", quick(1, NAMES))
def test_the_compiled_tables_are_those_of_the_generator(name: str) -> None:
    c = compiled(name)
    assert bits(c.table()) == bits(c.values.table)
    prepare = c.program.function("prepare")
    status, outputs = c.library.run(
        prepare, {"parameters": c.library.default("default_parameters"), "table": c.table()}
    )
    assert status == 0
    assert bits(outputs["table"]) == bits(c.table())
