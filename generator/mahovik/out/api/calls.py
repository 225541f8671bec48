"""Calls of the compiled C of a stand for arrays of states: inputs laid out, outputs by name, refused states."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Mapping, Sequence
from enum import IntEnum
from typing import Any, Literal, TypedDict, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mahovik.contract.functions import inverse_fault, row_of, task_of
from mahovik.contract.quantities import BOUNDS
from mahovik.contract.status import STATUS_VALUES
from mahovik.contract.status import status_words as words_of_status
from mahovik.core.program.arrays import ArgumentLayout, ArrayFunction, Member, record
from mahovik.core.stand.coordinates import row_name
from mahovik.core.stand.hold import freedom_names, numbered_freedoms, twists
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import structure
from mahovik.core.stand.units import show
from mahovik.core.toolchain.compiled import Real, compile_library
from mahovik.errors import InputError
from mahovik.nearest import suggestion
from mahovik.out.api import inputs
from mahovik.out.api.inputs import PLACE, QUATERNION, TWIST, WRENCH, Given
from mahovik.out.api.states import StateMaker, StateNumbers, States
from mahovik.out.api.tables import Tables
from mahovik.out.arguments import time
from mahovik.out.result import Axis, Column, Result
from mahovik.signatures import checked

Array = NDArray[Any]
Locks = Sequence[str] | ArrayLike
"""Names of flywheels that are locked, or a flag for each."""
OnError = Literal["raise", "nan"]


def check_on_error(on_error: str) -> None:
    """Raise InputError for another word than those of OnError."""
    if on_error not in ("raise", "nan"):
        raise InputError(f'on_error: expected "raise" or "nan", found {on_error!r:.40}')


class Status(IntEnum):
    """What the C says of a state: 0 is good, positive are bits (`status & Status.LIMITED`), negative is refused."""

    OK = STATUS_VALUES["OK"]
    NEAR_SINGULAR = STATUS_VALUES["NEAR_SINGULAR"]
    DAMPED = STATUS_VALUES["DAMPED"]
    LIMITED = STATUS_VALUES["LIMITED"]
    UNREACHABLE = STATUS_VALUES["UNREACHABLE"]
    RANK_DEFICIENT = STATUS_VALUES["RANK_DEFICIENT"]
    COARSE = STATUS_VALUES["COARSE"]
    EXCESSIVE = STATUS_VALUES["EXCESSIVE"]
    NOT_FINITE = STATUS_VALUES["NOT_FINITE"]
    RANGE = STATUS_VALUES["RANGE"]
    NOT_POSITIVE_DEFINITE = STATUS_VALUES["NOT_POSITIVE_DEFINITE"]
    SINGULAR_ATTITUDE = STATUS_VALUES["SINGULAR_ATTITUDE"]
    BAD_ARGUMENT = STATUS_VALUES["BAD_ARGUMENT"]


@checked
def status_words(status: int | Array) -> Any:
    """A status in words, as `mahovik eval` has it: `OK`, `NEAR_SINGULAR|LIMITED`; of an array a list of them."""
    if isinstance(status, np.ndarray):
        return [words_of_status(bits) for bits in status.tolist()] if status.ndim else words_of_status(int(status))
    return words_of_status(status)


class How(TypedDict, total=False):
    """What calls of a model have in common.

    wrench    N, N m; six numbers by the name of each body, in its own frame about its origin
    tables    of `Model.tables`: state j is of the stand of sample j; one state is of all of them
    on_error  "raise": a state that the C refuses raises RefusedError; "nan": its results are NaN
    """

    wrench: Mapping[str, ArrayLike] | None
    tables: Tables | None
    on_error: OnError


_RATES = Axis("rate", ("x", "y", "z", "psi", "theta", "phi"))
_BODY = Axis("parameter", ("mass", "x", "y", "z", "J11", "J22", "J33", "J12", "J13", "J23"))
_AXES: dict[tuple[Axis, ...], str] = {
    (PLACE,): "position center_of_mass center_of_mass_velocity specific_force angular_acceleration",
    (QUATERNION,): "attitude",
    (TWIST,): "V V_dot twist V_dot_phi V_dot_phi_dot V_dot_phi_ddot V_dot_tau Y_linear Y_quadratic",
    (TWIST, TWIST): "V_dot_V",
    (WRENCH,): "F I J residual reaction mount_wrench Y_added_mass",
    (WRENCH, TWIST): "K K_dot M",
    (WRENCH, _BODY): "Y_carrier Y_flywheel",
    (_RATES,): "q_dot q_ddot",
    (_BODY,): "Y_drive",
}
_BY_NAME = {name: axes for axes, names in _AXES.items() for name in names.split()}
"""What the axes of an array count; flywheels and sensors are known by what the C says that an axis counts."""

_BY_ROW = {
    **dict.fromkeys(("residual", "hardest"), ("N", "N m")),
    **dict.fromkeys(("u_dot", "q_ddot"), ("m/s2", "rad/s2")),
    "q": ("m", "rad"),
    "q_dot": ("m/s", "rad/s"),
}
"""Results of freedoms of a held carrier, in units of slides and of turns; of a task's rows, which are accelerations."""

