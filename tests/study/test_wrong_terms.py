"""Wrong terms of programs: planted in the literal equations one by one, and found by a sparse fit."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache
from typing import Any

import numpy as np
import pytest

import mahovik
from mahovik.errors import CheckError
from mahovik.proof import reference
from mahovik.proof.diagnose.diagnosis import Diagnosis
from mahovik.proof.diagnose.terms.search import TermSearch, TermSearchResult
from mahovik.proof.diagnose.words import as_object, sentences
from mahovik.proof.reference import Pieces
from mahovik.proof.reference.forward import bias
from mahovik.proof.verify.states import Request

Change = Callable[[Any, Any, Pieces], None]
"""Spoils K (6x6) and the right-hand side (6) of K V_r* = ... in place."""


@cache
def search(name: str) -> TermSearch:
    return TermSearch(mahovik.example(name))


def found(name: str, change: Change, tau: Callable[[Request, Any], Any] = lambda _, tau: tau) -> TermSearchResult:
    stand = mahovik.example(name)

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


def named(result: TermSearchResult) -> set[tuple[str, str, str, float, float | None, str]]:
    return {
        (x.want, x.component, x.term, round(x.multiple.factor, 6), x.multiple.expected, x.multiple.coefficient)
        for x in result.terms
    }


def mass(name: str) -> float:
    return sum(body.mass for body in mahovik.example(name).bodies)


@pytest.mark.parametrize("name", ["remus6", "demo3"])
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


def test_words_and_data_of_terms() -> None:
    def change(_: Any, right: Any, at: Pieces) -> None:
        right[2] -= 2 * mass("demo3") * at.V_r[0] * at.V_r[4]

    diagnosis = Diagnosis("unknown", terms=found("demo3", change))
    assert sentences(diagnosis)[:2] == [
        "wrong term found:",
        "  forward, Z: u q has the wrong sign: factor -1 m, expected 1 m; 100% of the error",
    ]
    data = as_object(diagnosis)
    assert (data["verdict"], data["found"][0]["term"], data["found"][0]["coefficient"]) == ("named", "u q", "m")
    assert data["unexplained"] < 1e-9
    assert as_object(Diagnosis("unknown"))["verdict"] == "unnamed"
    assert as_object(Diagnosis("equal"))["verdict"] == "none"
