"""The second derivation as a backend of the evaluation contract, and its derivatives to judge Jacobians."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cached_property
from typing import Any

import casadi as ca
import numpy as np

from mahovik.contract.functions import hold_fault, want_fault, wants_of
from mahovik.contract.laws import parts
from mahovik.core.stand.model import Stand, State
from mahovik.errors import StateError
from mahovik.proof.second import system as equations
from mahovik.proof.second.body import CarrierEnergy
from mahovik.proof.second.coordinates import free_coordinates, held_coordinates
from mahovik.proof.second.rotation import Array, Expr, attitude
from mahovik.proof.second.system import System, check_depth

PROBLEMS: dict[str, Callable[[System], dict[str, Expr]]] = {
    "momentum": equations.momentum,
    "forward": equations.forward,
    "torque": equations.torque,
    "coupled": equations.coupled,
    "points": equations.points,
    "reaction": equations.reaction,
}
"""Wants that are CasADi functions of the state."""

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
        return System(self.stand, equations.twists(self.stand.hold))

    def function(self, want: str) -> Expr:
        """The CasADi function of a want of PROBLEMS.

        Inputs by the names of `System.inputs`; results by theirs after the want's: `forward_V_dot`, `points_C`.
        """
        if want not in self._functions:
            results = {f"{want}_{name}": value for name, value in PROBLEMS[want](self.system).items()}
            self._functions[want] = self.as_function(want, results)
        return self._functions[want]

    def as_function(self, name: str, results: dict[str, Expr]) -> Expr:
        """Expressions in the system's inputs as a CasADi function of all of them."""
        inputs = self.system.inputs
        return ca.Function(name, list(inputs.values()), list(results.values()), list(inputs), list(results))

    def evaluate(self, state: State, want: Sequence[str]) -> Values:
        """What `want` names, under the names of the contract: arrays in SI, V and V_dot relative to E0, in E1.

        Raises StateError for wants that are unknown, not there or contradict each other, a state that does not fit the
        want, one where a law is undefined, what CasADi refuses, and results that are not finite.
        """
        for name in want:
            if name not in WANTS:
                raise StateError(f"want: the second derivation (casadi) has no {name!r}; it has " + ", ".join(WANTS))
        if fault := want_fault(want) or hold_fault(want, self.stand.hold is not None):
            raise StateError(fault)
        if state.task:
            raise StateError("task: the second derivation has no tasks, ask the backends c or numpy")
        if self.stand.hold is not None:
            state = equations.held_state(self.system.S, state)
        check_depth(self.stand, state)
        with np.errstate(all="ignore"):  # what is not finite is found below
            inputs = self.arguments(state)
            values: Values = {}
            for name in want:
                try:
                    values |= self._generalized(state, inputs) if name == "generalized" else self._solve(name, inputs)
                except RuntimeError as error:  # as CasADi raises them
                    raise StateError(f"{name}: {' '.join(str(error).split())[:200]}") from None
        return _finite_only(values)

    def arguments(self, state: State) -> dict[str, Any]:
        """Arguments of the functions at a state, by name: those of `System.inputs`. Raises StateError."""
        stand = self.stand
        C = attitude(stand.angles, state)
        of_laws: dict[str, Any] = {}
        for law in parts("energy", CarrierEnergy):
            of_laws |= law.arguments(stand, state, C)
        names = ("position", "V", "V_dot", "phi", "phi_dot", "phi_ddot", "tau")
        return {
            **{name: np.array(getattr(state, name), dtype=np.float64) for name in names},
            "C": C,
            "wrench": np.column_stack([state.wrench.get(body.name, np.zeros(6)) for body in stand.bodies]),
            **of_laws,
        }

    def _solve(self, want: str, inputs: dict[str, Any]) -> Values:
        if want == "points" and not equations.point_names(self.stand):
            return {"points": {}}
        if want == "momentum" and not any(body.mass for body in self.stand.bodies):
            raise StateError("momentum: no body of the stand has a mass, so there is no center_of_mass")
        answer = self.function(want)(**inputs)
        values = {name.removeprefix(f"{want}_"): value.full() for name, value in answer.items()}
        if want == "points":
            names = equations.point_names(self.stand)
            split = {name: np.split(value, len(names), axis=1) for name, value in values.items()}
            numbers = {
                name: [x if name == "C" else x[:, 0] for x in split[name]] for name in equations.POINT_QUANTITIES
            }
            return {"points": {point: {name: numbers[name][k] for name in numbers} for k, point in enumerate(names)}}
        return {name: float(value[0, 0]) if name == "energy" else value[:, 0] for name, value in values.items()}

    def _generalized(self, state: State, inputs: dict[str, Any]) -> Values:
        hold, sequence = self.stand.hold, self.stand.angles
        if hold is None and state.quaternion is not None:
            raise StateError("quaternion: `generalized` needs `angles`")
        V_dot = self._solve("forward", inputs)["V_dot"]
        if hold is not None:
            return held_coordinates(hold, sequence, state.position, inputs["C"], state.V, V_dot)
        try:
            return free_coordinates(sequence, state.angles or (0.0, 0.0, 0.0), inputs["V"], V_dot)
        except np.linalg.LinAlgError as error:
            raise StateError(f"generalized: {error}") from None


class Derivatives:
    """Jacobians of what a want gives by inputs of a state, at fixed position and attitude.

    `locked` (N): flywheels held at phi_ddot = 0, of `coupled` only.
    """

    def __init__(self, second: Second, want: str, by: Sequence[str], locked: Sequence[bool] = ()) -> None:
        self._second, system = second, second.system
        answer = equations.coupled(system, locked) if want == "coupled" else PROBLEMS[want](system)
        rate = "V_dot" if system.stand.hold is None else "u_dot"
        slopes = {f"{v}_{name}": self._slope(answer[v], name) for v in (rate, "phi_ddot") if v in answer for name in by}
        self._function = second.as_function("derivatives", slopes)

    def _slope(self, value: Expr, name: str) -> Expr:
        """Derivative of a value by an input, or by `u` of a held carrier, V = S u."""
        system = self._second.system
        return ca.jacobian(value, system.V) @ system.S if name == "u" else ca.jacobian(value, system.inputs[name])

    def evaluate(self, state: State) -> dict[str, Array]:
        """Matrices by name: `V_dot_phi` is that of V_dot by phi. Raises StateError."""
        slopes = self._function(**self._second.arguments(state))
        return _finite_only({name: matrix.full() for name, matrix in slopes.items()})


def _finite_only(values: Values) -> Values:
    for name, value in values.items():
        numbers = [x for of_point in value.values() for x in of_point.values()] if isinstance(value, dict) else [value]
        if not all(np.isfinite(x).all() for x in numbers):
            raise StateError(f"{name}: not finite at this state")
    return values
