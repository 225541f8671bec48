"""Every member of every result, and every status bit, is compared: a wrong one fails, whatever function returns it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from functools import cache
from typing import Any

import pytest

from mahovik import stands
from mahovik.contract.functions import FUNCTIONS
from mahovik.contract.limits import LIMITS
from mahovik.contract.status import BITS, STATUS_VALUES
from mahovik.core.program.function import Function
from mahovik.core.program.types import Struct
from mahovik.core.stand import load
from mahovik.core.stand.hold import FREEDOMS
from mahovik.core.stand.model import Flywheel, Hold
from mahovik.proof.second import Second
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.compare import Case, ordinary
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.functions.table import JUDGES, checks_of
from mahovik.proof.verify.harness import judge
from mahovik.proof.verify.scales import Scales


@cache
def example(name: str) -> Case:
    """An example that takes sines and cosines of the phases, and a run-time wrench, with two states.

    `held` is demo3 on a vertical axis.
    Of sat4 the flywheels are balanced here: four of them reach three directions.
    """
    stand = load(stands.path("demo3" if name == "held" else name))
    if name == "held":
        stand = replace(stand, hold=Hold((FREEDOMS["yaw"],), (0.1, 0.0, 0.0), (0.0,) * 3, (0.0,) * 3))
    if name == "sat4":
        stand = replace(stand, flywheels=tuple(balanced(s) for s in stand.flywheels))
    stand = replace(stand, phase_input="sincos", carrier=replace(stand.carrier, wrench_input=True))
    backend = CBackend(stand)
    states = ordinary(draw(stand, 3, 12), 2)
    return Case(stand, backend, states, LIMITS["double"], Second(stand), Scales(stand), 3)


def balanced(s: Flywheel) -> Flywheel:
    (axial, _, _), (_, second, _), (_, _, third) = s.inertia
    inertia = ((axial, 0.0, 0.0), (0.0, second, 0.0), (0.0, 0.0, third))
    return replace(s, center_of_mass=(s.center_of_mass[0], 0.0, 0.0), inertia=inertia)


def case_with(function: str) -> Case:
    """A stand that has the function: demo3, but for `points` and `reaction`."""
    return example({"points": "sat4", "reaction": "held"}.get(function, "demo3"))


def cases_of_statuses(function: str) -> list[Case]:
    """Stands whose statuses together are all: demands out of reach and within it, and a deficient rank."""
    return [example(name) for name in ("demo3", "bench8", "sat4")] if function == "inverse" else [case_with(function)]


def program_function(name: str) -> Function:
    (match,) = (
        function for function in case_with(name).backend.program.functions if function.public and function.name == name
    )
    return match


def members(function: Function) -> Iterator[tuple[str, str]]:
    """Outputs and their members, "" where the output is no struct."""
    for argument in function.arguments:
        if argument.direction != "in":
            names = [field.name for field in argument.type.fields] if isinstance(argument.type, Struct) else [""]
            yield from ((argument.name, name) for name in names)


def wrong(value: Any) -> Any:
    """Every number far from what it was."""
    if isinstance(value, Mapping):
        return {name: wrong(item) for name, item in value.items()}
    if isinstance(value, list | tuple):
        return [wrong(item) for item in value]
    return value + 1 if isinstance(value, int) else value + 1.0 + abs(value)


def failed(
    monkeypatch: pytest.MonkeyPatch,
    function: str,
    fault: Callable[[int, dict[str, Any]], tuple[int, dict[str, Any]]],
    case: Case,
) -> bool:
    """Whether a row fails when a fault is put on all that a function returns; none fails without it."""
    backend, run = case.backend, case.backend._run

    def faulty(name: str, inputs: Mapping[str, Any]) -> tuple[int, dict[str, Any]]:
        status, outputs = run(name, inputs)
        return fault(status, outputs) if name == function and status >= 0 else (status, outputs)

    monkeypatch.setattr(backend, "_run", faulty)
    rows = checks_of(case, function) if function in JUDGES else []
    if FUNCTIONS[function].want and not any(row.failed for row in rows):
        rows += judge(case.stand, backend, case.states, (function,), second=case.second)
    return any(row.failed for row in rows)


def with_wrong(outputs: Mapping[str, Any], output: str, member: str) -> dict[str, Any]:
    """Outputs of which one, or one member of one, is wrong, where it is there."""
    if output not in outputs:
        return dict(outputs)
    held = outputs[output]
    if not member:
        changed = wrong(held)
    elif isinstance(held, list):
        changed = [row | {member: wrong(row[member])} for row in held]
    else:
        changed = held | {member: wrong(held[member])}
    return {**outputs, output: changed}


@pytest.mark.parametrize("name", FUNCTIONS)
def test_without_a_fault_nothing_fails(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    assert not failed(monkeypatch, name, lambda status, outputs: (status, outputs), case_with(name))


@pytest.mark.parametrize("name", FUNCTIONS)
def test_every_member_of_every_result_is_compared(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    unnoticed = []
    for output, member in members(program_function(name)):
        with monkeypatch.context() as patch:

            def fault(
                status: int, outputs: dict[str, Any], output: str = output, member: str = member
            ) -> tuple[int, dict[str, Any]]:
                return status, with_wrong(outputs, output, member)

            if not failed(patch, name, fault, case_with(name)):
                unnoticed.append(f"{name}: {output}.{member}")
    assert unnoticed == []


@pytest.mark.parametrize("name", FUNCTIONS)
def test_every_status_bit_is_compared(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    unnoticed = []
    for bit in [status for status in program_function(name).statuses if status in BITS]:
        value = STATUS_VALUES[bit]
        for words, set_bits, cleared in (("always", value, 0), ("never", 0, value)):
            with monkeypatch.context() as patch:

                def fault(actual: int, outputs: dict[str, Any], bits: tuple[int, int] = (set_bits, cleared)) -> Any:
                    return (actual | bits[0]) & ~bits[1], outputs

                if not any(failed(patch, name, fault, case) for case in cases_of_statuses(name)):
                    unnoticed.append(f"{name}: {bit} {words} set")
    assert unnoticed == []
