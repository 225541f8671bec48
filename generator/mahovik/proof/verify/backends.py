"""What answers states by the names of `eval`: the references, and a stand's program, however its functions are run."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from itertools import cycle
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mahovik.contract.evaluation import answers_of
from mahovik.contract.functions import FUNCTIONS, TASK_TAKERS, TASK_WANTS, WANTS, hold_fault, inverse_fault, want_fault
from mahovik.contract.quantities import limits_of
from mahovik.contract.status import refusal_reason, status_words
from mahovik.core.lower.hold import OF_COORDINATES
from mahovik.core.lower.layout import Layout, run_time_inputs
from mahovik.core.lower.test_inputs import first_of
from mahovik.core.program.arrays import ArgumentLayout, record
from mahovik.core.program.types import DOUBLE, FLOAT
from mahovik.core.stand.model import Stand, State
from mahovik.core.stand.structure import structure
from mahovik.core.toolchain.compiled import Real, compile_library
from mahovik.errors import StateError
from mahovik.proof import reference
from mahovik.proof.verify.states import stand_at

if TYPE_CHECKING:
    from mahovik.core.program.function import Program
    from mahovik.proof.second import Second

NEAR_SINGULAR_BELOW = 1e-6
"""`NEAR_SINGULAR` in eval: smallest kept singular value below this part of the first."""

Runner = Callable[[str, Mapping[str, Any]], tuple[int, dict[str, Any]]]
"""Calls a function of the program by name with plain inputs; returns its status and outputs."""

WITHOUT_FLYWHEELS = {"coupled": "forward", "torque": "", "mounts": ""}
"""Functions that answer these wants on a stand without flywheels, whose C lacks theirs."""

EMPTY: Mapping[str, Any] = {
    "I": [[]] * 6, "J": [[]] * 6, "phi_ddot": [], "tau": [], "mount_wrench": [], "sigma": [], "points": [],
}  # fmt: skip
"""Members of answers that the C of a stand without flywheels, freedoms or points lacks."""


class NumpyBackend:
    """The literal reference of (1)-(13)."""

    name = "numpy"

    def __init__(self, stand: Stand) -> None:
        self._stand = stand

    def evaluate(self, state: State, want: Sequence[str]) -> dict[str, Any]:
        """See Backend."""
        try:
            return reference.evaluate(stand_at(self._stand, state), state, want)
        except (np.linalg.LinAlgError, ArithmeticError) as error:  # masses of 1e200 and the like
            raise StateError(f"the equations have no finite solution at this state: {error}") from None


class CasadiBackend:
    """The second derivation; with the deflections and speeds of a state it is made again."""

    name = "casadi"

    def __init__(self, stand: Stand, second: Second | None = None) -> None:
        from mahovik.proof.second import Second

        self._stand, self._make = stand, Second
        # numbers of actuators are part of its expressions
        self._made: dict[tuple[tuple[str, float], ...], Second] = {(): second or Second(stand)}

    def evaluate(self, state: State, want: Sequence[str]) -> dict[str, Any]:
        """See Backend."""
        key = tuple(state.actuators.items())
        if key not in self._made:
            self._made[key] = self._make(stand_at(self._stand, state))
        return self._made[key].evaluate(state, want)


class FunctionBackend(ABC):
    """Answers by the functions of a stand's C, whoever runs them.

    `table`, `mounting`: the prepared stand as the functions take it; no mounting without flywheels. `options`: of
    `inverse`, by the stand file.
    """

    def __init__(self, name: str, layout: Layout, table: Any, mounting: Any, options: Any = None) -> None:
        self.name = name
        self.mounting = mounting
        self.layout = layout
        self._table = table
        self._options = options or {}

    @abstractmethod
    def call(self, function: str, inputs: Mapping[str, Any]) -> tuple[int, dict[str, Any]]:
        """Calls one function with those of the inputs that it takes; returns status and outputs."""

    @property
    def inputs(self) -> tuple[str, ...]:
        """Bodies on which the program takes a run-time wrench."""
        return self.layout.inputs

    def evaluate(self, state: State, want: Sequence[str]) -> dict[str, Any]:
        """Results by the names of the contract. Raises StateError."""
        if fault := want_fault(want) or hold_fault(want, bool(self.layout.held)) or self._fault(state, want):
            raise StateError(fault)
        inputs = moved = self.arguments(state)
        results: dict[str, Any] = {}
        of_task: dict[str, Any] = {}
        if state.task:
            name = "torque_for" if "torque_for" in want else "inverse"
            of_task = _members(self._call(f"{name}_{state.task}", inputs), answers_of(name, task=True))
            moved = {**inputs, "V_dot": of_task["V_dot"], "phi_ddot": of_task["phi_ddot"]}
        if any(law.invalid for law in self.layout.law_tables) or self.layout.structure.stream_stations:
            self._call("matrices", inputs)  # a state where a law is undefined has no answer to any want
        for name in want:
            if of_task and name in ("inverse", *TASK_WANTS):
                results |= of_task
            else:
                results |= self.answer(name, state, moved if name in TASK_TAKERS else inputs)
        return results

    def _fault(self, state: State, want: Sequence[str]) -> str:
        """Why the C has no answer to these wants, in words; "" where it has."""
        layout = self.layout
        for name in want:
            if name in TASK_WANTS and not state.task:
                return f'want: "{name}" needs a task and its demand'
            if layout.held and name in OF_COORDINATES and not layout.coordinates:
                lacks = "whose freedoms have no coordinates" if layout.freedoms else "that clamps the carrier"
                return f'want: no "{name}" of a hold {lacks}, ask for forward'
            if layout.held and name == "inverse" and (fault := inverse_fault(layout.freedoms, layout.flywheels)):
                return f"want: {fault}"
        for body in state.wrench:
            if body not in self.inputs:
                return f'wrench: the C takes none on "{body}": set `wrench_input = true` in the stand file'
        if "generalized" in want and not layout.held and state.quaternion is not None:
            return "generalized: needs angles, not a quaternion"
        rows = {task.name: len(task.rows) for task in layout.structure.tasks}.get(state.task, 0)
        if state.task and rows != len(state.demand):
            return f"demand: expected {rows} numbers, found {len(state.demand)}"
        return ""

    def answer(self, want: str, state: State, inputs: Mapping[str, Any]) -> dict[str, Any]:
        """Results of one want, for arguments by name. Raises StateError."""
        layout = self.layout
        function = want if layout.flywheels else WITHOUT_FLYWHEELS.get(want, want)
        values = self._call(function, inputs) if function and (want != "points" or layout.sensors) else {}
        if want in ("forward", "coupled"):
            values = self.with_reaction(inputs, values)
        values = {**EMPTY, **values}
        values["points"] = dict(zip(layout.sensors, values["points"], strict=False))
        values["mount_wrench"] = np.reshape(values["mount_wrench"], (-1, 6)).tolist()
        return _members(values, answers_of(want, bool(layout.held)))

    def with_reaction(self, inputs: Mapping[str, Any], motion: dict[str, Any]) -> dict[str, Any]:
        """A motion, with its reaction where the carrier is held, and no rates of no freedoms where it is clamped.

        Accelerations that `reaction` does not take have none, as `is_beyond` says.
        """
        if not self.layout.held:
            return motion
        return {"u_dot": []} | motion | ({} if is_beyond(motion) else self._call("reaction", {**inputs, **motion}))

    def table_of(self, actuators: Mapping[str, float]) -> Any:
        """The table with other deflections and speeds. Raises StateError: a backend without them."""
        raise StateError("actuators: this C has neither fins nor propellers to set, expected a stand with them")

    def arguments(self, state: State) -> dict[str, Any]:
        """A state as arguments of the program's functions, by name."""
        if state.quaternion is not None:
            attitude: Any = state.quaternion
        elif state.angles is not None:
            attitude = self._call("quaternion", {"angles": state.angles})["attitude"]
        else:
            attitude = (1.0, 0.0, 0.0, 0.0)
        x = {"position": state.position, "attitude": attitude, "V": state.V}
        if self.layout.flywheels:
            x |= {"phi": state.phi, "phi_dot": state.phi_dot}
        wrench = [number for body in self.inputs for number in state.wrench.get(body, (0.0,) * 6)]
        return {
            "table": self.table_of(state.actuators) if state.actuators else self._table,
            "mounting": self.mounting,
            "x": x,
            "angles": state.angles or (0.0, 0.0, 0.0),
            "V_dot": state.V_dot,
            "demand": state.demand,
            "phi_ddot": state.phi_ddot,
            "tau": state.tau,
            "locked": [0] * len(state.phi),
            "wrench": wrench,
            "options": {**self._options, "near_singular": NEAR_SINGULAR_BELOW},
        }

    def _call(self, function: str, inputs: Mapping[str, Any]) -> dict[str, Any]:
        """Outputs of a function by name, and its status in words. Raises StateError where it refuses the state."""
        status, outputs = self.call(function, inputs)
        name = status_words(status)
        if status < 0:
            raise StateError(f"{name}: {refusal_reason(name, 'refused')}")
        members = outputs.get("out", outputs)  # of a struct of results
        return {**members, "status": name} if isinstance(members, Mapping) else {"points": members}


