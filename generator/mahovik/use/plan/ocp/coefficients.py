"""Numbers of a planning problem for the optimal control problem: coefficients, scales, limits. Does not need CasADi."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mahovik.core.motion.required import Bounds
from mahovik.use.plan.array import Array
from mahovik.use.plan.fourier import Angles
from mahovik.use.plan.objective import KINDS, Cost
from mahovik.use.plan.problem import Problem
from mahovik.use.plan.residual import prescribe
from mahovik.use.plan.residual.evaluate import flywheel_wrenches

_STEP = 1e-6
"""m, rad: step of the differences by the bias."""


@dataclass(frozen=True, eq=False)
class Scaled:
    """A planning problem in the scales of `node`: flywheels in the order `order`, time in 1/Omega.

    order   (N) numbers of the flywheels, (-, +) of (13)
    torque  (N, in the stand's order) J_s Omega^2, N m: unit of torque
    """

    problem: Problem
    cost: Cost
    order: NDArray[np.intp]

    @property
    def Omega(self) -> float:
        """Frequency of the motion, rad/s."""
        return self.cost.Omega

    @property
    def span(self) -> float:
        """Span of the motion in 1/Omega."""
        return self.problem.motion.span * self.Omega

    @property
    def torque(self) -> Array:
        """Unit of torque (N), N m."""
        return np.asarray(self.cost.spin_inertia * self.Omega**2)

    def node_parameters(self, t: Array, angles: Angles, bias: Array) -> Array:
        """Parameters (P, M) of the nodes at times t (M, s), around a bias.

        The change by the bias is linear, with the flywheels at the given angles (M, N). The error is of second order,
        and the result is solved exactly afterwards.
        """
        problem, M, N = self.problem, len(t), self.problem.N
        course = problem.motion.at(t)
        at = prescribe(problem.mechanics, course, bias)
        by_bias, tau_by_bias = np.zeros((M, 6, 6)), np.zeros((M, N, 6))
        for b in np.flatnonzero(problem.free):
            sides = []
            for sign in (1.0, -1.0):
                there = prescribe(problem.mechanics, course, bias + sign * _STEP * np.eye(6)[b])
                W = flywheel_wrenches(there, *angles)
                sides.append((there.base - W[:6].sum(axis=2).T, W[6]))
            by_bias[:, :, b] = problem.norm.scaled(sides[0][0] - sides[1][0]) / (2 * _STEP)
            tau_by_bias[:, :, b] = (sides[0][1] - sides[1][1]) / (2 * _STEP) / self.torque
        base = problem.norm.scaled(at.base)
        fixed, moving = (np.transpose(self._rows(x), (2, 0, 1, 3)) for x in (at.fixed, at.moving * self.Omega))
        parts = (base, fixed, moving, by_bias, tau_by_bias[:, self.order])
        return np.hstack([x.reshape(M, -1) for x in parts]).T

    def _rows(self, table: Array) -> Array:
        """A table (5, 7, M, N) with relative rows, flywheels reordered."""
        root = self.problem.norm.root / self.problem.norm.demand
        wrench = np.einsum("ij,hjmn->himn", root, table[:, :6])
        return np.concatenate([wrench, (table[:, 6] / self.torque)[:, None]], axis=1)[..., self.order]

    def stand_parameters(self, mean_speed: Array) -> Array:
        """Parameters of all nodes (P): tables, objective, motors; mean speeds (N, rad/s)."""
        own, cost, drives, Omega = self.problem.mechanics, self.cost, self.cost.drives, self.Omega
        still, spun = (self._rows(x * Omega**2)[:, :, 0] for x in (own.still, own.spun))
        per_flywheel = (
            np.array([cost.weights[kind] for kind in KINDS]),
            mean_speed / Omega,
            drives.resistance * cost.spin_inertia * Omega / drives.constant**2,
            drives.viscous * Omega / self.torque,
            drives.coulomb / self.torque,
            drives.coulomb_speed / Omega,
        )
        column = Omega**2 / self.problem.norm.demand * np.sqrt(own.tables.Theta_ff)
        ordered = [x[..., self.order].ravel() for x in (column, *per_flywheel)]
        return np.concatenate([still.ravel(), spun.ravel(), *ordered])

    def limits(self, bounds: Bounds, kind: str, part: float) -> Array:
        """Magnitudes (N, reordered) of a bound in these scales, times `part`; infinite without a bound."""
        given = getattr(bounds, kind)
        if given is None:
            return np.full(self.problem.N, np.inf)
        scale = {
            "speed": self.Omega, "speed_min": self.Omega, "acceleration": self.Omega**2,
            "torque": self.torque, "angle": 1.0,
        }[kind]  # fmt: skip
        return np.asarray((np.array(given) / scale)[self.order] * part)
