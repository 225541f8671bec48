"""Thrust and torque of propellers: in every derivation and in the C, against published formulas; what is refused."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from laws.vessel import CARRIER, POD, PROPELLER
from mahovik.core.emit.generate import generate_all
from mahovik.core.stand import Stand, dumps, identities, loads
from mahovik.core.stand.random import BARE, Features, random_stand, random_state
from mahovik.errors import StandError
from mahovik.laws.propeller.data import Propeller, Propellers
from mahovik.laws.propeller.plan import twist_law
from mahovik.laws.propeller.reference import thrust_and_torque
from mahovik.out.api.stands import Stand as ApiStand
from mahovik.out.campaign.places import Places
from mahovik.proof import reference
from mahovik.proof.verify.c_backend import CBackend
from second.agreement import AGREEMENT, differences, expectations, worst_difference

FILE = (
    CARRIER
    + POD
    + PROPELLER
    + """
speed = "1500 rpm"
wake = 0.056
deduction = 0.1
whole = true
left = true
[[propeller]]
name = "bow"
mount = "pod"
axis = [0, 2, 0]
density = "1026 kg/m^3"
diameter = 0.1
thrust = [0.4, -0.3, -0.1]
"""
)

MAIN = Propeller(
    "main", (-0.8, 0.1, 0.05), (2.0, 0.1, 0.2), 1026.0, 0.14, (0.46, -0.42, -0.1), (0.07, -0.06, 0.01), 150.0,
    0.06, 0.1, whole=False, left=False,
)  # fmt: skip
WHOLE = replace(MAIN, name="whole", position=(0.1, 0.3, 0.0), speed=-90.0, whole=True, left=True)
STILL = replace(MAIN, name="still", axis=(0.0, 1.0, 0.0), speed=0.0)

propellers = st.sampled_from([MAIN, WHOLE, STILL, replace(MAIN, speed=-20.0), replace(STILL, whole=True)])
twists = st.lists(st.floats(-3, 3, allow_subnormal=False), min_size=6, max_size=6).map(np.array)


def driven(seed: int) -> Stand:
    """A random stand whose carrier and instrument have propellers."""
    stand = random_stand(np.random.default_rng(seed), 1, Features(instruments=1))
    return replace(
        stand,
        carrier=stand.carrier.with_laws(Propellers((MAIN, WHOLE))),
        instruments=tuple(p.with_laws(Propellers((STILL,))) for p in stand.instruments),
    )


def test_derivations_and_C_agree() -> None:
    from mahovik.proof.second import Second

    stand = driven(1)
    backend, second = CBackend(stand), Second(stand)
    for number in range(3):
        state = random_state(stand, np.random.default_rng(number))
        for at in (state, replace(state, V=(0.0,) * 6, phi_dot=(0.0,))):
            assert worst_difference(stand, at, second.evaluate, backend.evaluate) <= AGREEMENT


@pytest.mark.parametrize(
    "wrong",
    [
        {"speed": 165.0}, {"thrust": (0.46, -0.46, -0.1)}, {"thrust": (0.46, -0.42, -0.2)}, {"left": True},
        {"torque": (0.07, -0.09, 0.01)}, {"wake": 0.1}, {"deduction": 0.2}, {"whole": True}, {"position": (-0.7, 0, 0)},
    ],
)  # fmt: skip
def test_an_error_of_one_number_is_seen(wrong: dict[str, Any]) -> None:
    stand = driven(2)
    state = random_state(stand, np.random.default_rng(2))
    changed = replace(stand, carrier=stand.carrier.with_laws(Propellers((replace(MAIN, **wrong), WHOLE))))
    found = differences(lambda s, w: reference.evaluate(changed, s, w), state, expectations(stand, state))
    assert max(found.values()) > 1e-6


def test_rigorous_balls_hold_the_wrench() -> None:
    from rigorous.balls import forward_is_enclosed

    stand = driven(3)
    state = random_state(stand, np.random.default_rng(3))
    forward_is_enclosed(stand, state)


@given(st.floats(0.1, 3), st.floats(-1, 1), st.floats(1, 1500))
def test_propellers_as_published(u: float, v: float, rpm: float) -> None:
    """REMUS 100 of the Marine Systems Simulator, K_T and K_Q linear in J = 0.944 U/(n D); NPS AUV II, by n/u."""
    rho, D, n, U = 1026.0, 0.14, rpm / 60, np.sqrt(u * u + v * v)
    J = 0.944 * U / (n * D)
    slopes = [(0.1798 - 0.4566) / 0.6632, (0.0312 - 0.07) / 0.6632]
    X = 0.9 * rho * n**2 * D**4 * (0.4566 + slopes[0] * J)
    K = rho * n**2 * D**5 * (0.07 + slopes[1] * J) / 10
    remus = Propeller(
        "p", (0, 0, 0), (1, 0, 0), rho, D, (0.4566, slopes[0], 0), (0.007, slopes[1] / 10, 0), 2 * np.pi * n,
        0.056, 0.1, whole=True, left=True,
    )  # fmt: skip
    V = np.array([u, v, 0, 0.1, 0, 0])
    size = 0.9 * rho * n**2 * D**4
    np.testing.assert_allclose(thrust_and_torque(remus, V), [X, 0, 0, K, 0, 0], rtol=1e-12, atol=1e-13 * size)

    L, water, Cd0, omega = 5.3, 1025.0, 0.00385, 2 * np.pi * n
    eta = 0.012 * omega / u
    X = water / 2 * L**2 * u**2 * Cd0 * (abs(eta) * eta - 1)
    scaled = Cd0 * L**2 / 2
    auv = Propeller(
        "p", (0, 0, 0), (1, 0, 0), water, 1.0, (scaled * (0.012 * 2 * np.pi) ** 2, 0, -scaled), (0, 0, 0), omega, 0, 0,
        whole=False, left=False,
    )  # fmt: skip
    bound = 1e-13 * water * scaled * (u**2 + (0.012 * omega) ** 2)
    np.testing.assert_allclose(thrust_and_torque(auv, V), [X, 0, 0, 0, 0, 0], rtol=1e-12, atol=bound)


@given(propellers, twists)
def test_turning_and_moving_the_other_way_is_the_opposite(p: Propeller, V: np.ndarray) -> None:
    if not p.whole:
        np.testing.assert_array_equal(thrust_and_torque(replace(p, speed=-p.speed), -V), -thrust_and_torque(p, V))
    mirrored = thrust_and_torque(replace(p, left=not p.left), V)
    np.testing.assert_allclose(mirrored[:3], thrust_and_torque(p, V)[:3])


@given(propellers, twists)
def test_planning_has_the_wrench_and_its_slopes(p: Propeller, V: np.ndarray) -> None:
    planned = twist_law(replace(loads(FILE).carrier, laws=(Propellers((p, MAIN)),)))
    assert planned is not None
    P = thrust_and_torque(p, V) + thrust_and_torque(MAIN, V)
    np.testing.assert_allclose(planned.wrench(V[None])[0], P, rtol=1e-9, atol=1e-9)
    if p.whole and np.linalg.norm(V[:3] + np.cross(V[3:], p.position)) < 0.01:
        return  # a length has no slope at zero
    step = 1e-6 * np.eye(6)
    slopes = (planned.wrench(V + step) - planned.wrench(V - step)) / 2e-6
    np.testing.assert_allclose(planned.rate(V[None])[0], slopes.T, rtol=1e-4, atol=1e-3)


def test_file_comes_back_and_other_stands_are_as_before() -> None:
    stand = loads(FILE)
    assert loads(dumps(stand)) == stand
    law = stand.carrier.law(Propellers)
    assert law is not None
    assert law.propellers[0].speed == pytest.approx(50 * np.pi)
    assert law.propellers[0].thrust == (0.4566, -0.4174, 0.0)
    faster = Propellers((replace(law.propellers[0], speed=1.0),))
    changed = replace(stand, carrier=stand.carrier.with_laws(faster))
    assert identities(changed).structure == identities(stand).structure
    assert identities(changed).physics != identities(stand).physics
    assert "may be set at run time" in generate_all(stand).files["vessel.h"]
    bare = random_stand(np.random.default_rng(1), 2, BARE)
    assert "propeller" not in generate_all(bare).files[f"{bare.name}.h"]


def test_campaigns_vary_its_numbers() -> None:
    places = Places(ApiStand.of(loads(FILE)))
    (place,) = places.find("main.diameter")
    assert place.nominal == 0.14
    assert [each.path for each in places.find("bow.thrust")] == [f"bow.thrust[{k}]" for k in range(3)]


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("[0.4566, -0.4174]", "[0.4566]", "expected [k0, k1] or [k0, k1, k2]"),
        ('"14 cm"', '"0 cm"', "is not above 0"),
        ("wake = 0.056", "wake = 1.5", "is above 1"),
        ('"1500 rpm"', '"1500 mm"', "an angular speed"),
        ('mount = "pod"', 'mount = "pad"', 'unknown "pad", did you mean "pod"?'),
        ('name = "bow"', 'name = "main"', "taken by a propeller"),
        ("deduction", "deductoin", 'unknown key "deductoin"'),
        ("axis = [0, 2, 0]", "axis = [0, 0, 0]", "has no direction"),
    ],
)
def test_refusals(old: str, new: str, words: str) -> None:
    """Each names the propeller and what was found."""
    with pytest.raises(StandError) as caught:
        loads(FILE.replace(old, new))
    assert words in str(caught.value)
    assert "propeller " in str(caught.value)
