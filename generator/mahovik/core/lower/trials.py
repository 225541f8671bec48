"""Trials of the self-test: the ordinary case with few inputs changed, into refusals and into rare branches.

Every trial is data: what is changed, which functions are called, and what the program's interpreter answers.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mahovik.contract.quantities import QUANTITIES
from mahovik.core.lower.test_inputs import inputs
from mahovik.core.program.call import Argument
from mahovik.core.program.function import Function, Program
from mahovik.core.program.types import Field, Kind, Struct

Path = tuple[str | int, ...]
"""Place of a number: name of the argument, then names of members and indices; ALL stands for every index."""

ALL = "all"

BEYOND = 2.0**60
"""Beyond the range of every input that has one."""

CHANGED = ("options", "parameters")
"""Tables that trials change, beside the inputs that are drawn."""

Changes = Mapping[Any, float]
"""Values by the place where they are put."""

Play = Callable[[Function, Changes], tuple[int, int, Mapping[str, Any]]]
"""Status, hash of status and outputs, 0 where it refuses, and outputs by name of a call with changes."""


@dataclass(frozen=True)
class Trial:
    """Changes, the functions that are called with them, and their answer."""

    changes: Changes
    functions: tuple[str, ...]
    status: int
    hash: int


def trials(program: Program, functions: Sequence[Function], play: Play) -> tuple[Trial, ...]:
    """All trials of the public functions of a program."""
    listed = [*_refusals(program, functions, play)]
    for function in functions:
        for changes in _rare(program, function, play):
            status, digest, _ = play(function, changes)
            listed.append(Trial(changes, (function.name,), status, digest))
    return tuple(listed)


def takes(function: Function, name: str) -> bool:
    """Whether a function reads an argument of that name."""
    return any(a.name == name and a.direction != "out" for a in function.arguments)


def _arguments(program: Program) -> Iterator[Argument]:
    """Arguments whose numbers trials change."""
    yield from inputs(program)
    tables = {a.name: a for f in program.functions if f.public for a in f.arguments if a.name in CHANGED}
    yield from tables.values()


def _refusals(program: Program, functions: Sequence[Function], play: Play) -> Iterator[Trial]:
    """One wrong number at a time, for all functions that refuse it with one status."""
    for a in _arguments(program):
        callers = [f for f in functions if takes(f, a.name)]
        unread: set[tuple[str, str]] = set()
        for changes in _wrong(a, (a.name,)):
            by_status: dict[int, list[str]] = {}
            member = ".".join(place for place in next(iter(changes)) if isinstance(place, str))
            for function in callers:
                if (function.name, member) in unread:
                    continue
                status = play(function, changes)[0]
                if status < 0:
                    by_status.setdefault(status, []).append(function.name)
                elif any(map(math.isnan, changes.values())):
                    unread.add((function.name, member))
            yield from (Trial(changes, tuple(names), status, 0) for status, names in by_status.items())


def _wrong(a: Argument | Field, path: Path) -> Iterator[Changes]:
    """Wrong values of an argument or member: in its first and in its last number, and what the contract names."""
    shape = [int(n) for n in a.shape]
    first, last = (*path, *(0 for _ in shape)), (*path, *(n - 1 for n in shape))
    if isinstance(a.type, Struct):
        for f in a.type.fields:
            yield from _wrong(f, (*first, f.name))
        return
    row = QUANTITIES.get(a.name)
    if a.type is Kind.REAL:
        yield {first: math.nan}
        if row is None or not row.infinite:
            yield {last: math.inf}
            yield {first: BEYOND}
        yield {last: -BEYOND}
    if row is not None and (path[0] != "parameters" or a.name == "mass"):
        yield from ({first: value} for value, _ in row.invalid)
    if path[0] == "parameters" and a.name in ("axis", "zero"):
        yield {(*path, k): 0.0 for k in range(3)}
        other = (*path[:-1], "zero" if a.name == "axis" else "axis")
        yield {(*place, k): float(k == 0) for place in (path, other) for k in range(3)}
    if path[0] == "parameters" and a.name == "inertia":
        yield from ({(*path, k): BEYOND**0.5} for k in (0, 3))
        yield from ({(*path, k): -1.0} for k in range(3))


def _rare(program: Program, function: Function, play: Play) -> Iterator[Changes]:
    """Changes that lead a function into its rare branches."""
    if takes(function, "options"):
        yield from _hard_demands(program, function, play)
    if takes(function, "order"):
        for dt in (2.0**-3, 8.0):
            yield from ({("dt",): dt, ("order",): order} for order in (2, 4))
    if takes(function, "angles"):
        yield from ({("angles", 1): angle} for angle in (0.0, math.pi / 2))
    if function.name == "wrap":
        for angle in (3.0, math.pi, 3.5, 3 * math.pi, 1000.0):
            yield from ({("phi",): sign * angle} for sign in (1.0, -1.0))


def _hard_demands(program: Program, function: Function, play: Play) -> Iterator[Changes]:
    """Options with which a demand is damped, limited, out of reach or too much; flywheels with parallel axes."""
    (options,) = (a.type for a in function.arguments if a.name == "options")
    assert isinstance(options, Struct)
    known = [f.name for f in options.fields]
    near = next(name for name in known if name.startswith("near"))
    outputs = play(function, {})[2]
    structs = (value for value in outputs.values() if isinstance(value, Mapping))
    known_answers = {name: value for mapping in (outputs, *structs) for name, value in mapping.items()}

    def largest(name: str) -> float:
        return max((abs(float(x)) for x in known_answers.get(name, ())), default=1.0)

    yield {("options", near): 1.0}
    yield {("options", near): 1.0, ("options", "damping"): 0.5}
    for share in (0.75, 0.25, 2.0**-10):
        yield {("options", "limit", ALL): share * largest("phi_ddot")}
        if "tau" in known_answers:
            yield {("options", "motor_torque", ALL): share * largest("tau")}
    yield {("options", "weight", ALL): 4.0}
    for name in ("most", "motor_torque", "motor_speed", "motor_power"):
        if name in known:
            yield {("options", name, ALL): 2.0**-10}
    asked = next(a for a in function.arguments if a.name in ("demand", "V_dot", "u_dot"))
    rest: dict[Any, float] = {("x", "V", k): 0.0 for k in range(6)} | {("x", "phi_dot", ALL): 0.5}
    rest |= {
        ("wrench", *i): 0.0 for a in function.arguments if a.name == "wrench" for i in np.ndindex(*map(int, a.shape))
    }
    for size in (2.0**-12, 2.0**-6, 1.0):
        yield rest | {(asked.name, k): size * (1 - 2 * (k % 2)) for k in range(int(asked.shape[0]))}
    if "avoid_speed" in known:
        wide = {("options", "avoid_speed"): 2.0**16, ("options", "target_rate"): 1.0}
        yield from (wide | {("options", "target_speed", ALL): speed} for speed in (-1.0, 0.0, 1.0))
    friction = {("options", name, ALL): 0.5 for name in known if name.startswith(("motor_viscous", "motor_coulomb"))}
    if friction:
        yield friction
    if all(f.name != "prepare" for f in program.functions):
        return
    parallel = {("axis", 0): 1.0, ("axis", 1): 0.0, ("axis", 2): 0.0, ("zero", 0): 0.0, ("zero", 1): 1.0}
    balanced = {("body", "center_of_mass", 1): 0.0, ("body", "center_of_mass", 2): 0.0}
    balanced |= {("body", "inertia", k): 0.0 for k in (3, 4)}
    yield {("parameters", "flywheel", ALL, *path): value for path, value in (parallel | balanced).items()}
