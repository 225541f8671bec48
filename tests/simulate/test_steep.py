"""Torques that fall steeply with speed: the C follows SciPy at the default step, or says that it cannot."""

from __future__ import annotations

import numpy as np
import pytest

from mahovik import stands
from mahovik.core.motion import loads_regime
from mahovik.core.motion.laws import RunUp
from mahovik.core.motion.motor import drive, steepness
from mahovik.core.stand import Stand, load
from mahovik.core.stand.model import Motor
from mahovik.errors import UsageError
from mahovik.use.simulate import Case, Run, simulate
from mahovik.use.simulate.by_c import CMotion
from mahovik.use.study.rest import rest

SHAKER = load(stands.path("shaker2"))


def case(text: str, stand: Stand = SHAKER, dt: float = 1e-4) -> Case:
    return Case(stand, loads_regime(f"schema = 1\n{text}\n", stand, 0.05), rest(stand).state, 0.05, every=0.01, dt=dt)


def run_up(torque: float, **more: float) -> str:
    rest_of_it = "".join(f", {key} = {value}" for key, value in more.items())
    return f'default = {{ run_up = {{ torque = {torque}, to = "300 rpm"{rest_of_it} }} }}'


def largest_difference(a: Run, b: Run, quantity: str) -> float:
    assert (a.stopped, b.stopped) == (None, None)
    return float(max(np.abs(a[name] - b[name]).max() for name in a.names if name.startswith(quantity)))


@pytest.mark.parametrize("torque", [3.0, *(pytest.param(x, marks=pytest.mark.slow) for x in (0.3, 20.0))])
def test_a_strong_run_up_agrees_with_scipy(torque: float) -> None:
    """The figures of docs/studies.md. Torques of 20 N m settle to 0.03 N m, so both are asked of them."""
    judge = simulate(case(run_up(torque)), "scipy")
    found = simulate(case(run_up(torque)))
    assert largest_difference(found, judge, "tau") < 1e-4
    assert largest_difference(found, judge, "phi_dot") < 1e-5
    assert largest_difference(found, judge, "v_dot") < 1e-4
    if torque >= 3.0:
        assert np.abs(found["tau left [N m]"][1:]).max() < 0.031


def test_what_is_too_steep_is_refused_before_the_run() -> None:
    with pytest.raises(
        UsageError, match=r"flywheel left: its torque falls by up to 5e\+03 N m per rad/s.* wider `band`"
    ):
        simulate(case(run_up(50.0, band=0.01)))
    CMotion(case(run_up(50.0, band=0.01), dt=1e-6))  # as the refusal proposes: taken


@pytest.mark.parametrize("seed", range(5))
def test_steepness_bounds_every_difference(seed: int) -> None:
    rng = np.random.default_rng(seed)
    law = RunUp(*rng.uniform(0.1, 2.0, 1), *rng.uniform(-9, 9, 1), *rng.uniform(0.1, 2.0, 1))
    motor = Motor(rng.uniform(0.5, 3.0), 8.0, None, None, None, 0.05, 0.3, 0.4)
    for each in (None, motor):
        low, high = sorted(rng.uniform(-12, 12, 2))
        speeds = np.linspace(low, high, 2001)
        torques = [drive(each, law.command(0.0, w), w) for w in speeds]
        most = np.abs(np.diff(torques) / np.diff(speeds)).max()
        assert most <= steepness(each, law.steepness(low, high), low, high) * (1 + 1e-9) + 1e-12
