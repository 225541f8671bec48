"""Control derivatives: in every derivation and in the C, against the products written out; what is refused."""

from __future__ import annotations

import copy
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from laws.vessel import CARRIER, POD, PROPELLER
from mahovik.core.emit.generate import generate_all
from mahovik.core.lower.fmu.parameters import laws
from mahovik.core.stand import Stand, dumps, identities, loads
from mahovik.core.stand.random import BARE, Features, random_stand, random_state
from mahovik.errors import StandError
from mahovik.laws.control.data import Control, ControlDerivative, ControlDerivatives, Factor, Velocity
from mahovik.laws.control.plan import twist_law
from mahovik.laws.control.reference import control_derivatives, wrenches
from mahovik.proof import reference
from mahovik.proof.verify.c_backend import CBackend
from second.agreement import AGREEMENT, differences, expectations, worst_difference

FIN = """
[[fin]]
name = "rudder"
density = 1025
area = 0.01
lift_slope = 2.0
incidence = false
deflection = 0.2
"""
DERIVATIVES = """
[carrier.control_derivatives]
race = 2e-4
terms = [
    { wrench = "X", of = ["u", "r", "rudder.deflection"], value = -3.1 },
    { wrench = "Y", of = ["u", "|v|", "|rudder.deflection|", "main.race"], value = "2.5 N s^3/m^3" },
    { wrench = "N", of = ["|main.speed|", "main.speed"], value = 1e-4 },
    { wrench = "Z", of = ["w", "w", "w"], value = -4.2 },
    { wrench = "K", of = ["p", "|main.race|"], value = -0.3 },
]
"""
BODY = CARRIER + DERIVATIVES + POD + FIN
FILE = BODY + PROPELLER + "speed = 90.0\n"


def steered(seed: int, speed: float = 90.0) -> Stand:
    """A random stand whose carrier is the file's, with another speed of the propeller."""
    stand = random_stand(np.random.default_rng(seed), 2, Features(instruments=1, stream=True))
    own = loads(FILE.replace("90.0", str(speed))).carrier
    return replace(stand, carrier=stand.carrier.with_laws(*own.laws))


@cache
def compiled() -> CBackend:
    """C of one of them."""
    return CBackend(steered(1))


@pytest.mark.slow
@pytest.mark.parametrize("speed", [90.0, -70.0, 0.0])
def test_derivations_and_C_agree(speed: float) -> None:
    from mahovik.proof.second import Second

    stand = steered(1, speed)
    backend, second = compiled() if speed == 90.0 else CBackend(stand), Second(stand)
    for number in range(3):
        state = random_state(stand, np.random.default_rng(number))
        for at in (state, replace(state, V=(0.0,) * 6)):
            assert worst_difference(stand, at, second.evaluate, backend.evaluate) <= AGREEMENT


def test_rigorous_balls_hold_the_wrench() -> None:
    from rigorous.balls import forward_is_enclosed

    for speed in (90.0, -70.0, 0.0):
        stand = steered(3, speed)
        state = random_state(stand, np.random.default_rng(3))
        forward_is_enclosed(stand, state)


@pytest.mark.slow
def test_random_stands_have_them_on_several_bodies() -> None:
    """Inputs of the carrier and of an instrument: each product takes those of its own body."""
    from mahovik.proof.second import Second

    stand = random_stand(np.random.default_rng(8), 1, Features(instruments=2, flow=True))
    bearing = [law for body in stand.bodies if (law := body.law(ControlDerivatives)) is not None]
    assert len(bearing) == 3
    assert len({f for law in bearing for term in law.terms for f in term.of if isinstance(f, Control)}) > 4
    assert dumps(loads(dumps(stand))) == dumps(stand)
    backend, second = CBackend(stand), Second(stand)
    state = random_state(stand, np.random.default_rng(8))
    assert worst_difference(stand, state, second.evaluate, backend.evaluate) <= AGREEMENT


@given(st.lists(st.floats(-3, 3, allow_subnormal=False), min_size=6, max_size=6).map(np.array))
def test_products_are_those_of_the_file(V: np.ndarray) -> None:
    """Written out by hand; the race by the water that is faster behind than ahead."""
    carrier = loads(FILE).carrier
    found = wrenches(carrier, np.zeros(3), V)["control derivatives"]
    u, v, w, p, _, r = V
    race = np.sqrt(u * u + 2e-4 * 90.0**2) - abs(u)
    expected = [-3.1 * u * r * 0.2, 2.5 * u * abs(v) * 0.2 * race, -4.2 * w**3, -0.3 * p * race, 0, 1e-4 * 90.0**2]
    np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-12)


speeds = st.sampled_from([90.0, -70.0, 0.0])


@given(st.lists(st.floats(-3, 3, allow_subnormal=False), min_size=6, max_size=6).map(np.array), speeds)
def test_planning_has_the_wrench_and_its_slopes(V: np.ndarray, speed: float) -> None:
    carrier = loads(FILE.replace("90.0", str(speed))).carrier
    law = carrier.law(ControlDerivatives)
    planned = twist_law(carrier)
    assert law is not None and planned is not None
    np.testing.assert_allclose(planned.wrench(V[None])[0], control_derivatives(carrier, law, V), rtol=1e-9, atol=1e-9)
    if np.min(np.abs(V[:2])) < 1e-4:
        return  # a magnitude has no slope at zero
    step = 1e-6 * np.eye(6)
    slopes = (planned.wrench(V + step) - planned.wrench(V - step)) / 2e-6
    np.testing.assert_allclose(planned.rate(V[None])[0], slopes.T, rtol=1e-4, atol=1e-3)


