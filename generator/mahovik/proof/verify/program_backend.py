"""Answers of a stand's program by the names of `eval`, however its functions are run."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from itertools import cycle
from typing import TYPE_CHECKING, Any

import numpy as np

from mahovik.contract.functions import FUNCTIONS, TASK_TAKERS, TASK_WANTS, WANTS, hold_fault, inverse_fault, want_fault
from mahovik.contract.quantities import limits_of
from mahovik.contract.status import refusal_reason, status_words
from mahovik.core.lower.hold import OF_COORDINATES
from mahovik.core.lower.test_inputs import first_of
from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.errors import StateError

if TYPE_CHECKING:
    from mahovik.core.lower.layout import Layout
    from mahovik.core.program.function import Program

NEAR_SINGULAR_BELOW = 1e-6
"""`NEAR_SINGULAR` in eval: smallest kept singular value below this part of the first."""


_TASK_ANSWERS = {
    "inverse": ("phi_ddot", "V_dot", "residual", "sigma", "rank"),
    "torque_for": ("tau", "phi_ddot", "V_dot", "residual", "limited"),
}
"""Members of the results of a task's functions that `eval` answers; the status besides."""

Runner = Callable[[str, Mapping[str, Any]], tuple[int, dict[str, Any]]]
"""Calls a function of the program by name with plain inputs; returns its status and outputs."""


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
        """Results by the names of contract/quantities.py. Raises StateError."""
        if fault := want_fault(want) or hold_fault(want, bool(self.layout.held)):
            raise StateError(fault)
        for name in want:
            if name in TASK_WANTS and not state.task:
                raise StateError(f'want: "{name}" needs a task and its demand')
            if self.layout.held and name in OF_COORDINATES and not self.layout.coordinates:
                lacks = "whose freedoms have no coordinates" if self.layout.freedoms else "that clamps the carrier"
                raise StateError(f'want: no "{name}" of a hold {lacks}, ask for forward')
            own = self.layout.held and name == "inverse"
            if own and (fault := inverse_fault(self.layout.freedoms, self.layout.flywheels)):
                raise StateError(f"want: {fault}")
        missing = [body for body in state.wrench if body not in self.inputs]
        if missing:
            raise StateError(f'wrench: the C takes none on "{missing[0]}": set `wrench_input = true` in the stand file')
        inputs = self.arguments(state)
        results: dict[str, Any] = {}
        moved = inputs
        if state.task:
            found = self._of_task(state, inputs, "torque_for" if "torque_for" in want else "inverse")
            moved = {**inputs, "V_dot": found["V_dot"], "phi_ddot": found["phi_ddot"]}
        if any(law.invalid for law in self.layout.law_tables) or self.layout.structure.stream_stations:
            self._call("wrench", inputs)  # a state where a law is undefined has no answer to any want
        for name in want:
            if state.task and name in ("inverse", *TASK_WANTS):
                results |= found
            else:
                results |= self.answer(name, state, moved if name in TASK_TAKERS else inputs)
        return results

    def answer(self, want: str, state: State, inputs: Mapping[str, Any]) -> dict[str, Any]:
        """Results of one want, for arguments by name. Raises StateError."""
        shaped = getattr(self, f"_{want}", None)
        found: dict[str, Any] = shaped(state, inputs) if shaped else self._plain(want, inputs)
        return found

    def _plain(self, function: str, inputs: Mapping[str, Any]) -> dict[str, Any]:
        """Results of a function by name; those of a struct of results by its members."""
        outputs = self._call(function, inputs)
        found: dict[str, Any] = outputs.get("out", outputs)
        return found

    def _forward(self, state: State, inputs: Mapping[str, Any]) -> dict[str, Any]:
        return self.with_reaction(inputs, self._call("forward", inputs))

    def with_reaction(self, inputs: Mapping[str, Any], motion: dict[str, Any]) -> dict[str, Any]:
        """A motion, with its reaction where the carrier is held, and no rates of no freedoms where it is clamped.

        Accelerations that `reaction` does not take have none, as `is_beyond` says.
        """
        if not self.layout.held:
            return motion
        if is_beyond(motion):
            return {"u_dot": []} | motion
        found = self._call("reaction", {**inputs, **motion})
        return {"u_dot": []} | motion | found

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
        zero = (0.0,) * 6
        wrench = [number for body in self.inputs for number in state.wrench.get(body, zero)]
        return {
            "table": self.table_of(state.actuators) if state.actuators else self._table,
            "mounting": self.mounting,
            "x": x,
            "sine": [math.sin(phi) for phi in state.phi],
            "cosine": [math.cos(phi) for phi in state.phi],
            "V_dot": state.V_dot,
            "demand": state.demand,
            "phi_ddot": state.phi_ddot,
            "tau": state.tau,
            "locked": [0] * len(state.phi),
            "wrench": wrench,
            "options": {  # of `inverse`: by the stand file what each flywheel has, the rest by default
                **self._options,
                "weight": [1.0] * len(state.phi),
                "limit": [self.layout.precision.largest] * len(state.phi),
                "near_singular": NEAR_SINGULAR_BELOW,
                "damping": 0.0,
            },
        }

    def _call(self, function: str, inputs: Mapping[str, Any]) -> dict[str, Any]:
        status, outputs = self.call(function, inputs)
        self._refuse(status)
        return outputs

    def _refuse(self, status: int) -> None:
        """Raises StateError for a negative status."""
        if status < 0:
            name = status_words(status)
            raise StateError(f"{name}: {refusal_reason(name, 'refused')}")

    def _matrices(self, state: State, inputs: Mapping[str, Any]) -> dict[str, Any]:
        found = self._plain("matrices", inputs)
        if not self.layout.flywheels:
            found |= {"I": [[] for _ in range(6)], "J": [[] for _ in range(6)]}
        return found

    def _generalized(self, state: State, inputs: Mapping[str, Any]) -> dict[str, Any]:
        if self.layout.held:
            return self._plain("generalized", inputs)
        if state.quaternion is not None:
            raise StateError("generalized: needs angles, not a quaternion")
        angles = state.angles or (0.0, 0.0, 0.0)
        found: dict[str, Any] = self._call("generalized", {**inputs, "angles": angles})["out"]
        return found

    def _torque(self, state: State, inputs: Mapping[str, Any]) -> dict[str, Any]:
        return self._call("torque", inputs) if self.layout.flywheels else {"tau": []}

    def _mounts(self, state: State, inputs: Mapping[str, Any]) -> dict[str, Any]:
        if not self.layout.flywheels:
            return {"mount_wrench": np.zeros((0, 6))}
        flat = self._call("mounts", inputs)["mount_wrench"]
        return {"mount_wrench": [flat[i : i + 6] for i in range(0, len(flat), 6)]}

    def _coupled(self, state: State, inputs: Mapping[str, Any]) -> dict[str, Any]:
        if not self.layout.flywheels:
            return {**self._forward(state, inputs), "phi_ddot": []}
        return self.with_reaction(inputs, self._call("coupled", inputs))

    def _inverse(self, state: State, inputs: Mapping[str, Any]) -> dict[str, Any]:
        status, outputs = self.call("inverse", inputs)
        self._refuse(status)
        found = {"phi_ddot": [], "sigma": []} | outputs["out"]
        result = {name: found[name] for name in ("phi_ddot", "residual", "sigma", "rank")}
        return result | {"status": status_words(status)}

    def _of_task(self, state: State, inputs: Mapping[str, Any], want: str) -> dict[str, Any]:
        """The answer of the task of a state: accelerations (`inverse`) or torques (`torque_for`). Raises StateError."""
        rows = {task.name: len(task.rows) for task in self.layout.structure.tasks}
        if rows.get(state.task) != len(state.demand):
            raise StateError(f"demand: expected {rows.get(state.task, 0)} numbers, found {len(state.demand)}")
        status, outputs = self.call(f"{want}_{state.task}", inputs)
        self._refuse(status)
        found = {name: outputs["out"][name] for name in _TASK_ANSWERS[want]}
        return found | {"status": status_words(status)}

    def _points(self, state: State, inputs: Mapping[str, Any]) -> dict[str, Any]:
        if not self.layout.sensors:
            return {"points": {}}
        readings = self._call("points", inputs)["out"]
        return {"points": dict(zip(self.layout.sensors, readings, strict=True))}


