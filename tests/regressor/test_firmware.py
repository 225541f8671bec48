"""`identify_step` and `regressor` on processors: the same bits as here, and instructions of a step."""

from __future__ import annotations

from dataclasses import replace

import pytest

from mahovik import stands
from mahovik.core.stand import load
from mahovik.core.stand.model import Stand
from mahovik.proof.cost.measure import measure
from mahovik.proof.verify.targets import run_selftest, selftest_sources
from targets.boards import target

ONLY = ("regressor", "identify_step")


def six_flywheels() -> Stand:
    """The vibration table on its suspension with six of its flywheels: twelve unbalances."""
    stand = load(stands.path("bench8"))
    return replace(stand, name="bench6", flywheels=stand.flywheels[:6])


@pytest.mark.slow
@pytest.mark.parametrize(("name", "real"), [("m4", "float"), ("rv64gc", "double")])
def test_the_bits_are_those_of_this_machine(name: str, real: str) -> None:
    files = selftest_sources(six_flywheels(), real, 100, only=ONLY)
    here = run_selftest(target("host"), "bench6", files)
    assert "failures 0" in here
    assert run_selftest(target(name), "bench6", files) == here


@pytest.mark.slow
def test_a_step_of_twelve_unbalances_fits_a_cortex_m4f() -> None:
    """Six channels of an accelerometer and a gyro, with the columns and the model, in at most 20,000 instructions."""
    (cost,) = measure(six_flywheels(), [(target("m4"), "float")], only=("identify_step",)).targets
    instructions = {f.function: f.instructions for f in cost.functions}["identify_step"]
    assert 10_000 < instructions <= 20_000