@pytest.mark.parametrize("k", range(5))
def test_an_error_of_one_value_is_seen(k: int) -> None:
    stand = steered(2)
    law = stand.carrier.law(ControlDerivatives)
    assert law is not None
    terms = tuple(replace(term, value=1.1 * term.value) if i == k else term for i, term in enumerate(law.terms))
    changed = replace(stand, carrier=stand.carrier.with_laws(replace(law, terms=terms)))
    state = random_state(stand, np.random.default_rng(2))
    found = differences(lambda s, w: reference.evaluate(changed, s, w), state, expectations(stand, state))
    assert max(found.values()) > 1e-9


def test_inputs_are_those_of_the_table() -> None:
    """The C takes the deflection and the speed that the caller sets at run time."""
    stand, other = steered(1), steered(1, -30.0)
    backend = compiled()
    state = random_state(stand, np.random.default_rng(4))
    table = copy.deepcopy(backend.table())
    table["propeller"][0]["speed"] = -30.0
    _, found = backend.call("wrench", backend.arguments(state) | {"table": table})
    expected = reference.evaluate(other, state, ["matrices"])["F"]
    np.testing.assert_allclose(found["F"], expected, rtol=1e-10, atol=1e-10)


def test_file_comes_back_and_other_stands_are_as_before() -> None:
    stand = loads(FILE)
    assert loads(dumps(stand)) == stand
    law = stand.carrier.law(ControlDerivatives)
    assert law is not None and law.drives and law.has_kinks
    assert not ControlDerivatives(law.terms[:1], 0.0).drives
    assert law.terms[1].of == (
        Velocity(0, False), Velocity(1, True), Control("rudder", "deflection", True), Control("main", "race", False)
    )  # fmt: skip
    assert law.terms[1].value == 2.5
    stronger = replace(law, terms=(replace(law.terms[0], value=2.0), *law.terms[1:]))
    changed = replace(stand, carrier=stand.carrier.with_laws(stronger))
    assert identities(changed).structure == identities(stand).structure
    assert identities(changed).physics != identities(stand).physics
    bare = random_stand(np.random.default_rng(1), 2, BARE)
    assert "control" not in generate_all(bare).files[f"{bare.name}.h"].split()


def test_simulators_see_them_with_units() -> None:
    stand = steered(5)
    generated = generate_all(stand)
    found = {m.name: m for m in laws(stand, generated.layout, generated.values)}
    assert found["control_derivative[1]"].unit.name == "N.s2/(m.rad2)"
    assert "X += value u r rudder.deflection" in found["control_derivative[1]"].description
    assert found["carrier.control_derivatives.race"].value == 2e-4


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('"rudder.deflection"]', '"rudde.deflection"]', 'no "rudde.deflection" on this body, which has rudder.defl'),
        ('"rudder.deflection"]', '"rudder.angle"]', 'PROPELLER.race, with or without bars, found "rudder.angle"'),
        ('"rudder.deflection"]', '"rudder.speed"]', 'no "rudder.speed" on this body'),
        ('["u", "r", "rudder.deflection"]', "[]", "expected one to four factors"),
        ('["w", "w", "w"]', '["w", "w", "w", "w", "w"]', "expected one to four factors"),
        ('"2.5 N s^3/m^3"', '"2.5 N s^2/m^2"', "does not fit, expected"),
        ("race = 2e-4", "", "race: required where a term has PROPELLER.race"),
        ("race = 2e-4", "race = -1", "race: "),
        ('wrench = "X"', 'wrench = "x"', "expected one of X Y Z K M N"),
        ('name = "main"', 'name = "main"\nmount = "pod"', "on this body, which has rudder.deflection"),
    ],
)
def test_refusals(old: str, new: str, words: str) -> None:
    """Each names the derivative and what was found."""
    assert old in FILE
    with pytest.raises(StandError) as caught:
        loads(FILE.replace(old, new))
    assert words in str(caught.value)
    assert "control_derivatives" in str(caught.value)


def test_a_race_that_no_term_has_is_refused() -> None:
    text = FILE.replace("main.race", "main.speed").replace('"2.5 N s^3/m^3"', "2.5")
    with pytest.raises(StandError, match=r"no term has PROPELLER\.race"):
        loads(text)


def test_a_body_without_inputs_says_so() -> None:
    one = ControlDerivative(0, (Control("screw", "speed", False),), 1.0)
    factors: tuple[Factor, ...] = (Velocity(0, False),)
    stand = loads(CARRIER)
    assert replace(one, of=factors).of == factors
    text = CARRIER + 'control_derivatives = { terms = [{ wrench = "X", of = ["screw.speed"], value = 1 }] }\n'
    with pytest.raises(StandError, match="which has no fin and no propeller"):
        loads(text)
    assert not stand.carrier.inputs
