"""Operation counts."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest

from docs.pages import ROOT
from emit.stands import generated
from mahovik.core.emit.generate import generate_all
from mahovik.core.program.build import Body
from mahovik.core.program.cost import Cost, cost
from mahovik.core.program.expression import BitCast, Place, real, select
from mahovik.core.program.function import Program
from mahovik.core.program.types import Kind
from mahovik.core.stand.stand_file import load
from program.small import argument, function, value_of

R, I = Kind.REAL, Kind.INT


def operations(program: Program, name: str) -> Cost:
    """Operations of one call of a function of the program."""
    return cost(program.function(name), program.functions)


@pytest.mark.parametrize(
    ("tree", "expected"),
    [
        (lambda a, b: a + b - a, Cost(additions=2)),
        (lambda a, b: a * b * 2, Cost(multiplications=2)),
        (lambda a, b: a / b + 1, Cost(additions=1, divisions=1)),
        (lambda a, b: -a, Cost()),
        (lambda a, b: select(a < b, a + b, a * b), Cost(1, 1, 0, 2)),
        (lambda a, b: BitCast(BitCast(a, Kind.WORD) + BitCast(b, Kind.WORD), Kind.REAL), Cost()),
        (lambda a, b: real(3), Cost()),
    ],
)
def test_expressions(tree: Callable[..., Any], expected: Cost) -> None:
    assert cost(value_of((R, R), tree)) == expected


def test_loops_multiply_and_the_dearer_branch_counts() -> None:
    def write(body: Body, x: Place) -> None:
        with body.loop("i", 4, start=1) as i:
            body.add(x[i], x[0] * 2)
            with body.when(x[0] < 0):
                body.set(x[1], x[2] / x[3])
            with body.otherwise():
                body.set(x[1], x[2] + x[3] + x[0])

    f = function("f", [argument("x", R, (4,), "inout")], write)
    assert cost(f) == Cost(additions=3 + 6, multiplications=3, comparisons=3)


def test_each_further_flywheel_costs_forward_the_same() -> None:
    """The count is linear from 5 to 64 flywheels, since the loop is over rows."""
    one, many = (operations(generated(name).program, "forward") for name in ("bare5", "bare64"))
    loops = [operations(generated("bare5").program, name) for name in ("sum_mass", "sum_spin")]
    assert (many.total - one.total) * 5 >= 59 * sum(loop.total for loop in loops)
    assert (many.total - one.total) % 59 == 0
    assert many.divisions == one.divisions


@pytest.mark.parametrize(
    ("name", "part"), [("pendulum", 0.5), ("linear_shaker", 0.5), ("cube", 0.8), ("air_table", 0.8)]
)
def test_of_a_held_carrier_only_what_its_freedoms_need_is_computed(name: str, part: float) -> None:
    held = load(ROOT / f"docs/held/{name}.toml")
    along, free = (operations(generate_all(of).program, "forward").total for of in (held, replace(held, hold=None)))
    assert along <= part * free
