"""Diagnosis of a program: the terms are those of the reference, every fault is one, and what is planted is found."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from mahovik.core.stand import load
from mahovik.core.stand.model import Stand
from mahovik.core.stand.random import EVERYTHING, Features, random_stand
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
from mahovik.proof.diagnose.search import match
from mahovik.proof.diagnose.states import FIRST
from mahovik.proof.diagnose.words import as_object, sentences
from mahovik.proof.second import Second
from mahovik.proof.verify.backends import NumpyBackend
from mahovik.proof.verify.states import Request
from mahovik.stands import path
from physics.motions import vec
from toolchain.quick import quick

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


def test_the_dictionary_is_large_and_says_what_it_means() -> None:
    assert len(DICTIONARY) >= 30
    assert len(BY_NAME) == len(DICTIONARY)
    assert len({fault.words for fault in DICTIONARY}) == len(DICTIONARY)
    for fault in DICTIONARY:
        assert not fault.words.endswith(".")
        assert fault.equation
        assert fault.look
        assert fault.edits


def test_faults_leave_the_right_answers_as_they_are() -> None:
    """Programs of one stand share the pieces of a state: a fault that wrote into them would spoil the others."""
    own = Diagnoser(stand())
    for fault in DICTIONARY:
        own.predictions.error((Part(fault),), False)
    first = own.whole.head(FIRST)
    known = own.predictions._pieces
    assert known
    found = first.fill(FaultyProgram(stand(), (), known).answer)
    assert np.array_equal(found, first.expected)


SEEN_ELSEWHERE = {
    "sequence, aircraft", "flywheel damping without phi'", "axis of any length not normalised",
    "products of added mass twice",
    *(fault.name for fault in (*FRICTION_FAULTS, *STOP_FAULTS, *PROFILE_FAULTS)),
}  # fmt: skip
"""Faults that need another stand: another sequence, a damped flywheel, a mounting by axes, published derivatives, a
held carrier, a stream by depth."""


@pytest.mark.slow
def test_every_fault_can_be_seen() -> None:
    found = planted(Part(BY_NAME["K* missing"]))
    assert set(found.unseen) <= SEEN_ELSEWHERE


@pytest.mark.slow
def test_no_two_faults_are_the_same() -> None:
    """No two causes predict the same error of a stand with everything."""
    predicted = {fault.name: diagnoser().predictions.error((Part(fault),), False) for fault in DICTIONARY}
    there = {name: p for name, p in predicted.items() if np.nanmax(np.abs(p)) > 1e-9}
    for name, p in there.items():
        same = [other for other, q in there.items() if other != name and np.allclose(p, q, rtol=1e-6, atol=1e-12)]
        assert same == [], name


# ---- what is planted is found ----


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


@pytest.mark.slow
def test_of_two_flywheels_that_mirror_one_another_one_is_named() -> None:
    """Two faults together cancel in some quantities; each alone does not."""
    shaker = load(path("shaker2"))
    wrong = FaultyProgram(shaker, (Part(BY_NAME["phase, sign"], "left"),))
    found = Diagnoser(shaker, wants=("matrices", "forward", "torque")).diagnose(wrong.answer)
    assert names(found)[0] == {("phase, sign", "left")}


def test_the_file_read_wrongly_is_found() -> None:
    """Planted without the dictionary: the reference itself, on a stand whose instruments have no added mass."""
    wrong = replace(stand(), instruments=tuple(replace(p, added_mass=None) for p in stand().instruments))
    assert wrong != stand()
    found = diagnoser().diagnose(answers(NumpyBackend(wrong).evaluate))
    assert names(found)[0] == {("added mass of instruments missing", None)}


def test_the_state_read_wrongly_is_found() -> None:
    right = NumpyBackend(stand())

    def negative(request: Request) -> Mapping[str, Any]:
        state = replace(request.state, phi=tuple(-phi for phi in request.state.phi))
        return right.evaluate(state, request.want)

    assert names(diagnoser().diagnose(negative))[0] == {("phase, sign", None)}


@pytest.mark.parametrize("factor", [0.5, 0.999, 1.001])
def test_what_explains_only_in_proportion_is_not_named(factor: float) -> None:
    """Half of gravity is no sign of gravity that is ignored, and a thousandth more of it none that is reversed."""
    other = replace(stand(), gravity=vec((1.0 - factor) * x for x in stand().gravity))
    found = diagnoser().diagnose(answers(NumpyBackend(other).evaluate))
    assert (found.outcome, found.causes) == ("unknown", ())
    assert " of what that would give" not in " ".join(sentences(found))


def test_a_small_error_in_double_is_no_rounding_of_float() -> None:
    """Such is gravity 9.80665 in place of 9.81, where weight is a small part of the forces."""
    other = replace(stand(), gravity=vec((1.0 + 1e-7) * x for x in stand().gravity))
    found = diagnoser().diagnose(answers(NumpyBackend(other).evaluate))
    assert found.outcome == "unknown" and found.verdict == "unnamed"
    assert "float" not in " ".join(sentences(found))


def test_two_at_once() -> None:
    found = planted(Part(BY_NAME["K* missing"]), Part(BY_NAME["buoyancy, sign"]))
    assert names(found)[0] == {("K* missing", None), ("buoyancy, sign", None)}
    assert sentences(found)[0] == "two faults at once found:"


@pytest.mark.slow
def test_a_fault_in_one_function_only() -> None:
    right, wrong = (
        FaultyProgram(stand()).answer,
        FaultyProgram(stand(), (Part(BY_NAME["added mass missing in Phi K"]),)).answer,
    )
    found = diagnoser().diagnose(lambda request: (wrong if request.want == ("forward",) else right)(request))
    assert names(found)[0] == {("added mass missing in Phi K", None)}
    assert found.causes[0].only_in == ("forward: V_dot",)


# ---- what is not ----


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


def test_a_faulty_program_in_float_has_its_fault() -> None:
    wrong = FaultyProgram(stand(), (Part(BY_NAME["phi'^2 terms, sign"]),)).answer
    found = diagnoser().diagnose(lambda request: as_float(wrong(request)))
    assert names(found)[0] == {("phi'^2 terms, sign", None)}


@pytest.mark.slow
def test_noise_has_no_fault() -> None:
    """Errors of one percent that come from nowhere."""
    rng = np.random.default_rng(1)

    def noisy(value: Any) -> Any:
        if isinstance(value, Mapping):
            return {name: noisy(each) for name, each in value.items()}
        return np.asarray(value) * (1.0 + 0.01 * rng.normal(size=np.shape(value)))

    found = diagnoser().diagnose(lambda request: noisy(FaultyProgram(stand()).answer(request)))
    assert (found.outcome, found.causes, found.confidence) == ("unknown", (), 0.0)
    assert "no fault of the" in sentences(found)[0]


def test_a_program_without_answers() -> None:
    assert diagnoser().diagnose(lambda _: {}).outcome == "nothing"
    garbage = diagnoser().diagnose(lambda _: {"V_dot": "many", "tau": [[1]], "K": None})
    assert garbage.outcome == "nothing"


@pytest.mark.parametrize("number", quick(2, [float("inf"), 0.0, 1e308, -1e308, 10**400, True]))
def test_numbers_that_make_no_sense_have_no_fault(number: Any) -> None:
    found = diagnoser().diagnose(lambda _: {"V_dot": [number] * 6})
    assert (found.outcome, found.causes) in (("unknown", ()), ("nothing", ()))


def test_a_rigid_body() -> None:
    """A stand without flywheels."""
    rigid = random_stand(np.random.default_rng(1), 0, EVERYTHING)
    found = Diagnoser(rigid, wants=("forward",)).diagnose(FaultyProgram(rigid, (Part(BY_NAME["legs, sign"]),)).answer)
    assert names(found)[0] == {("legs, sign", None)}


def test_what_a_stand_cannot_tell_apart_is_named_together() -> None:
    """Without gravity turned by anything, missing and reversed terms are alike; of one flywheel, all and it alone."""
    level = replace(
        random_stand(
            np.random.default_rng(3), 1, Features(fluid=False, laws={"suspension": 0, "leg": 0}, instruments=0)
        ),
        stream=None,
    )
    assert level.flywheels[0].inertia_about in ("origin", "center_of_mass")
    own = Diagnoser(level, wants=("forward",))
    found = own.diagnose(FaultyProgram(level, (Part(BY_NAME["phi'' not used"]),)).answer)
    assert {("phi'' not used", None)} in names(found)
    assert {("I phi'' missing", None)} in names(found)
    assert "with the same effect on this stand" in " ".join(sentences(found))


# ---- numbers ----


def test_match_counts_small_terms_as_much_as_large_ones() -> None:
    e, noise, block = np.array([1.0, 1e-6, 0.0]), np.full(3, 1e-11), np.array([0, 1, 2])
    assert match(e, e, noise, block).score == pytest.approx(0.0)
    assert match(e, np.array([1.0, 0.0, 0.0]), noise, block).score == pytest.approx(0.5, abs=1e-4)
    absent = match(e, np.array([1.0, 1e-6, 1.0]), noise, block)
    assert absent.rest == pytest.approx(0.0)
    assert absent.absent == (2,)
    assert 0.0 < absent.score < 0.1
    assert match(e, np.array([np.nan, 1e-6, 0.0]), noise, block).rest == pytest.approx(0.5)


def test_a_guess_is_called_a_guess() -> None:
    found = planted(Part(BY_NAME["gravity, sign"]))
    assert sentences(found)[0] == "fault found:"
    assert sentences(replace(found, confidence=0.1))[0] == "fault, perhaps:"
    assert "confidence 10.0%" in " ".join(sentences(replace(found, confidence=0.1)))


def test_a_diagnosis_as_data() -> None:
    data = as_object(planted(Part(BY_NAME["gravity, sign"])))
    assert data["outcome"] == "named"
    assert data["causes"][0]["faults"][0]["name"] == "gravity, sign"
    assert data["dictionary"] == len(DICTIONARY)
    assert 0.9 < data["confidence"] <= 1.0
