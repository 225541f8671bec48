"""Faults and wrong numbers in the program of a rig that knows nothing of the package: what is planted is named."""

from __future__ import annotations

import copy
import json
import sys
import tomllib
import xml.etree.ElementTree as ET
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mahovik
from diagnose.rig import WANTS, Rig
from mahovik.core.stand.files import parse_toml
from mahovik.core.stand.model import Stand
from mahovik.core.stand.stand_file import read
from mahovik.proof.diagnose.answers import Precision
from mahovik.proof.diagnose.diagnosis import Diagnoser, Diagnosis, sentences
from mahovik.proof.diagnose.search import TermSearch
from mahovik.proof.verify.states import Request

FOLDER = Path(__file__).parent
TEXT = (FOLDER / "rig.toml").read_text(encoding="utf-8")

FAULTS: dict[str, Any] = {
    "scalar last": "quaternion read with the scalar last",
    "scalar first": "quaternion given with the scalar last to what reads it scalar first",
    "conjugate": "quaternion conjugated",
    "degrees": "attitude angles in degrees",
    "sequence": "attitude angles of the state alone in the aircraft sequence",
    "reversed": "attitude angles about the axes in reverse order",
    "mm": "position in mm",
    "equilibrium": "angles of the suspension ignored",
    "no wrench": "run-time wrench ignored",
    "gravity": ("all bodies", "weight", -1.0, 1.0),
    "products": "products of inertia of the opposite sign (carrier alone)",
    "about": "inertia taken about the origin though it is about the centre of mass",
    "phase": "phase of the opposite sense",
    "rpm": "speed of a flywheel in revolutions a minute",
    "transposed": "stiffness matrix transposed",
    "buoyancy": "buoyancy that does not turn into the axes of the body",
    "added mass": "added mass of the opposite sign",
    "wrench": "run-time wrenches taken in the axes of E0",
    "displacement": "displacement of the suspension not turned into the axes of E1",
    "still inertia": "inertia about the centre of mass of flywheels does not turn with the phase",
    "still centre": "centre of mass of flywheels does not turn with the phase",
    "inertia": "inertia about the centre of mass turned into the axes of E1 the other way, by C^T for C",
    "inertia of arm": "inertia about the centre of mass not turned into the axes of E1 (arm alone)",
    "damping": "damping matrix taken in the axes of E0",
    "sine": "the sine of the angle for the rotation vector of the suspension",
    "turned in E0": "components in the axes of E0 for the rotation vector of the suspension",
    "munk": ("carrier", "Phi Lambda V_r", -1.0, 1.0),
    "order": "phase and speed in the reverse order of flywheels",
    "gyroscopic": ("flywheels", "Omega x J Omega", -1.0, 1.0),
    "spin": ("flywheels", "phi_dot omega x J_O e", -1.0, 1.0),
    "coriolis": ("flywheels", "m phi_dot omega x (e x r)", 1.0, 2.0),
    "omega x u": ("flywheels", "J phi_dot omega x e", 0.0, 1.0),
    "still axis": ("flywheels", "Theta_s (0, omega x e) phi_dot", 0.0, 1.0),
    "centripetal": ("w2", "m phi_dot^2 e x (e x r)", 0.0, 1.0),
    "rate": ("w2", "m omega x (omega x r)", 0.0, 1.0, "m phi_dot omega x (e x r)", 3.0, 2.0),
    "weight": ("flywheels", "moment of weight", 0.0, 1.0),
    "absolute": ("flywheels", "I_s (e . omega_dot)", -1.0, 0.0),
    "armature": ("w1", "w1.acceleration", None, None),
}
"""Faults of `rig.py`, and their names: a reading, or a body with terms, their factors and the right ones."""

