"""Products of added mass that derivatives contain or count twice: what a reader of the stand is warned of."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from laws.stands import CARRIER, KEY, PRODUCTS, bearing
from mahovik.core.stand import loads
from mahovik.core.stand.summary import summarize
from mahovik.laws.damping.law import Damping
from mahovik.proof.diagnose.diagnosis import Diagnoser
from mahovik.proof.verify.backends import NumpyBackend
from mahovik.proof.verify.states import Request


def warnings(text: str) -> list[str]:
    return [line for line in summarize(loads(text)).warnings if "added-mass products" in line]


def test_products_that_count_twice_are_warned_of() -> None:
    """X_udot = -1, Y_vdot = -30, Z_wdot = -31 make X_wq = Z_wdot and N_uv = Y_vdot - X_udot = -29."""
    plain = PRODUCTS.replace(KEY, "")
    (line,) = warnings(plain)
    assert "damping.terms X w q = -31.2 (and 1 more)" in line
    assert warnings(PRODUCTS) == []
    assert warnings(plain.replace("-31.2", "31.2").replace("-29.0", "-20.0")) == []
    assert warnings(plain.replace("-31.2", "-35").replace("-29.0", "-20.0")) == []
    assert warnings(plain.replace('["w", "q"]', '["w", "|q|"]').replace("-29.0", "-20.0")) == []


def test_derivatives_that_contain_no_product_are_warned_of() -> None:
    """The key takes out what no term puts in."""
    carrier = CARRIER + "added_mass = [1, 30, 30, 0, 4, 4]\n"
    damping = '[carrier.damping]\nderivatives = "with added-mass products"\nterms = [{}]\n'
    away = damping.format('{ wrench = "X", of = ["u", "|u|"], value = -2 }')
    assert "no derivative stands where added mass has a product" in warnings(carrier + away)[0]
    there = damping.format('{ wrench = "X", of = ["v", "r"], value = 25 }')
    assert warnings(carrier + there) == []


def test_a_program_that_counts_them_twice_is_named() -> None:
    stand = replace(bearing("products", 6), flywheels=())
    damping = stand.carrier.law(Damping)
    assert damping is not None
    law = replace(damping, contains_products=False)
    program = NumpyBackend(replace(stand, carrier=stand.carrier.with_laws(law)))

    def answer(request: Request) -> Mapping[str, Any]:
        return program.evaluate(request.state, request.want)

    (cause,) = Diagnoser(stand, wants=("forward",)).diagnose(answer).causes
    assert cause.name == "products of added mass counted twice, in the derivatives and beside them"


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
