"""Published derivatives that contain the products of added mass: in every derivation, in the C, refused, warned of."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from audits.audit import momentum_products, without_added_products
from laws.vessel import CARRIER
from mahovik.core.stand import Stand, dumps, identities, loads
from mahovik.core.stand.model import TWIST_LETTERS, WRENCH_LETTERS
from mahovik.core.stand.random import Features, random_stand, random_state
from mahovik.core.stand.summary import summarize
from mahovik.errors import StandError
from mahovik.laws.damping.data import Damping, DampingTerm, Factor
from mahovik.laws.damping.plan import twist_law
from mahovik.laws.damping.reference import products_in_derivatives
from mahovik.laws.damping.text import products_of_added_mass
from mahovik.proof import reference
from mahovik.proof.diagnose.diagnosis import Diagnoser
from mahovik.proof.verify.backends import NumpyBackend
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.states import Request
from second.agreement import AGREEMENT, worst_difference
from toolchain.quick import quick

KEY = 'derivatives = "with added-mass products"'

FILE = f"""
schema = 1
name = "slender"
[carrier]
mass = 30.0
inertia = [0.2, 3.0, 3.0]
added_mass = [1, 30, 31, 0.1, 4, 5]
[carrier.damping]
terms = [{{ wrench = "X", of = ["w", "q"], value = -31.2 }}, {{ wrench = "N", of = ["u", "v"], value = -29.0 }}]
{KEY}
"""

twists = st.lists(st.floats(-3, 3, allow_subnormal=False), min_size=6, max_size=6).map(np.array)


def published(seed: int, stream: bool = True) -> Stand:
    """A random stand in a fluid whose carrier has derivatives that contain the products of its added mass."""
    stand = random_stand(np.random.default_rng(seed), 2, Features(instruments=1, fluid=True, stream=stream))
    damping = stand.carrier.law(Damping) or Damping(None, None, ())
    return replace(stand, carrier=stand.carrier.with_laws(replace(damping, contains_products=True)))


def by_terms(stand: Stand) -> Stand:
    """The stand with rows of `terms` in place of the key: the products of added mass with the other sign."""
    damping = stand.carrier.law(Damping)
    assert damping is not None
    rows = without_added_products(np.array(stand.carrier.added_mass))
    added = tuple(_term(row) for row in rows)
    law = replace(damping, terms=(*damping.terms, *added), contains_products=False)
    return replace(stand, carrier=stand.carrier.with_laws(law))


def _term(row: Mapping[str, Any]) -> DampingTerm:
    first, second = (Factor(TWIST_LETTERS.index(letter), absolute=False) for letter in row["of"])
    return DampingTerm(WRENCH_LETTERS.index(row["wrench"]), (first, second), row["value"])


@pytest.mark.parametrize("seed", [1, 2])
def test_key_is_the_terms_that_take_the_products_out(seed: int) -> None:
    stand = published(seed)
    state = random_state(stand, np.random.default_rng(seed))
    wants = ["forward", "momentum"]
    found, expected = reference.evaluate(stand, state, wants), reference.evaluate(by_terms(stand), state, wants)
    np.testing.assert_allclose(found["V_dot"], expected["V_dot"], rtol=1e-11)
    damping = stand.carrier.law(Damping)
    assert damping is not None
    twice = replace(stand, carrier=stand.carrier.with_laws(replace(damping, contains_products=False)))
    other = np.array(reference.evaluate(twice, state, ["forward"])["V_dot"])
    assert np.abs(other - found["V_dot"]).max() > 1e-3 * np.abs(other).max()


@pytest.mark.parametrize("stream", quick(1, [True, False]))
def test_derivations_and_C_agree(stream: bool) -> None:
    from mahovik.proof.second import Second

    stand = published(3, stream)
    backend, second = CBackend(stand), Second(stand)
    for number in range(3):
        state = random_state(stand, np.random.default_rng(number))
        assert worst_difference(stand, state, second.evaluate, backend.evaluate) <= AGREEMENT


def test_rigorous_balls_hold_the_products() -> None:
    from rigorous.balls import forward_is_enclosed

    stand = published(4)
    state = random_state(stand, np.random.default_rng(4))
    forward_is_enclosed(stand, state)


@given(twists)
def test_products_have_no_power_and_are_those_of_the_handbook(V: np.ndarray) -> None:
    """Fossen's C(V) V, and planning with its slopes."""
    carrier = published(5).carrier
    P, Lambda = products_in_derivatives(carrier, V), np.array(carrier.added_mass)
    size = float(np.abs(Lambda).max() * (V @ V)) + 1e-9
    np.testing.assert_allclose(P, momentum_products(Lambda, V), rtol=0, atol=1e-13 * size)
    assert abs(float(P @ V)) <= 1e-13 * size * float(np.abs(V).max() + 1)
    warned = -np.einsum("ijk,j,k->i", products_of_added_mass(Lambda), V, V)
    np.testing.assert_allclose(P, warned, rtol=0, atol=1e-13 * size)
    law = twist_law(replace(carrier, laws=(Damping(None, None, (), contains_products=True),)))
    assert law is not None
    np.testing.assert_allclose(law.wrench(V[None])[0], P, rtol=0, atol=1e-13 * size)
    step = np.eye(6)
    slopes = (law.wrench(V + step) - law.wrench(V - step)) / 2  # exact: it is quadratic
    np.testing.assert_allclose(
        law.rate(V[None])[0], slopes.T, rtol=0, atol=1e-12 * (size + float(np.abs(Lambda).sum()))
    )


