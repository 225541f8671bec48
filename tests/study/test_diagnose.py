"""Diagnosis of a program, of a free and of a held carrier: planted faults, gaps and whole factors are named."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mahovik.core.stand import load
from mahovik.core.stand.model import Stand, StreamProfile
from mahovik.core.stand.random import EVERYTHING, random_stand
from mahovik.errors import StateError
from mahovik.laws.control.data import Control, ControlDerivative, ControlDerivatives, Velocity
from mahovik.laws.cross_flow.data import CrossFlow
from mahovik.laws.fading.data import FadingDamping
from mahovik.laws.fin.data import Fin, Fins
from mahovik.laws.friction.faults import FAULTS as FRICTION_FAULTS
from mahovik.laws.propeller.data import Propeller, Propellers
from mahovik.laws.stop.faults import FAULTS as STOP_FAULTS
from mahovik.proof.diagnose.diagnosis import Diagnoser, Diagnosis
from mahovik.proof.diagnose.fault import Fault
from mahovik.proof.diagnose.faults import DICTIONARY
from mahovik.proof.diagnose.faults.stream import PROFILE_FAULTS
from mahovik.proof.diagnose.predict import FaultyProgram, Part
from mahovik.proof.diagnose.terms.coefficients import Multiple
from mahovik.proof.diagnose.terms.search import TermSearchResult, WrongTerm
from mahovik.proof.diagnose.words import as_object, name_of, sentences
from mahovik.proof.reference.hold import twists
from mahovik.proof.second import Second
from mahovik.proof.verify.backends import NumpyBackend
from mahovik.proof.verify.states import Request
from mahovik.stands import path
from physics.motions import vec

BY_NAME = {fault.name: fault for fault in DICTIONARY}


@cache
def stand() -> Stand:
    """Two flywheels, one of them on an instrument, in a stream and with every wrench."""
    found = random_stand(np.random.default_rng(5), 2, replace(EVERYTHING, instruments=1, angles="aircraft"), "small")
    first, second = found.flywheels
    drag = CrossFlow(
        1000.0, (-0.5, 0.0, 0.5), (0.1, 0.3, 0.2), (0.2, 0.3, 0.1), (1.1,) * 3, (0.9,) * 3, 2, together=False
    )
    fin = Fin("a", (0.4, 0.1, 0.2), (1, 0, 0.1), (0, 1, 0.5), 1000.0, 0.05, 3.0, 0.1, 0.2, 0.3, 0.2, "across", True)
    ahead, around = (0.4, -0.4, -0.1), (0.2, -0.2, 0.1)
    propeller = Propeller(
        "b", (-0.4, 0, 0.1), (1, 0.1, 0), 1000.0, 0.2, ahead, around, 80.0, 0.2, 0.1, whole=False, left=False
    )
    rows = tuple(tuple(9.0 * (i == j) + 0.3 * (i - 2 * j) for j in range(6)) for i in range(6))
    fading = FadingDamping(rows, 0.7)  # type: ignore[arg-type]
    products = (
        ControlDerivative(0, (Velocity(0, False), Velocity(5, True), Control("a", "deflection", False)), -40.0),
        ControlDerivative(4, (Velocity(2, False), Control("b", "race", False)), 25.0),
    )
    steering = ControlDerivatives(products, 1e-3)
    carrier = found.carrier.with_laws(drag, Fins((fin,)), Propellers((propeller,)), fading, steering)
    return replace(found, carrier=carrier, flywheels=(replace(first, mount="carrier"), replace(second, mount="i1")))


@cache
def diagnoser() -> Diagnoser:
    return Diagnoser(stand())


def planted(*parts: Part) -> Diagnosis:
    return diagnoser().diagnose(FaultyProgram(stand(), parts).answer)


def names(found: Diagnosis) -> list[set[tuple[str, str | None]]]:
    return [{(part.fault.name, part.wheel) for part in cause.parts} for cause in found.causes]


def answers(evaluate: Callable[..., Mapping[str, Any]]) -> Callable[[Request], Mapping[str, Any]]:
    def answer(request: Request) -> Mapping[str, Any]:
        try:
            return evaluate(request.state, request.want)
        except StateError:
            return {}

    return answer


# ---- the dictionary ----


SEEN_ELSEWHERE = {
    "sequence, aircraft", "flywheel damping without phi'", "axis of any length not normalised",
    "products of added mass twice",
    *(fault.name for fault in (*FRICTION_FAULTS, *STOP_FAULTS, *PROFILE_FAULTS)),
}  # fmt: skip
"""Faults that need another stand: another sequence, a damped flywheel, a mounting by axes, published derivatives, a
held carrier, a stream by depth."""


FEW = DICTIONARY[::24]


@pytest.mark.parametrize(
    "fault",
    [*FEW, *(pytest.param(each, marks=pytest.mark.slow) for each in DICTIONARY if each not in FEW)],
    ids=lambda fault: fault.name,
)
def test_a_single_fault_is_named_first(fault: Fault) -> None:
    found = planted(Part(fault))
    if found.outcome == "equal":
        assert fault.name in SEEN_ELSEWHERE
    else:
        assert names(found)[0] == {(fault.name, None)}
        assert found.confidence > 0.9
        assert fault.words in " ".join(sentences(found))


@pytest.mark.slow
@pytest.mark.parametrize("name", ["J22 - J33 missing", "phi' not squared", "weight at the hub"])
def test_the_flywheel_that_has_it_is_named(name: str) -> None:
    found = planted(Part(BY_NAME[name], "w2"))
    assert names(found)[0] == {(name, "w2")}
    assert "in w2 alone" in " ".join(sentences(found))


@pytest.mark.parametrize("factor", [0.5, 1.0 + 1e-7])
def test_what_explains_only_in_proportion_is_not_named(factor: float) -> None:
    """Half of gravity is none that is ignored; in double a difference of 1e-7 is no rounding of float."""
    other = replace(stand(), gravity=vec(factor * x for x in stand().gravity))
    found = diagnoser().diagnose(answers(NumpyBackend(other).evaluate))
    assert (found.outcome, found.verdict, found.causes) == ("unknown", "unnamed", ())
    assert "float" not in " ".join(sentences(found))


def test_two_at_once() -> None:
    found = planted(Part(BY_NAME["K* missing"]), Part(BY_NAME["buoyancy, sign"]))
    assert names(found)[0] == {("K* missing", None), ("buoyancy, sign", None)}
    assert sentences(found)[0] == "two faults at once found:"


def test_correct_programs_have_no_fault() -> None:
    assert diagnoser().diagnose(answers(NumpyBackend(stand()).evaluate)).outcome == "equal"
    assert diagnoser().diagnose(answers(Second(stand()).evaluate)).outcome == "equal"


def test_a_correct_program_in_float_has_no_fault() -> None:
    found = diagnoser().diagnose(lambda request: as_float(FaultyProgram(stand()).answer(request)))
    assert (found.outcome, found.causes) == ("rounding", ())
    assert "no fault" in sentences(found)[0]


def as_float(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {name: as_float(each) for name, each in value.items()}
    return np.asarray(value, dtype=np.float32).astype(np.float64)


def test_a_program_without_answers() -> None:
    assert diagnoser().diagnose(lambda _: {}).outcome == "nothing"
    garbage = diagnoser().diagnose(lambda _: {"V_dot": "many", "tau": [[1]], "K": None})
    assert garbage.outcome == "nothing"


def test_a_diagnosis_in_words_and_as_data() -> None:
    found = planted(Part(BY_NAME["gravity, sign"]))
    assert sentences(found)[0] == "fault found:"
    guess = sentences(replace(found, confidence=0.1))
    assert guess[0] == "fault, perhaps:" and "confidence 10.0%" in " ".join(guess)
    data = as_object(found)
    assert (data["outcome"], data["dictionary"]) == ("named", len(DICTIONARY))
    assert data["causes"][0]["faults"][0]["name"] == "gravity, sign"
    assert 0.9 < data["confidence"] <= 1.0
    (line,) = sentences(Diagnosis("equal", failed=("inverse status (2 where the reference has 0)",)))
    assert "no fault" not in line and "inverse status (2 where the reference has 0)" in line


PROFILE = StreamProfile((0.0, 0.0, 1.0), (0.0, 10.0, 50.0), ((0.5, 0.0, 0.1), (0.25, 0.0, 0.0), (0.0, 0.0, 0.0)))


@pytest.mark.parametrize("fault", PROFILE_FAULTS, ids=lambda fault: fault.name)
def test_a_wrong_profile_of_the_stream_is_named(fault: Fault) -> None:
    deep = replace(load(path("auv6")), stream=(0.0, 0.0, 0.0), profile=PROFILE, laws=())
    found = Diagnoser(deep, wants=("forward",)).diagnose(FaultyProgram(deep, (Part(fault),)).answer)
    among = {name_of(part) for cause in found.causes for part in cause.parts}
    assert {fault.name} <= among <= {fault.name, "position ignored"}


# ---- numbers that a program leaves out ----


def with_gaps(change: Callable[[Request, dict[str, Any]], None], *wants: str, parts: tuple[Part, ...] = ()) -> Any:
    """Diagnosis of shaker2's program after a change of its answers, and how many states were asked."""
    program, asked = FaultyProgram(load(path("shaker2")), parts), Diagnoser(load(path("shaker2")), wants=wants)

    def answer(request: Request) -> Mapping[str, Any]:
        values = {name: np.array(value).tolist() for name, value in program.answer(request).items()}
        change(request, values)
        return values

    return asked.diagnose(answer), len(asked.requests)


