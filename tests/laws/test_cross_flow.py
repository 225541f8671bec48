"""Cross-flow drag by strips: in every derivation and in the C, alone and together; what is refused."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

import mahovik
from mahovik.core.emit.generate import generate_all
from mahovik.core.stand import Stand, dumps, identities, loads, rest_state
from mahovik.core.stand.random import BARE, Features, random_stand, random_state
from mahovik.errors import StandError
from mahovik.laws.cross_flow.data import CrossFlow
from mahovik.laws.cross_flow.plan import twist_law
from mahovik.laws.cross_flow.reference import cross_flow_drag
from mahovik.proof import reference
from mahovik.proof.verify.c_backend import CBackend
from second.agreement import AGREEMENT, differences, expectations, worst_difference

LAW = CrossFlow(
    1025.0, (-0.8, -0.2, 0.3, 0.9), (0.1, 0.3, 0.25, 0.05), (0.12, 0.28, 0.22, 0.06), (1.1, 1.2, 1.0, 0.9),
    (0.8, 0.9, 0.7, 0.6), 2, together=False,
)  # fmt: skip

FILE = """
schema = 1
name = "slender"
[carrier]
mass = 30.0
inertia = [0.2, 3.0, 3.0]
[carrier.cross_flow]
density = "1025 kg/m^3"
x = ["-70 cm", 0, 0.7]
height = { value = [0, 19, 0], unit = "cm" }
breadth = [0, 0.19, 0]
drag_y = 1.1
drag_z = [1.0, 1.1, 1.0]
"""

CARRIER = loads(FILE).carrier

twists = st.lists(st.floats(-3, 3, allow_subnormal=False), min_size=6, max_size=6).map(np.array)


def slender(seed: int, together: bool) -> Stand:
    """A random stand whose carrier and flywheels have strips, the ones apart where the others are together."""
    stand = random_stand(np.random.default_rng(seed), 2, Features(instruments=1))
    of_carrier, of_flywheels = replace(LAW, together=together), replace(LAW, together=not together)
    return replace(
        stand,
        carrier=stand.carrier.with_laws(of_carrier),
        flywheels=tuple(flywheel.with_laws(of_flywheels) for flywheel in stand.flywheels),
    )


@pytest.mark.parametrize("together", [False, True])
def test_drag_is_the_integral_along_the_axis(together: bool) -> None:
    """Sway, heave, pitch and yaw without a change of sign inside: two points between stations are exact apart."""
    V = np.array([1.0, 0.9, -1.3, 0.4, 0.3, 0.2])

    def force(x: float, which: int) -> float:
        h, b, C_y, C_z = (np.interp(x, LAW.x, table) for table in (LAW.height, LAW.breadth, LAW.drag_y, LAW.drag_z))
        v, w = V[1] + x * V[5], V[2] - x * V[4]
        if together:
            drag = (C_y * h * v**2 + C_z * b * w**2) / np.sqrt(v**2 + w**2)
            return float(drag * (v, w)[which])
        return float((C_y * h * v * abs(v), C_z * b * w * abs(w))[which])

    def integral(which: int, power: int) -> float:
        parts = zip(LAW.x[:-1], LAW.x[1:], strict=True)
        return float(sum(quad(lambda x: x**power * force(x, which), a, b, epsabs=0, epsrel=1e-12)[0] for a, b in parts))

    expected = -512.5 * np.array([0, integral(0, 0), integral(1, 0), 0, -integral(1, 1), integral(0, 1)])
    found = cross_flow_drag(replace(LAW, points=16, together=together), V)
    np.testing.assert_allclose(found, expected, rtol=1e-10, atol=1e-10)
    coarse = cross_flow_drag(replace(LAW, points=3, together=together), V)
    np.testing.assert_allclose(coarse, expected, rtol=1e-3 if together else 1e-10, atol=1e-10)


@pytest.mark.parametrize("together", [pytest.param(False, marks=pytest.mark.slow), True])
def test_derivations_and_C_agree(together: bool) -> None:
    from mahovik.proof.second import Second

    stand = slender(1, together)
    backend, second = CBackend(stand), Second(stand)
    for number in range(3):
        state = random_state(stand, np.random.default_rng(number))
        assert worst_difference(stand, state, second.evaluate, backend.evaluate) <= AGREEMENT
        still = replace(state, V=(0.0,) * 6, phi_dot=(0.0,) * 2)
        if stand.stream is None:
            assert worst_difference(stand, still, backend.evaluate) <= AGREEMENT


def test_a_strip_more_would_be_seen() -> None:
    stand = slender(2, False)
    state = random_state(stand, np.random.default_rng(2))
    changed = replace(stand, carrier=stand.carrier.with_laws(replace(LAW, density=2050.0)))
    found = differences(lambda s, w: reference.evaluate(changed, s, w), state, expectations(stand, state))
    assert max(found.values()) > 1e-6


@pytest.mark.parametrize("together", [False, True])
def test_rigorous_balls_hold_the_drag(together: bool) -> None:
    from rigorous.balls import forward_is_enclosed

    stand = slender(3, together)
    for V in (random_state(stand, np.random.default_rng(3)).V, (0.0,) * 6):
        state = replace(random_state(stand, np.random.default_rng(3)), V=V)
        forward_is_enclosed(stand, state)


@given(twists, st.booleans())
def test_drag_takes_power_and_planning_has_its_slopes(V: np.ndarray, together: bool) -> None:
    law = replace(LAW, together=together)
    P = cross_flow_drag(law, V)
    power = float(P @ V)
    assert power <= 1e-12 * float(np.abs(P) @ np.abs(V))
    planned = twist_law(replace(CARRIER, laws=(law,)))
    assert planned is not None
    np.testing.assert_allclose(planned.wrench(V[None])[0], P, rtol=1e-9, atol=1e-9)
    step = 1e-6 * np.eye(6)
    differences = (planned.wrench(V + step) - planned.wrench(V - step)) / 2e-6
    np.testing.assert_allclose(planned.rate(V[None])[0], differences.T, rtol=0, atol=0.02)


@pytest.mark.slow
def test_many_states_at_once_have_the_bits_of_one() -> None:
    model = mahovik.build(slender(4, True))
    rng = np.random.default_rng(4)
    x = model.states_of(
        np.array([model.state(V=rng.normal(size=6), phi_dot=rng.normal(size=2)).array for _ in range(9)])
    )
    many = model.forward(x, phi_ddot=np.zeros((9, 2)))["V_dot"]
    for row, found in zip(x.array, many, strict=True):
        alone = model.forward(model.states_of(row[None]), phi_ddot=np.zeros((1, 2)))["V_dot"]
        assert np.array_equal(found, alone[0])


def test_file_comes_back_and_other_stands_are_as_before() -> None:
    stand = loads(FILE)
    assert loads(dumps(stand)) == stand
    law = stand.carrier.law(CrossFlow)
    assert law is not None
    assert (law.height, law.drag_y, law.points) == ((0.0, 0.19, 0.0), (1.1, 1.1, 1.1), 2)
    stronger = replace(stand, carrier=stand.carrier.with_laws(replace(law, drag_y=(2.0, 2.0, 2.0))))
    assert identities(stronger).structure == identities(stand).structure
    assert identities(stronger).physics != identities(stand).physics
    finer = replace(stand, carrier=stand.carrier.with_laws(replace(law, points=3)))
    assert identities(finer).structure != identities(stand).structure
    bare = random_stand(np.random.default_rng(1), 2, BARE)
    assert "strip" not in generate_all(bare).files[f"{bare.name}.h"]
    at_rest = reference.pieces(stand, rest_state(stand)).F
    assert not np.any(at_rest)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("0, 0.7]", "0.7, 0.7]", "expected stations that rise"),
        ("[0, 19, 0]", "[0, 19]", "expected 3 numbers, one for each station of `x`, found 2"),
        ("[0, 0.19, 0]", "[0, -0.19, 0]", "is negative"),
        ("drag_y = 1.1", "drag_y = -1.1", "is negative"),
        ("drag_y = 1.1", "drag_y = 1.1\npoints = 0", "expected 1 to 16 points between two stations, found 0"),
        ("drag_y = 1.1", "drag_y = 1.1\ntogether = 1", "expected true or false"),
        ("1025 kg/m^3", "1025 kg", "density"),
        ("density", "densty", 'unknown key "densty"'),
    ],
)
def test_refusals(old: str, new: str, words: str) -> None:
    """Each names the place and what was found."""
    with pytest.raises(StandError) as caught:
        loads(FILE.replace(old, new))
    assert words in str(caught.value)
    assert "cross_flow" in str(caught.value)
