"""Numbers that a program leaves out are said, beside a fault too, and are never called no fault."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import cache
from typing import Any

import pytest

from mahovik.core.stand import load
from mahovik.core.stand.model import Stand
from mahovik.proof.diagnose.diagnosis import Diagnoser, Diagnosis
from mahovik.proof.diagnose.faults import DICTIONARY
from mahovik.proof.diagnose.predict import FaultyProgram, Part
from mahovik.proof.diagnose.words import as_object, sentences
from mahovik.proof.verify.states import Request
from mahovik.stands import path

Change = Callable[[Request, dict[str, Any]], None]


@cache
def stand() -> Stand:
    return load(str(path("shaker2")))


@cache
def diagnoser(*wants: str) -> Diagnoser:
    return Diagnoser(stand(), wants=wants)


def diagnosed(change: Change, *wants: str, parts: tuple[Part, ...] = ()) -> Diagnosis:
    program = FaultyProgram(stand(), parts)

    def answer(request: Request) -> Mapping[str, Any]:
        found = {
            name: value.tolist() if hasattr(value, "tolist") else value
            for name, value in program.answer(request).items()
        }
        change(request, found)
        return found

    return diagnoser(*wants).diagnose(answer)


def spoil(request: Request, found: dict[str, Any]) -> None:
    if request.want == ("forward",):
        found["V_dot"][2] = math.nan


def test_a_component_of_one_want() -> None:
    found = diagnosed(spoil)
    count = sum(request.want == ("forward",) for request in diagnoser().requests)
    first, *others = sentences(found)
    assert first == f"forward answers no number at {count} of {count} states of the diagnosis (component Z)"
    assert "no fault" not in " ".join(others)
    data = as_object(found)
    assert data["verdict"] == "unnamed"
    assert data["gaps"] == [{"want": "forward", "missing": count, "states": count, "components": {"V_dot": ["Z"]}}]


@pytest.mark.parametrize("number", [math.nan, None, math.inf])
def test_nothing_but_gaps(number: float | None) -> None:
    def change(_: Request, found: dict[str, Any]) -> None:
        found["V_dot"] = [number] * 6

    found = diagnosed(change, "forward")
    count = len(diagnoser("forward").requests)
    assert sentences(found) == [
        f"forward answers no number at {count} of {count} states of the diagnosis (all components)"
    ]


def test_another_shape_is_said_with_the_expected_one() -> None:
    def change(_: Request, found: dict[str, Any]) -> None:
        found["V_dot"] = found["V_dot"][:3]

    found = diagnosed(change, "forward", "coupled")
    first, second, *_ = sentences(found)
    assert first.startswith("forward answers another shape at ") and first.endswith("(shape [3], expected [6])")
    assert second.startswith("coupled answers another shape at ") and second.endswith(
        "(V_dot, shape [3], expected [6])"
    )
    assert as_object(found)["gaps"][0]["shapes"] == {"V_dot": [[3], [6]]}

    def missing_too(request: Request, found: dict[str, Any]) -> None:
        change(request, found)
        if "phi_ddot" in found:
            found["phi_ddot"] = None

    (gap,) = diagnosed(missing_too, "coupled").gaps
    assert "answers no number" in gap.sentence()
    assert gap.sentence().endswith("(V_dot, shape [3], expected [6]; phi_ddot, all components)")


def test_two_quantities_of_one_want() -> None:
    def change(_: Request, found: dict[str, Any]) -> None:
        found["V_dot"][0] = found["V_dot"][5] = None
        found["phi_ddot"] = None

    (gap,) = diagnosed(change, "coupled").gaps
    assert gap.sentence().endswith("(V_dot, components X N; phi_ddot, all components)")


def test_gaps_beside_a_fault() -> None:
    (fault,) = (each for each in DICTIONARY if each.name == "gravity, sign")
    states = [request.id for request in diagnoser("forward").requests][::3]

    def change(request: Request, found: dict[str, Any]) -> None:
        if request.id in states:
            found["V_dot"][1] = math.nan

    found = diagnosed(change, "forward", parts=(Part(fault),))
    words = sentences(found)
    assert words[0].startswith(f"forward answers no number at {len(states)} of ")
    assert words[1] == "fault found:"
    assert [part.fault.name for part in found.causes[0].parts] == ["gravity, sign"]


def test_a_refusal_is_no_gap() -> None:
    def change(request: Request, found: dict[str, Any]) -> None:
        if request.id == diagnoser("forward").requests[0].id:
            found.clear()

    assert diagnosed(change, "forward").gaps == ()


def test_what_failed_elsewhere_is_said() -> None:
    (line,) = sentences(Diagnosis("equal", failed=("inverse status (2 where the reference has 0)",)))
    assert "no fault" not in line
    assert "inverse status (2 where the reference has 0)" in line
