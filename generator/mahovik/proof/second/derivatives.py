"""Derivatives of the second derivation's accelerations by automatic differentiation, to judge Jacobians."""

from __future__ import annotations

from collections.abc import Sequence

import casadi as ca
import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof.second import hold
from mahovik.proof.second.chart import Expr
from mahovik.proof.second.evaluate import PROBLEMS, Second
from mahovik.proof.second.problems import coupled
from mahovik.proof.second.rotation import Array


class Derivatives:
    """Jacobians of what a want gives by inputs of a state, at fixed position and attitude.

    `locked` (N): flywheels held at phi_ddot = 0, of `coupled` only.
    """

    def __init__(self, second: Second, want: str, by: Sequence[str], locked: Sequence[bool] = ()) -> None:
        self._second = second
        system = second.system
        if system.stand.hold is None:
            found = coupled(system, locked) if want == "coupled" else PROBLEMS[want](system)
        else:
            whole = hold.coupled(system, locked) if want == "coupled" else hold.forward(system)
            found = {name: value for name, value in whole.items() if name in ("u_dot", "phi_ddot")}
        self._names = [(value, name) for value in found for name in by]
        parts = [self._slope(found[value], name) for value, name in self._names]
        self._function = ca.Function("derivatives", list(system.inputs.values()), parts, list(system.inputs), [
            f"{value}_{name}" for value, name in self._names
        ])  # fmt: skip

    def _slope(self, value: Expr, name: str) -> Expr:
        """Derivative of a value by an input, or by `u` of a held carrier, V = S u."""
        system = self._second.system
        if name != "u":
            return ca.jacobian(value, system.inputs[name])
        assert system.stand.hold is not None
        return ca.jacobian(value, system.V) @ ca.DM(hold.twists(system.stand.hold))

    @property
    def stand(self) -> Stand:
        """The stand whose equations are differentiated."""
        return self._second.stand

    def evaluate(self, state: State) -> dict[str, Array]:
        """Matrices by name: `V_dot_phi` is that of V_dot by phi. Raises StateError."""
        found = self._function(**self._second.arguments(state))
        matrices = {name: found[name].full() for name in (f"{value}_{by}" for value, by in self._names)}
        for name, matrix in matrices.items():
            if not np.isfinite(matrix).all():
                raise StateError(f"{name}: not finite at this state")
        return matrices
