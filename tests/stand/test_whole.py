"""Mass properties, capacities, grades, the mean stand and sines of unbalance: figures by hand and by other means."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from mahovik.core.stand import Stand, loads
from mahovik.core.stand.balance import GRADES, grade
from mahovik.core.stand.capacity import momentum_capacity, torque_capacity
from mahovik.core.stand.mean import mean_stand
from mahovik.core.stand.random import random_stand, random_state
from mahovik.core.stand.state import State
from mahovik.core.stand.summary import summarize
from mahovik.core.stand.whole import mass_properties
from mahovik.proof import reference

CARRIER = 'schema = 1\nname = "a"\n[carrier]\nmass = 3\ninertia = [0.5, 0.6, 0.7]\n'


def wheel(name: str, axis: str, extra: str = "", position: str = "[0, 0, 0]") -> str:
    zero = "[0, 1, 1]" if axis == "[1, 0, 0]" else "[1, 0, 0]"
    return (
        f'[[flywheel]]\nname = "{name}"\nposition = {position}\naxis = {axis}\nzero = {zero}\nmass = 1\n'
        f"spin_inertia = 0.02\ntransverse_inertia = 0.011\n{extra}\n"
    )


def stand(*wheels: str) -> Stand:
    return loads(CARRIER + "".join(wheels))


def test_a_wheel_beside_the_carrier() -> None:
    """3 kg and 1 kg at 0.4 m: the centre at 0.1 m, the reduced mass 0.75 kg, 0.75 x 0.4^2 = 0.12 kg m2 across."""
    found = mass_properties(stand(wheel("w", "[0, 0, 1]", position="[0.4, 0, 0]")))
    assert found.mass == 4.0
    assert found.center_of_mass == pytest.approx((0.1, 0.0, 0.0))
    moments = (0.5 + 0.011, 0.6 + 0.011 + 0.12, 0.7 + 0.02 + 0.12)
    assert np.allclose(found.inertia, np.diag(moments), rtol=0, atol=1e-15)
    assert found.principal_inertia == pytest.approx(moments)
    assert np.allclose(found.principal_axes, np.eye(3), rtol=0, atol=1e-12)


def test_an_instrument_is_turned_with_its_wheel() -> None:
    """The instrument's axis 1 is axis 2 of E1; a wheel along it adds 0.02 there, 0.011 across."""
    text = (
        '[[instrument]]\nname = "i"\nmass = 0\nangles = ["90 deg", 0, 0]\nposition = [0, 0, 0]\n'
        + wheel("w", "[1, 0, 0]", 'mount = "i"')
    )  # fmt: skip
    assert np.diag(mass_properties(stand(text)).inertia) == pytest.approx([0.511, 0.62, 0.711])


MOTOR = 'motor = {{ torque = {}, speed = "{} rpm" }}'


def test_capacity_of_three_wheels_on_the_axes() -> None:
    """0.02 kg m2 at 3000 rpm is 2 pi N m s; a box of three axes has its least reach along the shortest."""
    x, y, z = (MOTOR.format(torque, speed) for torque, speed in ((0.1, 3000), (0.2, 6000), (0.3, 3000)))
    found = stand(wheel("x", "[1, 0, 0]", x), wheel("y", "[0, 1, 0]", y), wheel("z", "[0, 0, 1]", z))
    momentum, torque = momentum_capacity(found), torque_capacity(found)
    h = 2 * math.pi
    assert momentum.each == pytest.approx((h, 2 * h, h))
    assert momentum.axes == pytest.approx((h, 2 * h, h))
    assert (momentum.total, momentum.direction) == pytest.approx((4 * h, h))
    assert torque.axes == pytest.approx((0.1, 0.2, 0.3))
    assert (torque.total, torque.direction) == pytest.approx((0.6, 0.1))


@pytest.mark.parametrize(("tilt", "direction"), [(1.2e-9, 0.0), (1.7e-9, 1.7e-9)])
def test_wheels_reach_across_a_plane_that_they_leave_by_more_than_rounding(tilt: float, direction: float) -> None:
    """Two wheels along one axis but for a tilt, across which the least singular value of the axes is tilt/sqrt 2."""
    axes = ("[1, 0, 0]", "[0, 1, 0]", f"[0, 1, {tilt}]")
    found = torque_capacity(stand(*(wheel(f"w{k}", axis, "motor = { torque = 1 }") for k, axis in enumerate(axes))))
    assert found.direction == pytest.approx(direction, rel=1e-6, abs=0.0)


def test_grades() -> None:
    """30 g mm on 1 kg is 30 um, at 3000 rpm 9.42 mm/s: above G 6.3, within G 16."""
    (row,) = summarize(stand(wheel("w", "[1, 0, 0]", 'unbalance = { static = "30 g mm" }'))).unbalance
    assert row.eccentric_velocity == pytest.approx(3e-5 * 100 * math.pi)
    assert row.grade == "G 16"
    assert [grade(1e-3 * each) for each in GRADES] == [f"G {each:g}" for each in GRADES]
    assert [grade(each) for each in (0.0, 2e-3, 6.3001e-3, 4.001)] == ["-", "G 2.5", "G 16", "above G 4000"]


@pytest.mark.parametrize(
    ("given", "static_at", "dynamic_at"),
    [
        ('static = "3 g mm", static_at = "70 deg"', 70.0, None),
        ('static = "3 g mm", dynamic = "9 g mm^2", dynamic_at = "-20 deg"', 0.0, -20.0),
        ('dynamic = "9 g mm^2", dynamic_at = "135 deg"', None, 135.0),
        ('dynamic = "9 g mm^2", dynamic_at = "180 deg"', None, 180.0),
    ],
)
def test_angles_of_unbalance_are_those_of_the_file(
    given: str, static_at: float | None, dynamic_at: float | None
) -> None:
    (row,) = summarize(stand(wheel("w", "[1, 0, 0]", f"unbalance = {{ {given} }}"))).unbalance
    for found, expected in ((row.static_at, static_at), (row.dynamic_at, dynamic_at)):
        assert (found is None) == (expected is None)
        assert found is None or expected is None or math.degrees(found) == pytest.approx(expected)


PHASES = 2.0 * np.pi * np.arange(8) / 8.0


def at_phase(state: State, phase: float) -> State:
    return replace(state, phi=tuple(phi + phase for phi in state.phi))


def matrices(stand: Stand, state: State) -> tuple[np.ndarray, np.ndarray]:
    found = reference.pieces(stand, state)
    return found.K, found.I


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_k_and_i_are_their_means_over_the_phases(seed: int) -> None:
    rng = np.random.default_rng(seed)
    stand = random_stand(rng, 3)
    state = random_state(stand, rng, phase_limit=10.0)
    each = [matrices(stand, at_phase(state, phase)) for phase in PHASES]
    for k, mean in enumerate(matrices(mean_stand(stand), state)):
        expected = np.mean([pair[k] for pair in each], axis=0)
        assert mean == pytest.approx(expected, rel=1e-12, abs=1e-12 * np.abs(expected).max())