def _members(values: Mapping[str, Any], names: Sequence[str]) -> dict[str, Any]:
    """Those of the values that have these names, in their order."""
    return {name: values[name] for name in names if name in values}


def is_beyond(motion: Mapping[str, Any]) -> bool:
    """Whether an acceleration that results is out of the range of those that functions take."""
    pairs = [(motion.get(name, ()), cycle(limits_of(name))) for name in ("V_dot", "phi_ddot")]
    return any(not abs(x) <= limit for values, limits in pairs for x, limit in zip(values, limits, strict=False))


class ProgramBackend(FunctionBackend):
    """Answers of a program, run as compiled C or by the interpreter."""

    def __init__(
        self, name: str, layout: Layout, program: Program, table: Any, mounting: Any, run: Runner, options: Any = None
    ) -> None:
        super().__init__(name, layout, table, mounting, options)
        self.program = program
        self._run = run

    @property
    def wants(self) -> tuple[str, ...]:
        """Wants that the program answers: no `points` on a stand without points, none whose function is left out."""
        return self.wants_of(self.program)

    def wants_of(self, program: Program) -> tuple[str, ...]:
        """Wants that the public functions of a program of this stand answer."""
        public = public_names(program)
        by = {want: want for want in WANTS} | ({} if self.layout.flywheels else {"coupled": "forward"})
        needs = {want: FUNCTIONS[function].needs for want, function in by.items() if function in public}
        return tuple(want for want, part in needs.items() if not part or getattr(self.layout, part))

    def call(self, function: str, inputs: Mapping[str, Any]) -> tuple[int, dict[str, Any]]:
        """Calls one function with those of the inputs that it takes; returns status and outputs."""
        wanted = [a for a in self.program.function(function).arguments if a.direction != "out" and a.name in inputs]
        return self._run(function, {a.name: first_of(a, inputs[a.name]) for a in wanted})


