"""Friction along the freedoms of a hold: in every derivation and in the C; closed formulas; what is refused."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cli.run import run
from laws.held_stands import HOLDS, agree, compare_slopes, enclosed, held_stand, moved, rail, refused, table
from mahovik.core.emit.generate import generate_all
from mahovik.core.stand import dumps, identities, loads
from mahovik.core.stand.hold import twists, wrenches
from mahovik.core.stand.random_state import random_state
from mahovik.errors import StandError
from mahovik.laws.friction import plan
from mahovik.laws.friction.data import Friction, Frictions
from mahovik.laws.friction.reference import drag, unit_wrenches, wrench
from mahovik.proof import reference
from mahovik.proof.reference.pose import Pose
from mahovik.use.simulate.friction_steps import long_steps
from second.agreement import differences, expectations
from toolchain.quick import quick

GIVEN = {
    "rail": table("friction", viscous="3 N s/m", coulomb="2 N", breakaway=3, stribeck_speed="50 mm/s"),
    "skew rail": table("friction", coulomb=2),
    "hinge": table("friction", viscous="0.2 N m s/rad", coulomb="1 N m", smoothing="1 rpm"),
    "skew hinge": table("friction", freedom="1", breakaway=3, stribeck_speed=0.5),
    "plane": table("friction", freedom="z", viscous=0.2) + table("friction", freedom="pitch", coulomb=0.7),
    "cylinder": table("friction", freedom="pitch", breakaway=1, stribeck_speed=2),
    "ball": table("friction", freedom="yaw", viscous=0.01, coulomb=0.2),
    "basis": table("friction", freedom="2", viscous=0.4, coulomb=0.3, breakaway=0.6, stribeck_speed=0.3),
}
"""Tables for each hold of HOLDS."""


@pytest.mark.parametrize("name", quick(2, ("skew hinge", "basis", "plane", "rail", "skew rail", "hinge", "cylinder",
                                           "ball")))  # fmt: skip
def test_derivations_and_C_agree(name: str) -> None:
    agree(held_stand(name, GIVEN[name]), range(3))


def test_a_missing_friction_would_be_seen() -> None:
    """The comparison above can fail."""
    stand = held_stand("hinge", GIVEN["hinge"])
    state = random_state(stand, np.random.default_rng(0))
    bare = stand.without_laws(Frictions)
    found = differences(lambda s, w: reference.evaluate(bare, s, w), state, expectations(stand, state))
    assert max(found.values()) > 1e-6


@pytest.mark.parametrize("name", HOLDS)
def test_the_unit_wrench_of_a_freedom_has_no_power_in_the_others(name: str) -> None:
    hold = held_stand(name).hold
    assert hold is not None
    np.testing.assert_allclose(wrenches(hold).T @ twists(hold), np.eye(len(hold.freedoms)), rtol=0, atol=1e-15)
    np.testing.assert_allclose(wrenches(hold), unit_wrenches(hold), rtol=0, atol=1e-14)


def test_levels_by_hand() -> None:
    """Coulomb's level far above the Stribeck speed, half of the rise at it, the slope of the sign at rest."""
    friction = Friction(0, "x", 0.5, 2.0, 3.0, 0.1, 1e-6)
    assert drag(friction, 1e4) == pytest.approx(0.5e4 + 2.0, rel=1e-9)
    assert drag(friction, -0.1) == pytest.approx(-(0.05 + 2.5), rel=1e-9)
    assert drag(friction, 1e-9) == pytest.approx(1e-9 * (0.5 + 3.0 / 1e-6), rel=1e-6)
    assert drag(replace(friction, viscous=0.0, stribeck_speed=None), 1e-6) == pytest.approx(2.0 / math.sqrt(2.0))


_POSITIVE = st.floats(1e-3, 1e3)


@pytest.mark.slow
@settings(deadline=None)
@given(st.sampled_from(sorted(HOLDS)), _POSITIVE, _POSITIVE, _POSITIVE, st.floats(1.01, 1e3), st.integers(0, 99))
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
        F = wrench(friction, hold, Pose(np.zeros(3), np.eye(3), V))
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


