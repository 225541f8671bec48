"""Wrong terms of programs: planted in the literal equations one by one, and found by a sparse fit."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mahovik.core.stand.model import Stand
from mahovik.core.stand.read import load, loads
from mahovik.errors import CheckError
from mahovik.laws.damping.faults import coefficients
from mahovik.proof import reference
from mahovik.proof.diagnose.diagnosis import Diagnosis
from mahovik.proof.diagnose.terms.search import TermSearch, TermSearchResult
from mahovik.proof.diagnose.words import as_object, sentences
from mahovik.proof.reference import Pieces
from mahovik.proof.reference.forward import bias
from mahovik.proof.reference.torque import torque
from mahovik.proof.verify.states import Request
from mahovik.stands import path

BODY = """
schema = 1
name = "body"
gravity = [0, 0, -9.81]
[carrier]
mass = 2.0
inertia = [0.02, 0.03, 0.04]
[suspension]
"""
SPRUNG = {
    "damped": "damping = [1.0, 1.5, 2.0, 0.1, 0.1, 0.1]\n",
    "sprung": "damping = [1.0, 1.5, 2.0, 0.1, 0.1, 0.1]\nstiffness = [9, 9, 9, 3, 3, 3]\n",
}

Change = Callable[[Any, Any, Pieces], None]
"""Spoils K (6x6) and the right-hand side (6) of K V_r* = ... in place."""


@cache
def stand_of(name: str) -> Stand:
    """An example stand; `hull`: remus6 without its flywheels, which has far fewer products; or a sprung body."""
    if name in SPRUNG:
        return loads(BODY + SPRUNG[name])
    return replace(load(path("remus6")), flywheels=()) if name == "hull" else load(path(name))


@cache
def search(name: str) -> TermSearch:
    return TermSearch(stand_of(name), wants=("forward", "torque"))


@cache
def mass(name: str) -> float:
    return sum(body.mass for body in stand_of(name).bodies)


def found(name: str, change: Change, tau: Callable[[Request, Any], Any] = lambda _, tau: tau) -> TermSearchResult:
    stand = stand_of(name)

    def answers(request: Request) -> Mapping[str, Any]:
        at = reference.pieces(stand, request.state)
        if request.want == ("torque",):
            right = reference.evaluate(stand, request.state, ("torque",), at)["tau"]
            return {"tau": np.array(tau(request, right)).tolist()}
        K, right = at.K.copy(), at.F - bias(at) - at.I @ np.array(request.state.phi_ddot)
        change(K, right, at)
        V_r_dot = np.asarray(np.linalg.solve(K, right), dtype=np.float64)
        return {"V_dot": at.V_dot(V_r_dot).tolist()}

    return search(name).find(answers)


ROOT = Path(__file__).parents[2]


def named(result: TermSearchResult) -> set[tuple[str, str, str, float, float | None, str]]:
    return {
        (x.want, x.component, x.term, round(x.multiple.factor, 6), x.multiple.expected, x.multiple.coefficient)
        for x in result.terms
    }


@pytest.mark.slow
@pytest.mark.parametrize("name", ["hull", "demo3"])
def test_a_wrong_sign_is_named_with_its_coefficient(name: str) -> None:
    def change(_: Any, right: Any, at: Pieces) -> None:
        right[2] -= 2 * mass(name) * at.V_r[0] * at.V_r[4]

    result = found(name, change)
    assert result.whole
    assert named(result) == {("forward", "Z", "u q", -1.0, 1.0, "m")}


def test_a_wrong_index_is_a_missing_term_and_one_too_many() -> None:
    def change(_: Any, right: Any, at: Pieces) -> None:
        right[2] += mass("demo3") * at.V_r[0] * (at.V_r[5] - at.V_r[4])

    assert named(found("demo3", change)) == {
        ("forward", "Z", "u q", 0.0, 1.0, "m"),
        ("forward", "Z", "u r", 1.0, 0.0, "m"),
    }


def test_a_wrong_inertia_is_named_where_it_is_the_shorter_story() -> None:
    def change(K: Any, _: Any, __: Pieces) -> None:
        K[0, 0] -= 0.2 * mass("demo3")

    # the same motion as with other factors of w q and v r, which are two terms
    assert named(found("demo3", change)) == {("forward", "X", "u_dot", -0.8, -1.0, "m")}


def test_damping_and_weight_have_their_own_names() -> None:
    derivative = coefficients(stand_of("hull").carrier, 0.0)["Y_v|v|"]

    def change(_: Any, right: Any, at: Pieces) -> None:
        right[1] -= 2 * derivative * np.abs(at.V_r[1]) * at.V_r[1]
        right[2] -= mass("hull") * at.gravity[2]

    assert named(found("hull", change)) == {
        ("forward", "Y", "|v| v", -1.0, 1.0, "Y_v|v|"),
        ("forward", "Z", "g_z", 0.0, 1.0, "W"),
    }


@pytest.mark.parametrize(("name", "factor", "expected"), [("damped", -1.65, -1.5), ("sprung", -0.15, None)])
def test_a_term_of_a_suspension_is_not_one_that_should_not_be_there(
    name: str, factor: float, expected: float | None
) -> None:
    """Where the rest of a suspension is no sum of products, only the error of a factor is known."""

    def change(_: Any, right: Any, at: Pieces) -> None:
        right[1] -= 0.15 * at.V_r[1]

    result = found(name, change)
    (term,) = result.terms
    assert (term.component, term.term, term.multiple.coefficient) == ("Y", "v", "")
    assert (term.multiple.factor, term.multiple.expected) == pytest.approx((factor, expected), abs=1e-9)
    text = " ".join(sentences(Diagnosis("unknown").with_terms(result)))
    assert "should not be there" not in text


def test_a_small_term_beside_a_large_error_is_there() -> None:
    """A mass of 1e-7 of the error: the right equation has it."""

    def change(_: Any, right: Any, at: Pieces) -> None:
        right[2] += 1e7 * mass("damped") * at.V_r[0] * at.V_r[4]

    assert named(found("damped", change)) == {("forward", "Z", "u q", 1e7 + 1.0, 1.0, "m")}


def test_terms_are_said_to_be_all_only_where_every_wrong_quantity_was_looked_at() -> None:
    def change(_: Any, right: Any, at: Pieces) -> None:
        right[1] -= 0.15 * at.V_r[1]

    result = found("damped", change)
    alone = sentences(Diagnosis("unknown", wrong=("forward: V_dot",)).with_terms(result))
    assert alone[-1] == "without it nothing is left of the error beyond rounding"
    more = sentences(Diagnosis("unknown", wrong=("forward: V_dot", "points: points.twist")).with_terms(result))
    assert more[-2:] == [
        "without it the equations of forward are right",
        "not known: whether it explains all of points: points.twist",
    ]


def test_terms_of_phases_and_of_torques() -> None:
    def change(_: Any, right: Any, at: Pieces) -> None:
        right[1] += 0.01 * np.sin(at.flywheels[0].phi) * at.phi_dot[0] ** 2

    def tau(request: Request, right: Any) -> Any:
        return right + np.eye(len(right))[1] * 0.5 * request.state.V[3] * request.state.V[4]

    result = found("demo3", change, tau)
    assert result.whole
    assert {(x.want, x.component, x.term) for x in result.terms} == {
        ("forward", "Y", "w1.speed w1.speed sin w1"),
        ("torque", "w2", "p q"),
    }


@pytest.mark.slow
def test_nothing_is_named_for_a_right_program_or_for_what_is_no_product() -> None:
    assert found("demo3", lambda *_: None).terms == ()

    def change(_: Any, right: Any, at: Pieces) -> None:
        right[0] += np.exp(at.V_r[1])

    assert not found("demo3", change).whole


def test_a_program_that_answers_otherwise_the_second_time_is_refused() -> None:
    rng = np.random.default_rng(1)

    def change(_: Any, right: Any, __: Pieces) -> None:
        right[0] += rng.normal()

    with pytest.raises(CheckError, match="not deterministic"):
        found("demo3", change)


def test_too_few_answers_are_refused_with_their_number() -> None:
    with pytest.raises(CheckError, match=r"forward: 0 of \d+ states have an answer; expected at least \d+"):
        search("demo3").find(lambda _: {"V_dot": [float("nan")] * 6})


@pytest.mark.slow
def test_terms_of_the_momentum() -> None:
    stand = stand_of("demo3")

    def answers(request: Request) -> Mapping[str, Any]:
        at = reference.pieces(stand, request.state)
        values = reference.evaluate(stand, request.state, request.want, at)
        values["Z"][4] -= 2 * at.K[4, 4] * at.V_r[4]
        values["Z"][5] += 0.01 * at.phi_dot[1]
        return values

    result = TermSearch(stand, wants=("momentum",)).find(answers)
    assert result.whole
    assert {(x.component, x.term) for x in result.terms} == {("M", "q"), ("N", "w2.speed")}
    (inertia,) = (x.multiple for x in result.terms if x.component == "M")
    assert (inertia.factor, inertia.expected, inertia.coefficient) == (-1.0, 1.0, "I_yy")


@pytest.mark.slow
def test_terms_of_coupled_equations() -> None:
    """A wrong drive torque and a wrong force at once, in a program that is asked for the motion under torques."""
    stand = stand_of("shaker2")
    N = len(stand.flywheels)

    def answers(request: Request) -> Mapping[str, Any]:
        at, state = reference.pieces(stand, request.state), request.state
        right = at.F - bias(at)
        right[2] -= 2 * sum(body.mass for body in stand.bodies) * at.V_r[0] * at.V_r[4]
        zero = np.zeros(6)
        tau = np.array(state.tau) - torque(at, at.V_dot(zero), np.zeros(N))
        tau[1] -= 0.02 * at.phi_dot[1]
        whole = np.linalg.solve(np.block([[at.K, at.I], [at.I.T, at.Theta_ff]]), np.concatenate([right, tau]))
        return {"V_dot": at.V_dot(whole[:6]).tolist(), "phi_ddot": whole[6:].tolist()}

    result = TermSearch(stand, wants=("coupled",)).find(answers)
    assert result.whole
    names = {(x.want, x.component, x.term, round(x.error, 9)) for x in result.terms}
    wheel = stand.flywheels[1].name
    mass = sum(body.mass for body in stand.bodies)
    assert names == {("coupled", "Z", "u q", -2 * mass), ("coupled", wheel, f"{wheel}.speed", 0.02)}


def test_answers_to_other_states_are_refused() -> None:
    stand = stand_of("demo3")
    before: list[Mapping[str, Any]] = [{}]

    def answers(request: Request) -> Mapping[str, Any]:
        before.append(reference.evaluate(stand, request.state, request.want))
        return before[-2]

    kept = {request.id: answers(request) for request in search("demo3").requests}
    with pytest.raises(CheckError, match="it answers another state's result: that to 'term 2, forward' is right for"):
        search("demo3").find(lambda request: kept[request.id.removesuffix(", again")])


def test_a_momentum_without_a_name_hinders_no_other() -> None:
    stand = stand_of("hull")

    def answers(request: Request) -> Mapping[str, Any]:
        at = reference.pieces(stand, request.state)
        if request.want == ("momentum",):
            return {"Z": (np.exp(at.V_r) + at.V_r).tolist()}
        right = at.F - bias(at)
        right[2] -= 2 * mass("hull") * at.V_r[0] * at.V_r[4]
        return {"V_dot": at.V_dot(np.asarray(np.linalg.solve(at.K, right), dtype=np.float64)).tolist()}

    result = TermSearch(stand, wants=("forward", "momentum")).find(answers)
    assert result.whole
    assert named(result) == {("forward", "Z", "u q", -1.0, 1.0, "m")}
    diagnosis = Diagnosis("unknown").with_terms(result)
    assert diagnosis.verdict == "approximate"
    text = sentences(diagnosis)
    assert "the error of momentum is not a few terms: nothing of it is named" in text
    assert not any("nothing is left" in line for line in text)


def test_coupled_is_asked_for_only_where_it_says_more() -> None:
    assert TermSearch(stand_of("shaker2"), wants=("forward", "coupled")).wants == ("forward", "coupled")
    assert TermSearch(stand_of("shaker2"), wants=("forward", "torque", "coupled")).wants == ("forward", "torque")
    alone = TermSearch(stand_of("shaker2"), wants=("forward", "torque", "coupled"), wrong=("coupled",))
    assert alone.wants == ("forward", "torque", "coupled")


@pytest.mark.slow
def test_words_and_data_of_terms() -> None:
    def change(_: Any, right: Any, at: Pieces) -> None:
        right[2] -= 2 * mass("demo3") * at.V_r[0] * at.V_r[4]

    diagnosis = Diagnosis("unknown").with_terms(found("demo3", change))
    assert diagnosis.outcome == "terms"
    page = (ROOT / "docs" / "diagnosis.md").read_text(encoding="utf-8")
    assert "\n".join(sentences(diagnosis)) in page
    data = as_object(diagnosis)
    assert (data["verdict"], data["found"][0]["term"], data["found"][0]["coefficient"]) == ("named", "u q", "m")
    assert data["unexplained"] < 1e-9
    assert (data["outcome"], data["confidence"]) == ("terms", None)
    assert as_object(Diagnosis("unknown"))["verdict"] == "unnamed"
    assert as_object(Diagnosis("equal"))["verdict"] == "none"
