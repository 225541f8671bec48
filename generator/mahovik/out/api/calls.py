"""Calls of the compiled C of a stand for arrays of states: inputs laid out, outputs by name, refused states."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Mapping, Sequence
from enum import IntEnum
from typing import Any, Literal, TypedDict

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mahovik.contract.functions import inverse_fault, row_of, task_of
from mahovik.contract.quantities import BOUNDS
from mahovik.contract.status import STATUS_VALUES
from mahovik.contract.status import status_words as words_of_status
from mahovik.core.program.arrays import ArgumentLayout, ArrayFunction, Member, record
from mahovik.core.stand.hold import freedom_names
from mahovik.core.stand.model import TWIST_LETTERS, WRENCH_LETTERS, Stand
from mahovik.core.stand.structure import structure
from mahovik.core.stand.task import row_name
from mahovik.core.stand.units import show
from mahovik.core.toolchain.compiled import Real, compile_library
from mahovik.errors import InputError
from mahovik.nearest import suggestion
from mahovik.out.api import inputs
from mahovik.out.api.inputs import Given
from mahovik.out.api.refusals import refusal_error
from mahovik.out.api.states import StateMaker, States
from mahovik.out.api.tables import Tables
from mahovik.out.result import Axis, Column, Result

Array = NDArray[Any]
Locks = Sequence[str] | ArrayLike
"""Names of flywheels that are locked, or a flag for each."""
OnError = Literal["raise", "nan"]


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


def status_words(status: int | Array) -> Any:
    """A status in words, as `mahovik eval` has it: `OK`, `NEAR_SINGULAR|LIMITED`; of an array a list of them."""
    if isinstance(status, np.ndarray) and status.ndim:
        return [status_words(bits) for bits in status]
    return words_of_status(int(status))


class How(TypedDict, total=False):
    """What calls of a model have in common.

    wrench    N, N m; six numbers by the name of each body, in its own frame about its origin
    tables    of `Model.tables`: state j is of the stand of sample j; one state is of all of them
    on_error  "raise": a state that the C refuses raises RefusedError; "nan": its results are NaN
    """

    wrench: Mapping[str, ArrayLike] | None
    tables: Tables | None
    on_error: OnError


_AXIS, _QUATERNION = Axis("axis", ("x", "y", "z")), Axis("quaternion", ("w", "x", "y", "z"))
_TWIST, _WRENCH = Axis("twist", tuple(TWIST_LETTERS)), Axis("wrench", tuple(WRENCH_LETTERS))
_RATES = Axis("rate", ("x", "y", "z", "psi", "theta", "phi"))
_BODY = Axis("parameter", ("mass", "x", "y", "z", "J11", "J22", "J33", "J12", "J13", "J23"))
_AXES: dict[tuple[Axis, ...], str] = {
    (_AXIS,): "position center_of_mass center_of_mass_velocity specific_force angular_acceleration",
    (_QUATERNION,): "attitude",
    (_TWIST,): "V V_dot twist V_dot_phi V_dot_phi_dot V_dot_phi_ddot V_dot_tau Y_linear Y_quadratic",
    (_TWIST, _TWIST): "V_dot_V",
    (_WRENCH,): "F I J residual reaction Y_added_mass",
    (_WRENCH, _TWIST): "K K_dot M",
    (_WRENCH, _BODY): "Y_carrier Y_flywheel",
    (_RATES,): "q_dot q_ddot",
    (_BODY,): "Y_drive",
}
_BY_NAME = {name: axes for axes, names in _AXES.items() for name in names.split()}
"""What the axes of an array count; flywheels and sensors are known by what the C says that an axis counts."""

_OF_ROWS = ("residual", "hardest", "u_dot", "q_dot", "q_ddot")
"""Results with a number for each row of a task, or for each freedom of a held carrier."""

_WITHOUT_FLYWHEELS: dict[str, dict[str, Any]] = {
    "matrices": {"I": (6, 0), "J": (6, 0)},
    "inverse": {"phi_ddot": (0,), "sigma": (0,), "limited": (0,)},
}
"""Results that the C of a stand without flywheels leaves out."""


class Calls:
    """A stand with its compiled C: calls by the names of arguments. Holds nothing that a call changes."""

    def __init__(self, stand: Stand, real: Real, compiler: str | None, threads: int) -> None:
        """See `build`."""
        self.stand, self.real, self.compiler, self.threads = stand, real, compiler, threads
        self.made = compile_library(stand, real, compiler, threads > 1, "batches", None)
        self.element = self.made.element
        self.flywheels = tuple(s.name for s in stand.flywheels)
        self._bodies = tuple(body.name for body in stand.bodies)
        self._rows = {task.name: tuple(map(row_name, task.rows)) for task in stand.tasks}
        state = next(a for f in self.made.functions.values() for a in f.arguments if a.name == "x")
        self._state = [self._column(m) for m in state.members]
        self.maker = StateMaker(stand, self._state, self.element, self._quaternions)
        self.columns = {name: list(self._columns(f)) for name, f in self.made.functions.items()}
        wheels = dict.fromkeys(("phi", "phi_dot", "phi_ddot", "tau"), self.flywheels)
        angles = ("psi", "theta", "phi")
        self._labels: dict[str, Sequence[str]] = {"V_dot": TWIST_LETTERS, "angles": angles, **wheels}

    # -- what comes out ----------------------------------------------------------------------------------------------

    def _columns(self, f: ArrayFunction) -> Iterator[Column]:
        """A column of no state for each result of a function."""
        rows = self._rows.get(task_of(f.name), ())
        of_rows = Axis("row", rows) if rows else None
        if self.stand.hold is not None:
            of_rows = Axis("freedom", tuple(freedom_names(self.stand.hold)))
        if f.name == "mounts":
            wrench = f.arguments[-1].members[0]
            axes = (Axis("flywheel", self.flywheels), _WRENCH)
            values = np.empty((0, len(self.flywheels), 6))
            yield Column("mount_wrench", wrench.unit, values, axes, meaning=wrench.meaning)
            return
        for a in f.arguments:
            for m in a.members if a.direction != "in" else ():
                for inner in m.members if m.kind == "record" else (m,):
                    one = self._column(inner, m.axes if m.kind == "record" else ())
                    yield one._replace(axes=(of_rows,)) if of_rows and one.name in _OF_ROWS else one
        for name, shape in _WITHOUT_FLYWHEELS.get(f.name, {}).items() if not self.flywheels else ():
            yield self._column(Member(name, "real", shape, (*[""] * (len(shape) - 1), "N")))

    def _column(self, member: Member, before: tuple[str, ...] = ()) -> Column:
        """The column of a member of the C, of no state; `before`: what axes count that stand before its own."""
        counted = {"N": Axis("flywheel", self.flywheels), "SENSORS": Axis("sensor", tuple(self.made.sensors))}
        known = iter(_BY_NAME.get(member.name, ()))
        axes = [counted.get(axis) or next(known, Axis(axis or member.name)) for axis in (*before, *member.axes)]
        shape = (*(len(counted[axis].labels) for axis in before), *member.shape)
        return Column(member.name, member.unit, np.empty((0, *shape)), tuple(axes), meaning=member.meaning)

    # -- calls -------------------------------------------------------------------------------------------------------

    def result(self, function: str, x: Any, how: How, **arguments: Any) -> Result:
        """The answer of a function. Raises InputError, RefusedError."""
        outputs, status, single = self._call(function, x, how, arguments)
        columns = [one._replace(values=outputs[one.name]) for one in self.columns[function]]
        columns.append(Column("status", "", status))
        refused = int(np.count_nonzero(status < 0))
        of = "a state" if single else f"{len(status)} states"
        messages = [f"{refused} of {len(status)} refused: NaN"] if refused else []
        title = f"{function} of {self.stand.name}, {of}"
        return Result(title, columns, messages=messages, ok=not refused, single=single)

    def step(
        self, function: str, x: Any, dt: float | str, order: int, carry: Array | None, how: How, **arguments: Any
    ) -> States:
        """States a step later; changes the carry. Raises InputError, RefusedError."""
        dt = inputs.time(dt, "dt")
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
        return States(self.stand.name, self._state, result["next"], single)

    def _call(
        self, function: str, x: Any, how: How, arguments: Mapping[str, Any], carry: Any = None
    ) -> tuple[dict[str, Array], NDArray[np.int32], bool]:
        """Outputs, statuses, and whether they are of a single state."""
        f = self._function(function)
        wrench, tables = how.get("wrench"), how.get("tables")
        takes = {a.name for a in f.arguments}
        for name in how:
            if name not in How.__annotations__ or name not in (*row_of(function).takes, "tables", "on_error"):
                raise TypeError(f"{function}() got an unexpected keyword argument {name!r}")
        by_body = None
        if wrench is not None or self.made.inputs:
            by_body = inputs.wrenches(wrench, self.made.inputs, self._bodies)
        parts: dict[str, Array] = {}
        alike: dict[str, Array] = {}
        for a in f.arguments:
            if a.direction != "in" or a.name in self.made.tables:
                continue
            if a.name == "x":
                parts["x"] = self.array(x)
            elif a.name == "wrench" and by_body is not None:
                parts["wrench"] = by_body
            elif a.order == "alike":
                value = arguments[a.name]
                alike[a.name] = inputs.lock_flags(value, self.flywheels) if a.name == "locked" else value
            else:
                labels = self._rows[task_of(function)] if a.name == "demand" else self._labels[a.name]
                noun = "row" if a.name == "demand" else "flywheel" if labels is self.flywheels else "component"
                parts[a.name] = inputs.read(arguments[a.name], a.name, a.components, labels, noun)
        for name in arguments.keys() - takes if not self.flywheels else ():
            inputs.read(arguments[name], name, 0, (), "flywheel")
        n = inputs.batch_size(parts)
        if tables is not None:
            n = self.check_tables(tables, n)
        if carry is not None:
            alike["carry"] = self._carry_records(f, carry, n)
        result, status = self._run(function, parts | alike, 1 if n is None else n, how.get("on_error", "raise"), tables)
        return result, status, n is None

    def _run(
        self, function: str, arguments: Mapping[str, Array], n: int, on_error: str, tables: Tables | None
    ) -> tuple[dict[str, Array], NDArray[np.int32]]:
        """Outputs by name, batch axis first, and statuses. Raises RefusedError, InputError.

        arguments  by name, as (components, n), (count,), () or a record of what is the same for all states
        tables  of n stands, one of each state; None: of the stand itself
        """
        if on_error not in ("raise", "nan"):
            raise InputError(f'on_error: expected "raise" or "nan", found {on_error!r:.40}')
        f = self.made.functions[function]
        memory: dict[str, Array] = {}
        for a in f.arguments:
            if a.name in self.made.tables:
                if tables is not None:
                    memory[a.name] = tables.block(a.name)
            elif a.name in arguments:
                value = arguments[a.name]
                in_order = a.order == "alike" or a.direction != "in"
                memory[a.name] = value if in_order else inputs.by_component(value, a.components, n, self.element)
        arrays, outputs = self.made.arrange(function, n, memory, {})
        status = np.zeros(n, dtype=np.int32)
        same = tables is None or not any(a.name in self.made.tables for a in f.arguments)  # whatever the tables
        library, name = (self.made.library, function) if same else (self.made.of_tables, f"{function}_of")
        if library.call(name, n, arrays, status, self.threads) < 0:
            if on_error == "raise":
                taken = {a.name: (a, x) for a, x in zip(f.arguments, arrays, strict=True) if a.direction == "in"}
                labels = {one.name: one.axes[0].labels for one in self._state} | self._labels
                labels["wrench"] = [f"{body} {letter}" for body in self.made.inputs for letter in WRENCH_LETTERS]
                raise refusal_error(function, status, taken, labels)
            for a, array in outputs:
                if a.direction == "out":
                    _spoil(a, array, status < 0)
        result = {name: part for a, array in outputs for name, part in _by_name(a, array)}
        if function == "mounts":
            result = {"mount_wrench": result["mount_wrench"].reshape(n, len(self.flywheels), 6)}
        if not self.flywheels:
            missing = _WITHOUT_FLYWHEELS.get(function, {}).items()
            result |= {name: np.zeros((n, *shape), self.element) for name, shape in missing}
        return result, status

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

    def array(self, x: Any) -> Array:
        """States as an array of shape (n, k) or (k,). Raises InputError."""
        components = self.maker.components
        if isinstance(x, States):
            if not x.is_like(self._state):
                raise InputError(f"states of another stand: {x!r}, expected states of {self.stand.name}")
            return x.array
        result = inputs.read(x, "states", components, (), "component")
        if result.ndim == 0:
            raise InputError(f"states: expected States or shape (n, {components}), found a number")
        return result

    def _number(self, value: Any, what: str) -> Array:
        numbers = inputs.numbers(value, what)
        if numbers.ndim:
            raise InputError(f"{what}: expected one number for all states, found shape {numbers.shape}")
        return np.array([numbers], dtype=self.element)

    def rows_of(self, task: str) -> tuple[str, ...]:
        """Names of the rows of a task. Raises InputError."""
        if task not in self._rows:
            raise InputError(f"task: unknown {show(task)}{suggestion(task, self._rows, 'the stand has none')}")
        return self._rows[task]

    def options(
        self, settings: Mapping[str, Given | None], task: str | None = None, rows: Sequence[str] | None = None
    ) -> Given:
        """The options of `inverse`: those of the stand file, and what is given instead; none without flywheels.

        task, rows  the task, and which of its rows are demanded; None: all

        Raises InputError.
        """
        if not self.flywheels:
            for name, value in settings.items():
                if value is not None and not isinstance(value, float | int):
                    inputs.read(value, name, 0, (), "flywheel")
            return []
        a = next(a for a in self._function("inverse").arguments if a.name == "options")
        result = np.zeros(1, dtype=record(a.members, self.element))
        for name, value in self.made.options.items():
            result[name] = value
        for name, value in settings.items():
            if value is None:
                continue
            if not result[name].shape[1:]:
                result[name] = self._number(value, name)
            elif isinstance(value, Mapping):
                for i, number in inputs.places(value, name, self.flywheels, "flywheel").items():
                    result[name][0, i] = self._number(number, f"{name} of {self.flywheels[i]}")[0]
            else:
                part = inputs.read(value, name, len(self.flywheels), self.flywheels, "flywheel")
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
        inner = m.members if m.kind == "record" else ()
        if a.order != "components":
            part = memory[m.name]
            yield from ((member.name, part[member.name]) for member in inner) if inner else [(m.name, part)]
            continue
        width = sum(member.numbers for member in inner) if inner else 1
        block = memory[row : row + m.numbers].reshape(*m.shape, width, memory.shape[1])
        row += m.numbers
        at = 0
        for member in inner:
            yield (
                member.name,
                np.moveaxis(
                    block[..., at : at + member.size, :].reshape(*m.shape, *member.shape, memory.shape[1]), -1, 0
                ),
            )
            at += member.size
        if not inner:
            yield m.name, np.moveaxis(block.reshape(*m.shape, memory.shape[1]), -1, 0)