def test_a_missing_component_is_said_beside_a_fault_too() -> None:
    def change(_: Request, values: dict[str, Any]) -> None:
        values["V_dot"][2] = math.nan

    found, count = with_gaps(change, "forward")
    line = f"forward answers no number at {count} of {count} states of the diagnosis (component Z)"
    assert sentences(found)[0] == line and "no fault" not in " ".join(sentences(found))
    gap = {"want": "forward", "missing": count, "states": count, "components": {"V_dot": ["Z"]}}
    assert (as_object(found)["verdict"], as_object(found)["gaps"]) == ("unnamed", [gap])
    found, _ = with_gaps(change, "forward", parts=(Part(BY_NAME["gravity, sign"]),))
    assert sentences(found)[:2] == [line, "fault found:"]
    assert [part.fault.name for part in found.causes[0].parts] == ["gravity, sign"]


def test_another_shape_is_said_with_the_expected_one() -> None:
    def change(_: Request, values: dict[str, Any]) -> None:
        values["V_dot"] = values["V_dot"][:3]
        if "phi_ddot" in values:
            values["phi_ddot"] = None

    found, _ = with_gaps(change, "forward", "coupled")
    first, second, *_ = sentences(found)
    assert first.startswith("forward answers another shape at ") and first.endswith("(shape [3], expected [6])")
    assert second.startswith("coupled answers no number at ")
    assert second.endswith("(V_dot, shape [3], expected [6]; phi_ddot, all components)")