NUMBERS: dict[str, float] = {
    "carrier.mass": 2.01,
    "carrier.center_of_mass[2]": 0.031,
    "carrier.inertia.J11": 0.0305,
    "carrier.added_mass[1][1]": 0.65,
    "carrier.buoyancy.displaced_mass": 1.45,
    "carrier.buoyancy.center[2]": 0.055,
    "arm.mass": 0.31,
    "arm.position[1]": 0.055,
    "w1.mass": 0.41,
    "w1.center_of_mass[1]": 0.0035,
    "w1.inertia.J11": 0.0012,
    "w1.angles[1]": -0.25,
    "w2.position[0]": 0.033,
    "suspension.damping[5][5]": 0.5,
    "suspension.damping[2][2]": 0.0,
    "suspension.stiffness[2][2]": 510.0,
    "suspension.position[2]": -0.025,
    "gravity[2]": -9.80665,
}
"""Numbers of the file that the program has otherwise."""

QUICK = ("scalar last", "spin", "buoyancy", "carrier.mass", "suspension.damping[5][5]")


@cache
def diagnoser() -> Diagnoser:
    return Diagnoser(stand(), parse_toml(TEXT), wants=WANTS)


@cache
def stand() -> Stand:
    return read(parse_toml(TEXT), "rig")


@cache
def term_search(wrong: tuple[str, ...]) -> TermSearch:
    return TermSearch(stand(), wants=WANTS, wrong=wrong)


def with_number(path: str, value: float) -> Mapping[str, Any]:
    """The keys of the file as the program reads them, with another number."""
    file: Any = copy.deepcopy(tomllib.loads(TEXT))
    changed = mahovik.Stand.from_dict(parse_toml(TEXT)).replace({path: value}).to_dict()
    file.update(json.loads(json.dumps(changed, default=float)))
    return dict(file)


def diagnosis_of(rig: Rig, digits: int = 17) -> Diagnosis:
    """Diagnosis of a program that prints these digits, as `judge --explain` makes it."""

    def answer(request: Request) -> Mapping[str, Any]:
        inputs = {key: value for key, value in vars(request.state).items() if value is not None}
        values = rig.answer({**inputs, "wrench": dict(request.state.wrench)}, request.want[0])
        return {name: np.vectorize(lambda x: float(f"{x:.{digits}g}"))(x).tolist() for name, x in values.items()}

    diagnosis = diagnoser().diagnose(answer)
    if diagnosis.wrong and not (diagnosis.verdict == "named" and len(diagnosis.causes) == 1):
        diagnosis = diagnosis.with_terms(term_search(diagnosis.wrong).find(answer))
    return diagnosis


def marked(names: Mapping[str, Any]) -> list[Any]:
    return [pytest.param(name, marks=() if name in QUICK else pytest.mark.slow) for name in names]


@pytest.mark.parametrize("fault", marked(FAULTS))
def test_a_fault_in_the_code_is_named(fault: str) -> None:
    diagnosis, expected = diagnosis_of(Rig(tomllib.loads(TEXT), fault)), FAULTS[fault]
    assert diagnosis.verdict == "named", sentences(diagnosis)
    if isinstance(expected, str):
        (cause,) = diagnosis.causes
        assert expected in (cause.name, *cause.like)
        return
    assert diagnosis.terms is not None
    body, *words = expected
    if words[1] is None:
        torque_terms = {(part.component, part.term) for part in diagnosis.terms.terms if part.want == "torque"}
        assert torque_terms == {(body, words[0]), ("w2", "w2.acceleration")}
        return
    right = {term: rest for term, *rest in zip(words[::3], words[1::3], words[2::3], strict=True)}
    assert {part.term for part in diagnosis.terms.terms} == {*right}
    for part in diagnosis.terms.terms:
        factor, wanted = right[part.term]
        assert part.component == body
        assert part.factor == pytest.approx(factor, abs=1e-6) and part.expected == wanted


def test_an_armature_that_is_in_all_equations_is_an_inertia_of_each_rotor() -> None:
    terms = diagnosis_of(Rig(tomllib.loads(TEXT), "armature in all")).terms
    assert terms is not None and terms.whole
    assert {(x.component, x.term) for x in terms.terms} == {("w1", "J11 e phi_ddot"), ("w2", "J11 e phi_ddot")}


