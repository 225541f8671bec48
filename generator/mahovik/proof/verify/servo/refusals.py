"""Inputs that the functions of a servo must refuse, one wrong value at a time, with all results untouched."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mahovik.contract.quantities import BOUNDS
from mahovik.contract.status import STATUS_VALUES, status_words
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.servo.folder import CompiledServo

BEYOND = 1 + 1e-6
"""Times its bound: a value out of range."""

LARGEST = {
    "phi_ref": "MAX_PHASE",
    "phi": "MAX_PHASE",
    "phi_dot_ref": "MAX_SPEED",
    "phi_dot": "MAX_SPEED",
    "tau_ff": "MAX_WRENCH",
    "tau": "MAX_WRENCH",
    "integral": "MAX_WRENCH",
    "torque": "MAX_WRENCH",
    "q": "MAX_POSITION",
    "position": "MAX_POSITION",
}
"""Bounds of the arrays, by their names."""


@dataclass(frozen=True)
class _Call:
    """A good call: arguments of C by name; names of those that may be null, and of those that only receive results."""

    function: str
    given: dict[str, Any]
    optional: tuple[str, ...] = ()
    results: tuple[str, ...] = ()


def refusal_rows(made: CompiledServo, functions: Sequence[str]) -> Iterator[Check]:
    """A row for each of these functions."""
    for call in _calls(made):
        if call.function in functions:
            yield _row(made, call)


def _calls(made: CompiledServo) -> Iterator[_Call]:
    ffi, n = made.library.ffi, made.count

    def numbers(count: int = n, value: float = 0.125) -> Any:
        return made.reals(np.full(count, value))

    def state(kind: str) -> Any:
        return ffi.new(f"{made.prefix}_{kind} *")

    wanted = {name: numbers() for name in ("phi_ref", "phi_dot_ref", "tau_ff", "phi", "phi_dot")}
    sample = {"gains": made.library.default("servo_default"), "state": state("servo_state"), **wanted}
    yield _Call("servo_reset", {"state": state("servo_state")})
    yield _Call("servo_step", {**sample, "invalid": ffi.NULL, "tau": numbers()}, ("invalid",), ("tau",))
    if not made.has_trim:
        return
    design = made.library.default("trim_default")
    many = len(made.default("trim_default")["target"])
    given = {"design": design, "state": state("trim_state"), "phase": 0.25, "q": numbers(many)}
    yield _Call("trim_reset", {"state": state("trim_state")})
    yield _Call("trim_step", given | {name: numbers() for name in ("phi", "phi_dot", "tau")})
    if not made.library.has("trim_coordinates"):
        return  # of a held carrier, which has them from the stand's C
    pose = {"position": numbers(3), "attitude": made.reals(np.array([1.0, 0.0, 0.0, 0.0])), "q": numbers(many)}
    yield _Call("trim_coordinates", pose, results=("q",))


def _row(made: CompiledServo, call: _Call) -> Check:
    row = Check(call.function, "bad inputs refused, results untouched")
    for words, status, found, untouched in _outcomes(made, call):
        right = found == STATUS_VALUES[status]
        wrong = "refused, but results were written" if right else f"status {status_words(found)}, expected {status}"
        row.demand(right and untouched, words, wrong)
    return row


def _outcomes(made: CompiledServo, call: _Call) -> Iterator[tuple[str, str, int, bool]]:
    """Each wrong value in words, the status that is due, the status found, and whether nothing was written."""
    ffi = made.library.ffi
    for name, value in call.given.items():
        if not isinstance(value, ffi.CData):
            for wrong, status in _wrong_phases():
                yield f"{name} = {wrong:g}", status, *_call_with(made, call, {name: wrong})
            continue
        if name not in call.optional:
            yield f"{name} null", "BAD_ARGUMENT", *_call_with(made, call, {name: ffi.NULL})
        if name in call.results or name in call.optional:
            continue
        kind = ffi.typeof(value).item
        if kind.kind == "primitive":
            yield from _wrong_numbers(made, call, name, value)
        elif name == "state" and call.function in ("servo_step", "trim_step"):
            yield from _wrong_states(made, call, value)


def _wrong_phases() -> tuple[tuple[float, str], ...]:
    return (
        *((each, "NOT_FINITE") for each in (math.nan, math.inf, -math.inf)),
        *((each, "RANGE") for each in (1.0, -0.01, 7.0)),
    )


def _wrong_values(made: CompiledServo, name: str) -> list[tuple[float, str]]:
    """Values of the elements of an array that must be refused."""
    found = [(each, "NOT_FINITE") for each in (math.nan, math.inf, -math.inf)]
    if name == "attitude":
        return [*found, (1.01, "RANGE"), (3.0, "RANGE")]
    largest = 2 * BOUNDS["MAX_SPEED"].value if name == "speed" else BOUNDS[LARGEST[name]].at(made.real)
    return [*found, (BEYOND * largest, "RANGE"), (-BEYOND * largest, "RANGE")]


def _wrong_numbers(made: CompiledServo, call: _Call, name: str, array: Any) -> Iterator[tuple[str, str, int, bool]]:
    for i in range(len(array)):
        good = array[i]
        for wrong, status in _wrong_values(made, name):
            array[i] = wrong
            yield f"{name}[{i}] = {wrong:g}", status, *_call_with(made, call, {})
            array[i] = good


def _wrong_states(made: CompiledServo, call: _Call, state: Any) -> Iterator[tuple[str, str, int, bool]]:
    """Numbers of the servo's state like those of arrays; counts of the trim's that it never makes."""
    if call.function == "servo_step":
        for name in ("integral", "speed", "torque"):
            yield from _wrong_numbers(made, call, name, getattr(state, name))
        return
    design = made.default("trim_default")
    end = int(design["settling"]) + int(design["window"]) + made.count
    for name, wrong in (("sample", -1), ("sample", end), ("rounds", -1)):
        setattr(state, name, wrong)
        yield f"{name} = {wrong}", "BAD_ARGUMENT", *_call_with(made, call, {})
        setattr(state, name, 0)


def _call_with(made: CompiledServo, call: _Call, other: dict[str, Any]) -> tuple[int, bool]:
    """Status of the call with other arguments, and whether every byte that it may write is as before."""
    ffi = made.library.ffi
    given = call.given | other
    held = [each for each in call.given.values() if isinstance(each, ffi.CData) and each != ffi.NULL]
    before = [bytes(ffi.buffer(each)) for each in held]
    status = made.call(call.function, *given.values())
    return status, all(bytes(ffi.buffer(each)) == old for each, old in zip(held, before, strict=True))
