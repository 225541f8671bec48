"""Friction and stops along the freedoms of a hold: all derivations and the C, closed formulas, what is refused."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import mahovik
from laws.held_stands import (
    FRICTION,
    HOLDS,
    STOPS,
    agree,
    compare_slopes,
    enclosed,
    held_stand,
    moved,
    rail,
    refused,
    table,
)
from mahovik.core.emit.generate import generate_all
from mahovik.core.stand import identities, loads
from mahovik.core.stand.hold import twists, wrenches
from mahovik.core.stand.random import random_state
from mahovik.core.stand.summary import summarize
from mahovik.errors import StandError
from mahovik.laws.friction.law import Friction, Frictions
from mahovik.laws.friction.reference import drag, unit_wrenches
from mahovik.laws.friction.reference import wrench as friction_wrench
from mahovik.laws.stop.law import Stops, stops_of
from mahovik.laws.stop.reference import wrench as stop_wrench
from mahovik.proof import reference
from mahovik.proof.reference.algebra import Pose, carrier_rotation
from mahovik.proof.reference.coordinates import coordinate
from mahovik.use.simulate.held import home, long_steps, move
from second.agreement import differences, expectations
from toolchain.quick import quick


@pytest.mark.parametrize("name", quick(1, ("skew hinge", "plane", "rail", "skew rail", "hinge", "cylinder")))
def test_derivations_and_C_agree(name: str) -> None:
    """They agree with both laws, and the reference without one of them differs."""
    stand = held_stand(name, FRICTION[name] + STOPS[name])
    agree(stand, range(4))
    states = [random_state(stand, np.random.default_rng(seed)) for seed in range(10)]
    for law in (Frictions, Stops):
        without = partial(reference.evaluate, stand.without_laws(law))
        changes = [max(differences(without, at, expectations(stand, at, ["forward"])).values()) for at in states]
        assert max(changes) > 1e-6


@pytest.mark.parametrize("name", HOLDS)
def test_balls_hold_the_wrench_and_planning_has_its_slopes(name: str) -> None:
    """Balls enclose the wrench at any pose; slopes are those of differences."""
    stand = held_stand(name, FRICTION[name] + STOPS.get(name, ""))
    for seed in range(2):
        enclosed(stand, random_state(stand, np.random.default_rng(seed)))
    assert not compare_slopes(stand, Frictions, "friction", 6, slower=10.0)[:, :6].any()
    if name in STOPS:
        compare_slopes(stand, Stops, "stop", 1)


@pytest.mark.parametrize(
    ("kind", "other", "file", "word"),
    [
        (FRICTION["hinge"], table("friction", viscous=7), "held.c", "held_rub("),
        (STOPS["hinge"], table("stop", at=1, stiffness=7) + table("stop", at=-1, stiffness=7), "held.h", "stop"),
    ],
)
def test_numbers_are_no_structure_and_nothing_is_there_without_it(kind: str, other: str, file: str, word: str) -> None:
    stand, changed, bare = held_stand("hinge", kind), held_stand("hinge", other), held_stand("hinge")
    assert identities(changed).structure == identities(stand).structure != identities(bare).structure
    assert identities(changed).physics != identities(stand).physics
    assert word in generate_all(stand).files[file]
    assert word not in generate_all(bare).files[file]


@pytest.mark.parametrize("name", HOLDS)
def test_the_unit_wrench_of_a_freedom_has_no_power_in_the_others(name: str) -> None:
    hold = held_stand(name).hold
    assert hold is not None
    np.testing.assert_allclose(wrenches(hold).T @ twists(hold), np.eye(len(hold.freedoms)), rtol=0, atol=1e-15)
    np.testing.assert_allclose(wrenches(hold), unit_wrenches(hold), rtol=0, atol=1e-14)


def test_levels_by_hand() -> None:
    """It is Coulomb's far above the Stribeck speed, half of the rise at it, with the slope of the sign at rest."""
    friction = Friction(0, "x", 0.5, 2.0, 3.0, 0.1, 1e-6)
    assert drag(friction, 1e4) == pytest.approx(0.5e4 + 2.0, rel=1e-9)
    assert drag(friction, -0.1) == pytest.approx(-(0.05 + 2.5), rel=1e-9)
    assert drag(friction, 1e-9) == pytest.approx(1e-9 * (0.5 + 3.0 / 1e-6), rel=1e-6)
    assert drag(replace(friction, viscous=0.0, stribeck_speed=None), 1e-6) == pytest.approx(2.0 / math.sqrt(2.0))


