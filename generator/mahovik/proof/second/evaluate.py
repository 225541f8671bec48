"""The second derivation as a backend of the evaluation contract."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cached_property
from typing import Any

import casadi as ca
import numpy as np

from mahovik.contract import laws
from mahovik.contract.functions import hold_fault, want_fault, wants_of
from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof.second import coordinates, hold, points, problems
from mahovik.proof.second.chart import Expr
from mahovik.proof.second.kinematics import generalized
from mahovik.proof.second.rotation import Array, attitude
from mahovik.proof.second.stream import check_depth
from mahovik.proof.second.system import System

PROBLEMS: dict[str, Callable[[System], dict[str, Expr]]] = {
    "momentum": problems.momentum,
    "forward": problems.forward,
    "torque": problems.torque,
    "coupled": problems.coupled,
    "points": points.points,
    "reaction": hold.reaction,
}
"""Wants that are CasADi functions of the state."""

OF_HELD: dict[str, Callable[[System], dict[str, Expr]]] = {"forward": hold.forward, "coupled": hold.coupled}
"""Wants that a held carrier answers in its freedoms."""

WANTS = wants_of("second")
"""Wants of the second derivation: those of PROBLEMS, and `generalized`."""

Values = dict[str, Any]


class Second:
    """The second derivation of one stand. CasADi functions are built where they are first asked for, and kept."""

    name = "casadi"

    def __init__(self, stand: Stand) -> None:
        self.stand = stand
        self._functions: dict[str, Expr] = {}

    @cached_property
    def system(self) -> System:
        """The stand's equations as expressions."""
        return System(self.stand)

    def function(self, want: str) -> Expr:
        """The CasADi function of a want of PROBLEMS.

        Inputs by the names of `System.inputs`; results by theirs after the want's: `forward_V_dot`, `points_C`.
        """
        if want not in self._functions:
            problem = PROBLEMS[want] if self.stand.hold is None else OF_HELD.get(want, PROBLEMS[want])
            found = problem(self.system)
            inputs = self.system.inputs
            self._functions[want] = ca.Function(
                want, list(inputs.values()), list(found.values()), list(inputs), [f"{want}_{name}" for name in found]
            )
        return self._functions[want]

    def evaluate(self, state: State, want: Sequence[str]) -> Values:
        """What `want` names, under the names of the contract: arrays in SI, V and V_dot relative to E0, in E1.

        Raises StateError for wants that are unknown, not there or contradict each other, a state that does not fit the
        stand or the want, one where a law is undefined, what CasADi refuses, and results that are not finite.
        """
        for name in want:
            if name not in WANTS:
                raise StateError(f"want: the second derivation (casadi) has no {name!r}; it has " + ", ".join(WANTS))
        if fault := want_fault(want) or hold_fault(want, self.stand.hold is not None):
            raise StateError(fault)
        if state.task:
            raise StateError("task: the second derivation has no tasks, ask the backends c or numpy")
        if self.stand.hold is not None:
            state = hold.held_state(self.stand.hold, state)
        self._check_state(state)
        check_depth(self.stand, state)
        with np.errstate(all="ignore"):  # what is not finite is found below
            inputs = self.arguments(state)
            found: Values = {}
            for each in want:
                try:
                    found |= self._generalized(state, inputs) if each == "generalized" else self._solve(each, inputs)
                except RuntimeError as error:  # as CasADi raises them
                    raise StateError(f"{each}: {' '.join(str(error).split())[:200]}") from None
        for name, value in found.items():
            if not _finite(value):
                raise StateError(f"{name}: not finite at this state")
        return found

    def arguments(self, state: State) -> dict[str, Any]:
        """Arguments of the functions at a state, by name: those of `System.inputs`. Raises StateError."""
        stand = self.stand
        C = attitude(stand.angles, state)
        own: dict[str, Any] = {}
        for law in laws.parts("second"):
            own |= law.arguments(stand, state, C)
        names = ("position", "V", "V_dot", "phi", "phi_dot", "phi_ddot", "tau")
        return {
            **{name: np.array(getattr(state, name), dtype=np.float64) for name in names},
            "C": C,
            "wrench": np.column_stack([state.wrench.get(body.name, np.zeros(6)) for body in stand.bodies]),
            **own,
        }

    def _solve(self, want: str, inputs: dict[str, Any]) -> Values:
        if want == "points" and not points.names(self.stand):
            return {"points": {}}
        if want == "momentum" and not any(body.mass for body in self.stand.bodies):
            raise StateError("momentum: no body of the stand has a mass, so there is no center_of_mass")
        found = self.function(want)(**inputs)
        values = {name.removeprefix(f"{want}_"): value.full() for name, value in found.items()}
        if want == "points":
            return {"points": self._by_point(values)}
        return {name: float(value[0, 0]) if name == "energy" else value[:, 0] for name, value in values.items()}

    def _by_point(self, values: dict[str, Array]) -> dict[str, dict[str, Array]]:
        names = points.names(self.stand)
        split = {name: np.split(value, len(names), axis=1) for name, value in values.items()}
        return {
            point: {name: split[name][k] if name == "C" else split[name][k][:, 0] for name in points.QUANTITIES}
            for k, point in enumerate(names)
        }

    def _generalized(self, state: State, inputs: dict[str, Any]) -> Values:
        if self.stand.hold is not None:
            V_dot = self._solve("forward", inputs)["V_dot"]
            where = (state.position, inputs["C"], state.V, V_dot)
            return coordinates.generalized(self.stand.hold, self.stand.angles, *where)
        if state.quaternion is not None:
            raise StateError("quaternion: `generalized` needs `angles`")
        V_dot = self._solve("forward", inputs)["V_dot"]
        try:
            return generalized(self.stand.angles, state.angles or (0.0, 0.0, 0.0), inputs["V"], V_dot)
        except np.linalg.LinAlgError as error:
            raise StateError(f"generalized: {error}") from None

    def _check_state(self, state: State) -> None:
        N = len(self.stand.flywheels)
        for name, count in (("V", 6), ("V_dot", 6), ("phi", N), ("phi_dot", N), ("phi_ddot", N), ("tau", N)):
            found = len(getattr(state, name))
            if found != count:
                raise StateError(f"{name}: expected {count} numbers, found {found}")
        names = [body.name for body in self.stand.bodies]
        for name in state.wrench:
            if name not in names:
                raise StateError(f"wrench: {name!r} is no body of the stand; known are " + ", ".join(names))


def _finite(value: Any) -> bool:
    if isinstance(value, dict):
        return all(_finite(each) for each in value.values())
    return bool(np.isfinite(value).all())
