"""Motions and increments below the resolution of float: claims of check against the C in float itself."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from cli.run import run
from mahovik.core.stand import Stand, load
from mahovik.core.stand.random import EVERYTHING, random_stand
from mahovik.core.stand.random_state import random_state
from mahovik.core.stand.state import rest_state
from mahovik.core.stand.summary import summarize
from mahovik.core.stand.write import dumps
from mahovik.proof import reference
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.draw import round_to_float
from mahovik.proof.verify.functions.carries import end_of_steps
from mahovik.stands import names, path
from mahovik.use.study.exchange import Exchange
from mahovik.use.study.increments import lost_increments
from mahovik.use.study.resolution import FACTOR, MOTIONS, QUANTITIES, UNIT, balanced_flywheel, shortfalls, states
from physics.general import rows
from toolchain.quick import quick


@cache
def heavy() -> Stand:
    """shaker2 on a carrier of 500 t that falls, its left flywheel balanced to a millionth of a gramme millimetre."""
    stand = load(path("shaker2"))
    left = balanced_flywheel(stand.flywheels[0])
    left = replace(left, center_of_mass=(left.center_of_mass[0], 1e-12 / left.mass, 0.0))
    mass = replace(stand.carrier, mass=5e5, inertia=rows(1e5 * np.array(stand.carrier.inertia)))
    return replace(stand, carrier=mass, flywheels=(left, *stand.flywheels[1:]), gravity=(0.0, 0.0, -9.81))


def speeds(stand: Stand) -> list[float]:
    return [row.speed for row in summarize(stand).unbalance]


@pytest.mark.parametrize("name", names())
def test_the_examples_are_fine(name: str) -> None:
    stand = load(path(name))
    assert shortfalls(stand, speeds(stand)) == []


@pytest.mark.parametrize("name", quick(1, ["sat4", "auv6"]))
def test_rounding_is_what_the_estimate_allows(name: str) -> None:
    stand = load(path(name))
    c = CBackend(stand, "float")
    for motion in MOTIONS:
        for state in map(round_to_float, states(stand, speeds(stand), motion)):
            at = reference.pieces(stand, state)
            for want, quantity in QUANTITIES.items():
                expected = reference.evaluate(stand, state, [want], at)[quantity.key]
                off = np.abs(np.array(c.evaluate(state, [want])[quantity.key]) - expected)
                assert (off <= FACTOR * UNIT * quantity.terms(at, state)).all(), (want, motion)


def test_generate_of_float_says_so_as_check_does(tmp_path: Path) -> None:
    file = tmp_path / "heavy.toml"
    file.write_text(dumps(heavy()))
    warned = [line for line in run("check", str(file)).stdout.splitlines() if line.startswith("warning: float: ")]
    result = run("generate", str(file), "--real", "float", "--only", "forward", "-o", str(tmp_path / "f"))
    unbalance, steps = result.stderr.splitlines()
    assert (result.exit_code, [unbalance]) == (0, warned)
    assert steps.startswith("warning: float: steps of 0.0001 s lose")


@pytest.mark.parametrize("seed", range(4))
def test_a_change_is_the_difference_of_two_stands(seed: int) -> None:
    random = np.random.default_rng([19, seed])
    stand = random_stand(random, 3, EVERYTHING, name="exchanged")
    state = random_state(stand, random)
    number = seed % 3
    other = balanced_flywheel(stand.flywheels[number])
    if seed % 2:  # another mass as well, so that weight and the centre of mass change
        other = replace(other, mass=1.5 * other.mass)
    wheels = (*stand.flywheels[:number], other, *stand.flywheels[number + 1 :])
    exchanged = replace(stand, flywheels=wheels)

    at = reference.pieces(stand, state)
    before = reference.evaluate(stand, state, list(QUANTITIES), at)
    after = reference.evaluate(exchanged, state, list(QUANTITIES))
    found = Exchange.of(number, stand.flywheels[number], other).changes(at, state, before["V_dot"])
    for want, quantity in QUANTITIES.items():
        difference, size = after[quantity.key] - before[quantity.key], quantity.terms(at, state)
        if quantity.by_flywheel:
            difference, size = difference[number], size[number]
        assert np.abs(difference).max() > 0.0
        assert (np.abs(found[want] - difference) <= 1e-12 * size).all(), want


SAT4 = load(path("sat4"))
TOP_SPEED = 6000 * math.pi / 30


@pytest.mark.slow
def test_the_c_loses_at_most_the_part_that_is_named_and_much_of_it() -> None:
    """A thousand steps of 0.1 ms at 6000 rpm and at full torque, against double; a carry loses nothing of it."""
    (dt, steps), N = (1e-4, 1000), len(SAT4.flywheels)
    lost = lost_increments(SAT4, [TOP_SPEED] * N, dt)
    assert len(lost) == N
    start = replace(rest_state(SAT4), phi_dot=(TOP_SPEED,) * N, tau=(0.2,) * N)
    c = CBackend(SAT4, "float")
    exact = end_of_steps(CBackend(SAT4), "step", start, dt * steps, steps)["phi_dot"] - TOP_SPEED
    first = np.float64(np.float32(TOP_SPEED))  # the start in float
    plain, carried = (
        end_of_steps(c, name, start, dt * steps, steps)["phi_dot"] - first for name in ("step", "step_carried")
    )
    part = np.abs(plain / exact - 1.0)
    bounds = np.array([each.part for each in lost])
    assert np.all(part < 1.1 * bounds) and np.all(part > 0.02 * bounds)
    assert np.all(np.abs(carried / exact - 1.0) < 0.1 * part + 1e-4)


def test_check_names_step_part_and_remedy() -> None:
    found = run("check", str(path("sat4")), "--dt", "0.1 ms")
    text = " ".join(found.stdout.split())
    assert "warning: float: a step of 0.0001 s adds" in text and "use step_carried or double" in text
    assert "at 6000 rpm by up to 3.1e-05 rad/s" in text
    for wrong in ("0", "-1", "1 m", "inf"):
        assert "--dt: " in run("check", str(path("sat4")), "--dt", wrong).stderr


def test_long_steps_lose_nothing_worth_a_warning() -> None:
    assert lost_increments(SAT4, [TOP_SPEED] * 4, 0.1) == []
    bare = replace(SAT4, flywheels=tuple(replace(s, motor=None) for s in SAT4.flywheels))
    assert lost_increments(bare, [TOP_SPEED] * 4, 1e-2) == [] and len(lost_increments(bare, [TOP_SPEED] * 4, 1e-4)) == 4
