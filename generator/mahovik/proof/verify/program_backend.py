"""Evaluates the wants of a state through a stand's program, whoever runs it: compiled C or the interpreter."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, Protocol

import numpy as np

from mahovik.contract.functions import FUNCTIONS, WANTS
from mahovik.contract.status import refusal_reason, status_words
from mahovik.core.lower.layout import Layout
from mahovik.core.program.function import Program
from mahovik.core.stand.state import State
from mahovik.errors import StateError

NEAR_SINGULAR_BELOW = 1e-6
"""`NEAR_SINGULAR` in eval: smallest kept singular value below this part of the first (stand.md)."""


class Runner(Protocol):
    """Calls a function of the program by name with plain inputs; returns its status and outputs."""

    def __call__(self, function: str, inputs: Mapping[str, Any]) -> tuple[int, dict[str, Any]]: ...


class ProgramBackend:
    """Wants of a state from a program. `table`, `mounting` are what the functions take as the prepared stand."""

    def __init__(self, name: str, layout: Layout, program: Program, table: Any, mounting: Any, run: Runner) -> None:
        self.name = name
        self._mounting = mounting
        self.layout = layout
        self.program = program
        self._table = table
        self._run = run

    @property
    def mounting(self) -> Any:
        """What `mounts` takes as the prepared mountings; None without flywheels."""
        return self._mounting

    @property
    def wants(self) -> tuple[str, ...]:
        """What the program has an answer to: no points on a stand without, nothing to invert without flywheels."""
        return tuple(want for want in WANTS if want == "coupled" or self._has(FUNCTIONS[want].needs))

    def _has(self, needs: str) -> bool:
        """Whether the stand has what a row of the contract needs."""
        return not needs or bool(getattr(self.layout, needs))

    @property
    def inputs(self) -> tuple[str, ...]:
        """Bodies on which the program takes a run-time wrench."""
        return self.layout.inputs

    def evaluate(self, state: State, want: Sequence[str]) -> dict[str, Any]:
        """Results by the names of stand.md. Raises StateError."""
        for name in want:
            if name not in WANTS:
                raise StateError(f'want: unknown "{name}", expected one of {", ".join(WANTS)}')
        missing = [body for body in state.wrench if body not in self.inputs]
        if missing:
            raise StateError(f'wrench: the C takes none on "{missing[0]}": set `wrench_input = true` in the stand file')
        inputs = self.arguments(state)
        results: dict[str, Any] = {}
        if any(law.invalid for law in self.layout.law_tables):
            self._call("wrench", inputs)  # a state where a law is undefined is spoilt, whatever is wanted
        for name in want:
            answer = getattr(self, f"_{name}", None)
            results |= answer(state, inputs) if answer else self._plain(name, inputs)
        return results

    def _plain(self, function: str, inputs: Mapping[str, Any]) -> dict[str, Any]:
        """What a function gives, members of a struct of results by their names."""
        outputs = self._call(function, inputs)
        found: dict[str, Any] = outputs.get("out", outputs)
        return found

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
            "table": self._table,
            "mounting": self._mounting,
            "x": x,
            "sine": [math.sin(phi) for phi in state.phi],
            "cosine": [math.cos(phi) for phi in state.phi],
            "V_dot": state.V_dot,
            "phi_ddot": state.phi_ddot,
            "tau": state.tau,
            "locked": [0] * len(state.phi),
            "wrench": wrench,
            "options": self._options(len(state.phi), self.layout.precision.largest),
        }

    @staticmethod
    def _options(count: int, largest: float) -> dict[str, Any]:
        """Options of `inverse` by stand.md: weights 1, no damping, no limits."""
        return {"weight": [1.0] * count, "limit": [largest] * count, "near": NEAR_SINGULAR_BELOW, "damping": 0.0}

    def call(self, function: str, inputs: Mapping[str, Any]) -> tuple[int, dict[str, Any]]:
        """Calls one function with those of the inputs that it takes; returns status and outputs."""
        wanted = {a.name for a in self.program.function(function).arguments if a.direction != "out"}
        return self._run(function, {name: value for name, value in inputs.items() if name in wanted})

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
            return {**self._call("forward", inputs), "phi_ddot": []}
        return self._call("coupled", inputs)

    def _inverse(self, state: State, inputs: Mapping[str, Any]) -> dict[str, Any]:
        if not self.layout.flywheels:
            raise StateError("inverse: the generated C of a stand without flywheels has none")
        status, outputs = self.call("inverse", inputs)
        self._refuse(status)
        found = outputs["out"]
        result = {name: found[name] for name in ("phi_ddot", "residual", "sigma", "rank")}
        return result | {"status": status_words(status)}

    def _points(self, state: State, inputs: Mapping[str, Any]) -> dict[str, Any]:
        if not self.layout.sensors:
            return {"points": {}}
        readings = self._call("points", inputs)["out"]
        return {"points": dict(zip(self.layout.sensors, readings, strict=True))}