@pytest.mark.parametrize("name", ("skew hinge", "basis", "plane"))
def test_rigorous_balls_hold_the_friction(name: str) -> None:
    stand = held_stand(name, GIVEN[name])
    enclosed(stand, random_state(stand, np.random.default_rng(5)))


@pytest.mark.parametrize("name", ("skew hinge", "basis", "plane"))
def test_slopes_of_planning(name: str) -> None:
    """The wrench is the literal one; its slopes are differences of it, and the pose does not matter."""
    stand = held_stand(name, GIVEN[name])
    assert not compare_slopes(stand, plan, "friction", 6, slower=10.0).by_pose.any()


def test_numbers_are_no_structure_and_nothing_is_there_without_it() -> None:
    stand, bare = held_stand("hinge", GIVEN["hinge"]), held_stand("hinge")
    other = held_stand("hinge", table("friction", viscous=7))
    assert identities(other).structure == identities(stand).structure != identities(bare).structure
    assert identities(other).physics != identities(stand).physics
    assert "held_rub(" in generate_all(stand).files["held.c"]
    assert "held_rub(" not in generate_all(bare).files["held.c"]
    assert held_stand("hinge", table("friction", viscous=0)) == bare  # it does nothing


@pytest.mark.parametrize(
    ("hold", "text", "words"),
    [
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
    ],
)
def test_refusals(hold: str, text: str, words: str) -> None:
    refused(hold, text, words)


def test_a_number_names_a_freedom_that_has_a_name() -> None:
    """The axis may be one of E1, so that its name is that of the direction."""
    given = [held_stand("axis = [0, 1, 0]\n", table("friction", freedom=name, viscous=1)) for name in ("1", "pitch")]
    assert given[0] == given[1]
    assert held_stand("plane", table("friction", freedom="3", viscous=1)) == held_stand(
        "plane", table("friction", freedom="pitch", viscous=1)
    )


def test_steps_that_are_too_long_for_the_friction_are_warned_of() -> None:
    """m s / F of a rail is 1.2 ms here. A wheel about the same axis gives way, unless its speed is given."""
    stand = held_stand("rail", table("friction", coulomb=2.5, smoothing=1.2e-3))
    (found,) = long_steps(stand, 2e-3)
    assert found.freedom == "x"
    assert found.bound == pytest.approx(2.5 * 1.2e-3 / 2.5, rel=1e-3)
    assert long_steps(stand, 1e-3) == []
    hinge = held_stand("hinge", table("friction", coulomb=1, smoothing=1e-6))
    free, driven = (long_steps(hinge, 1e-3, [given])[0].bound for given in (False, True))
    assert free < driven
    coupled = 1e-3 - 4e-5 * 0.3  # kg m2: spin inertia, and the unbalance at the arm to the pivot
    assert driven - free == pytest.approx(coupled**2 / 1e-3 * 1e-6, rel=1e-9)


def test_simulate_and_check_say_the_bound(tmp_path: Path) -> None:
    path = tmp_path / "rail.toml"
    path.write_text(dumps(held_stand("rail", table("friction", coulomb=2.5, smoothing=1e-5))), encoding="utf-8")
    words = "friction of x: a step of 0.0001 s is not shorter than 1e-05 s"
    assert words in " ".join(run("check", str(path)).stdout.split())
    assert words not in " ".join(run("check", str(path), "--dt", "9 us").stdout.split())
    start = tmp_path / "start.json"
    start.write_text('{"u": [0]}', encoding="utf-8")
    shown = run("simulate", str(path), "--until", "0.01", "--start", str(start), "-o", str(tmp_path / "run.csv")).stderr
    assert words in " ".join(shown.split())


def test_friction_needs_a_hold() -> None:
    with pytest.raises(StandError, match="it is not said how the carrier can move"):
        loads('schema = 1\nname = "s"\n[carrier]\nmass = 1\ninertia = [1, 1, 1]\n[[hold.friction]]\nviscous = 1\n')
