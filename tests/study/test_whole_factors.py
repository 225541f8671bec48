"""Quantities of a held carrier that are wrong by one constant factor are one line, not a list of wrong terms."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mahovik.core.stand.model import Stand
from mahovik.core.stand.read import load
from mahovik.proof.diagnose.diagnosis import Cause, Diagnoser, Diagnosis
from mahovik.proof.diagnose.faults import DICTIONARY
from mahovik.proof.diagnose.predict import FaultyProgram, Part
from mahovik.proof.diagnose.terms.coefficients import Multiple
from mahovik.proof.diagnose.terms.search import TermSearchResult, WrongTerm
from mahovik.proof.diagnose.words import as_object, sentences
from mahovik.proof.reference.hold import twists
from mahovik.proof.verify.states import Request

WANTS = ("momentum", "forward", "coupled", "generalized", "reaction")
RIGHT = "with this put right nothing is left of the error beyond rounding"


@cache
def stand() -> Stand:
    return load(str(Path(__file__).parents[2] / "docs" / "held" / "pendulum.toml"))


@cache
def diagnoser() -> Diagnoser:
    return Diagnoser(stand(), wants=WANTS)


def scaled(**factors: float) -> Diagnosis:
    """Diagnosis of the right program with some quantities times a factor."""

    def answer(request: Request) -> Mapping[str, Any]:
        found = FaultyProgram(stand()).answer(request)
        return {name: np.array(value) * factors.get(name, 1.0) for name, value in found.items()}

    return diagnoser().diagnose(answer)


def some_terms(count: int) -> TermSearchResult:
    term = WrongTerm("reaction", "X", "g_x", Multiple(-1.0, 1.0, "W"), -2.0, 1.0)
    return TermSearchResult((term,) * count, 0.0, ("reaction",), True)


def test_a_reaction_with_the_wrong_sign_is_one_line() -> None:
    found = scaled(reaction=-1.0).with_terms(some_terms(9)).by_factors()
    assert sentences(found) == ["reaction has the wrong sign throughout, in forward, coupled and reaction", RIGHT]
    data = as_object(found)
    assert (data["outcome"], data["verdict"], data["unexplained"]) == ("factors", "named", 0.0)
    assert data["found"] == [
        {"quantities": ["reaction"], "wants": ["forward", "coupled", "reaction"], "factor": pytest.approx(-1.0)}
    ]


def test_accelerations_with_the_wrong_sign() -> None:
    found = scaled(u_dot=-1.0, V_dot=-1.0).with_terms(some_terms(1)).by_factors()
    assert sentences(found) == ["u_dot and V_dot have the wrong sign throughout, in forward and coupled", RIGHT]


@pytest.mark.parametrize(
    ("factor", "words"),
    [
        (180 / math.pi, "57.2958 times the right value throughout (180/pi, degrees in place of radians)"),
        (57.2958, "57.2958 times the right value throughout (180/pi, degrees in place of radians)"),
        (0.0, "zero at every state"),
        (1.7, "1.7 times the right value throughout"),
    ],
)
def test_factors_in_words(factor: float, words: str) -> None:
    assert sentences(scaled(q_dot=factor).by_factors())[0] == f"q_dot is {words}, in generalized"


def test_a_term_stays_where_a_factor_says_no_more() -> None:
    """A wrong moment of inertia alone makes u_dot of a pendulum wrong by one factor."""
    found = scaled(u_dot=1.25).with_terms(some_terms(1))
    assert found.by_factors().outcome == "terms"


def test_no_factor_beside_another_error() -> None:
    def answer(request: Request) -> Mapping[str, Any]:
        found = FaultyProgram(stand()).answer(request)
        return {name: -np.array(x) if name == "reaction" else np.array(x) + (name == "Z") for name, x in found.items()}

    found = diagnoser().diagnose(answer)
    assert found.factors == ()
    assert found.by_factors() == found


def test_a_whole_fault_is_named_before_a_factor() -> None:
    fault = Diagnosis("named", (Cause((Part(DICTIONARY[0]),), 0.0),), factors=scaled(reaction=-1.0).factors)
    assert fault.by_factors() == fault


@pytest.mark.parametrize("digits", [math.pi / 180, 0.0174533])
def test_speeds_in_degrees_are_a_fault_of_the_state(digits: float) -> None:
    hold = stand().hold
    assert hold is not None

    def answer(request: Request) -> Mapping[str, Any]:
        u = digits * np.array(request.state.u)
        state = replace(request.state, u=tuple(u), V=tuple(twists(hold) @ u))
        return FaultyProgram(stand()).answer(replace(request, state=state))

    found = diagnoser().diagnose(answer)
    assert [part.fault.name for part in found.causes[0].parts] == ["omega in degrees"]