# ---- held carriers ----


@cache
def pendulum() -> Stand:
    return load(Path(__file__).parents[2] / "docs" / "held" / "pendulum.toml")


@cache
def pendulum_diagnoser() -> Diagnoser:
    return Diagnoser(pendulum(), wants=("momentum", "forward", "coupled", "generalized", "reaction"))


def scaled(**factors: float) -> Diagnosis:
    """Diagnosis of the right program of the pendulum with some quantities times a factor."""

    def answer(request: Request) -> Mapping[str, Any]:
        values = FaultyProgram(pendulum()).answer(request)
        return {name: np.array(value) * factors.get(name, 1.0) for name, value in values.items()}

    return pendulum_diagnoser().diagnose(answer)


@pytest.mark.parametrize(
    ("quantity", "factor", "line"),
    [
        ("reaction", -1.0, "reaction has the wrong sign throughout, in forward, coupled and reaction"),
        ("q_dot", 180 / math.pi, "q_dot is 57.2958 times the right value throughout (180/pi, degrees in place of"),
        ("q_dot", 0.0, "q_dot is zero at every state, in generalized"),
        ("q_dot", 1.7, "q_dot is 1.7 times the right value throughout, in generalized"),
    ],
)
def test_a_quantity_that_is_wrong_by_one_factor_is_one_line(quantity: str, factor: float, line: str) -> None:
    """And no list of wrong terms; but one term says as much."""
    term = WrongTerm("reaction", "X", "g_x", Multiple(-1.0, 1.0, "W"), -2.0, 1.0)
    found = scaled(**{quantity: factor})
    words = sentences(found.with_terms(TermSearchResult((term,) * 9, 0.0, ("reaction",), True)).by_factors())
    assert words[0].startswith(line)
    assert words[1:] == ["with this put right nothing is left of the error beyond rounding"]
    assert as_object(found.by_factors())["found"][0]["factor"] == pytest.approx(factor)


def test_a_factor_gives_way_to_one_term_and_to_another_error() -> None:
    """A wrong moment of inertia alone makes u_dot of a pendulum wrong by one factor."""
    term = WrongTerm("forward", "M", "q_dot", Multiple(-0.8, -1.0, "I_yy"), 0.2, 1.0)
    found = scaled(u_dot=1.25).with_terms(TermSearchResult((term,), 0.0, ("forward",), True))
    assert found.by_factors().outcome == "terms"
    other = replace(pendulum(), carrier=replace(pendulum().carrier, mass=0.33))
    unknown = pendulum_diagnoser().diagnose(FaultyProgram(other).answer)
    assert unknown.outcome in ("named", "unknown") and sentences(unknown)
    assert unknown.factors == () and unknown.by_factors() == unknown


def test_speeds_of_a_freedom_in_degrees_are_a_fault_of_the_state() -> None:
    hold = pendulum().hold
    assert hold is not None

    def answer(request: Request) -> Mapping[str, Any]:
        u = math.pi / 180 * np.array(request.state.u)
        state = replace(request.state, u=tuple(u), V=tuple(twists(hold) @ u))
        return FaultyProgram(pendulum()).answer(replace(request, state=state))

    found = pendulum_diagnoser().diagnose(answer)
    assert [part.fault.name for part in found.causes[0].parts] == ["omega in degrees"]
