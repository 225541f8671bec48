"""Runs in float, with and without what rounding takes from each sum."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

import mahovik
from mahovik import stands
from mahovik.core.motion import loads_regime
from mahovik.core.stand import load, rest_state
from mahovik.errors import UsageError
from mahovik.use.simulate import Case, Run, simulate
from simulate.test_agreement import MIXED, busy, case

PUSHED = 'schema = 1\ndefault = { torque = "10 mN m", initial_speed = 200 }\n'


def pushed(**more: Any) -> Run:
    """sat4 from 200 rad/s under 10 mN m for 0.2 s."""
    stand = load(stands.path("sat4"))
    start = replace(rest_state(stand), position=(200.0, 0.0, 0.0), V=(5e-3, 0.0, 0.0, 0.0, 0.0, 0.0))
    return simulate(Case(stand, loads_regime(PUSHED, stand, 0.2), start, 0.2, every=0.1, **more))


def error(found: Run, name: str) -> float:
    """Error of the change of a column in the run, relative to that of double."""
    exact, own = (run[name][-1] - run[name][0] for run in (pushed(dt=1e-3), found))
    return float(abs(own / exact - 1.0))


@pytest.mark.slow
def test_a_carried_run_in_float_keeps_what_a_plain_one_loses() -> None:
    """10,000 steps: a plain run loses a share of each increment of speed, and does not leave its place at all."""
    speed = next(name for name in pushed(dt=1e-2).names if name.startswith("phi_dot "))
    plain, carried = (pushed(dt=2e-5, real="float", carried=each) for each in (False, True))
    assert error(carried, speed) < 1e-4
    assert error(plain, speed) > 20 * error(carried, speed)
    assert error(plain, "x [m]") == 1.0
    assert error(carried, "x [m]") < 0.02  # the place of a float 200 m away


def test_a_plain_run_in_float_warns_of_lost_increments(recwarn: pytest.WarningsRecorder) -> None:
    given: dict[str, Any] = {"regime": {"default": {"torque": "0.1 mN m", "initial_speed": 200}}}
    mahovik.simulate(mahovik.load(stands.path("sat4")), 0.001, real="float", dt=1e-5, **given)
    assert ["use --carried, or --real double" in str(each.message) for each in recwarn] == [True]
    recwarn.clear()
    mahovik.simulate(mahovik.load(stands.path("sat4")), 0.001, real="float", dt=1e-5, carried=True, **given)
    assert not recwarn.list


def test_scipy_has_no_float_and_no_carry() -> None:
    for more in ({"real": "float"}, {"carried": True}):
        with pytest.raises(UsageError, match="--backend scipy: not allowed with --"):
            simulate(case(busy(), MIXED, **more), "scipy")
    with pytest.raises(UsageError, match="--real half: expected double or float"):
        case(busy(), MIXED, real="half")
