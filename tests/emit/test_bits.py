"""The same bits from the interpreter and from every compiler at every optimisation, in double and float."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from emit.compiled import QUANTITIES, Compiled, bits, compiled, compiled_float
from mahovik.core.program.types import DOUBLE, FLOAT
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
@pytest.mark.parametrize("name", quick(2, NAMES))
def test_interpreter_is_c(name: str) -> None:
    c = compiled(name, SHIPPED)
    chosen = states(c.stand, 2)
    assert all_bits(c.interpreted, c, chosen) == all_bits(c.c, c, chosen)


@pytest.mark.slow
@pytest.mark.parametrize("name", quick(1, ("bare5", NAME, "hung5")))
def test_interpreter_is_c_in_float(name: str) -> None:
    c = compiled_float(name, SHIPPED)
    chosen = states(c.stand, 2, FLOAT.max_phase)
    assert all_bits(c.interpreted, c, chosen) == all_bits(c.c, c, chosen)


@pytest.mark.parametrize(
    ("compiler", "optimisation"),
    quick(0, [("clang", "-O2"), ("gcc", "-O3"), ("gcc", "-O0"), ("gcc", "-Os"), ("clang", "-O0")]),
)
def test_compilers_agree(compiler: str, optimisation: str) -> None:
    require(compiler, compiler)
    reference, other = compiled(NAME, SHIPPED), compiled(NAME, optimisation, compiler)
    chosen = states(reference.stand)
    assert all_bits(reference.c, reference, chosen) == all_bits(other.c, other, chosen)
    assert bits(reference.table()) == bits(other.table())


@pytest.mark.slow
@pytest.mark.parametrize(
    ("compiler", "optimisation"), [("gcc", "-O0"), ("gcc", "-O1"), ("gcc", "-O3"), ("clang", "-O0"), ("clang", "-O3")]
)
def test_compilers_agree_in_float(compiler: str, optimisation: str) -> None:
    require(compiler, compiler)
    reference, other = compiled_float(NAME, SHIPPED), compiled_float(NAME, optimisation, compiler)
    chosen = states(reference.stand, phase_limit=FLOAT.max_phase)
    assert all_bits(reference.c, reference, chosen) == all_bits(other.c, other, chosen)
    assert bits(reference.table()) == bits(other.table())


def test_ordinary_states_are_evaluated() -> None:
    """Guard of the tests above: agreement on refusals alone would prove nothing."""
    c = compiled(NAME, SHIPPED)
    found = all_bits(c.c, c, states(c.stand))
    good = [key for key, (status, _) in found.items() if status == 0]
    assert len(good) > 0.9 * len(found)


@pytest.mark.parametrize("name", quick(2, NAMES))
def test_the_compiled_tables_are_those_of_the_generator(name: str) -> None:
    c = compiled(name, SHIPPED)
    assert bits(c.table()) == bits(c.values.table)
    prepare = c.program.function("prepare")
    status, outputs = c.library.run(
        prepare, {"parameters": c.library.default("default_parameters"), "table": c.table()}
    )
    assert status == 0
    assert bits(outputs["table"]) == bits(c.table())


@pytest.mark.slow
def test_float_follows_double() -> None:
    """Float results are those of double but for its rounding; tests/verify/test_float.py has the bounds."""
    double, single = compiled(NAME, SHIPPED), compiled_float(NAME, SHIPPED)
    rng = np.random.default_rng(3)
    for _ in range(5):
        state = random_state(double.stand, rng)
        want = np.array(double.c("forward", double.inputs(state))[1]["V_dot"])
        got = np.array(single.c("forward", single.inputs(state))[1]["V_dot"])
        assert np.abs(want - got).max() < 1e-3 * np.abs(want).max()
        assert not math.isclose(np.abs(want - got).max(), 0.0)
