"""Diagnosis of a program, of a free and of a held carrier: readings and numbers are named, gaps are said."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mahovik.core.stand import load
from mahovik.core.stand.model import Stand, rest_state
from mahovik.core.stand.random import EVERYTHING, random_stand
from mahovik.laws.buoyancy.law import Buoyancy
from mahovik.proof.diagnose.answers import Precision, Reference
from mahovik.proof.diagnose.causes import READINGS, Reading, readings_of
from mahovik.proof.diagnose.columns import snapped
from mahovik.proof.diagnose.diagnosis import Cause, Diagnoser, Diagnosis, as_object, sentences
from mahovik.proof.reference.algebra import twists
from mahovik.proof.second import Second
from mahovik.proof.verify.states import Request
from physics.motions import vec

WANTS = ("forward", "torque", "momentum")
BY_NAME = {reading.name: reading for reading in READINGS}


@cache
def stand() -> Stand:
    """Two flywheels, one of them on an instrument, in a stream and with every wrench."""
    example = random_stand(np.random.default_rng(5), 2, replace(EVERYTHING, instruments=1, angles="aircraft"), "small")
    first, second = example.flywheels
    return replace(example, flywheels=(replace(first, mount="carrier"), replace(second, mount="i1")))


@cache
def diagnoser() -> Diagnoser:
    return Diagnoser(stand(), wants=WANTS)


def planted(reading: Reading) -> Diagnosis:
    model = reading.model(stand())
    return diagnoser().diagnose(lambda request: model(request.state, request.want[0]))


def of(other: Stand, digits: int | None = None) -> Diagnosis:
    """Diagnosis of the right equations of another stand, whose program may print few digits."""
    model = Reference(other)

    def answer(request: Request) -> Mapping[str, Any]:
        values = model(request.state, request.want[0])
        return values if digits is None else rounded(values, digits)

    return diagnoser().diagnose(answer)


def rounded(value: Any, digits: int) -> Any:
    if isinstance(value, Mapping):
        return {name: rounded(item, digits) for name, item in value.items()}
    return np.vectorize(lambda x: float(f"{x:.{digits}g}"))(value).tolist()


QUICK = READINGS[::16]


@pytest.mark.parametrize(
    "reading",
    [*QUICK, *(pytest.param(case, marks=pytest.mark.slow) for case in READINGS if case not in QUICK)],
    ids=lambda reading: reading.name,
)
def test_a_wrong_reading_is_named(reading: Reading) -> None:
    diagnosis = planted(reading)
    assert diagnosis.verdict in ("named", "none")
    if diagnosis.verdict == "named":
        (cause,) = diagnosis.causes
        assert reading.name in (cause.name, *cause.like)


def test_buoyancy_of_flywheels_keeps_its_direction_as_that_of_others_does() -> None:
    """At attitude zero nothing is to be turned into the axes of E1."""
    flywheels = tuple(k.with_laws(Buoyancy(0.1, (0.001, 0.002, 0.0))) for k in stand().flywheels)
    floating, state = replace(stand(), flywheels=flywheels), replace(rest_state(stand()), phi=(0.5, -1.0))
    reading = BY_NAME["buoyancy that does not turn into the axes of E1"].model(floating)
    np.testing.assert_allclose(reading(state, "forward")["V_dot"], Reference(floating)(state, "forward")["V_dot"])


def test_the_flywheel_that_has_it_is_named() -> None:
    reading = next(
        candidate for candidate in readings_of(stand()) if candidate.words == "phase of the opposite sense (w2 alone)"
    )
    diagnosis = planted(reading)
    assert [cause.name for cause in diagnosis.causes] == ["phase of the opposite sense (w2 alone)"]


@pytest.mark.parametrize("factor", [pytest.param(0.5, marks=pytest.mark.slow), 1.0 + 1e-7])
def test_all_of_gravity_by_a_factor_is_no_single_number(factor: float) -> None:
    """In double a difference of 1e-7 is no rounding of float; what three numbers leave is said."""
    diagnosis = of(replace(stand(), gravity=vec(factor * x for x in stand().gravity)))
    assert diagnosis.verdict != "none"
    assert diagnosis.precision is not None and diagnosis.precision.name == "double"
    assert not any("nothing is left" in line for line in sentences(diagnosis))


def test_two_numbers_at_once() -> None:
    carrier = stand().carrier
    c = carrier.center_of_mass
    diagnosis = of(
        replace(stand(), carrier=replace(carrier, mass=1.02 * carrier.mass, center_of_mass=(c[0] + 0.01, *c[1:])))
    )
    assert diagnosis.verdict == "named"
    assert {cause.name for cause in diagnosis.causes} == {"carrier.mass", "carrier.center_of_mass[0]"}


def test_a_number_is_named_to_the_digits_that_are_printed() -> None:
    wheel, *rest = stand().flywheels
    diagnosis = of(replace(stand(), flywheels=(replace(wheel, mass=1.01 * wheel.mass), *rest)), digits=7)
    assert diagnosis.precision is not None and diagnosis.precision.name == "7 digits"
    assert diagnosis.verdict == "named"
    assert diagnosis.causes[0].name == f"{wheel.name}.mass"
    assert "rounding (7 digits)" in sentences(diagnosis)[0]


def test_correct_programs_have_no_fault() -> None:
    assert of(stand()).verdict == "none"
    second = Second(stand())
    assert diagnoser().diagnose(lambda request: second.evaluate(request.state, request.want)).verdict == "none"
    assert of(stand(), digits=6).verdict == "none"


def test_a_correct_program_in_float_has_no_fault() -> None:
    model = Reference(stand())
    diagnosis = diagnoser().diagnose(lambda request: as_float(model(request.state, request.want[0])))
    assert diagnosis.verdict == "none"
    assert sentences(diagnosis) == [
        "no fault: nothing differs by more than rounding (float) at the states of the diagnosis"
    ]


def as_float(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {name: as_float(item) for name, item in value.items()}
    return np.asarray(value, dtype=np.float32).astype(np.float64)


def test_precision_is_read_off_the_answers() -> None:
    numbers = np.random.default_rng(1).normal(size=50)
    assert Precision.of(numbers).name == "double"
    assert Precision.of(numbers.astype(np.float32).astype(np.float64)).name == "float"
    assert Precision.of(np.round(numbers, 4)).decimals == 4
    assert Precision.of(numbers, 1e-3).name == "tolerance 0.001"


def test_a_program_without_answers() -> None:
    garbage: dict[str, Any] = {"V_dot": "many", "tau": [[1]], "K": None}
    for diagnosis in (diagnoser().diagnose(lambda _: {}), diagnoser().diagnose(lambda _: garbage)):
        assert (diagnosis.verdict, diagnosis.precision) == ("unnamed", None)


def test_a_fault_of_one_function_alone_says_so() -> None:
    """Gravity has the opposite sign in torques alone, and the diagnosis says that accelerations are right."""
    right, wrong = Reference(stand()), BY_NAME["gravity of the opposite sign"].model(stand())

    def answer(request: Request) -> Mapping[str, Any]:
        (want,) = request.want
        return (wrong if want == "torque" else right)(request.state, want)

    diagnosis = diagnoser().diagnose(answer)
    assert diagnosis.causes[0].only_in == ("torque",)
    assert "  only in torque: what else it would spoil is right" in sentences(diagnosis)


def test_a_diagnosis_as_data() -> None:
    data = as_object(planted(BY_NAME["quaternion conjugated"]))
    assert (data["verdict"], data["unexplained"]) == ("named", 0.0)
    assert data["found"][0] == {"fault": "quaternion conjugated", "share": 1.0}
    assert data["precision"] == {"name": "double", "accepted": 1e-11}
    assert as_object(Diagnosis("none"))["found"] == []


def test_what_leaves_much_of_an_error_is_no_cause() -> None:
    cause = Cause("centre of mass in mm")
    diagnosis = Diagnosis("unnamed", (cause,), 0.365, wrong=("forward: V_dot",))
    words = " ".join(sentences(diagnosis))
    assert "no single cause explains it" in words and cause.name not in words
    assert as_object(diagnosis)["found"] == [] and as_object(diagnosis)["verdict"] == "unnamed"


def test_a_factor_is_0_or_1_where_its_rounding_does_not_tell_another() -> None:
    cases = ((-3e-9, 1e-8), (1.0 - 2e-9, 1e-8), (-1.00002, 5e-5), (0.9999, 5e-5), (0.5, 1e-8))
    assert [snapped(*case) for case in cases] == [0.0, 1.0, -1.0, 0.9999, 0.5]


def test_missing_numbers_are_said_beside_a_fault_too() -> None:
    """Another shape is missing as well; without another fault there is none that is named."""
    for reading in ("", "attitude transposed: from E0 to E1"):
        program = BY_NAME[reading].model(stand()) if reading else Reference(stand())

        def answer(request: Request, program: Any = program) -> Mapping[str, Any]:
            values = {name: np.array(value).tolist() for name, value in program(request.state, request.want[0]).items()}
            if "V_dot" in values:
                values["V_dot"][2] = math.nan
            if "tau" in values:
                values["tau"] = values["tau"][:1]
            return values

        diagnosis = diagnoser().diagnose(answer)
        assert diagnosis.missing == ("forward: V_dot", "torque: tau")
        assert sentences(diagnosis)[0] == "numbers are missing in forward: V_dot and torque: tau: they are left out"
        assert "no fault" not in " ".join(sentences(diagnosis))
        assert diagnosis.verdict == ("named" if reading else "unnamed")
        assert as_object(diagnosis)["missing"] == list(diagnosis.missing)


# ---- held carriers ----


@cache
def pendulum() -> Stand:
    return load(Path(__file__).parents[2] / "docs" / "held" / "pendulum.toml")


@cache
def pendulum_diagnoser() -> Diagnoser:
    return Diagnoser(pendulum(), wants=("momentum", "forward", "coupled", "generalized", "reaction"))


@pytest.mark.parametrize(
    ("quantity", "factor", "words"),
    [
        ("reaction", -1.0, "reaction answered of the opposite sign"),
        ("q_dot", 180 / math.pi, "q_dot answered in degrees"),
        ("q_dot", 0.0, "q_dot answered as zero"),
    ],
)
def test_a_quantity_that_is_wrong_by_one_factor_is_named(quantity: str, factor: float, words: str) -> None:
    model = Reference(pendulum())

    def answer(request: Request) -> Mapping[str, Any]:
        values = model(request.state, request.want[0])
        return {name: np.array(value) * (factor if name == quantity else 1.0) for name, value in values.items()}

    (cause,) = pendulum_diagnoser().diagnose(answer).causes
    assert words in (cause.name, *cause.like)


def test_speeds_of_a_freedom_in_degrees_are_a_wrong_reading() -> None:
    hold, model = pendulum().hold, Reference(pendulum())
    assert hold is not None

    def answer(request: Request) -> Mapping[str, Any]:
        u = math.pi / 180 * np.array(request.state.u)
        return model(replace(request.state, u=tuple(u), V=tuple(twists(hold) @ u)), request.want[0])

    (cause,) = pendulum_diagnoser().diagnose(answer).causes
    assert "omega in degrees a second" in (cause.name, *cause.like)
