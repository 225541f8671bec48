"""Correction weights from influence coefficients: least squares, or the smallest largest vibration (min-max).

Min-max is a second-order cone programme: least t with |A_m + (ALPHA w)_m| <= t. SLSQP finds w; a linear programme over
tangents of the cones then bounds t from below, and more tangents are added until both agree. So `bound` proves how
good the answer is.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import linprog, minimize

from mahovik.errors import CheckError
from mahovik.use.balance.influence import Influence
from mahovik.use.balance.polar import Array, Complex

METHODS = ("least-squares", "min-max")

AGREED = 1e-8
"""Largest vibration above its lower bound, as a part of the largest before, at which min-max is settled."""

ENOUGH = 1e-6
"""Likewise, above which the answer is refused after all rounds."""

ROUNDS = 60
SIDES = 8
"""Tangents of each cone at the start."""


@dataclass(frozen=True, eq=False)
class Solution:
    """Corrections w (N) and what they leave, r = A + ALPHA w (M).

    bound           min-max: no weights leave a largest vibration below this; None for least squares
    standard_error  (N): of each component of w along and across its direction, from what least squares leaves; None
                    without more sensors than planes, with limits, or for min-max
    """

    w: Complex
    left: Complex
    bound: float | None = None
    standard_error: Array | None = None


def solve(problem: Influence, method: str = "least-squares") -> Solution:
    """Correction weights by one of METHODS, within the limits of the problem. Raises CheckError."""
    scale = float(np.abs(problem.A).max())
    if scale == 0.0:
        return Solution(
            np.zeros(problem.alpha.shape[1], dtype=np.complex128), problem.A, 0.0 if method == "min-max" else None
        )
    size = np.linalg.norm(problem.alpha, axis=0)
    own = _Scaled(problem.A / scale, problem.alpha / size, problem.most * size / scale)
    if method == "min-max":
        x, bound = own.min_max()
        w = x * scale / size
        return Solution(w, problem.A + problem.alpha @ w, bound * scale)
    x = own.least_squares()
    w = x * scale / size
    left = problem.A + problem.alpha @ w
    return Solution(w, left, None, None if np.isfinite(problem.most).any() else _standard_error(problem.alpha, left))


def _standard_error(alpha: Complex, left: Complex) -> Array | None:
    M, N = alpha.shape
    if M <= N:
        return None
    variance = float(np.sum(np.abs(left) ** 2)) / (2.0 * (M - N))
    return np.asarray(np.sqrt(variance * np.diag(np.linalg.inv(alpha.conj().T @ alpha)).real))


@dataclass(frozen=True, eq=False)
class _Scaled:
    """A with a largest amplitude of 1, alpha with unit columns; most: largest |x| of each plane."""

    A: Complex
    alpha: Complex
    most: Array

    def residual(self, x: Complex) -> Complex:
        return self.A + self.alpha @ x

    def cut_to_limits(self, x: Complex) -> Complex:
        """x with amplitudes cut to their limits."""
        size = np.abs(x)
        over = size > self.most
        found = x.copy()
        found[over] *= self.most[over] / size[over]
        return found

    def least_squares(self) -> Complex:
        x = np.asarray(np.linalg.lstsq(self.alpha, -self.A, rcond=None)[0])
        if np.all(np.abs(x) <= self.most):
            return x
        G, g = self.alpha.conj().T @ self.alpha, self.alpha.conj().T @ self.A

        def fall(z: Array) -> tuple[float, Array]:
            x, gradient = _join(z), G @ _join(z) + g
            return float((x.conj() @ (G @ x) + 2.0 * (x.conj() @ g)).real), 2.0 * _split(gradient)

        return self.cut_to_limits(self._search(fall, self.cut_to_limits(x)))

    def min_max(self) -> tuple[Complex, float]:
        """x, and a lower bound of the largest |left|. Raises CheckError."""
        M, N = self.alpha.shape
        x = self.cut_to_limits(np.asarray(np.linalg.lstsq(self.alpha, -self.A, rcond=None)[0]))
        best, most = x, float(np.abs(self.residual(x)).max())
        turns = np.exp(2j * np.pi * np.arange(SIDES) / SIDES)
        rows = [(m, u) for m in range(M) for u in turns]
        walls = [(k, u) for k in range(N) if self.most[k] < np.inf for u in turns]
        bound = 0.0
        for _ in range(ROUNDS):
            polished = self.cut_to_limits(self._polish(x))
            for each in (x, polished):
                left = self.residual(each)
                if np.abs(left).max() < most:
                    best, most = each, float(np.abs(left).max())
                rows += [(m, left[m] / abs(left[m])) for m in range(M) if abs(left[m]) > 0.5 * most]
                walls += [(k, each[k] / abs(each[k])) for k in range(N) if abs(each[k]) > 0.9 * self.most[k]]
            x, lower = self._tangents(rows, walls)
            bound = max(bound, lower)
            if most - bound <= AGREED:
                break
        if most - bound > ENOUGH:
            raise CheckError(f"min-max: {most - bound:.1e} of the largest vibration is not settled; use least-squares")
        return best, min(bound, most)

    def _tangents(self, rows: list[tuple[int, complex]], walls: list[tuple[int, complex]]) -> tuple[Complex, float]:
        """Least t above tangents of the cones, within tangents of the limits: a linear programme."""
        N = self.alpha.shape[1]
        at, u = np.array([m for m, _ in rows]), np.array([each for _, each in rows])
        turned = u.conj()[:, None] * self.alpha[at]
        upper = np.column_stack([turned.real, -turned.imag, -np.ones(len(rows))])
        limit = -(u.conj() * self.A[at]).real
        if walls:
            more = np.zeros((len(walls), 2 * N + 1))
            for i, (k, v) in enumerate(walls):
                more[i, k], more[i, N + k] = v.real, v.imag
            upper, limit = np.vstack([upper, more]), np.concatenate([limit, [self.most[k] for k, _ in walls]])
        found = linprog(np.eye(2 * N + 1)[-1], upper, limit, bounds=[(None, None)] * (2 * N) + [(0.0, None)])
        if found.x is None:
            raise CheckError(f"min-max: the linear programme failed: {found.message}; use least-squares")
        return _join(found.x[:-1]), float(found.fun)

    def _polish(self, start: Complex) -> Complex:
        """Local search for the least t with |left| <= t, which is convex."""
        t = float(np.abs(self.residual(start)).max())

        def cones(z: Array) -> Array:
            return np.asarray(z[-1] ** 2 - np.abs(self.residual(_join(z[:-1]))) ** 2)

        def slopes(z: Array) -> Array:
            turned = self.residual(_join(z[:-1])).conj()[:, None] * self.alpha
            return np.column_stack([-2.0 * turned.real, 2.0 * turned.imag, np.full(len(self.A), 2.0 * z[-1])])

        last = np.eye(2 * len(start) + 1)[-1]
        constraints = [{"type": "ineq", "fun": cones, "jac": slopes}]
        return self._search(lambda z: (float(z[-1]), last), start, constraints, [t])

    def _search(
        self,
        fall: Callable[[Array], tuple[float, Array]],
        start: Complex,
        constraints: Sequence[Mapping[str, object]] = (),
        more: Sequence[float] = (),
    ) -> Complex:
        """SLSQP within the limits."""
        N = len(start)
        limited = np.flatnonzero(np.isfinite(self.most))

        def room(z: Array) -> Array:
            return np.asarray(self.most[limited] ** 2 - z[limited] ** 2 - z[N + limited] ** 2)

        def room_slopes(z: Array) -> Array:
            found = np.zeros((len(limited), len(z)))
            for i, k in enumerate(limited):
                found[i, k], found[i, N + k] = -2.0 * z[k], -2.0 * z[N + k]
            return found

        if len(limited):
            constraints = [*constraints, {"type": "ineq", "fun": room, "jac": room_slopes}]
        z = np.concatenate([_split(start), more])
        found = minimize(
            fall, z, jac=True, method="SLSQP", constraints=constraints, options={"ftol": 1e-15, "maxiter": 300}
        )
        return _join(found.x[: 2 * N]) if np.all(np.isfinite(found.x)) else start


def _join(z: Array) -> Complex:
    half = len(z) // 2
    return np.asarray(z[:half] + 1j * z[half:])


def _split(x: Complex) -> Array:
    return np.concatenate([x.real, x.imag])
