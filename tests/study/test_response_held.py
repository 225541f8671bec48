"""Response of held carriers: force tables, shakers and pendulums against closed formulas and the C through time."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mahovik
from cli.run import refused
from mahovik import stands
from mahovik.core.stand import Stand, load
from mahovik.core.stand.hold import FREEDOMS
from mahovik.core.stand.model import Hold
from mahovik.use.study.response import periodic_response

HELD = Path(__file__).parents[2] / "docs" / "held"
ZERO = (0.0, 0.0, 0.0)


def stand_of(document: dict[str, Any]) -> Stand:
    return mahovik.Stand.from_dict(document)


def table(**unbalance: str) -> dict[str, Any]:
    """A wheel that turns about z, 100 mm above O1, on a clamped carrier without weight."""
    return {
        "schema": 1,
        "name": "table",
        "carrier": {"mass": 12, "inertia": [0.2, 0.2, 0.2]},
        "hold": {"freedoms": []},
        "flywheel": [{"name": "wheel", "position": [0, 0, 0.1], "axis": [0, 0, 1], "zero": [1, 0, 0], "mass": 2,
                      "spin_inertia": 4e-3, "transverse_inertia": 2.5e-3, "unbalance": unbalance}],
    }  # fmt: skip


def reaction(found: Any, quantity: str) -> Any:
    """Magnitudes (H + 1, 3) of the harmonics of the reaction."""
    return np.abs(found.motion_of("hold.reaction").harmonics(quantity))


def test_a_force_table_reads_a_static_unbalance() -> None:
    """U w^2 across the axis, with the arm of 100 mm in the moment, at one order alone."""
    found = periodic_response(stand_of(table(static="72 g mm")), [300.0])
    force = 72e-6 * 300.0**2
    np.testing.assert_allclose(reaction(found, "force")[1], [force, force, 0.0], rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(reaction(found, "moment")[1], [0.1 * force, 0.1 * force, 0.0], rtol=1e-12, atol=1e-12)
    assert reaction(found, "force")[2:].max() < 1e-12 * force


def test_a_force_table_reads_a_dynamic_unbalance() -> None:
    """A couple of U w^2, and no force."""
    found = periodic_response(stand_of(table(dynamic="5 kg mm^2")), [300.0])
    couple = 5e-6 * 300.0**2
    np.testing.assert_allclose(reaction(found, "moment")[1], [couple, couple, 0.0], rtol=1e-12, atol=1e-12)
    assert reaction(found, "force")[1:].max() < 1e-12


def shaker(friction: bool, damping: float = 300.0) -> dict[str, Any]:
    """One exciter about x on a rail along z with a spring; damped by the suspension, or by viscous friction."""
    own = {"freedoms": ["z"]} | ({"friction": [{"viscous": damping}]} if friction else {})
    return {
        "schema": 1, "name": "shaker",
        "carrier": {"mass": 60, "inertia": [1.6, 1.9, 2.4]},
        "hold": own,
        "suspension": {"stiffness": [0, 0, 4e4, 0, 0, 0], "damping": [0, 0, 0 if friction else damping, 0, 0, 0]},
        "flywheel": [{"name": "w", "axis": [1, 0, 0], "zero": [0, 0, 1], "mass": 8, "spin_inertia": 0.02,
                      "transverse_inertia": 0.012, "unbalance": {"static": "160 g m"}}],
    }  # fmt: skip


@pytest.mark.parametrize("friction", [False, True])
@pytest.mark.parametrize("speed", [10.0, 24.0, 80.0])
def test_a_shaker_of_one_freedom(friction: bool, speed: float) -> None:
    """m e w^2 / (k - M w^2 + i c w) along the rail, by the suspension or by friction; m e w^2 across it is held."""
    M, k, c, me = 68.0, 4e4, 300.0, 0.16
    found = periodic_response(stand_of(shaker(friction)), [speed], ["carrier"])
    size = me * speed**2 / abs(k - M * speed**2 + 1j * c * speed)
    along = found.motion_of("hold.z")
    assert np.abs(along.harmonics("displacement")[1, 0]) == pytest.approx(size, rel=1e-9)
    assert np.abs(along.harmonics("acceleration")[1, 0]) == pytest.approx(size * speed**2, rel=1e-9)
    at_carrier = np.abs(found.motion_of("carrier").harmonics("displacement")[1])
    np.testing.assert_allclose(at_carrier, [0.0, 0.0, size], rtol=1e-9, atol=1e-14)
    np.testing.assert_allclose(reaction(found, "force")[1], [0.0, me * speed**2, 0.0], rtol=1e-9, atol=1e-9)
    assert found.natural == pytest.approx([math.sqrt(k / M) / (2 * math.pi)], rel=1e-9)


def test_six_freedoms_are_the_free_carrier() -> None:
    """A hold that blocks nothing: the same motion of points, the same natural frequencies, no reaction."""
    free = load(stands.path("bench8"))
    held = replace(free, hold=Hold(tuple(FREEDOMS.values()), (0.1, -0.2, 0.3), ZERO, ZERO))
    speeds = [60.0, -40.0, 20.0, 0, 0, 0, 0, 0]
    found, other = periodic_response(free, speeds), periodic_response(held, speeds)
    # of the mean of the linear equations over the period, which differs a little between coordinates
    np.testing.assert_allclose(other.natural, found.natural, rtol=1e-4)
    for name in found.points:
        expected = found.points[name].harmonics("acceleration")[:8]
        given = other.points[name].harmonics("acceleration")[:8]
        np.testing.assert_allclose(given, expected, rtol=0, atol=1e-8 * np.abs(expected).max())
    size = np.abs(other.motion_of("hold.reaction").harmonics("force")).max()
    assert size < 1e-9 * 10.0 * free.carrier.mass


@pytest.mark.slow
def test_it_is_the_motion_of_the_c_through_time() -> None:
    """A damped pendulum with an unbalanced wheel, stepped until it is steady: displacement and reaction over a turn."""
    document = {
        "schema": 1, "name": "pendulum", "gravity": [0, 0, -9.81],
        "carrier": {"mass": 2, "center_of_mass": [0, 0, -0.2], "inertia": [0.02, 0.02, 0.01],
                    "inertia_about": "center_of_mass"},
        "hold": {"freedoms": ["pitch"], "pivot": [0, 0, 0.05], "friction": [{"viscous": 1.0}]},
        "flywheel": [{"name": "w1", "axis": [0, 1, 0], "zero": [0, 0, 1], "position": [0, 0, -0.2], "mass": 0.5,
                      "spin_inertia": 1e-3, "transverse_inertia": 6e-4, "unbalance": {"static": "5 g m"}}],
    }  # fmt: skip
    stand = stand_of(document)
    speed = 20.0
    found = periodic_response(stand, [speed])
    turn, steps = 2 * math.pi / speed, 64
    turns = 12
    run_ = mahovik.simulate(
        stand, turns * turn, regime={"default": {"speed": speed}}, start={"phi_dot": [speed]},
        dt=turn / steps / 4, every=turn / steps,
    ).run  # fmt: skip
    last = slice(-steps - 1, -1)
    for column, expected in (("hold.reaction.x [N]", 0), ("hold.reaction.z [N]", 2)):
        spectrum = np.fft.rfft(run_[column][last]) * 2 / steps
        given = np.abs(found.motion_of("hold.reaction").harmonics("force")[1:4, expected])
        np.testing.assert_allclose(np.abs(spectrum[1:4]), given, rtol=1e-4, atol=1e-4 * given.max())
    spectrum = np.fft.rfft(run_["omega_y [rad/s]"][last]) * 2 / steps
    given = np.abs(found.motion_of("hold.pitch").harmonics("velocity")[1, 0])
    assert np.abs(spectrum[1]) == pytest.approx(given, rel=1e-4)


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (["--at", "hold.reacton"], 'unknown output "hold.reacton", did you mean "hold.reaction"?'),
        (["--at", "hold.pitch"], "expected one of hold.reaction, hold.z"),
        (["--at", "hold.z", "--quantity", "force"], "--quantity force: hold.z has none"),
        (["--at", "hold.z", "--quantity", "angle"], "hold.z has none; expected one of displacement, velocity"),
        (["--at", "carrier", "--quantity", "moment"], "--quantity moment: carrier has none"),
    ],
)
def test_refusals(words: list[str], expected: str) -> None:
    text = refused("response", str(HELD / "linear_shaker.toml"), "--speed", "all=10", *words)
    assert expected in text and len(text.splitlines()) == 1


def test_a_free_carrier_has_no_reaction() -> None:
    text = refused("response", str(stands.path("sat4")), "--speed", "all=10", "--at", "hold.reaction")
    assert "sat4 has no [hold]" in text


def test_a_freedom_that_turns_has_an_angle_and_its_derivatives() -> None:
    hold, springs = {"freedoms": ["pitch"], "pivot": [0, 0, 0.2]}, {"stiffness": [0, 0, 0, 0, 50, 0]}
    stand = stand_of(table(static="72 g mm") | {"hold": hold, "suspension": springs})
    angle, rate, acceleration = (
        mahovik.response(stand, {"wheel": 30.0}, "hold.pitch", quantity=name).sweep
        for name in ("angle", "rate", "acceleration")
    )
    assert [each.unit for each in (angle, rate, acceleration)] == ["rad", "rad/s", "rad/s2"]
    assert [each.quantity for each in (angle, rate)] == ["angle", "rate"]
    np.testing.assert_allclose(rate.rms(), 30.0 * angle.rms(), rtol=1e-4)
    np.testing.assert_allclose(acceleration.rms(), 900.0 * angle.rms(), rtol=1e-4)
