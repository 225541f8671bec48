"""Stands on which (12) is singular in practice, and tasks that the flywheels do not reach."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest

from mahovik.core.stand import load, loads
from mahovik.core.stand.model import Stand
from mahovik.stands import names, path
from mahovik.use.study.excess import excess
from mahovik.use.study.task_reach import task_shortfalls


def example(name: str) -> Stand:
    return load(path(name))


@pytest.mark.parametrize("name", sorted(names()))
def test_of_the_examples_it_is_the_satellites_but_for_their_tasks(name: str) -> None:
    """A task names the rows that are asked, so that (12) as a whole is not."""
    stand = example(name)
    assert excess(stand) is None
    assert (excess(replace(stand, tasks=())) is not None) == (name in ("eye4", "sat4"))


def test_the_words_name_flywheel_and_task() -> None:
    found = excess(replace(example("sat4"), tasks=()))
    assert found is not None and found.share > 100
    assert "[task.pointing]" in str(found) and found.flywheel in str(found)


def test_without_motors_a_stated_acceleration_decides() -> None:
    sat = example("sat4")
    bare = replace(sat, flywheels=tuple(replace(s, motor=None) for s in sat.flywheels), tasks=())
    found = excess(bare)
    assert found is not None and found.share == pytest.approx(found.phi_ddot / bare.inverse_most)
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
    (found,) = task_shortfalls(two(*rows))
    assert found.flywheel == "" and found.share == np.inf
    assert found.direction == pytest.approx([float(row == "wz") for row in rows], abs=1e-12)
    assert re.search(r"along wz \(UNREACHABLE\)", str(found))


def test_a_mixed_direction_is_told_by_its_parts() -> None:
    """Wheels about x and y, the first turned in the plane x-z: no moment about (-1, 0, 1)."""
    (found,) = task_shortfalls(two("wx", "wy", "wz", first=(1, 0, 1)))
    x, y, z = found.direction
    assert y == pytest.approx(0, abs=1e-9) and x * z < 0
    assert "wx" in str(found) and "wz" in str(found) and "wy" not in str(found)


def test_a_force_of_unbalance_alone_is_too_much_for_the_motors() -> None:
    stand = two("vx")
    wheels = tuple(replace(s, center_of_mass=(0.0, 1e-6, 0.0)) for s in stand.flywheels)
    (found,) = task_shortfalls(replace(stand, flywheels=wheels))
    assert found.flywheel in ("a", "b") and 1.0 < found.share < np.inf
    assert "(EXCESSIVE)" in str(found)
