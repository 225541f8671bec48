"""Golden vectors of the self-test: chosen inputs, and the answers of the program's interpreter."""

from __future__ import annotations

import struct
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import islice
from math import floor, log2
from typing import Any

import numpy as np

from mahovik.contract.status import STATUS_VALUES
from mahovik.core.lower.test_inputs import (
    MASS_FACTOR,
    OMITTED_EVERY,
    OPTIONS_EVERY,
    SCALED,
    Generator,
    Input,
    draw,
    first_of,
    options_plan,
    plan,
    sweep_factors,
)
from mahovik.core.lower.trials import ALL, Changes, Path, Play, Trial, takes, trials
from mahovik.core.lower.values import Values
from mahovik.core.program.call import Argument
from mahovik.core.program.function import Function, Program
from mahovik.core.program.interpret import Interpreter, filled_value, plain
from mahovik.core.program.types import Kind, Precision, Struct, leaves, numbers

LISTED = 32
"""Numbers of an answer that are listed; the rest is in its hash alone, so that the file stays small."""

LARGEST_ANSWER = 1 << 17
"""Numbers of an answer; what gives more is not in the self-test: N^2 numbers of 1,000 flywheels fill no board's memory,
and the interpreter would take minutes to know them."""

SWEPT = 4
"""States of the sweep whose hash is known beforehand: with and without drawn options and arrays that are left out."""

FAR = 1_000_000
"""ulp; a larger distance is only printed as `more than` this, since such numbers are not neighbours."""

CASES = ("ordinary", "fast flywheels, large phases", "out of range")
"""Kinds of the golden inputs."""

_FNV_OFFSET, _FNV_PRIME = 2166136261, 16777619


@dataclass(frozen=True)
class Answer:
    """Answer of a function to one case: status, hash of status and all outputs, first outputs that are reals."""

    status: int
    hash: int
    listed: tuple[Any, ...]


@dataclass(frozen=True)
class Golden:
    """Golden inputs, and by function the answers to them and the hash of a sweep of SWEPT states."""

    plan: tuple[Input, ...]
    options_plan: tuple[Input, ...]
    inputs: tuple[dict[str, Any], ...]
    answers: dict[str, tuple[Answer, ...]]
    sweep: dict[str, int]
    trials: tuple[Trial, ...]


def fnv1a(words: Iterable[int], start: int = _FNV_OFFSET) -> int:
    """The 32-bit hash FNV-1a of bytes, or of larger numbers; `start` continues an earlier hash."""
    digest = start
    for word in words:
        digest = (digest ^ word) * _FNV_PRIME & 0xFFFFFFFF
    return digest


def golden(program: Program, values: Values) -> Golden:
    """Golden vectors of a stand's program."""
    player = Player(program, values)
    planned, public = player.plan, player.functions
    cases = tuple(_cases(planned, program.precision))
    answers: dict[str, list[Answer]] = {f.name: [] for f in public}
    for case in cases:
        values_of_case = player.arguments(case)
        for f in public:
            status, written = player.play(f, values_of_case)
            answers[f.name].append(
                Answer(
                    status, fnv1a(_bytes(status, written, program.precision)), tuple(islice(_reals(written), LISTED))
                )
            )
    return Golden(
        planned,
        options_plan(program),
        cases,
        {name: tuple(rows) for name, rows in answers.items()},
        player.sweep(SWEPT),
        trials(program, public, player.trial(cases[0])),
    )


def tested_functions(program: Program) -> tuple[Function, ...]:
    """The public functions that are in the self-test: those with answers of at most LARGEST_ANSWER numbers."""
    return tuple(
        f
        for f in program.functions
        if f.public and sum(numbers(a.type, a.shape) for a in f.arguments if a.direction != "in") <= LARGEST_ANSWER
    )


def _cases(planned: tuple[Input, ...], precision: Precision) -> Iterator[dict[str, Any]]:
    """The golden inputs, in the order of CASES, by a generator of their own."""
    generator = Generator(0x9E3779B9)
    largest_phase = 2.0 ** floor(log2(precision.max_phase))
    # each order of the time step once, whatever is drawn
    yield draw(planned, generator, precision) | {"order": 4}
    large = {"phi": largest_phase / 16.0, "phi_dot": 64.0, "V": 4.0, "V_dot": 4.0}
    yield draw(planned, generator, precision, large) | {"order": 2}
    beyond = dict.fromkeys(("angles", "phi", "position"), 2.0**40) | {"attitude": 2.0, "sine": 2.0}
    beyond |= {"dt": 0.0, MASS_FACTOR: -1.0}
    yield draw(planned, generator, precision, beyond)


