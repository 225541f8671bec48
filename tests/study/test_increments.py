"""Warnings of increments that short steps in float lose, held to the C itself."""

from __future__ import annotations

import json
import math
from dataclasses import replace

import numpy as np
import pytest

from cli.run import run
from mahovik.core.stand import load
from mahovik.core.stand.state import rest_state
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.functions.carries import end_of_steps
from mahovik.stands import path
from mahovik.use.study.increments import lost_increments

SAT4 = load(path("sat4"))
SPEED = 6000 * math.pi / 30


@pytest.mark.slow
def test_the_c_loses_at_most_the_part_that_is_named_and_much_of_it() -> None:
    """A thousand steps of 0.1 ms at 6000 rpm and at full torque, against double; a carry loses nothing of it."""
    (dt, steps), N = (1e-4, 1000), len(SAT4.flywheels)
    lost = lost_increments(SAT4, [SPEED] * N, dt)
    assert len(lost) == N
    start = replace(rest_state(SAT4), phi_dot=(SPEED,) * N, tau=(0.2,) * N)
    c = CBackend(SAT4, "float")
    exact = end_of_steps(CBackend(SAT4), "step", start, dt * steps, steps)["phi_dot"] - SPEED
    first = np.float64(np.float32(SPEED))  # the start in float
    plain, carried = (
        end_of_steps(c, name, start, dt * steps, steps)["phi_dot"] - first for name in ("step", "step_carried")
    )
    part = np.abs(plain / exact - 1.0)
    bounds = np.array([each.part for each in lost])
    assert np.all(part < 1.1 * bounds) and np.all(part > 0.02 * bounds)
    assert np.all(np.abs(carried / exact - 1.0) < 0.1 * part + 1e-4)


def test_a_torque_below_the_lost_one_does_nothing() -> None:
    """Half of it, since the carrier turns back, so that a flywheel gains more speed than by its own inertia."""
    dt, N = 1e-5, len(SAT4.flywheels)
    lost = lost_increments(SAT4, [SPEED] * N, dt)[0]
    still = replace(SAT4, gravity=(0.0, 0.0, 0.0))
    start = replace(rest_state(still), phi_dot=(SPEED,) * N, tau=(0.5 * lost.lost_torque,) * N)
    end = end_of_steps(CBackend(still, "float"), "step", start, 100 * dt, 100)["phi_dot"]
    assert np.all(end == np.float32(SPEED))


def test_check_names_step_part_and_remedy() -> None:
    found = run("check", str(path("sat4")), "--dt", "0.1 ms")
    text = " ".join(found.stdout.split())
    assert "warning: float: a step of 0.0001 s adds" in text and "use step_carried or double" in text
    assert "at 6000 rpm by up to 3.1e-05 rad/s" in text
    given = json.loads(run("check", str(path("sat4")), "--dt", "1e-4", "--json").stdout)["increments"]
    assert [each["flywheel"] for each in given] == ["rw1", "rw2", "rw3", "rw4"]
    assert given[0]["part"] == pytest.approx(2**-15 / given[0]["increment"])


def test_long_steps_lose_nothing_worth_a_warning() -> None:
    assert lost_increments(SAT4, [SPEED] * 4, 0.1) == []
    bare = replace(SAT4, flywheels=tuple(replace(s, motor=None) for s in SAT4.flywheels))
    assert lost_increments(bare, [SPEED] * 4, 1e-2) == [] and len(lost_increments(bare, [SPEED] * 4, 1e-4)) == 4
    for wrong in ("0", "-1", "1 m", "inf"):
        assert "--dt: " in run("check", str(path("sat4")), "--dt", wrong).stderr