positive = st.floats(1e-3, 1e3)


@given(st.sampled_from(sorted(HOLDS)), positive, positive, positive, st.floats(1.01, 1e3), st.integers(0, 99))
def test_friction_never_does_positive_work(
    name: str, viscous: float, coulomb: float, rise: float, factor: float, seed: int
) -> None:
    """The power -drag(u) u is not positive at any speed, and no larger against another freedom than rounding."""
    hold = held_stand(name).hold
    assert hold is not None
    rng = np.random.default_rng(seed)
    u = rng.normal(size=len(hold.freedoms)) * 10.0 ** rng.uniform(-4, 3)
    for k in range(len(u)):
        friction = Friction(k, "", viscous, coulomb, coulomb + rise, 1e-2 * factor, 1e-2)
        V = twists(hold) @ u
        F = friction_wrench(friction, hold, Pose(np.zeros(3), np.eye(3), V))
        rounding = 1e-13 * float(np.abs(F) @ np.abs(V))
        power = float(F @ V)
        assert power <= rounding
        assert power == pytest.approx(-drag(friction, float(u[k])) * float(u[k]), rel=1e-6, abs=rounding + 1e-9)


def test_a_sliding_mass_stops_after_the_way_of_coulomb() -> None:
    """m v^2 / (2 coulomb), which is v^2 / (2 mu g) where coulomb = mu m g; by the smoothing a little more, exactly
    m / coulomb (v w + s^2 asinh(v/s)) / 2, w = sqrt(v^2 + s^2)."""
    mass, mu, v, s = 2.0, 0.3, 1.5, 1e-2
    coulomb = mu * mass * 9.81
    run = moved(rail(mass, friction=[{"coulomb": coulomb, "smoothing": s}]), v, 1.0)
    exact = mass / coulomb * (v * math.hypot(v, s) + s**2 * math.asinh(v / s)) / 2
    assert run["x [m]"][-1] == pytest.approx(exact, rel=1e-9)
    assert run["x [m]"][-1] == pytest.approx(v**2 / (2 * mu * 9.81), rel=1e-3)
    half = int(np.searchsorted(run["t [s]"], 0.25))
    slower = v - mu * 9.81 * run["t [s]"][half]
    assert run["v_x [m/s]"][half] == pytest.approx(slower, abs=2e-4)


def test_viscous_friction_alone_decays_exponentially() -> None:
    run = moved(rail(2.0, friction=[{"viscous": 3.0}]), 1.0, 1.0)
    np.testing.assert_allclose(run["v_x [m/s]"], np.exp(-1.5 * run["t [s]"]), rtol=1e-9)


def test_breakaway_holds_what_coulomb_lets_go() -> None:
    """On a slope, a push between coulomb and breakaway moves the mass only if it moves already."""
    friction = [{"coulomb": 1.0, "breakaway": 3.0, "stribeck_speed": 0.05, "smoothing": 1e-3}]
    slope = rail(2.0, friction=friction) | {"gravity": [1.0, 0.0, 0.0]}  # 2 N along the rail
    assert moved(slope, 0.0, 0.5)["v_x [m/s]"][-1] < 1e-3
    assert moved(slope, 0.3, 0.5)["v_x [m/s]"][-1] > 0.5


def test_a_number_names_a_freedom_that_has_a_name() -> None:
    """The axis may be one of E1, so that its name is that of the direction."""
    stands = [held_stand("axis = [0, 1, 0]\n", table("friction", freedom=name, viscous=1)) for name in ("1", "pitch")]
    assert stands[0] == stands[1]
    assert held_stand("plane", table("friction", freedom="3", viscous=1)) == held_stand(
        "plane", table("friction", freedom="pitch", viscous=1)
    )


def test_steps_that_are_too_long_for_the_friction_are_warned_of() -> None:
    """m s / F of a rail is 1.2 ms here. A wheel about the same axis gives way, unless its speed is given."""
    stand = held_stand("rail", table("friction", coulomb=2.5, smoothing=1.2e-3))
    (step,) = long_steps(stand, 2e-3)
    assert step.freedom == "x"
    assert step.bound == pytest.approx(2.5 * 1.2e-3 / 2.5, rel=1e-3)
    assert long_steps(stand, 1e-3) == []
    hinge = held_stand("hinge", table("friction", coulomb=1, smoothing=1e-6))
    free, driven = (long_steps(hinge, 1e-3, [driven_only])[0].bound for driven_only in (False, True))
    assert free < driven
    coupled = 1e-3 - 4e-5 * 0.3  # kg m2: spin inertia, and the unbalance at the arm to the pivot
    assert driven - free == pytest.approx(coupled**2 / 1e-3 * 1e-6, rel=1e-9)