class KeptBackend(FunctionBackend):
    """Answers of a stand's C, compiled at the first use of its structure and kept from command to command.

    A state with a run-time wrench that the C does not take is evaluated by the C of the same stand with an input on
    every body. Raises ToolchainError, UsageError, StandError.
    """

    def __init__(self, stand: Stand, real: Real) -> None:
        self._stand, self._real = stand, real
        self.made = compile_library(stand, real, kind="states")
        layout = Layout(structure(stand), FLOAT if real == "float" else DOUBLE)
        super().__init__("c", layout, None, None, self.made.options)

    @cached_property
    def full(self) -> KeptBackend:
        """The C of the same stand with a run-time wrench on every body."""
        stand = with_all_inputs(self._stand)
        return self if stand == self._stand else KeptBackend(stand, self._real)

    def evaluate(self, state: State, want: Sequence[str]) -> dict[str, Any]:
        """See FunctionBackend. What the reference refuses as well is refused in its words."""
        if not (set(state.wrench) <= set(self.inputs) or self.full is self):
            return self.full.evaluate(state, want)
        try:
            return super().evaluate(state, want)
        except StateError:
            NumpyBackend(self._stand).evaluate(state, want)
            raise

    def table_of(self, actuators: Mapping[str, float]) -> Any:
        """The table with other deflections and speeds, by name."""
        table = self.made.tables["table"].copy()
        for item in run_time_inputs(self.layout.structure):
            for k, name in enumerate(item.names):
                if name in actuators:
                    table[item.array][item.member][0, k] = actuators[name]
        return table

    def call(self, function: str, inputs: Mapping[str, Any]) -> tuple[int, dict[str, Any]]:
        """Calls one function with those of the inputs that it takes; returns status and outputs."""
        f, arguments = self.made.functions[function], {}
        for a in f.arguments:
            if a.name == "table" and inputs.get("table") is not None:
                arguments[a.name] = inputs["table"]
            elif a.direction == "in" and a.name not in self.made.tables:
                arguments[a.name] = _memory(a, self.made.element, inputs[a.name])
        arrays, results = self.made.arrange(function, 1, arguments, {})
        status = np.zeros(1, dtype=np.int32)
        self.made.library.call(function, 1, arrays, status)
        return int(status[0]), {a.name: _plain(a, memory, self.made.element) for a, memory in results}


def _memory(a: ArgumentLayout, element: np.dtype[Any], value: Any) -> NDArray[Any]:
    """Memory of an argument of one state, with its value."""
    memory = np.zeros(1, dtype=record(a.members, element))
    for m in a.members:
        memory[m.name] = value[m.name] if isinstance(value, Mapping) else value
    return memory


def _plain(a: ArgumentLayout, memory: NDArray[Any], element: np.dtype[Any]) -> Any:
    """A result of one state as plain data: numbers, lists, dicts by member."""
    row = memory.reshape(-1).view(record(a.members, element))[0]
    result = {
        m.name: (
            [{inner.name: entry[inner.name].tolist() for inner in m.members} for entry in row[m.name]]
            if m.kind == "record"
            else row[m.name].tolist()
        )
        for m in a.members
    }
    return result[a.name] if [*result] == [a.name] and len(result) == 1 else result


def turns(state: State) -> dict[str, Any]:
    """Sines and cosines of the phases, which functions take of a stand with `phase_input = "sincos"`."""
    return {"sine": [math.sin(phi) for phi in state.phi], "cosine": [math.cos(phi) for phi in state.phi]}


def public_names(program: Program) -> tuple[str, ...]:
    """Names of the public functions of a program, in its order."""
    return tuple(f.name for f in program.functions if f.public)


def with_all_inputs(stand: Stand) -> Stand:
    """The stand with a run-time wrench on every body."""
    return replace(
        stand,
        carrier=replace(stand.carrier, wrench_input=True),
        instruments=tuple(replace(body, wrench_input=True) for body in stand.instruments),
        flywheels=tuple(replace(body, wrench_input=True) for body in stand.flywheels),
    )
