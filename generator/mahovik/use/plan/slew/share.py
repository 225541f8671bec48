"""How the flywheels share a turn: their accelerations per unit of sigma'', from the mean model over all phases.

The mean model has balanced flywheels: K0 of (2) and I0 of (9) as means over the phases. A demanded acceleration
r sigma'' of the rows then takes A g = -r, A = S K0^-1 I0, of flywheels phi'' = g sigma'', with torques
tau = Q g sigma'', Q = Theta_ff - I0^T K0^-1 I0. More flywheels than rows leave a choice of g.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.optimize import linprog, minimize

from mahovik.core.motion.required import Slew
from mahovik.use.numeric.mechanics import Mechanics
from mahovik.use.numeric.se3 import Array
from mahovik.use.plan.slew.limits import Limits

_REACH = 1e-9
"""Share of a demand that may be left as rounding."""

_RANK = 1e-9


@dataclass(frozen=True, eq=False)
class Mean:
    """The mean model for rows S (m, 6): A (m, N), Q (N, N), weights Theta_ff (N), K0 (6, 6)."""

    S: Array
    A: Array
    Q: Array
    Theta_ff: Array
    K0: Array

    @staticmethod
    def of(mechanics: Mechanics, S: Array) -> Mean:
        """The mean model of a stand."""
        K0, I0 = mechanics.mean_inertia, mechanics.tables.coupling[0].T
        to_motion = np.linalg.solve(K0, I0)
        return Mean(
            S, S @ to_motion, np.diag(mechanics.tables.Theta_ff) - I0.T @ to_motion, mechanics.tables.Theta_ff, K0
        )

    def least(self, wanted: Array) -> Array:
        """phi'' (..., N) with A phi'' = wanted (..., m), the least in the norm of Theta_ff."""
        return np.asarray(wanted @ self._least.T)

    @cached_property
    def _least(self) -> Array:
        root = np.sqrt(self.Theta_ff)
        return np.asarray(np.linalg.pinv(self.A / root, rcond=_RANK) / root[:, None])

    def missing(self, wanted: Array) -> Array | None:
        """A twist (6, in E1) on which the flywheels do no work, though A phi'' = wanted needs it; None: reached."""
        left = wanted - self.A @ self.least(wanted)
        if float(np.linalg.norm(left)) <= _REACH * float(np.linalg.norm(wanted)):
            return None
        G = self.S @ np.linalg.solve(self.K0, self.S.T)
        norm = np.linalg.inv(np.linalg.cholesky(G))
        nearest, *_ = np.linalg.lstsq(norm @ self.A, norm @ wanted, rcond=_RANK)
        return np.asarray(np.linalg.solve(self.K0, self.S.T @ np.linalg.solve(G, self.A @ nearest - wanted)))


def choices(mean: Mean, wanted: Array, limits: Limits) -> Iterator[Array]:
    """Shares g (N) with A g = wanted: that with the least torque as part of the limits, of speed, and some between."""
    gentle = _least_part(mean, wanted, mean.Q, limits.strongest, limits.acceleration)
    yield gentle
    if not np.isfinite(limits.speed).any():
        return
    slow = _least_part(mean, wanted, np.eye(len(limits.speed)), limits.speed, np.full(len(limits.speed), np.inf))
    if np.abs(slow - gentle).max() > 1e-6 * np.abs(gentle).max():
        for x in (0.25, 0.5, 0.75, 1.0):
            yield (1.0 - x) * gentle + x * slow


def _least_part(mean: Mean, wanted: Array, rows: Array, most: Array, acceleration: Array) -> Array:
    """g with the least largest part of |rows g| in `most` and of |g| in `acceleration`; of these the least in Theta_ff.

    A linear programme, then a quadratic one inside its value.
    """
    N = len(most)
    bounded = np.vstack([rows[np.isfinite(most)], np.eye(N)[np.isfinite(acceleration)]])
    level = np.concatenate([most[np.isfinite(most)], acceleration[np.isfinite(acceleration)]])
    start = mean.least(wanted)
    if not len(level):
        return start
    unit = float(np.abs(start).max())
    scaled = bounded * unit / level[:, None]
    size = float(np.abs(scaled @ (start / unit)).max())
    A, b = _independent(mean.A * unit, wanted)
    column = -np.full((len(level), 1), size)
    solution = linprog(
        [*np.zeros(N), 1.0],
        A_ub=np.block([[scaled, column], [-scaled, column]]),
        b_ub=np.zeros(2 * len(level)),
        A_eq=np.hstack([A, np.zeros((len(A), 1))]),
        b_eq=b,
        bounds=[(None, None)] * N + [(0.0, None)],
    )
    if solution.x is None:
        return start
    g, part = solution.x[:N], float(solution.x[N])
    if np.abs(scaled @ (start / unit)).max() <= part * size * (1.0 + 1e-9):
        return start
    null = _null(A)
    if null.shape[1]:
        weight = mean.Theta_ff / mean.Theta_ff.max()
        most_part = part * size * (1.0 + 1e-7)
        shorter = minimize(
            lambda y: float(weight @ (g + null @ y) ** 2),
            np.zeros(null.shape[1]),
            jac=lambda y: 2.0 * null.T @ (weight * (g + null @ y)),
            method="SLSQP",
            constraints={
                "type": "ineq",
                "fun": lambda y: most_part - np.concatenate([scaled, -scaled]) @ (g + null @ y),
                "jac": lambda y: -np.concatenate([scaled, -scaled]) @ null,
            },
        )
        nearer = g + null @ shorter.x
        if np.abs(scaled @ nearer).max() <= part * size * (1.0 + 1e-6):
            g = nearer
    return np.asarray(g * unit)


def _independent(A: Array, b: Array) -> tuple[Array, Array]:
    """The equations without those that say nothing new."""
    U, sigma, Vt = np.linalg.svd(A, full_matrices=False)
    kept = sigma > _RANK * sigma[0]
    return np.asarray(sigma[kept, None] * Vt[kept]), np.asarray(U[:, kept].T @ b)


def _null(A: Array) -> Array:
    """An orthonormal basis (N, n) of A x = 0."""
    _, sigma, Vt = np.linalg.svd(A)
    rank = int((sigma > _RANK * sigma[0]).sum())
    return np.asarray(Vt[rank:].T)


class NoSlewError(Exception):
    """Why there is no programme: reason and words of `Plan`; without a reason the attitude is singular."""

    def __init__(self, reason: str | None, words: str) -> None:
        super().__init__(words)
        self.reason, self.words = reason, words


def unreached_motion(slew: Slew, S: Array, twist: Array, left: Array) -> NoSlewError:
    """The flywheels do no work on a twist (6, in E1), though the rows S (m, 6) need it; left (m): what the rows miss.

    A moment or a force where rows turn; else the acceleration of the point whose rows these are.
    """
    places = {row.of or "O1" for row in slew.task.rows}
    if slew.kind == "still" and len(places) == 1:
        words = f"they give no acceleration of {places.pop()} along ({_direction(left @ S[:, :3])}) of E1"
    else:
        turns = float(np.linalg.norm(twist[3:])) > 1e-6 * float(np.linalg.norm(twist[:3]))
        along = "moment about" if turns else "force along"
        words = f"they give no {along} ({_direction(twist[3:] if turns else twist[:3])}) of E1"
    return NoSlewError("SPAN", f"the flywheels do not reach the task {slew.task.name}: {words}")


def _direction(x: Array) -> str:
    unit = x / np.linalg.norm(x)
    return ", ".join(f"{x:.4g}" for x in np.where(np.abs(unit) > 1e-9, unit, 0.0) + 0.0)
