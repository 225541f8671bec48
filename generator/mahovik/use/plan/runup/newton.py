"""Newton's method for shooting, two equations a freedom and more unknowns; steps that bring a flight inside bounds.

Bounds are of the carrier's deviation and of speeds, accelerations and torques of the flywheels.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mahovik.core.motion.required import Bounds
from mahovik.errors import StateError
from mahovik.use.numeric import Array
from mahovik.use.plan.budget import Budget
from mahovik.use.plan.runup.boundary import Boundary, Flight

LONGEST = 0.5
"""rad: limit of the change of an unknown in a step."""

FAR = 0.3
"""Above this error a step minimises the unknowns, not itself: the motion stays near the plain fade."""

_SHARES = (1.0, 0.5, 0.25, 0.125, 0.0625)
"""Parts of a step, tried in this order."""

NOTHING = 1e-4
"""Singular value of the derivatives of the terminal error (1/rad), or part of the largest, that counts as zero."""


def shoot(problem: Boundary, start: Flight, goal: float, most: int, budget: Budget | None = None) -> tuple[Flight, int]:
    """Newton steps until the terminal error meets the goal or falls no more, time is over, or `most` are taken.

    Return the best flight and the number of steps.

    Raises CheckError: there is no rest to start from, or to end in.
    """
    flight = start
    for taken in range(most):
        if flight.size <= goal or (budget is not None and budget.is_spent()):
            return flight, taken
        flight = problem.linearise_again(flight)
        J, _ = problem.sensitivity(flight)
        step = least_step(J, flight.error, flight.c.ravel() if flight.size > FAR else None).reshape(flight.c.shape)
        step *= min(1.0, LONGEST / max(float(np.abs(step).max()), 1e-300))
        better = reduce_error(problem, flight, step)
        if better is None:
            return flight, taken + 1
        flight = better
    return flight, most


def reduce_error(problem: Boundary, flight: Flight, step: Array) -> Flight | None:
    """The flight after the largest part of a step that reduces the terminal error; None: none does."""
    for share in _SHARES:
        try:
            there = problem.fly(flight.c + share * step, flight)
        except StateError:
            continue
        if there.size < flight.size:
            return there
    return None


def least_step(J: Array, error: Array, c: Array | None) -> Array:
    """-J^+ e; or, with c, the step that minimises c + step among those that meet the terminal equations."""
    U, sigma, Vt = np.linalg.svd(J, full_matrices=False)
    kept = nonzero_mask(sigma)
    inverse = (Vt[kept].T / sigma[kept]) @ U[:, kept].T
    return np.asarray(-inverse @ error if c is None else inverse @ (J @ c - error) - c)


def nonzero_mask(sigma: Array) -> NDArray[np.bool_]:
    """Mask of singular values that do not count as zero."""
    return np.asarray(sigma > NOTHING * max(1.0, float(sigma[0])))


KEEP = 0.97
"""Enforce bounds at this fraction."""

_REDUCTIONS, _CLOSE = 24, 1e-4
"""Number of steps; terminal error after each."""
_STALL = 4
"""Steps that together must reduce the excess by a tenth."""


@dataclass(frozen=True, eq=False)
class Shares:
    """Values over bound (M, 1 or N) at the nodes, by name, for each bound given."""

    by_name: dict[str, Array]

    @property
    def largest(self) -> float:
        """The largest; 0 without bounds."""
        return max((float(np.max(x)) for x in self.by_name.values()), default=0.0)

    @property
    def excess(self) -> float:
        """Sum of squares of the parts above KEEP."""
        return sum(float(np.sum(np.maximum(x - KEEP, 0.0) ** 2)) for x in self.by_name.values())


def shares(problem: Boundary, flight: Flight, bounds: Bounds) -> Shares:
    """Values over bounds along a flight; the deviation from the mean pose, linear (m) and angular (rad)."""
    found = {}
    for name, values in measure(problem, flight).items():
        limit = bounds.deviation if name == "deviation" else getattr(bounds, name)
        if limit is not None:
            found[name] = np.abs(values) / np.array(limit)
    return Shares(found)


def measure(problem: Boundary, flight: Flight) -> dict[str, Array]:
    """Deviation (M, 2; m, rad), speed, acceleration, torque (M, N) at the nodes."""
    angles, away = problem.family.angles(flight.c), problem.chart.displacement(flight.course.y)
    return {
        "deviation": np.column_stack([np.linalg.norm(x, axis=1) for x in np.hsplit(away, 2)]),
        "speed": angles.phi_dot,
        "acceleration": angles.phi_ddot,
        "torque": problem.linearise(flight).tau,
    }


def reduce_excess(problem: Boundary, flight: Flight, bounds: Bounds, budget: Budget) -> Flight:
    """The flight with the least excess found in the time, by Gauss-Newton steps that keep the terminal conditions.

    Each step minimises the excess and its own length subject to the terminal conditions; Newton's steps follow.
    """
    best, least, weight = flight, shares(problem, flight, bounds).excess, 1e-2
    history = [least]
    for _ in range(_REDUCTIONS):
        if (
            budget.is_spent()
            or least == 0.0
            or weight > 1e6
            or (len(history) > _STALL and least > 0.9 * history[-1 - _STALL])
        ):
            break
        best = problem.linearise_again(best)
        J, states = problem.sensitivity(best)
        h, G = _rows(problem, best, bounds, states)
        step = _bounded_step(J, best.error, h, G, weight * float(np.linalg.norm(G)) ** 2 / G.shape[1])
        step = step.reshape(best.c.shape) * min(1.0, LONGEST / max(float(np.abs(step).max()), 1e-300))
        try:
            there = shoot(problem, problem.fly(best.c + step, best), _CLOSE, 4)[0]
            excess = shares(problem, there, bounds).excess if there.size <= _CLOSE else np.inf
        except StateError:
            excess = np.inf
        if excess < least:
            best, least, weight = there, excess, weight * 0.2
        else:
            weight *= 8.0
        history.append(least)
    return best


def _bounded_step(J: Array, error: Array, h: Array, G: Array, weight: float) -> Array:
    """argmin |h + G dx|^2 + weight |dx|^2 with J dx = -error."""
    U, sigma, Vt = np.linalg.svd(J)
    rank = int(nonzero_mask(sigma).sum())
    straight = -Vt[:rank].T @ ((U.T @ error)[:rank] / sigma[:rank])
    null = Vt[rank:].T
    reach = G @ null
    z = np.linalg.solve(reach.T @ reach + weight * np.eye(reach.shape[1]), -reach.T @ (h + G @ straight))
    return np.asarray(straight + null @ z)


def _rows(problem: Boundary, flight: Flight, bounds: Bounds, states: Array) -> tuple[Array, Array]:
    """Parts above KEEP (K), and derivatives by the unknowns (K, N P), without the carrier's part in torques."""
    N, P = flight.c.shape
    values, basis, along = measure(problem, flight), problem.family.basis, problem.linearise(flight)
    h, G = [np.zeros(0)], [np.zeros((0, N * P))]
    for name, share in shares(problem, flight, bounds).by_name.items():
        rows, columns = np.nonzero(share > KEEP)
        h.append(share[rows, columns] - KEEP)
        signed = values[name][rows, columns]
        scale = share[rows, columns] / signed  # factor of the derivatives: sign over bound
        own = np.zeros((len(rows), N, P))
        k = np.arange(len(rows))
        if name == "deviation":
            pose = problem.chart.displacement(flight.course.y).reshape(-1, 2, 3)[rows, columns]
            moved = problem.chart.displacement_change(flight.course.y, states).reshape(-1, 2, 3, N * P)[rows, columns]
            own += np.einsum("ki,kip->kp", pose / signed[:, None], moved).reshape(-1, N, P)
        elif name == "torque":
            for by, b in zip((along.tau_by_phi, along.tau_by_phi_dot, along.tau_by_phi_ddot), basis, strict=True):
                own[k, columns] += by[rows, columns, None] * b[rows]
        else:
            own[k, columns] = basis[1 if name == "speed" else 2][rows]
        G.append((own * scale[:, None, None]).reshape(-1, N * P))
    return np.concatenate(h), np.concatenate(G)
