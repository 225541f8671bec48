"""A stand with its compiled C: what it is, its states, and calls by the names of arguments."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mahovik.contract.functions import inverse_fault, row_of, task_of
from mahovik.contract.quantities import BOUNDS
from mahovik.contract.status import STATUS_VALUES
from mahovik.core.program.arrays import ArgumentLayout, ArrayFunction, record
from mahovik.core.stand.model import TWIST_LETTERS, Stand
from mahovik.core.stand.structure import structure
from mahovik.core.stand.task import row_name
from mahovik.core.stand.units import show
from mahovik.core.toolchain.compiled import Real, compile_library
from mahovik.errors import InputError
from mahovik.nearest import suggestion
from mahovik.out.api import inputs
from mahovik.out.api.call import Caller, OnError
from mahovik.out.api.fields import Array, field, functions
from mahovik.out.api.inputs import Given, wrenches
from mahovik.out.api.making_states import MakesStates
from mahovik.out.api.results import Answer
from mahovik.out.api.states import States
from mahovik.out.api.tables import Tables, make_tables

Wrenches = Mapping[str, ArrayLike] | None
Locks = Sequence[str] | ArrayLike
AnyAnswer = TypeVar("AnyAnswer", bound=Answer)


@dataclass(frozen=True)
class Offered:
    """A function of a model. `wide`: by the batch C, many states in a register; else state by state."""

    name: str
    takes: tuple[str, ...]
    gives: tuple[str, ...]
    wide: bool


class Built(MakesStates):
    """A stand with its compiled C: its states, and calls by the names of arguments."""

    def __init__(
        self, stand: Stand, real: Real, compiler: str | None, threads: int, only: tuple[str, ...] | None = None
    ) -> None:
        """`only`: functions that it has, state by state. Raises ToolchainError, UsageError, StandError."""
        self._stand = stand
        self._real = real
        self._given = (compiler, threads)
        kind: Literal["states", "batches"] = "batches" if only is None else "states"
        self._made = compile_library(stand, real, compiler, threads > 1, kind, only)
        self._element = self._made.element
        self._call = Caller(stand, self._made, self._element, threads)
        state = next(a for f in self._made.functions.values() for a in f.arguments if a.name == "x")
        self._state = tuple(field(m, stand, ()) for m in state.members)
        self._components = state.components
        self._flywheels = tuple(s.name for s in stand.flywheels)
        self._bodies = tuple(body.name for body in stand.bodies)
        self._rows = {task.name: tuple(map(row_name, task.rows)) for task in stand.tasks}
        self._labels: dict[str, tuple[str, ...]] = {
            "V_dot": TWIST_LETTERS,
            "angles": ("psi", "theta", "phi"),
            "phi_ddot": self._flywheels,
            "tau": self._flywheels,
        }

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self._stand, self._real, *self._given)

    # -- what it is --------------------------------------------------------------------------------------------------

    @property
    def stand(self) -> Stand:
        """The stand it was built of."""
        return self._stand

    @property
    def compiler(self) -> str:
        """Command of the compiler of its C."""
        return " ".join(self._made.compiler)

    @property
    def flywheels(self) -> tuple[str, ...]:
        """Names of the flywheels, in the order of all arrays."""
        return self._flywheels

    @property
    def sensors(self) -> tuple[str, ...]:
        """Names of instruments and points, in the order of `points`."""
        return self._made.sensors

    @property
    def wrenches(self) -> tuple[str, ...]:
        """Bodies that take a run-time wrench: those with `wrench_input = true` in the stand file."""
        return self._made.inputs

    @property
    def functions(self) -> tuple[Offered, ...]:
        """Functions of this stand's C."""
        found = []
        for function, f in self._made.functions.items():
            # a task is asked of `inverse`
            if "x" in row_of(function).takes and not task_of(function):
                takes = tuple(a.name for a in f.arguments if a.direction == "in" and a.name not in self._made.tables)
                gives = (
                    ("states",)
                    if "next" in row_of(function).gives
                    else tuple(g.name for g in self._call.fields(function))
                )
                found.append(Offered(function, takes, gives, f.wide))
        return tuple(found)

    def tables(self, changes: Mapping[str, Any], n: int | None = None) -> Tables:
        """Prepared tables of n stands that differ from the model's: arrays by path of the stand file.

        `{"w1.unbalance.static": array, "gravity": array}`: paths as in `Stand.replace`, arrays with the samples first,
        (n,) for a number, (n, 3) for a vector; SI, or `{"value": array, "unit": "g mm"}`; a number or a text is for all
        samples. Table j has the bits of `Stand.replace` with the values of sample j.

        Raises InputError for arrays that do not fit, UsageError for a path that leads nowhere or to another structure,
        StandError for a sample that cannot be, by its number.
        """
        return make_tables(self._stand, self._made, self._real, self._element, self._given[1], changes, n)

    # -- how ---------------------------------------------------------------------------------------------------------

    def _result(
        self,
        kind: type[AnyAnswer],
        function: str,
        x: Any,
        on_error: OnError,
        wrench: Wrenches,
        tables: Tables | None,
        **given: Any,
    ) -> AnyAnswer:
        found, status, single = self._calculate(function, x, on_error, wrench, tables, given)
        return kind(self._call.fields(function), found, status, single)

    def _step(
        self,
        function: str,
        x: Any,
        dt: float | str,
        order: int,
        on_error: OnError,
        wrench: Wrenches,
        carry: Array | None,
        tables: Tables | None,
        **given: Any,
    ) -> States:
        dt = inputs.time(dt, "dt") if isinstance(dt, str) else dt
        given |= {"dt": self._number(dt, "dt"), "order": _order(order)}
        if carry is not None:
            given["carry"] = carry
        found, status, single = self._calculate(function, x, on_error, wrench, tables, given)
        if carry is not None:
            carry[...] = found["rounding"].reshape(carry.shape)
        coarse = np.count_nonzero(status == STATUS_VALUES["COARSE"])
        if coarse:
            which = f" in {coarse:,} of {len(status):,} states" if len(status) > 1 else ""
            warnings.warn(
                f"{function}: COARSE{which}: a flywheel or the carrier turns by more than "
                f"{BOUNDS[f'MAX_TURN_{order}'].value:g} rad in dt = {dt:g} s; expected a smaller dt",
                RuntimeWarning,
                stacklevel=3,
            )
        return States(self._stand.name, self._state, found["next"], single)

    def _calculate(
        self,
        function: str,
        x: Any,
        on_error: OnError,
        wrench: Wrenches,
        tables: Tables | None,
        given: Mapping[str, Any],
    ) -> tuple[dict[str, Array], NDArray[np.int32], bool]:
        """Outputs, statuses, and whether they are of a single state."""
        f = self._function(function)
        parts: dict[str, Array] = {}
        alike: dict[str, Array] = {}
        given = dict(given)
        carry = given.pop("carry", None)
        if wrench is not None or self._made.inputs:
            by_body = wrenches(wrench, self._made.inputs, self._bodies)
        for a in f.arguments:
            if a.direction != "in" or a.name in self._made.tables:
                continue
            if a.name == "x":
                parts["x"] = self._array(x)
            elif a.name == "wrench":
                parts["wrench"] = by_body
            elif a.order == "alike":
                value = given[a.name]
                alike[a.name] = inputs.lock_flags(value, self._flywheels) if a.name == "locked" else value
            else:
                parts[a.name] = self._read(a, given[a.name], task_of(function))
        if not self._flywheels:
            for name in given.keys() - {a.name for a in f.arguments}:
                inputs.read(given[name], name, 0, (), "flywheel")
        n = inputs.batch_size(parts)
        if tables is not None:
            n = self._check_tables(tables, n)
        if carry is not None:
            alike["carry"] = self._carry_records(f, carry, n)
        found, status = self._call.run(function, parts | alike, 1 if n is None else n, on_error, tables)
        return found, status, n is None

    def _function(self, name: str) -> ArrayFunction:
        """A function of the C. Raises InputError: this stand's has none of that name."""
        found = self._made.functions.get(name)
        if found is None:
            hold, needs = self._stand.hold, row_of(name).needs
            what = {"sensors": "instruments or points", "held": "[hold]"}.get(needs, needs)
            fault = inverse_fault(len(hold.freedoms), len(self._flywheels)) if hold and name == "inverse" else ""
            raise InputError(f"{name}: {fault or f'the stand has no {what}'}")
        return found

    def _check_tables(self, tables: Any, n: int | None) -> int:
        """The number of states with these tables; one state stands for all. Raises InputError."""
        if not isinstance(tables, Tables):
            raise InputError(f"tables: expected what model.tables makes, found {type(tables).__name__}")
        same = tables.made_of is self._stand or structure(tables.base) == structure(self._stand)
        if tables.real != self._real or not same:
            raise InputError(
                f"tables of another model: {tables!r}, expected tables of {self._stand.name}, {self._real}"
            )
        if n not in (None, len(tables)):
            raise InputError(f"different numbers of states: {n} given, tables {len(tables)}")
        return len(tables)

    def _carry_records(self, f: ArrayFunction, carry: Any, n: int | None) -> Array:
        """A carry as records, one for each state."""
        shape = (self._components,) if n is None else (n, self._components)
        if not isinstance(carry, np.ndarray) or carry.dtype != self._element or carry.shape != shape:
            found = f"{carry.dtype} {carry.shape}" if isinstance(carry, np.ndarray) else type(carry).__name__
            count = "" if n is None else str(n)
            raise InputError(f"carry: expected {self._element} {shape}, found {found}: model.carry({count}) makes one")
        a = next(a for a in f.arguments if a.name == "carry")
        records = np.zeros(1 if n is None else n, dtype=record(a.members, self._element))
        records["rounding"] = carry
        return records

    def _array(self, x: Any) -> Array:
        """States as an array of shape (n, k) or (k,)."""
        if isinstance(x, States):
            if x.fields != self._state:
                raise InputError(f"states of another stand: {x!r}, expected states of {self._stand.name}")
            return x.array
        found = inputs.read(x, "states", self._components, (), "component")
        if found.ndim == 0:
            raise InputError(f"states: expected States or shape (n, {self._components}), found a number")
        return found

    def _read(self, a: ArgumentLayout, value: Any, task: str) -> Array:
        labels = self._rows[task] if a.name == "demand" else self._labels[a.name]
        noun = "row" if a.name == "demand" else "flywheel" if labels is self._flywheels else "component"
        return inputs.read(value, a.name, a.components, labels, noun)

    def _number(self, value: float, what: str) -> Array:
        found = inputs.numbers(value, what)
        if found.ndim:
            raise InputError(f"{what}: expected one number for all states, found shape {found.shape}")
        return np.array([found], dtype=self._element)

    def _demand_options(self, task: str, rows: Sequence[str] | None) -> dict[str, Array]:
        """The options that say which rows of a task are demanded: all, or those named."""
        known = self._rows[task]
        for name in rows or ():
            if name not in known:
                raise InputError(f"rows: the task {task} has no {show(name)}{suggestion(name, known)}")
        return {f"use_{task}": np.array([rows is None or name in rows for name in known], dtype=np.int32)}

    def _options(
        self,
        by_flywheel: Mapping[str, Given | None],
        numbers: Mapping[str, float | None],
        rows: Mapping[str, Array] | None = None,
    ) -> Given:
        """The options of `inverse`: those of the stand file, and what is given instead; none without flywheels."""
        if not self._flywheels:
            for name, given in by_flywheel.items():
                if given is not None:
                    inputs.read(given, name, 0, (), "flywheel")
            return []
        a = next(a for a in self._function("inverse").arguments if a.name == "options")
        found = np.zeros(1, dtype=record(a.members, self._element))
        for name, value in self._made.options.items():
            found[name] = value
        for name, given in by_flywheel.items():
            if isinstance(given, Mapping):
                for i, value in inputs.places(given, name, self._flywheels, "flywheel").items():
                    found[name][0, i] = self._number(value, f"{name} of {self._flywheels[i]}")[0]
            elif given is not None:
                part = inputs.read(given, name, len(self._flywheels), self._flywheels, "flywheel")
                if part.ndim == 2:
                    raise InputError(f"{name}: expected shape ({len(self._flywheels)},), the same for all states")
                found[name] = part
        for name, number in numbers.items():
            if number is not None:
                found[name] = self._number(number, name)
        for name, flags in (rows or {}).items():
            found[name] = flags
        return found

    def __repr__(self) -> str:
        count = self._given[1]
        how = f"{self._real}, {count} thread{'' if count == 1 else 's'}"
        return f"<Model of {self._stand.name}: {len(self._flywheels)} flywheels; {how}>"

    def _repr_html_(self) -> str:
        rows = [
            (f.name, ", ".join(f.takes), ", ".join(f.gives), "batch C" if f.wide else "C, state by state")
            for f in self.functions
        ]
        return functions(repr(self), rows)


def _order(order: int) -> Array:
    if order not in (2, 4):
        raise InputError(f"order: expected 2 or 4, found {order!r:.40}")
    return np.array([order], dtype=np.int32)
