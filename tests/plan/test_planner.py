"""Planning as a whole, bounds and choice: statuses, what is said of a bound, determinism."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mahovik.core.motion.programme import Fourier
from mahovik.core.motion.required import Bounds
from mahovik.errors import MotionError
from mahovik.use.plan import Plan, PlanOptions, plan_motion
from mahovik.use.plan.certificate import make_programme
from plan.examples import example

N = 8
QUICK = PlanOptions(winding="rock", verify=False)


def planned(options: PlanOptions, **changed: Any) -> Plan:
    """bench8 with fields of its motion changed."""
    stand, motion = example("bench8")
    return plan_motion(stand, replace(motion, **changed), options)


@pytest.mark.slow
def test_a_bound_that_cannot_be_kept() -> None:
    """OK_LIMIT: a programme all the same, exact, with the excess that it really has, in words and in the report."""
    found = planned(replace(QUICK, steps=90), bounds=Bounds(acceleration=(60.0,) * N))
    assert found.status == "OK_LIMIT"
    (programme,) = found.programmes
    assert programme.report["residual"] < 1e-6
    t = np.linspace(0.0, 0.1, 3001)
    peak = np.abs(programme.at(t).phi_ddot).max()
    assert peak > 60.0
    told = float(found.words[0].split(": ")[1].split()[0])
    assert told == pytest.approx(peak, rel=1e-3)
    assert f"bound is 60: {peak / 60.0:.2g}" in found.words[0]
    assert programme.report["bounds_used"] == pytest.approx(peak / 60.0, rel=1e-3)
    assert list(programme.report["exceeded"]) == list(found.words)


@pytest.mark.slow
def test_several_are_kept_best_first_and_the_same_seed_gives_the_same() -> None:
    """Objectives rise; the spread is reported; twice the same bits."""
    several = replace(QUICK, keep=2, seed=5)
    first, second = (planned(several, bounds=Bounds(acceleration=(2500.0,) * N)) for _ in range(2))
    assert first.status == "OK" and first.words == ()
    values = [programme.report["objective"] for programme in first.programmes]
    assert len(values) == 2 and values[0] < values[1]
    assert list(first.effort["objective_spread"])[:2] == values
    for one, two in zip(first.programmes, second.programmes, strict=True):
        assert isinstance(one.course, Fourier) and isinstance(two.course, Fourier)
        assert np.array_equal(one.course.cos, two.course.cos)
        assert one.report["search"] == two.report["search"]


def test_the_end_of_the_steps_gives_the_best_so_far() -> None:
    """Cut in the middle of the optimisation: an exact programme, though not the best."""
    cut = planned(replace(QUICK, steps=25), bounds=Bounds())
    assert cut.status == "OK"
    assert cut.effort["steps"] == 25
    assert cut.programmes[0].report["residual"] < 1e-6


def test_power_without_motors_is_refused() -> None:
    """bench8 has no motors."""
    _, motion = example("bench8")
    with pytest.raises(MotionError, match=r'flywheels "w1", "w2", .*"w8" have no motor') as error:
        planned(QUICK, objective=replace(motion.objective, power=(1.0,) * N))
    assert len(str(error.value).splitlines()) == 1


def test_a_bias_of_rounding_is_zero() -> None:
    """The search leaves a small part of a component that needs no shift."""
    stand, motion = example("bench8")
    none = np.zeros((0, N))
    bias = np.array([-1e-19, 1e-4, -2e-12, 0.0, 3e-17, 1e-3])
    found = make_programme(stand, motion, bias, (1,) * N, Fourier(np.zeros(N), none, none), {})
    assert found.bias.tolist() == [0.0, 1e-4, -2e-12, 0.0, 0.0, 1e-3]
