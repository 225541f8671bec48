"""A call of the C for arrays of states: inputs laid out, outputs made, refused states explained or made NaN."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from mahovik.contract.functions import task_of
from mahovik.contract.quantities import QUANTITIES
from mahovik.contract.status import refusal_reason, status_words
from mahovik.core.lower.limits import UNIT_SQUARE_MAX, UNIT_SQUARE_MIN, Limit, limits
from mahovik.core.lower.thresholds import thresholds
from mahovik.core.program.arrays import ArgumentLayout, ArrayFunction, Member
from mahovik.core.program.types import DOUBLE, FLOAT, Precision
from mahovik.core.stand.hold import freedom_names
from mahovik.core.stand.model import WRENCH_LETTERS, Stand
from mahovik.core.stand.task import row_name
from mahovik.core.toolchain.compiled import CompiledLibrary
from mahovik.errors import InputError, RefusedError
from mahovik.out.api.fields import Array, Field, field
from mahovik.out.api.inputs import by_component
from mahovik.out.api.tables import Tables

OnError = Literal["raise", "nan"]

OF_ROWS = ("residual", "hardest", "u_dot", "q_dot", "q_ddot")
"""Results with a number for each row of a task, or for each freedom of a held carrier."""


class Caller:
    """Calls functions of a compiled stand. Holds nothing that a call changes."""

    def __init__(self, stand: Stand, made: CompiledLibrary, real: np.dtype[Any], threads: int) -> None:
        self._stand = stand
        self._made = made
        self._real = real
        self._threads = threads
        self._fields = {name: self._of(f) for name, f in made.functions.items()}

    def fields(self, function: str) -> tuple[Field, ...]:
        """Results of a function."""
        return self._fields[function]

    def run(
        self, function: str, given: Mapping[str, Array], n: int, on_error: OnError, tables: Tables | None = None
    ) -> tuple[dict[str, Array], NDArray[np.int32]]:
        """Outputs by name, batch axis first, and statuses. Raises RefusedError, InputError.

        given   by argument, as (components, n), (count,), () or a record of what is the same for all states
        tables  of n stands, one of each state; None: of the stand itself
        """
        if on_error not in ("raise", "nan"):
            raise InputError(f'on_error: expected "raise" or "nan", found {on_error!r:.40}')
        f = self._made.functions[function]
        memory: dict[str, Array] = {}
        for a in f.arguments:
            if a.name in self._made.tables:
                if tables is not None:
                    memory[a.name] = tables.block(a.name)
            elif a.name in given:
                value = given[a.name]
                in_order = a.order == "alike" or a.direction != "in"
                memory[a.name] = value if in_order else by_component(value, a.components, n, self._real)
        arrays, outputs = self._made.arrange(function, n, memory, {})
        status = np.zeros(n, dtype=np.int32)
        same = tables is None or not any(a.name in self._made.tables for a in f.arguments)  # whatever the tables
        library = self._made.library if same else self._made.of_tables
        called = function if same else f"{function}_of"
        if library.call(called, n, arrays, status, self._threads) < 0:
            if on_error == "raise":
                inputs = {a.name: (a, x) for a, x in zip(f.arguments, arrays, strict=True) if a.direction == "in"}
                raise refusal_error(function, status, inputs, self._stand, self._made.inputs)
            for a, array in outputs:
                if a.direction == "out":
                    _spoil(a, array, status < 0)
        found: dict[str, Array] = {}
        for a, array in outputs:
            found |= _outputs_by_name(a, array)
        if function == "mounts":
            found = {"mount_wrench": found["mount_wrench"].reshape(n, len(self._stand.flywheels), 6)}
        if function == "matrices" and not self._stand.flywheels:
            found |= {"I": np.zeros((n, 6, 0), self._real), "J": np.zeros((n, 6, 0), self._real)}
        if function == "inverse" and not self._stand.flywheels:
            found |= {name: np.zeros((n, 0), self._real) for name in ("phi_ddot", "sigma")}
            found["limited"] = np.zeros((n, 0), np.int32)
        return found, status

    def _of(self, f: ArrayFunction) -> tuple[Field, ...]:
        found: list[Field] = []
        if f.name == "mounts":
            names = tuple(s.name for s in self._stand.flywheels)
            wrench = f.arguments[-1].members[0]
            return (Field("mount_wrench", (len(names), 6), wrench.unit, wrench.meaning, (names, WRENCH_LETTERS)),)
        if f.name == "matrices" and not self._stand.flywheels:
            found += [field(Member(name, "real", (6, 0), ("", "N")), self._stand, ()) for name in ("I", "J")]
        if f.name == "inverse" and not self._stand.flywheels:
            names = ("phi_ddot", "sigma", "limited")
            found += [
                field(Member(name, "int" if name == "limited" else "real", (0,), ("N",)), self._stand, ())
                for name in names
            ]
        for a in f.arguments:
            if a.direction == "in":
                continue
            for m in a.members:
                if m.kind == "record":
                    found += [field(inner, self._stand, self._made.sensors, m.axes) for inner in m.members]
                else:
                    found.append(field(m, self._stand, self._made.sensors))
        rows = {task.name: tuple(map(row_name, task.rows)) for task in self._stand.tasks}.get(task_of(f.name))
        if self._stand.hold is not None:
            rows = tuple(freedom_names(self._stand.hold))
        return tuple(replace(each, labels=(rows,)) if rows and each.name in OF_ROWS else each for each in found)


def _spoil(a: ArgumentLayout, memory: Array, which: NDArray[np.bool_]) -> None:
    """NaN, and 0 for what is counted, where states are refused."""
    if a.order == "components":
        memory[:, which] = np.nan
        return
    for m in a.members:
        inner = [memory[m.name]] if m.kind != "record" else [memory[m.name][each.name] for each in m.members]
        for part in inner:
            part[which] = np.nan if part.dtype.kind == "f" else 0


def _outputs_by_name(a: ArgumentLayout, memory: Array) -> dict[str, Array]:
    """The arrays of an output by name; states as the one array that they are."""
    if a.order == "components":
        return _by_member(a, memory)
    found: dict[str, Array] = {}
    for m in a.members:
        part = memory[m.name]
        found |= {each.name: part[each.name] for each in m.members} if m.kind == "record" else {m.name: part}
    return found


def _by_member(a: ArgumentLayout, memory: Array) -> dict[str, Array]:
    """Results ordered by component, by name with the batch axis first; states as the one array that they are."""
    if a.name == "next":
        return {a.name: memory}
    found: dict[str, Array] = {}
    row = 0
    for m in a.members:
        block = memory[row : row + m.numbers]
        row += m.numbers
        if m.kind != "record":
            found[m.name] = np.moveaxis(block.reshape(*m.shape, -1), -1, 0)
            continue
        inner, at = block.reshape(*m.shape, -1, memory.shape[1]), 0
        for each in m.members:
            part = inner[..., at : at + each.size, :]
            at += each.size
            found[each.name] = np.moveaxis(part.reshape(*m.shape, *each.shape, memory.shape[1]), -1, 0)
    return found


def refusal_error(
    function: str,
    status: NDArray[np.int32],
    inputs: Mapping[str, tuple[ArgumentLayout, Array]],
    stand: Stand,
    wrenches: Sequence[str],
) -> RefusedError:
    """The error of a call: names the first refused state, its status, and the input to blame where it can be seen."""
    bad = np.flatnonzero(status < 0)
    index = int(bad[0])
    value = int(status[index])
    name = status_words(value)
    blamed = next(
        _refusal_reasons(index, inputs, stand, wrenches), refusal_reason(name, "an option is outside its range")
    )
    which = f"state {index}: " if len(status) > 1 else ""
    more = f"; {len(bad):,} of {len(status):,} states refused" if len(bad) > 1 else ""
    message = f"{function}: {which}{name}: {blamed}{more}"
    return RefusedError(message, function, index, value, name, len(bad))


def _refusal_reasons(
    index: int, inputs: Mapping[str, tuple[ArgumentLayout, Array]], stand: Stand, wrenches: Sequence[str]
) -> Iterator[str]:
    for argument, memory in inputs.values():
        if argument.name == "dt" and not 0.0 < memory[0] <= _bounds(memory)["MAX_STEP"].value:
            yield f"dt is {memory[0]:.9g} s, expected above 0 and at most {_bounds(memory)['MAX_STEP'].value:g}"
        if argument.name == "options":
            yield from _option(argument, memory, stand)
        if argument.order != "components":
            continue
        row = 0
        for member in argument.members:
            labels = field(member, stand, ()).labels[0]
            if member.name == "wrench":
                labels = tuple(f"{body} {letter}" for body in wrenches for letter in WRENCH_LETTERS)
            column = memory[row : row + member.size, index]
            row += member.size
            yield from _wrong(member.name, column, labels, member.unit)


_NOT_NEGATIVE = ("motor_torque", "motor_viscous", "motor_coulomb", "motor_power", "target_rate", "avoid_speed")


def _option(argument: ArgumentLayout, memory: Array, stand: Stand) -> Iterator[str]:
    """Options of `inverse` that are outside their ranges."""
    least = thresholds(_precision(memory["weight"])).weight
    for member in argument.members:
        if member.kind == "int":  # rows of tasks: any number says something
            continue
        values = memory[member.name].reshape(-1).tolist()
        for i, x in enumerate(values):
            what = f"{member.name} {stand.flywheels[i].name}" if member.shape else member.name
            if member.name == "weight" and not x >= least:
                yield f"{what} is {x:.9g}, expected at least {least:g}"
            elif member.name in _NOT_NEGATIVE and not x >= 0:
                yield f"{what} is {x:.9g} {member.unit}, expected at least 0"
            elif member.name in ("limit", "most", "motor_speed", "motor_coulomb_speed") and not x > 0:
                yield f"{what} is {x:.9g} {member.unit}, expected above 0"
            elif member.name in ("near_singular", "damping") and not 0 <= x <= 1:
                yield f"{what} is {x:.9g}, expected 0 to 1"


def _wrong(name: str, column: NDArray[Any], labels: Sequence[str], unit: str) -> Iterator[str]:
    bounds = _bounds(column)
    for i, x in enumerate(column.tolist()):
        what = f"{name} {labels[i]}" if labels else f"{name}[{i}]"
        if not np.isfinite(x):
            yield f"{what} is {x}"
            continue
        names = QUANTITIES[name].bounds if name in QUANTITIES else ()
        if names and abs(x) > bounds[limit := names[i // 3 % len(names)]].value:
            yield f"{what} is {x:.9g}, at most {bounds[limit].value:g} {bounds[limit].unit}".rstrip()
    if name == "attitude" and not UNIT_SQUARE_MIN <= float(np.sum(column.astype(np.float64) ** 2)) <= UNIT_SQUARE_MAX:
        length = float(np.linalg.norm(column.astype(np.float64)))
        yield f"attitude has length {length:.9g}, expected 1 within 0.001"


def _bounds(a: Array) -> dict[str, Limit]:
    return limits(_precision(a))


def _precision(a: Array) -> Precision:
    return FLOAT if a.dtype == np.float32 else DOUBLE