_FLYWHEEL_RESULTS: dict[str, tuple[Member, ...]] = {
    "matrices": tuple(Member(name, "real", (6, 0), ("", "N")) for name in ("I", "J")),
    "inverse": tuple(Member(name, "real", (0,), ("N",)) for name in ("phi_ddot", "sigma", "limited")),
}
"""Results that the C of a stand without flywheels leaves out."""


class Calls:
    """A stand with its compiled C: calls by the names of arguments. Holds nothing that a call changes.

    state    a column of no state for each array of `States`
    columns  of each function: a column of no state for each result
    """

    def __init__(self, stand: Stand, real: Real, compiler: str | None, threads: int) -> None:
        """See `build`."""
        self.stand, self.real, self.compiler, self.threads = stand, real, compiler, threads
        self.made = compile_library(stand, real, compiler, threads > 1, "batches", None)
        self.element = self.made.element
        self.flywheels = tuple(s.name for s in stand.flywheels)
        self._bodies = tuple(body.name for body in stand.bodies)
        self._rows = {task.name: Axis("row", tuple(map(row_name, task.rows))) for task in stand.tasks}
        self._axes = inputs.axes_of(stand)
        self._counted = {"N": self._axes["phi"], "SENSORS": Axis("sensor", tuple(self.made.sensors))}
        state = next(a for f in self.made.functions.values() for a in f.arguments if a.name == "x")
        self.state = [self._column(m) for m in state.members]
        self.maker = StateMaker(stand, self.state, self.element, self._quaternions)
        self.columns = {name: list(self._columns(f)) for name, f in self.made.functions.items()}

    # -- what comes out ----------------------------------------------------------------------------------------------

    def _columns(self, f: ArrayFunction) -> Iterator[Column]:
        """A column of no state for each result of a function."""
        for a in f.arguments:
            for m in a.members if a.direction != "in" else ():
                for inner in m.members or (m,):
                    yield self._by_row(self._column(inner, m.axes if m.members else ()), task_of(f.name))
        yield from map(self._column, _FLYWHEEL_RESULTS.get(f.name, ()) if not self.flywheels else ())

    def _by_row(self, one: Column, task: str) -> Column:
        """A column of rows of a task, or of freedoms of a held carrier, with their names and units; others as is."""
        hold = self.stand.hold
        if one.name not in _BY_ROW or not (task or hold):
            return one
        if task or hold is None:
            axis = self._rows[task]
            turns = [name.rpartition(".")[2].startswith("w") for name in axis.labels]
        else:
            kept = numbered_freedoms(hold) if one.name == "q" else range(len(hold.freedoms))
            axis = Axis("freedom", tuple(freedom_names(hold)[k] for k in kept))
            turns = [bool(twists(hold)[3:, k].any()) for k in kept]
        sliding, turning = _BY_ROW["u_dot" if task else one.name]
        units = [turning if turn else sliding for turn in turns]
        return one._replace(axes=(axis,), unit=", ".join(units if len(set(units)) > 1 else units[:1]))

    def _column(self, member: Member, before: tuple[str, ...] = ()) -> Column:
        """The column of a member of the C, of no state; `before`: what axes count that stand before its own."""
        names, shape = (*before, *member.axes), member.shape
        if member.name == "mount_wrench":  # which the C has in one row
            names, shape = ("N", ""), (len(self.flywheels), 6)
        known = iter(_BY_NAME.get(member.name, ()))
        axes = [self._counted.get(axis) or next(known, Axis(axis or member.name)) for axis in names]
        shape = (*(len(self._counted[axis].labels) for axis in before), *shape)
        return Column(member.name, member.unit, np.empty((0, *shape)), tuple(axes), meaning=member.meaning)

    # -- calls -------------------------------------------------------------------------------------------------------

    def result(self, function: str, x: Any, how: How, **arguments: Any) -> Result:
        """The answer of a function. Raises InputError, RefusedError."""
        outputs, status, single = self._call(function, x, how, arguments)
        n, refused = len(status), int(np.count_nonzero(status < 0))
        columns = []
        for one in self.columns[function]:
            values = outputs.get(one.name, np.zeros(0, self.element))  # without flywheels the C leaves out some
            columns.append(one._replace(values=values.reshape(n, *one.values.shape[1:])))
        columns.append(Column("status", "", status))
        title = f"{function} of {self.stand.name}, {'a state' if single else f'{n} states'}"
        messages = [f"{refused} of {n} refused: NaN"] if refused else []
        return Result(title, columns, messages=messages, ok=not refused, single=single)

    def step(
        self, function: str, x: Any, dt: float | str, order: int, carry: Array | None, how: How, **arguments: Any
    ) -> States:
        """States a step later; changes the carry. Raises InputError, RefusedError."""
        dt = time("dt", dt)
        if order not in (2, 4):
            raise InputError(f"order: expected 2 or 4, found {order!r:.40}")
        arguments |= {"dt": self._number(dt, "dt"), "order": np.array([order], dtype=np.int32)}
        result, status, single = self._call(function, x, how, arguments, carry)
        if carry is not None:
            carry[...] = result["rounding"].reshape(carry.shape)
        coarse = np.count_nonzero(status == STATUS_VALUES["COARSE"])
        if coarse:
            which = f" in {coarse:,} of {len(status):,} states" if len(status) > 1 else ""
            warnings.warn(
                f"{function}: COARSE{which}: a flywheel or the carrier turns by more than "
                f"{BOUNDS[f'MAX_TURN_{order}'].value:g} rad in dt = {dt:g} s; expected a smaller dt",
                RuntimeWarning,
                stacklevel=3,
            )
        return States(self.stand.name, self.state, result["next"], single)

    def _call(
        self, function: str, x: Any, how: How, arguments: Mapping[str, Any], carry: Any = None
    ) -> tuple[dict[str, Array], NDArray[np.int32], bool]:
        """Outputs, statuses, and whether they are of a single state."""
        f, tables = self._function(function), how.get("tables")
        for name in how:
            if name not in How.__annotations__ or name not in (*row_of(function).takes, "tables", "on_error"):
                raise TypeError(f"{function}() got an unexpected keyword argument {name!r}")
        values = {**arguments, "wrench": inputs.wrenches(how.get("wrench"), self.made.inputs, self._bodies), "x": x}
        parts: dict[str, Array] = {}
        alike: dict[str, Array] = {}
        for a in f.arguments:
            if a.direction != "in" or a.name in self.made.tables:
                continue
            value = values.pop(a.name)
            if a.order == "alike":
                alike[a.name] = inputs.lock_flags(value, self._counted["N"]) if a.name == "locked" else value
            elif a.name == "x":
                parts["x"] = self.array(x)
            elif a.name == "wrench":
                parts["wrench"] = value
            else:
                axis = self._rows[task_of(function)] if a.name == "demand" else self._axes[a.name]
                parts[a.name] = inputs.read(value, a.name, axis)
        for name in values.keys() & arguments.keys():  # numbers of flywheels that the stand does not have
            inputs.read(values[name], name, self._counted["N"])
        n = inputs.batch_size(parts)
        n = n if tables is None else self.check_tables(tables, n)
        if carry is not None:
            alike["carry"] = self._carry_records(f, carry, n)
        result, status = self._run(function, parts | alike, 1 if n is None else n, how.get("on_error", "raise"), tables)
        return result, status, n is None

    def _run(
        self, function: str, arguments: Mapping[str, Array], n: int, on_error: str, tables: Tables | None
    ) -> tuple[dict[str, Array], NDArray[np.int32]]:
        """Outputs by name, batch axis first, and statuses. Raises RefusedError, InputError.

        arguments  by name, as (components, n), (count,), () or a record of what is the same for all states
        tables     of n stands, one of each state; None: of the stand itself
        """
        check_on_error(on_error)
        memory: dict[str, Array] = {}
        same = True  # whatever the tables
        for a in self.made.functions[function].arguments:
            if a.name in self.made.tables and tables is not None:
                memory[a.name], same = tables.block(a.name), False
            elif a.name in arguments:
                value = arguments[a.name]
                in_order = a.order == "alike" or a.direction != "in"
                memory[a.name] = value if in_order else inputs.by_component(value, a.components, n, self.element)
        arrays, outputs = self.made.arrange(function, n, memory, {})
        status = np.zeros(n, dtype=np.int32)
        library, name = (self.made.library, function) if same else (self.made.of_tables, f"{function}_of")
        if library.call(name, n, arrays, status, self.threads) < 0:
            if on_error == "raise":
                taken = zip(self.made.functions[function].arguments, arrays, strict=True)
                labels = {key: axis.labels for key, axis in self._axes.items()}
                labels["wrench"] = tuple(f"{body} {letter}" for body in self.made.inputs for letter in WRENCH.labels)
                raise inputs.refusal_error(
                    function, status, [pair for pair in taken if pair[0].direction == "in"], labels
                )
            for a, array in outputs:
                if a.direction == "out":
                    _spoil(a, array, status < 0)
        return {name: part for a, array in outputs for name, part in _by_name(a, array)}, status

    def _quaternions(self, angles: Array) -> Array:
        """Quaternions of angles (3) or (n, 3) of the stand's sequence. Raises RefusedError."""
        quaternions, _ = self._run("quaternion", {"angles": angles}, len(np.atleast_2d(angles)), "raise", None)
        return quaternions["attitude"] if angles.ndim == 2 else quaternions["attitude"][0]

    # -- what goes in ------------------------------------------------------------------------------------------------

    def _function(self, name: str) -> ArrayFunction:
        """A function of the C. Raises InputError: this stand's has none of that name."""
        array_function = self.made.functions.get(name)
        if array_function is None:
            hold, needs = self.stand.hold, row_of(name).needs
            what = {"sensors": "instruments or points", "held": "[hold]"}.get(needs, needs)
            fault = inverse_fault(len(hold.freedoms), len(self.flywheels)) if hold and name == "inverse" else ""
            raise InputError(f"{name}: {fault or f'the stand has no {what}'}")
        return array_function

    def check_tables(self, tables: Any, n: int | None) -> int:
        """The number of states with these tables; one state stands for all. Raises InputError."""
        if not isinstance(tables, Tables):
            raise InputError(f"tables: expected what model.tables makes, found {type(tables).__name__}")
        same = tables.made_of is self.stand or structure(tables.base) == structure(self.stand)
        if tables.real != self.real or not same:
            raise InputError(f"tables of another model: {tables!r}, expected tables of {self.stand.name}, {self.real}")
        if n not in (None, len(tables)):
            raise InputError(f"different numbers of states: {n} given, tables {len(tables)}")
        return len(tables)

    def _carry_records(self, f: ArrayFunction, carry: Any, n: int | None) -> Array:
        """A carry as records, one for each state."""
        shape = (self.maker.components,) if n is None else (n, self.maker.components)
        if not isinstance(carry, np.ndarray) or carry.dtype != self.element or carry.shape != shape:
            actual = f"{carry.dtype} {carry.shape}" if isinstance(carry, np.ndarray) else type(carry).__name__
            count = "" if n is None else str(n)
            raise InputError(f"carry: expected {self.element} {shape}, found {actual}: model.carry({count}) makes one")
        a = next(a for a in f.arguments if a.name == "carry")
        records = np.zeros(1 if n is None else n, dtype=record(a.members, self.element))
        records["rounding"] = carry
        return records

    def array(self, x: States | Mapping[str, Any] | ArrayLike) -> Array:
        """States, or numbers by name that `states` takes, as an array (n, k) or (k,). Raises InputError."""
        if isinstance(x, Mapping):
            x = self.maker.states(None, cast(StateNumbers, x))
        elif not isinstance(x, States):
            x = self.maker.of_array(x)
        if x.flywheels != self.flywheels:
            raise InputError(f"states of another stand: {x!r}, expected states of {self.stand.name}")
        return x.array

    def _number(self, value: Any, what: str) -> Array:
        numbers = inputs.numbers(value, what)
        if numbers.ndim:
            raise InputError(f"{what}: expected one number for all states, found shape {numbers.shape}")
        return np.array([numbers], dtype=self.element)

    def rows_of(self, task: str) -> tuple[str, ...]:
        """Names of the rows of a task. Raises InputError."""
        if task not in self._rows:
            raise InputError(f"task: unknown {show(task)}{suggestion(task, self._rows, 'the stand has none')}")
        return self._rows[task].labels

    def options(
        self, settings: Mapping[str, Given | None], task: str | None = None, rows: Sequence[str] | None = None
    ) -> Given:
        """The options of `inverse`: those of the stand file, and what is given instead; none without flywheels.

        task, rows  the task, and which of its rows are demanded; None: all

        Raises InputError.
        """
        chosen, wheels = [(key, value) for key, value in settings.items() if value is not None], self._counted["N"]
        if not self.flywheels:
            for name, value in chosen:
                inputs.read(value, name, wheels)
            return []
        a = next(a for a in self._function("inverse").arguments if a.name == "options")
        result = np.zeros(1, dtype=record(a.members, self.element))
        for name, value in self.made.options.items():
            result[name] = value
        for name, value in chosen:
            if not result[name].shape[1:]:
                result[name] = self._number(value, name)
            elif isinstance(value, Mapping):
                for i, number in inputs.places(value, name, wheels).items():
                    result[name][0, i] = self._number(number, f"{name} of {self.flywheels[i]}")[0]
            else:
                part = inputs.read(value, name, wheels)
                if part.ndim == 2:
                    raise InputError(f"{name}: expected shape ({len(self.flywheels)},), the same for all states")
                result[name] = part
        if task is not None:
            for row in rows or ():
                if row not in (known := self.rows_of(task)):
                    raise InputError(f"rows: the task {task} has no {show(row)}{suggestion(row, known)}")
            result[f"use_{task}"] = [rows is None or row in rows for row in self.rows_of(task)]
        return result


