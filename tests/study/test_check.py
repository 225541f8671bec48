"""What check says: motions that float loses, damping that drives in a fluid, tasks that the flywheels do not reach."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from cli.run import run
from lower.in_place import end_of_steps
from mahovik.core.stand import Stand, load, loads
from mahovik.core.stand.model import rest_state
from mahovik.core.stand.stand_file import dumps
from mahovik.core.stand.summary import summarize
from mahovik.proof.reference import pieces
from mahovik.proof.reference.motion import forward
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.draw import round_to_float
from mahovik.proof.verify.scales import Scales
from mahovik.stands import names, path
from mahovik.use.simulate.held import lost_increments
from mahovik.use.study.shortfalls import (
    FACTOR,
    MOTIONS,
    QUANTITIES,
    UNIT,
    balanced_flywheel,
    excess,
    shortfalls,
    states,
    task_shortfalls,
    with_one_balanced,
)
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


HELD = loads(dumps(load(path("auv6"))) + '[hold]\nfreedoms = ["y", "pitch"]\n')


@pytest.mark.parametrize(
    "stand", quick(2, [load(path("sat4")), HELD, load(path("auv6"))]), ids=["sat4", "held", "auv6"]
)
def test_rounding_is_what_the_estimate_allows(stand: Stand) -> None:
    c = CBackend(stand, "float")
    scales = Scales(stand, "float")
    for motion in MOTIONS:
        for state in (round_to_float(stand, exact) for exact in states(stand, speeds(stand), motion)):
            for want, (key, _) in QUANTITIES.items():
                measured = scales.want(state, want)
                assert measured is not None
                off = np.abs(np.array(c.evaluate(state, [want])[key]) - measured.values[key])
                assert (off <= FACTOR * UNIT * np.array(measured.scales[key])).all(), (want, motion)


@pytest.mark.parametrize("stand", [HELD, load(path("auv6"))], ids=["held", "free"])
def test_an_effect_is_what_balancing_of_that_flywheel_changes(stand: Stand) -> None:
    """In a stream, with added mass."""
    stand = replace(stand, stream=(0.5, -0.3, 0.2))
    balanced = [balanced_flywheel(flywheel) for flywheel in stand.flywheels]
    for state in (state for motion in MOTIONS for state in states(stand, [300.0] * len(balanced), motion)):
        at, all_balanced = (pieces(s, state) for s in (stand, replace(stand, flywheels=tuple(balanced))))
        for k, V_dot in enumerate(with_one_balanced(at, all_balanced)["forward"]):
            wheels = (*stand.flywheels[:k], balanced[k], *stand.flywheels[k + 1 :])
            expected = forward(pieces(replace(stand, flywheels=wheels), state), np.zeros(len(wheels)))
            assert np.abs(V_dot - expected).max() <= 1e-12 * np.abs(expected).max()


@pytest.mark.parametrize("hold", ["", '[hold]\nfreedoms = ["x", "roll"]\n'], ids=["free", "held"])
def test_generate_of_float_says_so_as_check_does(hold: str, tmp_path: Path) -> None:
    file = tmp_path / "heavy.toml"
    file.write_text(dumps(heavy()) + hold)
    warned = [line for line in run("check", str(file)).stdout.splitlines() if line.startswith("warning: float: ")]
    result = run("generate", str(file), "--real", "float", "--only", "forward", "-o", str(tmp_path / "f"))
    unbalance, steps = result.stderr.splitlines()
    assert (result.exit_code, [unbalance]) == (0, warned)
    assert steps.startswith("warning: float: steps of 0.0001 s lose")


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
        end_of_steps(c, "step", start, dt * steps, steps, carried=kept)["phi_dot"] - first for kept in (False, True)
    )
    part = np.abs(plain / exact - 1.0)
    bounds = np.array([loss.part for loss in lost])
    assert np.all(part < 1.1 * bounds) and np.all(part > 0.02 * bounds)
    assert np.all(np.abs(carried / exact - 1.0) < 0.1 * part + 1e-4)


def test_check_names_step_part_and_remedy() -> None:
    result = run("check", str(path("sat4")), "--dt", "0.1 ms")
    text = " ".join(result.stdout.split())
    assert "warning: float: a step of 0.0001 s adds" in text and "give step a carry, or take double" in text
    assert "at 6000 rpm by up to 3.1e-05 rad/s" in text
    for wrong in ("0", "-1", "1 m", "inf"):
        assert "--dt" in run("check", str(path("sat4")), "--dt", wrong).stderr


HEAD = """
schema = 1
name = "hull"
gravity = [0, 0, 9.81]
[carrier]
mass = 20.0
inertia = [0.3, 2.0, 2.0]
added_mass = [2, 25, 24, 0, 1.5, 1.5]
"""


def test_check_warns_of_fins_without_stall_and_of_fading_damping_that_drives(tmp_path: Path) -> None:
    file = tmp_path / "hull.toml"
    fin = '[[fin]]\nname = "rudder"\ndensity = 1025\narea = 0.01\naspect = 3.0\n'
    fading = "[carrier]\nfading_damping = { linear = [3, -9, 9, 0.2, 2, 2], rate = 3 }\n"
    body = HEAD.replace("[carrier]\n", fading, 1)
    assert body != HEAD
    file.write_text(body + fin, encoding="utf-8")
    text = " ".join(run("check", str(file)).stdout.split())
    assert "warning: fin rudder: without `stall`" in text
    assert "warning: carrier: fading_damping.linear has -9 for v: it drives" in text
    file.write_text(body.replace("-9", "9") + fin + 'stall = "15 deg"\n', encoding="utf-8")
    text = run("check", str(file)).stdout
    assert "without `stall`" not in text
    assert "drives" not in text


def example_stand(name: str) -> Stand:
    return load(path(name))


@pytest.mark.parametrize("name", sorted(names()))
def test_of_the_examples_it_is_the_satellites_but_for_their_tasks(name: str) -> None:
    """A task names the rows that are asked, so that (12) as a whole is not."""
    stand = example_stand(name)
    assert excess(stand) is None
    assert (excess(replace(stand, tasks=())) is not None) == (name in ("eye4", "sat4"))


def test_the_words_name_flywheel_and_task() -> None:
    largest = excess(replace(example_stand("sat4"), tasks=()))
    assert largest is not None and largest.share > 100
    assert "[task.pointing]" in str(largest) and largest.flywheel in str(largest)


def test_without_motors_a_stated_acceleration_decides() -> None:
    sat = example_stand("sat4")
    bare = replace(sat, flywheels=tuple(replace(s, motor=None) for s in sat.flywheels), tasks=())
    largest = excess(bare)
    assert largest is not None
    more = excess(replace(bare, inverse_most=bare.inverse_most / 3))
    assert more is not None and more.share == pytest.approx(3 * largest.share)
    assert excess(replace(bare, inverse_most=1e9)) is None
    assert excess(replace(bare, flywheels=())) is None


WHEEL = """
[[flywheel]]
name = "{name}"
mass = 0.5
axis = {axis}
zero = [-1, 1, 1]
spin_inertia = 1e-3
transverse_inertia = [6e-4, 6e-4]
motor = {{ torque = 0.02, speed = "6000 rpm" }}
"""


def two(*rows: str, first: tuple[float, ...] = (1, 0, 0)) -> Stand:
    """Wheels about an axis and about y, and a task of these rows."""
    head = 'schema = 1\nname = "two"\n[carrier]\nmass = 10\ninertia = [0.4, 0.5, 0.6]\n'
    wheels = WHEEL.format(name="a", axis=list(first)) + WHEEL.format(name="b", axis=[0, 1, 0])
    return loads(f"{head}{wheels}[task.chosen]\nrows = {list(rows)}\n")


@pytest.mark.parametrize("name", sorted(names()))
def test_the_examples_reach_their_tasks(name: str) -> None:
    assert task_shortfalls(load(path(name))) == []


@pytest.mark.parametrize("rows", [("wz",), ("wx", "wy", "wz"), ("wx", "wz")])
def test_a_moment_that_no_wheel_gives_is_named(rows: tuple[str, ...]) -> None:
    (shortfall,) = task_shortfalls(two(*rows))
    assert shortfall.flywheel == "" and shortfall.share == np.inf
    assert shortfall.direction == pytest.approx([float(row == "wz") for row in rows], abs=1e-12)
    assert re.search(r"along wz \(UNREACHABLE\)", str(shortfall))


def test_a_force_of_unbalance_alone_is_too_much_for_the_motors() -> None:
    stand = two("vx")
    wheels = tuple(replace(s, center_of_mass=(0.0, 1e-6, 0.0)) for s in stand.flywheels)
    (shortfall,) = task_shortfalls(replace(stand, flywheels=wheels))
    assert shortfall.flywheel in ("a", "b") and 1.0 < shortfall.share < np.inf
    assert "(EXCESSIVE)" in str(shortfall)