def test_of_a_body_and_its_added_mass_the_body_comes_first() -> None:
    diagnosis = diagnosis_of(Rig(with_number("carrier.inertia.J33", 0.051)))
    assert diagnosis.causes[0].name == "carrier.inertia.J33"
    assert "  or, of the same effect on this stand: carrier.added_mass[5][5]" in sentences(diagnosis)


def test_what_a_term_leaves_at_large_speeds_is_said() -> None:
    diagnosis = diagnosis_of(Rig(tomllib.loads(TEXT), "spin and drag"))
    words = " ".join(sentences(diagnosis))
    assert diagnosis.verdict == "approximate" and 0.0 < diagnosis.unexplained < 1e-3
    assert "phi_dot omega x J_O e has the wrong sign" in words and "nothing is left" not in words


@pytest.mark.parametrize("path", marked(NUMBERS))
def test_a_wrong_number_is_named_with_its_value(path: str) -> None:
    diagnosis = diagnosis_of(Rig(with_number(path, NUMBERS[path])))
    (cause,) = diagnosis.causes
    assert diagnosis.verdict == "named" and cause.number is not None
    assert path in (cause.name, *cause.like)
    assert cause.name != path or cause.number[0] == NUMBERS[path]


def test_a_number_is_solved_to_the_digits_that_all_states_tell() -> None:
    diagnosis = diagnosis_of(Rig(with_number("w2.zero[1]", 0.35)), digits=6)
    (cause,) = diagnosis.causes
    assert diagnosis.verdict == "named" and cause.number is not None
    assert "w2.zero[1]" in (cause.name, *cause.like)


def test_printed_places_are_read_off_large_numbers_as_well() -> None:
    printed = Precision.of(np.array([float(f"{x:.12f}") for x in (1234.567890123456, -98765.4321, 0.1234567890123)]))
    assert (printed.name, printed.decimals) == ("12 decimals", 12)


def test_the_right_program_has_no_fault() -> None:
    assert diagnosis_of(Rig(tomllib.loads(TEXT))).verdict == "none"


def test_a_wrong_term_beside_a_wrong_reading_is_named() -> None:
    file = FOLDER / "rig.toml"
    command = f"{sys.executable} {FOLDER / 'rig.py'} {file} 'spin and about'"
    result = mahovik.judge(file, with_=command, explain=True, states=20, want="forward")
    reading, term = result["diagnosis"]["found"]
    assert result["diagnosis"]["verdict"] == "named"
    assert reading["fault"].startswith("inertia taken about the origin though it is about the centre of mass")
    assert (term["term"], term["factor"]) == ("phi_dot omega x J_O e", -1.0)


def test_the_command_names_a_number(tmp_path: Path) -> None:
    """The program is a process that speaks JSON; the number is right to the digits that it prints; JUnit has it too."""
    wrong = tmp_path / "wrong.toml"
    wrong.write_text(TEXT.replace("mass = 2.0\n", "mass = 2.01\n"), encoding="utf-8")
    file = tmp_path / "rig.toml"
    file.write_text(TEXT, encoding="utf-8")
    command, junit = f"{sys.executable} {FOLDER / 'rig.py'} {wrong}", tmp_path / "junit.xml"
    result = mahovik.judge(file, with_=command, explain=True, states=20, junit=junit)
    assert "carrier.mass: 2.01 kg explains the error to rounding (double); the file has 2" in result.messages
    suite = ET.fromstring(junit.read_text(encoding="utf-8"))
    assert suite.get("name") == "mahovik judge rig"
    assert all((case.text or "").startswith("carrier.mass: 2.01 kg explains") for case in suite.iter("failure"))
    diagnosis = result["diagnosis"]
    assert diagnosis["found"] == [
        {"number": "carrier.mass", "value": 2.01, "expected": 2.0, "unit": "kg", "share": 1.0}
    ]
