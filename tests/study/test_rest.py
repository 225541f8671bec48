"""Static equilibrium: V_dot is zero there, by the reference and by the C; free directions; and where there is none."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mahovik import stands
from mahovik.core.stand import load
from mahovik.core.stand.model import Stand
from mahovik.core.stand.random import Features, random_stand
from mahovik.core.stand.state import State
from mahovik.errors import CheckError
from mahovik.laws.leg.data import Leg, Legs
from mahovik.laws.suspension.data import Suspension
from mahovik.proof import reference
from mahovik.use.study.rest import rest
from physics.general import rows, suspension_of

LIMIT = 1e-12  # the contract of `mahovik rest`, absolute


def acceleration(stand: Stand, state: State) -> np.ndarray:
    return np.asarray(np.abs(reference.evaluate(stand, state, ["forward"])["V_dot"]))


@pytest.mark.parametrize("name", ["bench8", "shaker2", "auv6", "demo3", "sat4"])
@pytest.mark.parametrize("phase", [0.0, 1.0])
def test_examples_rest(name: str, phase: float) -> None:
    stand = load(stands.path(name))
    found = rest(stand, [phase + s for s in range(len(stand.flywheels))])
    assert found.state.phi == tuple(phase + s for s in range(len(stand.flywheels)))
    assert acceleration(stand, found.state).max() <= LIMIT
    assert max(map(abs, found.V_dot)) <= LIMIT
    assert len(found.free) == {"bench8": 0, "shaker2": 0, "auv6": 4, "demo3": 6, "sat4": 6}[name]
    assert not found.unstable


def test_free_directions_stay_at_zero() -> None:
    """auv6 floats: no shift, and free to shift and to turn about the vertical."""
    stand = load(stands.path("auv6"))
    found = rest(stand)
    assert np.abs(found.state.position).max() < 1e-12  # metres; steps are rounded against a turn of 0.15 rad
    np.testing.assert_allclose(np.array(found.free)[:3], np.eye(6)[:3], atol=1e-5)
    vertical = reference.pieces(stand, found.state).C.T @ [0.0, 0.0, 1.0]
    about = np.array(found.free[3][3:])
    np.testing.assert_allclose(np.cross(about, vertical) / np.linalg.norm(about), 0.0, atol=1e-6)


@pytest.mark.parametrize("seed", range(4))
def test_random_suspended_stands_rest(seed: int) -> None:
    """Suspension, legs, weight, buoyancy at general places."""
    features = Features(gravity=True, stream=False, fluid=True, laws={"suspension": 1, "leg": 2})
    stand = random_stand(np.random.default_rng(seed), 3, features)
    found = rest(stand, [0.3, 1.0, -2.0])
    assert (acceleration(stand, found.state) <= 1e-10).all()  # forces of 1e3 N on inertias of 0.1 kg m2: rounding


def test_three_legs_hang_a_pendulum() -> None:
    """A body on one leg hangs below its ground point, stretched by its weight, from a start far off."""
    stand = load(stands.path("shaker2"))
    leg = Leg((0.3, 0.0, 1.0), (0.0, 0.0, 0.0), 0.8, 1000.0, 1.0)
    found = rest(replace(stand, laws=(Legs((leg,)),)), [0.0, 0.0])
    x, y, z = found.state.position
    weight = sum(body.mass for body in stand.bodies) * 9.81
    assert (x, y) == pytest.approx((0.3, 0.0), abs=1e-9)
    assert z == pytest.approx(1.0 - 0.8 - weight / 1000.0, rel=1e-9)
    assert not found.unstable


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
    found = rest(replace(stand, carrier=carrier).with_laws(soft))
    assert not found.unstable
    assert found.state.quaternion is not None
    assert abs(found.state.quaternion[0]) < 0.95
