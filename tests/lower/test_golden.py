"""Answers that the self-test omits for many flywheels: those that grow with the square of their number."""

from __future__ import annotations

import numpy as np
import pytest

from emit.stands import generated
from mahovik.contract.status import STATUS_VALUES
from mahovik.core.lower import golden
from mahovik.core.lower.layout import Layout
from mahovik.core.lower.program import lower_layout
from mahovik.core.program.types import DOUBLE
from mahovik.core.stand.random import BARE, random_stand
from mahovik.core.stand.structure import structure


@pytest.mark.parametrize(("flywheels", "left_out"), [(3, set()), (64, set()), (300, {"coupled_jacobian"})])
def test_only_answers_too_large_for_a_board_are_left_out(flywheels: int, left_out: set[str]) -> None:
    stand = random_stand(np.random.default_rng(0), flywheels, BARE)
    program = lower_layout(Layout(structure(stand), DOUBLE))
    assert {f.name for f in program.functions if f.public} - {
        f.name for f in golden.tested_functions(program)
    } == left_out


@pytest.mark.parametrize("name", ["bench8", "demo3"])
def test_both_orders_of_the_time_step_are_taken(name: str) -> None:
    made = generated(name)
    vectors = golden.golden(made.program, made.values)
    assert [case["order"] for case in vectors.inputs[:2]] == [4, 2]
    # the second has fast flywheels: half a radian and more in the step
    assert [answer.status for answer in vectors.answers["step"][:2]] == [0, STATUS_VALUES["COARSE"]]
