"""Stops of the freedoms of a hold: in every derivation and in the C; closed formulas; what is refused."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mahovik
from cli.run import run
from laws.held_stands import agree, compare_slopes, enclosed, held_stand, moved, rail, refused, table
from mahovik.core.emit.generate import generate_all
from mahovik.core.stand import dumps, identities
from mahovik.core.stand.hold import twists
from mahovik.core.stand.random_state import random_state
from mahovik.core.stand.summary import summarize
from mahovik.laws.stop import plan
from mahovik.laws.stop.data import Stops, stops_of
from mahovik.laws.stop.reference import wrench
from mahovik.proof import reference
from mahovik.proof.reference.coordinates import coordinate
from mahovik.proof.reference.pose import Pose
from mahovik.proof.reference.rotation import carrier_rotation
from mahovik.use.simulate.held import home, move
from second.agreement import differences, expectations
from toolchain.quick import quick

GIVEN = {
    "rail": table("stop", at="-10 mm", stiffness="10 N/mm", damping=100) + table("stop", at="10 mm", stiffness=900),
    "skew rail": table("stop", at=0.0, side="above", stiffness=30),
    "hinge": table("stop", at="-20 deg", side="above", stiffness="5 N m/deg", damping=3)
    + table("stop", at="-120 deg", stiffness=4),
    "skew hinge": table("stop", at=2, side="below", stiffness=7, damping=0.3) + table("stop", at=2.5, stiffness=9),
    "plane": table("stop", freedom="pitch", at="10 deg", side="above", stiffness=40)
    + table("stop", freedom="3", at="-150 deg", stiffness=30),
    "cylinder": table("stop", freedom="y", at=0.1, stiffness=50, damping=3)
    + table("stop", freedom="pitch", at=-0.1, stiffness=20)
    + table("stop", freedom="pitch", at=2.9, stiffness=10, damping=1),
}
"""Tables for each hold that has a coordinate."""


@pytest.mark.parametrize("name", quick(2, ("skew hinge", "cylinder", "plane", "rail", "skew rail", "hinge")))
def test_derivations_and_C_agree(name: str) -> None:
    agree(held_stand(name, GIVEN[name]), range(4))


def test_a_missing_stop_would_be_seen() -> None:
    """The comparison above can fail."""
    stand = held_stand("skew hinge", GIVEN["skew hinge"])
    state = random_state(stand, np.random.default_rng(2))
    bare = stand.without_laws(Stops)
    found = differences(lambda s, w: reference.evaluate(bare, s, w), state, expectations(stand, state))
    assert max(found.values()) > 1e-6


@pytest.mark.parametrize("name", GIVEN)
def test_the_rate_of_a_coordinate_is_the_speed_of_its_freedom(name: str) -> None:
    """At poses that the hold allows: from home along the freedoms, then on."""
    stand = held_stand(name, GIVEN[name])
    hold, rng = stand.hold, np.random.default_rng(3)
    assert hold is not None

    def pose_of(state: Any, V: Any) -> Pose:
        return Pose(np.array(state.position), carrier_rotation(stand, state), V)

    S = twists(hold)
    state = home(stand)
    for _ in range(3):
        state = move(state, carrier_rotation(stand, state), S @ rng.uniform(-0.5, 0.5, S.shape[1]))
    u: Any = rng.normal(size=S.shape[1])
    ends = [move(state, carrier_rotation(stand, state), sign * 1e-5 * (S @ u)) for sign in (1, -1)]
    for stop in stops_of(stand):
        freedom = hold.freedoms[stop.freedom]
        after, before = (coordinate(hold, freedom, stand.angles, pose_of(end, S @ u)) for end in ends)
        assert (after - before) / 2e-5 == pytest.approx(float(u[stop.freedom]), rel=1e-6)


def test_a_stop_pushes_back_and_never_pulls() -> None:
    """No force before the stop; beyond it none along the way into it, at whatever speed."""
    stand = held_stand("skew rail", GIVEN["skew rail"].replace("stiffness = 30", "stiffness = 30\ndamping = 1e4"))
    (stop,), hold = stops_of(stand), stand.hold
    assert hold is not None
    S = twists(hold)[:, 0]
    for place in np.linspace(-0.1, 0.1, 21):
        for u in (-10.0, -0.1, 0.0, 0.1, 10.0):
            F = wrench(stop, hold, stand.angles, Pose(place * S[:3], np.eye(3), u * S))
            along = float(F @ S)
            assert along <= 0.0
            assert along == pytest.approx(-max(0.0, place) * max(0.0, 30 + 1e4 * u), rel=1e-12, abs=1e-12)


def test_a_mass_bounces_off_an_undamped_stop() -> None:
    """It comes back as fast, after half a period in the stop, from a depth of v sqrt(m/k)."""
    mass, stiffness, v = 2.0, 8e3, 0.5
    run = moved(rail(mass, stop=[{"at": 0.1, "stiffness": stiffness}]), v, 0.5, every=5e-4)
    assert run["v_x [m/s]"][-1] == pytest.approx(-v, rel=1e-6)
    assert run["x [m]"].max() - 0.1 == pytest.approx(v * math.sqrt(mass / stiffness), rel=1e-3)
    inside = np.ptp(run["t [s]"][run["x [m]"] > 0.1])
    assert inside == pytest.approx(math.pi * math.sqrt(mass / stiffness), abs=2e-3)


@pytest.mark.slow
def test_a_damped_stop_returns_what_hunt_and_crossley_say() -> None:
    """m v dv/dx = -k x (1 + d v), d = damping / stiffness: v/d - ln(1 + d v)/d^2 is the same on the way in and out."""
    stiffness, damping, v = 8e3, 8e3, 0.5
    run = moved(rail(2.0, stop=[{"at": 0.1, "stiffness": stiffness, "damping": damping}]), v, 0.45, every=2e-4)
    d, back = damping / stiffness, run["v_x [m/s]"][-1]
    assert -v < back < 0.0

    def level(speed: float) -> float:
        return speed / d - math.log(1 + d * speed) / d**2

    assert level(back) == pytest.approx(level(v), rel=1e-5)
    depth = math.sqrt(2 * 2.0 / stiffness * level(v))
    assert run["x [m]"].max() - 0.1 == pytest.approx(depth, rel=1e-2)


@pytest.mark.parametrize("home", [0.0, 5.0])
def test_a_pendulum_rests_on_its_stop(home: float) -> None:
    """Against the moment of the weight: stiffness times depth is m g r cos(angle). The search begins at the home pose,
    where at a right angle to the weight nothing changes its moment."""
    document = {
        "schema": 1, "name": "arm", "gravity": [0, 0, -9.81],
        "carrier": {"mass": 2.0, "center_of_mass": [0.2, 0, 0], "inertia": [0.1, 0.1, 0.1],
                    "inertia_about": "center_of_mass"},
        "hold": {"freedoms": ["pitch"], "angles": [0, f"{home} deg", 0],
                 "stop": [{"at": f"{10 - home} deg", "stiffness": 50.0}, {"at": "-90 deg", "stiffness": 50.0}]},
    }  # fmt: skip
    state = mahovik.rest(mahovik.Stand.from_dict(document)).result.state
    assert state.quaternion is not None
    angle = 2 * math.atan2(state.quaternion[2], state.quaternion[0])
    assert angle > math.radians(10)
    assert 50.0 * (angle - math.radians(10)) == pytest.approx(2.0 * 9.81 * 0.2 * math.cos(angle), rel=1e-9)


@pytest.mark.parametrize("name", GIVEN)
def test_rigorous_balls_hold_the_push(name: str) -> None:
    stand = held_stand(name, GIVEN[name])
    for seed in range(3):
        enclosed(stand, random_state(stand, np.random.default_rng(seed)))


@pytest.mark.parametrize("name", GIVEN)
def test_slopes_of_planning(name: str) -> None:
    """The wrench is the literal one at any pose; its slopes are differences of it over small steps of the pose."""
    stand = held_stand(name, GIVEN[name])
    for seed in range(3):
        compare_slopes(stand, plan, "stop", seed)


def test_numbers_are_no_structure_and_nothing_is_there_without_it() -> None:
    stand, bare = held_stand("hinge", GIVEN["hinge"]), held_stand("hinge")
    other = held_stand("hinge", table("stop", at=1, stiffness=7) + table("stop", at=-1, stiffness=7))
    assert identities(other).structure == identities(stand).structure != identities(bare).structure
    assert identities(other).physics != identities(stand).physics
    assert "stop" in generate_all(stand).files["held.h"]
    assert "stop" not in generate_all(bare).files["held.h"]


@pytest.mark.parametrize(
    ("hold", "text", "words"),
    [
        ("ball", table("stop", freedom="yaw", at=1, stiffness=1), "where several freedoms turn, none has an angle"),
        ("plane", table("stop", freedom="x", at=1, stiffness=1), "another freedom turns its direction"),
        ("basis", table("stop", freedom="1", at=1, stiffness=1), "a freedom of a basis has no coordinate"),
        ("hinge", table("stop", at="175 deg", stiffness=1), "at: 3.05433 rad is more than 170 deg"),
        ("hinge", table("stop", at=0, stiffness=1), "side: required where `at` is zero"),
        ("hinge", table("stop", at=1, side="left", stiffness=1), 'side: expected "above" or "below"'),
        ("hinge", table("stop", at=1), "hold, stop[0], stiffness: required, but missing"),
        ("hinge", table("stop", at=1, stiffness=0), "stiffness: 0 N m/rad is not above 0"),
        ("hinge", table("stop", at="1 mm", stiffness=1), 'at: unit "mm" does not fit, expected an angle (rad)'),
        ("rail", table("stop", at=1, stiffness=1, damping="1 N s/m"), "expected a damping per depth (N s/m^2)"),
        (
            "rail",
            table("stop", at=1, stiffness=1, freedom="y"),
            'freedom: "y" is no freedom of this hold, expected one of x',
        ),
        ("hinge", table("stop", at=1, stiffness=1), 'hold, stop: only side = "above" of pitch has a stop'),
        ("hinge", table("stop", at=1, stiffness=1), 'expected one of side = "below" too'),
        ("hinge", table("stop", at=-1, stiffness=1) * 2, 'expected one of side = "above" too'),
        (
            "hinge",
            table("stop", at="-30 deg", side="above", stiffness=1) + table("stop", at=0.5, side="below", stiffness=1),
            "pitch may not go above -0.523599 rad, nor below 0.5 rad: nothing is left between",
        ),
        (
            "rail",
            table("stop", at=-0.1, side="above", stiffness=1) + table("stop", at=0.1, side="below", stiffness=1),
            "x may not go above -0.1 m, nor below 0.1 m",
        ),
    ],
)
def test_refusals(hold: str, text: str, words: str) -> None:
    refused(hold, text, words)


def test_a_home_pose_behind_a_stop_is_warned_of() -> None:
    """Each such stop has a line; a home pose at a stop or before it has none."""
    behind = table("stop", at=0.1, side="below", stiffness=1) + table("stop", at=0.2, stiffness=1)
    (line,) = [line for line in summarize(held_stand("rail", behind)).warnings if "stop" in line]
    assert line.startswith("the home pose is behind the stop of x at 0.1")
    before = table("stop", at=0.0, side="below", stiffness=1) + table("stop", at=0.2, stiffness=1)
    assert not [line for line in summarize(held_stand("rail", before)).warnings if "stop" in line]


def test_a_pendulum_between_two_stops_makes_no_energy() -> None:
    """Thrown from home against one stop it comes back to home as fast, then again from the other."""
    stop = [{"at": "100 deg", "stiffness": 200.0}, {"at": "-100 deg", "stiffness": 200.0}]
    document = rail(2.0) | {"hold": {"freedoms": ["pitch"], "stop": stop}}
    run = moved(document, 3.0, 3.0)
    assert np.abs(run["omega_y [rad/s]"]).max() == pytest.approx(3.0, rel=1e-6)
    assert run["omega_y [rad/s]"].min() == pytest.approx(-3.0, rel=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize(("hold", "freedom"), [("rail", "x"), ("plane", "pitch"), ("skew hinge", "1")])
def test_verify_passes_with_friction_and_stops(hold: str, freedom: str, tmp_path: Path) -> None:
    friction = table("friction", freedom=freedom, viscous=0.3, coulomb=2, breakaway=3, stribeck_speed=0.05)
    path = tmp_path / "held.toml"
    path.write_text(dumps(held_stand(hold, GIVEN[hold] + friction)), encoding="utf-8")
    assert "FAILED" not in run("verify", str(path)).stdout
