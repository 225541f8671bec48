"""Tasks out of reach of the flywheels, and the direction that is named."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
from click.testing import CliRunner

from mahovik.core.stand import load
from mahovik.core.stand.model import Stand
from mahovik.out.cli import main
from mahovik.stands import names, path
from mahovik.use.study.unreached import unreached


def with_wheels(*numbers: int) -> Stand:
    """eye4 with some of its four wheels."""
    whole = load(path("eye4"))
    return replace(whole, flywheels=tuple(whole.flywheels[k] for k in numbers))


@pytest.mark.parametrize("name", names())
def test_the_examples_reach_their_tasks(name: str) -> None:
    assert unreached(load(path(name))) == []


def test_three_wheels_of_the_pyramid_are_enough() -> None:
    for left_out in range(4):
        assert unreached(with_wheels(*(k for k in range(4) if k != left_out))) == []


@pytest.mark.parametrize(("wheels", "axis"), [((0, 1), (0, 1, -1)), ((1, 2), (1, 0, 1)), ((0, 2), (1, -1, 0))])
def test_two_wheels_give_no_moment_across_both_axes(wheels: tuple[int, int], axis: tuple[float, ...]) -> None:
    """Torques along the two spin axes do no work on turns about an axis that is across both."""
    (found,) = unreached(with_wheels(*wheels))
    turning = np.array(found.twist[3:])
    assert np.abs(turning / np.linalg.norm(turning) @ axis) / np.linalg.norm(axis) == pytest.approx(1.0, abs=1e-3)
    assert str(found).startswith("the flywheels do not reach the task pointing: they give no moment about (")


def test_without_flywheels_nothing_is_reached() -> None:
    (found,) = unreached(with_wheels())
    assert found.task == "pointing"


def test_check_warns_in_one_line(tmp_path_factory: pytest.TempPathFactory) -> None:
    text = path("eye4").read_text(encoding="utf-8")
    head, first, second, *_, rest = text.split("[[flywheel]]")
    file = tmp_path_factory.mktemp("two") / "two.toml"
    two = "[[flywheel]]".join([head, first, second]) + rest[rest.index("[[point]]") :]
    file.write_text(two.replace('"eye4"', '"two"'), encoding="utf-8")
    printed = CliRunner().invoke(main, ["check", str(file)])
    assert printed.exit_code == 0
    (line,) = (each for each in printed.output.splitlines() if "reach the task" in each)
    assert (
        "pointing" in line
        and "no moment about (" in line
        and "0.7071, -0.7071) of E1" in line
        and "leave rows out" in line
    )
    found = json.loads(CliRunner().invoke(main, ["check", str(file), "--json"]).output)
    assert [each["task"] for each in found["unreached"]] == ["pointing"]