def _spoil(a: ArgumentLayout, memory: Array, which: NDArray[np.bool_]) -> None:
    """NaN, and 0 for what is counted, where states are refused."""
    if a.order == "components":
        memory[:, which] = np.nan
        return
    for _, part in _by_name(a, memory):
        part[which] = np.nan if part.dtype.kind == "f" else 0


def _by_name(a: ArgumentLayout, memory: Array) -> Iterator[tuple[str, Array]]:
    """The arrays of an output by name, views with the batch axis first; states as the one array that they are."""
    if a.name == "next" and a.order == "components":
        yield a.name, memory
        return
    row = 0
    for m in a.members:
        if a.order != "components":
            part = memory[m.name]
            yield from ((inner.name, part[inner.name]) for inner in m.members) if m.members else [(m.name, part)]
            continue
        block, at, n = memory[row : row + m.numbers], 0, memory.shape[1]
        row += m.numbers
        if not m.members:
            yield m.name, np.moveaxis(block.reshape(*m.shape, n), -1, 0)
            continue
        block = block.reshape(*m.shape, -1, n)
        for inner in m.members:
            part = block[..., at : at + inner.size, :].reshape(*m.shape, *inner.shape, n)
            yield inner.name, np.moveaxis(part, -1, 0)
            at += inner.size
