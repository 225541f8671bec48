"""Equilibrium of held carriers: hanging, on springs, none; along the freedoms alone."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from cli.run import refused
from cli.test_eval_held import TEXT
from mahovik.core.stand.model import Stand
from mahovik.core.stand.read import loads
from mahovik.errors import CheckError
from mahovik.proof import reference
from mahovik.proof.reference.rotation import carrier_rotation
from mahovik.use.study.rest import rest


def pendulum_with(text: str, more: str = "") -> Stand:
    """The pendulum with another hold."""
    return loads(TEXT.replace('freedoms = ["pitch"]\npivot = [0, 0, -0.2]', text) + more)


def test_a_pendulum_that_stands_on_its_pivot_hangs() -> None:
    found = rest(loads(TEXT))
    assert not found.unstable and found.free == ()
    C = carrier_rotation(loads(TEXT), found.state)
    assert C[2, 2] == pytest.approx(-1) and found.state.position == pytest.approx((0, 0, -0.4), abs=1e-12)
    answer = reference.evaluate(loads(TEXT), found.state, ["forward"])
    weight = [0, 0, -2.5 * 9.81]  # the pivot bears it, upwards in E0
    assert C @ answer["reaction"][:3] == pytest.approx([-x for x in weight], abs=1e-9)


def test_a_spring_along_a_rail_sinks_by_the_weight() -> None:
    found = rest(pendulum_with('freedoms = ["z"]', "[suspension]\nstiffness = [0, 0, 500, 0, 0, 0]\n"))
    assert found.state.position == pytest.approx((0, 0, -2.5 * 9.81 / 500), abs=1e-12)


def test_what_no_force_brings_back_is_free() -> None:
    found = rest(pendulum_with('freedoms = ["yaw"]'))
    assert found.free == ((0, 0, 0, 0, 0, 1),) and not found.unstable
    plane = rest(pendulum_with('freedoms = ["x", "y", "yaw"]'))
    assert len(plane.free) == 3


def test_clamped_it_rests_in_its_home_pose() -> None:
    found = rest(pendulum_with("freedoms = []\nposition = [1, 2, 3]\nangles = [0.1, 0, 0]"))
    assert found.state.position == (1, 2, 3) and found.V_dot == (0,) * 6 and found.free == ()


def test_where_it_falls_there_is_none() -> None:
    with pytest.raises(CheckError, match=r"nothing carries -24\.525 \(N or N m\) along the freedom z"):
        rest(pendulum_with('freedoms = ["z"]'))


def test_freedoms_that_are_no_closed_set_have_none(tmp_path: Path) -> None:
    path = tmp_path / "pendulum.toml"
    path.write_text(TEXT.replace('["pitch"]', '["x", "yaw"]'))
    message = refused("rest", str(path), status=1)
    assert "not a closed set" in message and len(message.strip().splitlines()) == 1


@pytest.mark.parametrize("at", [-0.3, -0.1, 0.1])
@pytest.mark.parametrize("stiffness", [1e4, 1e6])
def test_a_stop_that_presses_at_home_lets_the_stand_come_to_rest(at: float, stiffness: float) -> None:
    """A pendulum on its pivot, which falls against the other stop, or against the one that it must not pass."""
    stops = "".join(
        f'\n[[hold.stop]]\nat = {place}\nside = "{side}"\nstiffness = {stiffness}\n'
        for place, side in ((at, "above"), (at - 1.0, "below"))
    )
    stand = pendulum_with('freedoms = ["pitch"]\npivot = [0, 0, -0.2]\n', stops)
    found = rest(stand)
    w, _, y, _ = found.state.quaternion or (1.0, 0.0, 0.0, 0.0)
    angle = 2 * math.atan2(y, w)
    weight, depth = 2.5 * 9.81 * 0.2 * math.sin(angle), max(angle - at, at - 1.0 - angle)
    assert abs(weight) == pytest.approx(stiffness * depth, rel=1e-4) and not found.unstable


BALL = """
schema = 1
name = "ball"
gravity = [0, 0, -9.81]
[carrier]
mass = 1.7
center_of_mass = [0.004, -0.004, HEIGHT]
inertia = [[6e-3, 1e-4, 2e-4], [1e-4, 7e-3, -3e-4], [2e-4, -3e-4, 5e-3]]
inertia_about = "center_of_mass"
[hold]
freedoms = ["roll", "pitch", "yaw"]
pivot = [X, 0, 0.2]
"""


@pytest.mark.parametrize("height", [0.0715, 0.21])  # hangs; leans over by more than 90 degrees until it hangs
@pytest.mark.parametrize("x", [0.0, 0.0005, 0.001, 0.003, 0.01])
def test_a_ball_joint_tilts_and_does_not_turn_where_nothing_brings_it_back(x: float, height: float) -> None:
    """The tilt is the angle of the mass centre, seen from the pivot, to straight down; its axis is level."""
    stand = loads(BALL.replace("X", str(x)).replace("HEIGHT", str(height)))
    found = rest(stand)
    arm = np.array([0.004 - x, -0.004, height - 0.2])
    level = np.array([arm[1], -arm[0], 0.0])  # arm x (0, 0, 1)
    tilt = math.acos(-arm[2] / np.linalg.norm(arm))
    expected = (math.cos(tilt / 2), *(-math.sin(tilt / 2) * level / np.linalg.norm(level)).tolist())
    assert found.state.quaternion == pytest.approx(expected, abs=1e-9)
    assert len(found.free) == 1 and not found.unstable