class Player:
    """Calls the functions of a program with drawn inputs."""

    def __init__(self, program: Program, values: Values) -> None:
        self.plan, self._options_plan = plan(program), options_plan(program)
        self.functions = tested_functions(program)
        self._program = program
        self._values = values
        self._interpreter: Interpreter = values.interpreter
        self._constants = {
            "table": values.table,
            "mount_table": values.mounting,
            "inverse_options": values.options,
        }
        structs = {s.name: s for s in program.structs}
        # filled once: the interpreter takes a record as it is, and functions do not write into what is "in"
        self._filled = {
            name: self._interpreter.fill_storage(structs[name], value)
            for name, value in self._constants.items()
            if value is not None and name in structs
        }

    def sweep(self, states: int) -> dict[str, int]:
        """Hashes by function over a number of states."""
        precision = self._program.precision
        generator = Generator()
        hashes = {f.name: _FNV_OFFSET for f in self.functions}
        for state in range(states):
            inputs = self.arguments(draw(self.plan, generator, precision, sweep_factors(state)))
            if state % OPTIONS_EVERY == OPTIONS_EVERY - 1:
                drawn = draw(self._options_plan, generator, precision)
                inputs |= {name: {**inputs[name], **options} for name, options in drawn.items()}
            omitted = state % OMITTED_EVERY == OMITTED_EVERY - 1
            for f in self.functions:
                hashes[f.name] = fnv1a(_bytes(*self.play(f, inputs, omitted), precision), hashes[f.name])
        return hashes

    def trial(self, case: Mapping[str, Any]) -> Play:
        """What calls a function with changes of a case."""
        base = self.arguments(case)
        prepare = next((f for f in self._program.functions if f.name == "prepare"), None)

        def play(function: Function, changes: Changes) -> tuple[int, int, Mapping[str, Any]]:
            inputs = dict(base)
            for path, value in changes.items():
                inputs[str(path[0])] = _with_number(inputs[str(path[0])], path[1:], value)
            if prepare is not None and is_prepared(function, changes):
                inputs["table"] = self.play(prepare, inputs)[1][0][1]
            status, written = self.play(function, inputs)
            digest = fnv1a(_bytes(status, written, self._program.precision)) if status >= 0 else 0
            return status, digest, {a.name: value for a, value in written}

        return play

    def arguments(self, drawn: Mapping[str, Any]) -> dict[str, Any]:
        """Drawn inputs by argument name, and parameters with their masses multiplied, under the struct's name."""
        factor = self._program.precision.scalar(drawn[MASS_FACTOR])
        structs = {s.name: s for s in self._program.structs}
        parameters = _scale_masses(structs["parameters"], self._values.parameters, factor, self._program.precision)
        return {"options": self._values.options, **drawn, "parameters": parameters}

    def play(
        self, function: Function, inputs: Mapping[str, Any], omitted: bool = False
    ) -> tuple[int, list[tuple[Argument, Any]]]:
        """Status and outputs; after a refusal only the outputs that are also inputs.

        `omitted`: arguments that may be null are; a result among them stays as it was.
        """
        taken = {
            a.name: self._interpreter.argument(a) if a.optional and omitted else self._argument_value(a, inputs)
            for a in function.arguments
            if a.direction != "out"
        }
        value, outputs = self._interpreter.run(function.name, taken)
        left = (a for a in function.arguments if a.direction == "inout" and a.name not in outputs)
        outputs |= {a.name: plain(self._argument_value(a, inputs)) for a in left}
        status = int(value) if function.returns is Kind.STATUS else STATUS_VALUES["OK"]
        written = [
            (a, outputs[a.name])
            for a in function.arguments
            if a.direction == "inout" or (a.direction == "out" and status >= 0)
        ]
        if function.returns is Kind.REAL:
            written.append((Argument("value", Kind.REAL), value))
        return status, written

    def _argument_value(self, a: Argument, inputs: Mapping[str, Any]) -> Any:
        if isinstance(a.type, Struct) and a.type.name in self._constants and inputs.get(a.name) is None:
            kept = a.direction == "in"
            return self._filled[a.type.name] if kept else self._constants[a.type.name]
        return first_of(a, inputs[a.name])


def is_prepared(function: Function, changes: Changes) -> bool:
    """Whether a trial calls a function with the table that `prepare` makes of changed parameters."""
    return function.name != "prepare" and takes(function, "table") and any(p[0] == "parameters" for p in changes)


def _with_number(value: Any, path: Path, new: float) -> Any:
    """A copy of nested data with the number at a path replaced, at every index where the path says ALL."""
    if not path:
        return new
    if path[0] == ALL:
        return [_with_number(element, path[1:], new) for element in value]
    copy: Any = dict(value) if isinstance(value, Mapping) else list(value)
    copy[path[0]] = _with_number(copy[path[0]], path[1:], new)
    return copy


def _scale_masses(struct_: Struct, value: Mapping[str, Any], factor: Any, precision: Precision) -> dict[str, Any]:
    """Parameters with every mass and inertia multiplied."""

    def scale(type_: Kind | Struct, shape: tuple[Any, ...], data: Any, name: str) -> Any:
        if shape:
            return [scale(type_, shape[1:], element, name) for element in data]
        if isinstance(type_, Struct):
            return {f.name: scale(f.type, f.shape, data[f.name], f.name) for f in type_.fields}
        number = filled_value(type_, (), data, precision)
        return number * factor if name in SCALED else number

    return {f.name: scale(f.type, f.shape, value[f.name], f.name) for f in struct_.fields}


def _bytes(status: int, written: list[tuple[Argument, Any]], precision: Precision) -> bytes:
    """Bits of a status and of outputs, the lowest byte first: what is hashed."""
    real = f"<f{precision.width // 8}"
    kinds = {Kind.REAL: real, Kind.INT: "<i4"}
    values = (leaf for a, value in written for leaf in leaves(a.type, a.shape, value))
    return struct.pack("<i", status) + b"".join(np.array(value, dtype=kinds[kind]).tobytes() for kind, value in values)


def _reals(written: list[tuple[Argument, Any]]) -> Iterator[Any]:
    """The reals of outputs in the order in which they are hashed."""
    values = (leaf for a, value in written for leaf in leaves(a.type, a.shape, value))
    return (value for kind, value in values if kind is Kind.REAL)