def is_beyond(motion: Mapping[str, Any]) -> bool:
    """Whether an acceleration that results is out of the range of those that functions take."""
    for name in ("V_dot", "phi_ddot"):
        limits = cycle(limits_of(name))
        if any(not abs(x) <= limit for x, limit in zip(motion.get(name, ()), limits, strict=False)):
            return True
    return False


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
        return tuple(want for want, function in by.items() if function in public and self._has_parts(function))

    def _has_parts(self, function: str) -> bool:
        """Whether the stand has what a function needs."""
        needs = FUNCTIONS[function].needs
        return not needs or bool(getattr(self.layout, needs))

    def call(self, function: str, inputs: Mapping[str, Any]) -> tuple[int, dict[str, Any]]:
        """Calls one function with those of the inputs that it takes; returns status and outputs."""
        wanted = [a for a in self.program.function(function).arguments if a.direction != "out" and a.name in inputs]
        return self._run(function, {a.name: first_of(a, inputs[a.name]) for a in wanted})


def public_names(program: Program) -> tuple[str, ...]:
    """Names of the public functions of a program, in its order."""
    return tuple(f.name for f in program.functions if f.public)


def with_all_inputs(stand: Stand) -> Stand:
    """The stand with a run-time wrench on every body."""
    return replace(
        stand,
        carrier=replace(stand.carrier, wrench_input=True),
        instruments=tuple(replace(p, wrench_input=True) for p in stand.instruments),
        flywheels=tuple(replace(s, wrench_input=True) for s in stand.flywheels),
    )