def test_file_comes_back_and_the_key_counts() -> None:
    stand, without = loads(FILE), loads(FILE.replace(KEY, 'derivatives = "without added-mass products"'))
    assert loads(dumps(stand)) == stand
    assert without == loads(FILE.replace(KEY, ""))
    assert "derivatives" not in dumps(without)
    assert identities(stand).structure != identities(without).structure


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        (KEY, 'derivatives = "with products"', 'expected "with added-mass products" or "without added-mass products"'),
        (KEY, "derivatives = true", "expected a string"),
        ("added_mass = [1, 30, 31, 0.1, 4, 5]", "", "the carrier has no added mass, expected `added_mass`"),
    ],
)
def test_refusals(old: str, new: str, words: str) -> None:
    with pytest.raises(StandError) as caught:
        loads(FILE.replace(old, new))
    assert words in str(caught.value)
    assert "damping" in str(caught.value)


def test_key_of_another_body_is_refused() -> None:
    with pytest.raises(StandError, match="for the carrier only"):
        loads(FILE + f'[[instrument]]\nname = "fin"\nadded_mass = [1, 1, 1, 1, 1, 1]\ndamping = {{ {KEY} }}\n')


def warnings(text: str) -> list[str]:
    return [line for line in summarize(loads(text)).warnings if "added-mass products" in line]


def test_products_that_count_twice_are_warned_of() -> None:
    """With X_udot = -1, Y_vdot = -30, Z_wdot = -31: X_wq = Z_wdot, and N_uv = Y_vdot - X_udot = -29."""
    plain = FILE.replace(KEY, "")
    (line,) = warnings(plain)
    assert "damping.terms X w q = -31.2 (and 1 more)" in line
    assert warnings(FILE) == []
    assert warnings(plain.replace("-31.2", "31.2").replace("-29.0", "-20.0")) == []
    assert warnings(plain.replace("-31.2", "-35").replace("-29.0", "-20.0")) == []
    assert warnings(plain.replace('["w", "q"]', '["w", "|q|"]').replace("-29.0", "-20.0")) == []


def test_products_with_a_viscous_part_are_warned_of_where_they_are_several() -> None:
    """One of them alone may be near by chance. Of NPS AUV II most are 4 to 25 % apart."""
    text = (Path(__file__).parents[2] / "docs" / "vehicles" / "nps_auv2.toml").read_text(encoding="utf-8")
    text = text.replace(f"{KEY}\n", "").replace('wrench = "K", of = ["v", "w"]', 'wrench = "K", of = ["v", "|w|"]')
    (line,) = warnings(text)
    assert "damping.terms X w q = -14888 (and 6 more) is near the product of added mass -17865" in line
    damping = CARRIER + "added_mass = [1, 30, 30, 0, 4, 4]\n[carrier.damping]\nterms = [\n{}]\n"
    one, other = (
        '{ wrench = "X", of = ["w", "q"], value = -25 },\n',
        '{ wrench = "Y", of = ["w", "p"], value = 26 },\n',
    )
    assert warnings(damping.format(one)) == warnings(damping.format(other)) == []
    (line,) = warnings(damping.format(one + other))
    assert "X w q = -25 (and 1 more) is near the product of added mass -30" in line


def test_derivatives_that_contain_no_product_are_warned_of() -> None:
    """The key takes out what no term puts in."""
    carrier = CARRIER + "added_mass = [1, 30, 30, 0, 4, 4]\n"
    damping = '[carrier.damping]\nderivatives = "with added-mass products"\nterms = [{}]\n'
    away = damping.format('{ wrench = "X", of = ["u", "|u|"], value = -2 }')
    assert "no derivative stands where added mass has a product" in warnings(carrier + away)[0]
    there = damping.format('{ wrench = "X", of = ["v", "r"], value = 25 }')
    assert warnings(carrier + there) == []


def test_a_program_that_counts_them_twice_is_named() -> None:
    stand = replace(published(6), flywheels=())
    damping = stand.carrier.law(Damping)
    assert damping is not None
    law = replace(damping, contains_products=False)
    program = NumpyBackend(replace(stand, carrier=stand.carrier.with_laws(law)))

    def answer(request: Request) -> Mapping[str, Any]:
        return program.evaluate(request.state, request.want)

    found = Diagnoser(stand).diagnose(answer)
    assert found.causes[0].parts[0].fault.name == "products of added mass twice"
    assert found.causes[0].score == pytest.approx(0.0, abs=1e-6)