@pytest.mark.parametrize("name", STOPS)
def test_the_rate_of_a_coordinate_is_the_speed_of_its_freedom(name: str) -> None:
    """Poses are those that the hold allows: from home along the freedoms, then on."""
    stand = held_stand(name, STOPS[name])
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
    stand = held_stand("skew rail", STOPS["skew rail"].replace("stiffness = 30", "stiffness = 30\ndamping = 1e4"))
    (stop,), hold = stops_of(stand), stand.hold
    assert hold is not None
    S = twists(hold)[:, 0]
    for place in np.linspace(-0.1, 0.1, 21):
        for u in (-10.0, -0.1, 0.0, 0.1, 10.0):
            F = stop_wrench(stop, hold, stand.angles, Pose(place * S[:3], np.eye(3), u * S))
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
    quaternion = mahovik.check(mahovik.Stand.from_dict(document))["rest"]["state"]["quaternion"]
    angle = 2 * math.atan2(quaternion[2], quaternion[0])
    assert angle > math.radians(10)
    assert 50.0 * (angle - math.radians(10)) == pytest.approx(2.0 * 9.81 * 0.2 * math.cos(angle), rel=1e-9)


def test_a_home_pose_behind_a_stop_is_warned_of() -> None:
    """Each such stop has a line; a home pose at a stop or before it has none."""
    behind = table("stop", at=0.1, side="below", stiffness=1) + table("stop", at=0.2, stiffness=1)
    (line,) = [line for line in summarize(held_stand("rail", behind)).warnings if "stop" in line]
    assert line.startswith("the home pose is behind the stop of x at 0.1")
    before = table("stop", at=0.0, side="below", stiffness=1) + table("stop", at=0.2, stiffness=1)
    assert not [line for line in summarize(held_stand("rail", before)).warnings if "stop" in line]


REFUSED = [
    ("plane", table("friction", coulomb=1), "hold, friction[0], freedom: required where there are several"),
    (
        "plane",
        table("friction", freedom="pich"),
        'freedom: "pich" is no freedom of this hold, did you mean "pitch"?',
    ),
    ("hinge", table("friction", coulomb=-1), "hold, friction[0], coulomb: -1 N m is negative"),
    ("hinge", table("friction", coulomb="1 N"), 'coulomb: unit "N" does not fit, expected a torque (N m)'),
    ("rail", table("friction", viscous="1 N m s/rad"), "friction[0], viscous: unit"),
    ("rail", table("friction", breakaway=1), "stribeck_speed: required with breakaway"),
    ("rail", table("friction", coulomb=1, stribeck_speed=1), "breakaway: required with stribeck_speed"),
    ("rail", table("friction", coulomb=2, breakaway=1), "breakaway: 1 is below coulomb, 2"),
    (
        "rail",
        table("friction", breakaway=1, stribeck_speed=0.01),
        "0.01 m/s is not above smoothing",
    ),
    (
        "rail",
        table("friction", smoothing=1),
        "friction[0], viscous: none of viscous, coulomb and breakaway is given",
    ),
    ("skew hinge", table("friction", freedom="2"), 'freedom: "2" is no freedom of this hold, expected one of 1'),
    ("rail", table("friction", coulomb=1, smoothing=0), "smoothing: 0 m/s: expected above 0"),
    ("rail", table("friction", viscous=1) * 2, "friction[1], freedom: x has friction already"),
    ("rail", table("friction", viscos=1), 'friction[0]: unknown key "viscos", did you mean "viscous"?'),
    ("rail", "friction = 3\n", "hold, friction: expected a list, found 3"),
    ("freedoms = []\n", table("friction", viscous=1), "freedom: the hold is clamped: it has no freedom"),
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
]


@pytest.mark.parametrize(("hold", "text", "words"), REFUSED)
def test_refusals(hold: str, text: str, words: str) -> None:
    refused(hold, text, words)


def test_friction_needs_a_hold() -> None:
    with pytest.raises(StandError, match="hold: found none of"):
        loads('schema = 1\nname = "s"\n[carrier]\nmass = 1\ninertia = [1, 1, 1]\n[[hold.friction]]\nviscous = 1\n')
