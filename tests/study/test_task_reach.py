"""Tasks that the flywheels do not reach, and those that they do."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from mahovik.core.stand import load, loads
from mahovik.core.stand.model import Stand
from mahovik.out.cli import main
from mahovik.stands import names, path
from mahovik.use.study.task_reach import task_shortfalls

TWO = """
schema = 1
name = "two"
[carrier]
mass = 10
inertia = [[0.4, 0, 0], [0, 0.5, 0], [0, 0, 0.6]]
[[flywheel]]
name = "a"
mass = 0.5
axis = [1, 0, 0]
zero = [0, 1, 0]
spin_inertia = 1e-3
transverse_inertia = [6e-4, 6e-4]
motor = {{ torque = 0.02, speed = "6000 rpm" }}
[[flywheel]]
name = "b"
mass = 0.5
axis = [0, 1, 0]
zero = [0, 0, 1]
spin_inertia = 1e-3
transverse_inertia = [6e-4, 6e-4]
motor = {{ torque = 0.02, speed = "6000 rpm" }}
[task.chosen]
rows = [{rows}]
"""


def two(*rows: str) -> Stand:
    return loads(TWO.format(rows=", ".join(f'"{row}"' for row in rows)))


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
    text = TWO.format(rows='"wx", "wy", "wz"').replace("axis = [1, 0, 0]", "axis = [1, 0, 1]")
    (found,) = task_shortfalls(loads(text))
    x, y, z = found.direction
    assert y == pytest.approx(0, abs=1e-9) and x * z < 0
    assert "wx" in str(found) and "wz" in str(found) and "wy" not in str(found)


def test_a_force_of_unbalance_alone_is_too_much_for_the_motors() -> None:
    stand = two("vx")
    wheels = tuple(replace(s, center_of_mass=(0.0, 1e-6, 0.0)) for s in stand.flywheels)
    (found,) = task_shortfalls(replace(stand, flywheels=wheels))
    assert found.flywheel in ("a", "b") and 1.0 < found.share < np.inf
    assert "(EXCESSIVE)" in str(found)


def with_wheels(*numbers: int) -> Stand:
    """eye4 with some of its four wheels."""
    whole = load(path("eye4"))
    return replace(whole, flywheels=tuple(whole.flywheels[k] for k in numbers))


@pytest.mark.parametrize(("wheels", "axis"), [((0, 1), (0, 1, -1)), ((1, 2), (1, 0, 1)), ((0, 2), (1, -1, 0))])
def test_two_wheels_do_no_work_on_turns_across_both_axes(wheels: tuple[int, int], axis: tuple[float, ...]) -> None:
    (found,) = task_shortfalls(with_wheels(*wheels))
    assert abs(np.array(found.direction) @ axis) / np.linalg.norm(axis) == pytest.approx(1.0, abs=1e-3)


def test_check_warns_in_one_line(tmp_path: Path) -> None:
    text = path("eye4").read_text(encoding="utf-8")
    head, first, second, *_, rest = text.split("[[flywheel]]")
    file = tmp_path / "two.toml"
    two = "[[flywheel]]".join([head, first, second]) + rest[rest.index("[[point]]") :]
    file.write_text(two.replace('"eye4"', '"two"'), encoding="utf-8")
    printed = CliRunner().invoke(main, ["check", str(file)])
    assert printed.exit_code == 0
    (line,) = (each for each in printed.output.splitlines() if "UNREACHABLE" in each)
    assert "task pointing" in line and "wy" in line and "wz" in line and "remove a row" in line
    found = json.loads(CliRunner().invoke(main, ["check", str(file), "--json"]).output)
    assert [each["task"] for each in found["unreached"]] == ["pointing"]
