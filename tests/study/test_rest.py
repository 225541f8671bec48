"""Static equilibrium of free and held carriers: no acceleration by the reference, free directions, none at all."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from mahovik import stands
from mahovik.core.stand import load
from mahovik.core.stand.model import Stand, State
from mahovik.core.stand.random import Features, random_stand
from mahovik.core.stand.stand_file import loads
from mahovik.errors import CheckError
from mahovik.laws.suspension.law import Suspension
from mahovik.proof import reference
from mahovik.proof.reference.algebra import carrier_rotation
from mahovik.use.study.rest import rest
from physics.general import rows, suspension_of
from verify.holds import PENDULUM

LIMIT = 1e-12  # the contract of a pose of rest, absolute


def acceleration(stand: Stand, state: State) -> np.ndarray:
    return np.asarray(np.abs(reference.evaluate(stand, state, ["forward"])["V_dot"]))


@pytest.mark.parametrize("name", ["bench8", "shaker2", "auv6", "demo3", "sat4"])
@pytest.mark.parametrize("phase", [0.0, 1.0])
def test_examples_rest(name: str, phase: float) -> None:
    stand = load(stands.path(name))
    result = rest(stand, [phase + s for s in range(len(stand.flywheels))])
    assert result.state.phi == tuple(phase + s for s in range(len(stand.flywheels)))
    assert acceleration(stand, result.state).max() <= LIMIT
    assert max(map(abs, result.V_dot)) <= LIMIT
    assert len(result.free) == {"bench8": 0, "shaker2": 0, "auv6": 4, "demo3": 6, "sat4": 6}[name]
    assert not result.unstable


@pytest.mark.parametrize("seed", range(2))
def test_random_suspended_stands_rest(seed: int) -> None:
    """Suspension, legs, weight and buoyancy act at general places."""
    features = Features(gravity=True, stream=False, fluid=True, laws={"suspension": 1, "leg": 2})
    stand = random_stand(np.random.default_rng(seed), 3, features)
    result = rest(stand, [0.3, 1.0, -2.0])
    assert (acceleration(stand, result.state) <= 1e-10).all()  # forces of 1e3 N on inertias of 0.1 kg m2: rounding


def test_weight_that_nothing_carries() -> None:
    stand = load(stands.path("shaker2")).without_laws(Suspension)
    weight = sum(body.mass for body in stand.bodies) * 9.81
    with pytest.raises(CheckError, match=r"nothing carries a force of .* N along \(0, 0, -1\) in E0") as caught:
        rest(stand)
    assert f"{weight:.6g} N" in str(caught.value)
    assert caught.value.exit_status == 1


def test_unstable_equilibria_are_left_or_named() -> None:
    """shaker2 with soft turning and a high mass centre falls over to a stable pose, or says that it would."""
    stand = load(stands.path("shaker2"))
    suspension = suspension_of(stand)
    stiffness = np.array(suspension.stiffness)
    for i in (3, 4):
        stiffness[i, i] = 5.0  # N m/rad, less than m g h = 6 * 9.81 * 0.2
    carrier = replace(stand.carrier, center_of_mass=(0.0, 0.0, 0.2), inertia_about="center_of_mass")
    soft = replace(suspension, stiffness=rows(stiffness))
    result = rest(replace(stand, carrier=carrier).with_laws(soft))
    assert not result.unstable
    assert result.state.quaternion is not None
    assert abs(result.state.quaternion[0]) < 0.95


def pendulum_with(text: str, more: str = "") -> Stand:
    """The pendulum with another hold."""
    return loads(PENDULUM.replace('freedoms = ["pitch"]\npivot = [0, 0, -0.2]', text) + more)


def test_a_pendulum_that_stands_on_its_pivot_hangs() -> None:
    result = rest(loads(PENDULUM))
    assert not result.unstable and result.free == ()
    C = carrier_rotation(loads(PENDULUM), result.state)
    assert C[2, 2] == pytest.approx(-1) and result.state.position == pytest.approx((0, 0, -0.4), abs=1e-12)
    answer = reference.evaluate(loads(PENDULUM), result.state, ["forward"])
    weight = [0, 0, -2.5 * 9.81]  # the pivot bears it, upwards in E0
    assert C @ answer["reaction"][:3] == pytest.approx([-x for x in weight], abs=1e-9)


@pytest.mark.parametrize(
    ("hold", "law", "position", "free"),
    [
        ('freedoms = ["z"]', "[suspension]\nstiffness = [0, 0, 500, 0, 0, 0]\n", (0, 0, -2.5 * 9.81 / 500), 0),
        ('freedoms = ["yaw"]', "", (0, 0, 0), 1),
        ('freedoms = ["x", "y", "yaw"]', "", (0, 0, 0), 3),
        ("freedoms = []\nposition = [1, 2, 3]\nangles = [0.1, 0, 0]", "", (1, 2, 3), 0),
    ],
)
def test_where_a_held_carrier_rests_and_what_no_force_brings_back(
    hold: str, law: str, position: tuple[float, ...], free: int
) -> None:
    result = rest(pendulum_with(hold, law))
    assert result.state.position == pytest.approx(position, abs=1e-12)
    assert len(result.free) == free and not result.unstable


@pytest.mark.parametrize(
    ("freedoms", "words"),
    [('["z"]', r"nothing carries -24\.525 \(N or N m\) along the freedom z"), ('["x", "yaw"]', "not a closed set")],
)
def test_where_there_is_no_rest(freedoms: str, words: str) -> None:
    with pytest.raises(CheckError, match=words):
        rest(pendulum_with(f"freedoms = {freedoms}"))


@pytest.mark.parametrize(("at", "stiffness"), [(-0.3, 1e4), (0.1, 1e6)])
def test_a_stop_that_presses_at_home_lets_the_stand_come_to_rest(at: float, stiffness: float) -> None:
    """A pendulum on its pivot, which falls against the other stop, or against the one that it must not pass."""
    stops = "".join(
        f'\n[[hold.stop]]\nat = {place}\nside = "{side}"\nstiffness = {stiffness}\n'
        for place, side in ((at, "above"), (at - 1.0, "below"))
    )
    stand = pendulum_with('freedoms = ["pitch"]\npivot = [0, 0, -0.2]\n', stops)
    result = rest(stand)
    w, _, y, _ = result.state.quaternion or (1.0, 0.0, 0.0, 0.0)
    angle = 2 * math.atan2(y, w)
    weight, depth = 2.5 * 9.81 * 0.2 * math.sin(angle), max(angle - at, at - 1.0 - angle)
    assert abs(weight) == pytest.approx(stiffness * depth, rel=1e-4) and not result.unstable


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
@pytest.mark.parametrize("x", [0.0, 0.0005, 0.01])
def test_a_ball_joint_tilts_and_does_not_turn_where_nothing_brings_it_back(x: float, height: float) -> None:
    """The tilt is the angle of the mass centre, seen from the pivot, to straight down; its axis is level."""
    stand = loads(BALL.replace("X", str(x)).replace("HEIGHT", str(height)))
    result = rest(stand)
    arm = np.array([0.004 - x, -0.004, height - 0.2])
    level = np.array([arm[1], -arm[0], 0.0])  # arm x (0, 0, 1)
    tilt = math.acos(-arm[2] / np.linalg.norm(arm))
    expected = (math.cos(tilt / 2), *(-math.sin(tilt / 2) * level / np.linalg.norm(level)).tolist())
    assert result.state.quaternion == pytest.approx(expected, abs=1e-9)
    assert len(result.free) == 1 and not result.unstable
