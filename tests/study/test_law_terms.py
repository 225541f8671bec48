"""Wrong coefficients of cross-flow drag, fins, propellers and fading damping, one by one."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any, cast

import numpy as np
import pytest

from mahovik.contract.laws import of_bodies
from mahovik.core.stand.model import Carrier, Mat6, Stand
from mahovik.core.stand.read import load
from mahovik.core.stand.state import rest_state
from mahovik.laws.cross_flow.data import CrossFlow
from mahovik.laws.fading.data import FadingDamping
from mahovik.laws.fin.data import Fins
from mahovik.laws.propeller.data import Propeller, Propellers
from mahovik.proof import reference
from mahovik.proof.diagnose.terms.search import TermSearch, TermSearchResult
from mahovik.proof.reference.forward import bias
from mahovik.proof.reference.wrench_kinds import body_wrench
from mahovik.proof.verify.actuators import stand_at, with_drawn_actuators
from mahovik.proof.verify.states import Request

VEHICLES = Path(__file__).parents[2] / "docs" / "vehicles"


@cache
def vehicle() -> Stand:
    """REMUS 100, of which Y_vdot = Z_wdot, with planes, a propeller, strips and fading damping; actuators at zero."""
    hull = load(VEHICLES / "remus100.toml")
    linear = tuple(tuple(1.0 + i if i == j else 0.1 * (i + j) for j in range(6)) for i in range(6))
    table = (0.1, 0.2, 0.1)
    return replace(
        hull,
        carrier=hull.carrier.with_laws(
            Propellers((Propeller("screw", (-0.7, 0.0, 0.01), (1.0, 0.0, 0.0), 1000.0, 0.14, (0.3, -0.2, -0.1),
                                  (0.03, -0.02, -0.01), 0.0, 0.1, 0.05, False, False),)),
            CrossFlow(1000.0, (-0.6, 0.1, 0.7), table, table, (0.9, 1.0, 1.1), (0.7, 0.8, 0.6), 2, True),
            FadingDamping(cast(Mat6, linear), 1.5),
        ),
    )  # fmt: skip


@cache
def search() -> TermSearch:
    return TermSearch(vehicle(), wants=("forward",), actuators=True)


def terms_found(wrong: Callable[[Stand], Stand], rows: Sequence[int] = range(6)) -> TermSearchResult:
    """Search in a program that has another law in some components of the wrench."""

    def answers(request: Request) -> Mapping[str, Any]:
        right_stand = stand_at(vehicle(), request.state)
        at, other = (reference.pieces(x, request.state) for x in (right_stand, wrong(right_stand)))
        right = at.F - bias(at)
        change = body_wrench(other.terms["carrier"]) - body_wrench(at.terms["carrier"])
        right[list(rows)] += change[list(rows)]
        V_r_dot = np.asarray(np.linalg.solve(at.K, right), dtype=np.float64)
        return {"V_dot": at.V_dot(V_r_dot).tolist()}

    return search().find(answers)


def with_fin(share: float) -> Callable[[Stand], Stand]:
    """A share of the lift slope of the first fin."""

    def change(stand: Stand) -> Stand:
        first, *others = law_of(stand, Fins).fins
        return with_law(stand, Fins((replace(first, lift_slope=share * first.lift_slope), *others)))

    return change


def with_screw(**values: Any) -> Callable[[Stand], Stand]:
    return lambda stand: with_law(stand, Propellers((replace(law_of(stand, Propellers).propellers[0], **values),)))


def with_strips(**values: Any) -> Callable[[Stand], Stand]:
    return lambda stand: with_law(stand, replace(law_of(stand, CrossFlow), **values))


def law_of(stand: Stand, kind: Any) -> Any:
    law = stand.carrier.law(kind)
    assert law is not None
    return law


def with_law(stand: Stand, law: Any) -> Stand:
    carrier: Carrier = stand.carrier.with_laws(law)
    return replace(stand, carrier=carrier)


def named(result: TermSearchResult) -> set[tuple[str, str, float, float | None, str]]:
    assert result.whole
    return {
        (x.component, x.term, round(x.multiple.factor, 6), x.multiple.expected, x.multiple.coefficient)
        for x in result.terms
    }


def with_fading_element(stand: Stand) -> Stand:
    rows = [list(row) for row in law_of(stand, FadingDamping).linear]
    rows[2][4] *= -1
    return with_law(stand, replace(law_of(stand, FadingDamping), linear=tuple(map(tuple, rows))))


@pytest.mark.parametrize(
    ("wrong", "rows", "expected"),
    [
        (with_fin(-1.0), range(6), {(c, "rudder lift", -1.0, 1.0, "rudder.lift_slope") for c in "YN"}),
        (with_screw(thrust=(0.3, -0.4, -0.1)), [0], {("X", "screw thrust |n| V_a", 2.0, 1.0, "screw.thrust[1]")}),
        (
            with_strips(drag_z=(0.7, 1.6, 0.6)),
            [2],
            {("Z", "cross flow (w - x q) at 0.1 m", 2.0, 1.0, "carrier.cross_flow.drag_z[1]")},
        ),
        (with_fading_element, range(6), {("Z", "exp(-rate U) q", -1.0, 1.0, "carrier.fading_damping.linear[2][4]")}),
    ],
)
def test_a_wrong_coefficient_is_named(
    wrong: Callable[[Stand], Stand], rows: Sequence[int], expected: set[tuple[Any, ...]]
) -> None:
    assert named(terms_found(wrong, rows)) == expected


def test_parts_of_a_law_add_up_to_it() -> None:
    """The sum of the parts of each detail is the wrench, at states with deflections and speeds of their own."""
    rng = np.random.default_rng(4)
    states = [with_drawn_actuators(vehicle(), rest_state(vehicle()), rng) for _ in range(4)]
    V = rng.normal(size=(4, 6))
    bodies = [stand_at(vehicle(), state).carrier for state in states]
    kinds = of_bodies("terms", "KIND")
    for kind, law_terms in zip(kinds, of_bodies("terms", "law_terms"), strict=True):
        expected = [
            {k: P for wrenches in of_bodies("reference", "wrenches") for k, P in wrenches(b, np.zeros(3), x).items()}[
                kind
            ]
            for b, x in zip(bodies, V, strict=True)
        ]
        terms = law_terms(bodies, V)
        for detail in {term.detail for term in terms}:
            total = sum(term.value * term.wrench for term in terms if term.detail == detail)
            np.testing.assert_allclose(total, expected, rtol=1e-12, atol=1e-12 * np.abs(expected).max())
