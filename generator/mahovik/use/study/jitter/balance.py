"""Harmonic balance of the carrier's motion over the phases of all flywheels, at any constant speeds: (8) in full.

The state about rest is a function on a torus, y(theta), one phase theta_s per flywheel that turns. It obeys

    sum_s phi_s' dy/dtheta_s = y'(theta, y),

so that coefficient k obeys i k . phi' y_k = [y'(theta, y)]_k. Newton's method; its linear equations are solved by
GMRES, preconditioned by their mean over all phases. Kept are all k up to an order. What the others would add is
measured: the accelerations that the literal reference (8) finds along the motion at random phases differ by `left_out`.

Directions without a restoring force are kept from drifting: of all motions the one is found whose mean pose is that of
rest and whose mean rotation is zero, for any phases. Where momentum is conserved nothing is needed for that.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.sparse.linalg import LinearOperator, gmres
from scipy.spatial.transform import Rotation

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.errors import CheckError
from mahovik.proof.reference import pieces
from mahovik.proof.reference.forward import forward
from mahovik.use.plan.array import Array, Complex
from mahovik.use.plan.forward import Drive
from mahovik.use.study.jitter.torus import Torus, Whole
from mahovik.use.study.response.scene import Scene

ACCURATE = 1e-9
"""Accuracy of GMRES in one step of Newton's method."""

RESTART, ROUNDS = 40, 5
STEPS = 20
SETTLED = 1e-11
"""Relative size of a last step of Newton's method."""

ROUNDING = 1e-15
"""m/s2, rad/s2: smaller amplitudes of V* count as zero."""

LARGEST = 2.0
"""rad: limit near the edge of the chart."""

SLOW = 1e-9
"""Part of the fastest speed below which a combination k . phi' is a constant, as of two flywheels of one speed."""

ENOUGH = 1e-6
"""Accelerations left out, relative, at which no higher order is tried."""

FIRST, HIGHEST = 2, 8
"""Orders tried without a given one."""

SAMPLES = 64
"""Random phases at which the literal reference is evaluated."""


@dataclass(frozen=True, eq=False)
class Balance:
    """A motion on the torus of the flywheels that turn.

    speeds    (N, rad/s); turning: indices of those that turn, in the order of the torus' phases
    c         (n, 12): coefficients of states y = (x, r, V) in the chart about rest
    hold      (6; N, N m): constant wrench in E1 that keeps the mean place along free directions, mean over phases
    left_out  largest remaining acceleration by the literal reference, as a part of the largest acceleration
    """

    scene: Scene
    torus: Torus
    order: int
    speeds: Array
    phases: Array
    turning: tuple[int, ...]
    c: Complex
    hold: Array
    left_out: float

    @property
    def frequencies(self) -> Array:
        """k . phi' (n; rad/s), of either sign."""
        return self.torus.frequencies(self.speeds[list(self.turning)])

    def states(self, theta: Array) -> tuple[Array, Array]:
        """y (m, 12) and its derivative (m, 12) at phases theta (m, turning; rad) of the flywheels that turn."""
        rates = 1j * self.frequencies[:, None] * self.c
        return self.torus.at(self.c, theta), self.torus.at(rates, theta)

    def state(self, theta: Array, V_dot: Array | None = None) -> State:
        """The state as `eval` and `simulate` take it, at phases theta (turning; rad)."""
        y = self.torus.at(self.c, theta[None])[0]
        return _state(self.scene, y, self._phi(theta), self.speeds)

    def _phi(self, theta: Array) -> Array:
        phi = self.phases.copy()
        phi[list(self.turning)] = theta
        return phi


def balance(
    stand: Stand | Scene, speeds: Sequence[float], phases: Sequence[float] | None = None, order: int | None = None
) -> Balance:
    """The motion at constant `speeds` (N, rad/s), for all phases of the flywheels that turn.

    stand    or its Scene, for many speeds
    phases   (N, rad): only of those at rest
    order    largest sum of |k_s|; None: raised until at most ENOUGH is left out or it no longer helps

    Raises CheckError: no equilibrium, or no motion is found.
    """
    scene = stand if isinstance(stand, Scene) else Scene.of(stand)
    N = len(scene.stand.flywheels)
    start = np.zeros(N) if phases is None else np.array(phases, dtype=np.float64)
    search = _Search(scene, np.array(speeds, dtype=np.float64), start)
    if order is not None:
        return search.at(order)
    found = search.at(FIRST)
    for higher in range(FIRST + 1, HIGHEST + 1):
        if found.left_out <= ENOUGH:
            break
        try:
            found = search.at(higher)
        except CheckError:
            break
    return found


class _Search:
    """Newton's method at one order after the other, each from the last."""

    def __init__(self, scene: Scene, speeds: Array, phases: Array) -> None:
        self.scene, self.speeds, self.phases = scene, speeds, phases
        self.turning = tuple(int(s) for s in np.flatnonzero(speeds))
        self.fastest = float(np.abs(speeds).max(initial=0.0)) or 1.0
        self.before: tuple[Torus, Complex] | None = None

    def at(self, order: int) -> Balance:
        """The motion at an order. Raises CheckError."""
        torus = Torus.of(len(self.turning), order)
        w = torus.frequencies(self.speeds[list(self.turning)])
        slow = np.flatnonzero(np.abs(w) <= SLOW * self.fastest)
        given = self._drive(torus.nodes)
        f = self.scene.free.shape[1]
        push = self.scene.push(given)
        c, h = self._start(torus), np.zeros((len(torus.k), f), dtype=np.complex128)
        size = np.repeat([1.0, self.fastest], 6)
        for _ in range(STEPS):
            y = torus.values(c)
            if not np.all(np.isfinite(y)) or np.abs(y[:, 3:6]).max() > LARGEST:
                break
            rate = self.scene.chart.rate(given, y) + (push @ torus.values(h)[:, :, None])[:, :, 0]
            J = self.scene.jacobian(given, y, rate[:, 6:])
            linear = _Linearised(torus, J, push, self.scene.free_displacement, w, slow, size)
            step = linear.solve(torus.coefficients(rate) - 1j * w[:, None] * c, c)
            if step is None:
                break
            c, h = c + step[0], h + step[1]
            change = np.abs(step[0] / size).max()
            if change <= SETTLED * np.abs(c / size).max() + ROUNDING / self.fastest**2:
                self.before = torus, c
                return self._result(order, torus, c, h)
        given_text = ", ".join(f"{x:.6g}" for x in self.speeds)
        raise CheckError(
            f"{self.scene.stand.name} at speeds {given_text} rad/s: no steady motion found: an undamped resonance, "
            "or the carrier moves too violently"
        )

    def _start(self, torus: Torus) -> Complex:
        c = np.zeros((len(torus.k), 12), dtype=np.complex128)
        if self.before is not None:
            c[: len(self.before[1])] = self.before[1]  # indices are sorted by size
        return c

    def _phi(self, theta: Array) -> tuple[Array, Array]:
        phi = np.tile(self.phases, (len(theta), 1))
        phi[:, list(self.turning)] = theta
        return phi, np.tile(self.speeds, (len(theta), 1))

    def _drive(self, theta: Array) -> Drive:
        return self.scene.drive(*self._phi(theta))

    def _result(self, order: int, torus: Torus, c: Complex, h: Complex) -> Balance:
        hold = self.scene.wrench @ h[0].real
        found = Balance(self.scene, torus, order, self.speeds, self.phases, self.turning, c, hold, 0.0)
        return replace(found, left_out=self._left_out(found, h))

    def _left_out(self, found: Balance, h: Complex) -> float:
        """Largest difference between V* of the motion and that of the reference, and of the pose's rate."""
        theta = np.random.default_rng(1).uniform(0.0, 2.0 * np.pi, (SAMPLES, len(self.turning)))
        y, y_dot = found.states(theta)
        phi, _ = self._phi(theta)
        given = self._drive(theta)
        held = (self.scene.push(given) @ found.torus.at(h, theta)[:, :, None])[:, 6:, 0]
        exact = np.array([_forward(self.scene, y[i], phi[i], self.speeds) for i in range(len(theta))])
        left = y_dot[:, 6:] - exact - held
        pose = y_dot[:, :6] - self.scene.chart.rate(given, y)[:, :6]
        parts = [_largest(self.scene, a, b) for a, b in ((left, exact), (pose, y_dot[:, :6]))]
        return max(parts)


def _largest(scene: Scene, off: Array, whole: Array) -> float:
    """Largest of off (M, 6) as a part of the largest of `whole`, rotations times the radius of gyration."""
    radius = float(np.sqrt(np.trace(scene.K[3:, 3:]) / np.trace(scene.K[:3, :3])))
    scale = np.repeat([1.0, radius], 3)
    most = float(np.linalg.norm(whole * scale, axis=1).max())
    return float(np.linalg.norm(off * scale, axis=1).max()) / most if most > ROUNDING else 0.0


def _state(scene: Scene, y: Array, phi: Array, phi_dot: Array) -> State:
    C = scene.chart.C @ Rotation.from_rotvec(y[3:6]).as_matrix()
    w, i, j, k = Rotation.from_matrix(C).as_quat(scalar_first=True).tolist()
    X, Y, Z = (scene.chart.O1 + scene.chart.C @ y[:3]).tolist()
    u, v, a, p, q, r = y[6:].tolist()
    return replace(
        scene.rest,
        position=(X, Y, Z),
        angles=None,
        quaternion=(w, i, j, k),
        V=(u, v, a, p, q, r),
        phi=tuple(phi.tolist()),
        phi_dot=tuple(phi_dot.tolist()),
    )


def _forward(scene: Scene, y: Array, phi: Array, phi_dot: Array) -> Array:
    """V* (6) by the literal reference."""
    at = pieces(scene.stand, _state(scene, y, phi, phi_dot))
    return forward(at, np.zeros(len(phi)))


@dataclass(frozen=True, eq=False)
class _Linearised:
    """i w_k dc_k - [J dy + push dh]_k = r_k, with free . dc_k = - free . c_k for constant k; unknown dc, dh.

    J (M, 12, 12), push (M, 12, f) at the nodes; free (f, 12); w (n, rad/s); slow: the constant k; size (12).
    """

    torus: Torus
    J: Array
    push: Array
    free: Array
    w: Array
    slow: Whole
    size: Array

    def solve(self, r: Complex, c: Complex) -> tuple[Complex, Complex] | None:
        """dc (n, 12), dh (n, f); None if the equations are singular, at an undamped resonance."""
        n, f = len(self.w), len(self.free)
        inverse = self._inverse()
        if inverse is None:
            return None
        slow = np.zeros(n, dtype=bool)
        slow[self.slow] = True

        def pack(found: Complex) -> Array:
            scaled = found / np.concatenate([self.size, np.ones(f)])
            return np.concatenate([scaled.real.ravel(), scaled.imag.ravel()])

        def unpack(x: Array) -> Complex:
            half = len(x) // 2
            found = (x[:half] + 1j * x[half:]).reshape(n, 12 + f)
            found[0] = found[0].real
            return np.asarray(found * np.concatenate([self.size, np.ones(f)]))

        def back(right: Complex) -> Array:
            found = (inverse @ right[:, :, None])[:, :, 0]
            found[0] = found[0].real
            return pack(found)

        def forward(x: Array) -> Array:
            found = unpack(x)
            dc, dh = found[:, :12], np.where(slow[:, None], found[:, 12:], 0.0)
            dy, at = self.torus.values(dc), self.torus.values(dh)
            moved = (self.J @ dy[:, :, None])[:, :, 0] + (self.push @ at[:, :, None])[:, :, 0]
            left = 1j * self.w[:, None] * dc - self.torus.coefficients(moved)
            last = np.where(slow[:, None], dc @ self.free.T, found[:, 12:])
            return back(np.concatenate([left, last], axis=1))

        last = np.where(slow[:, None], -c @ self.free.T, 0.0)
        count = 2 * n * (12 + f)
        operator = LinearOperator((count, count), matvec=forward, dtype=np.float64)
        right = back(np.concatenate([r, last], axis=1))
        x, missed = gmres(operator, right, rtol=ACCURATE, atol=0.0, restart=RESTART, maxiter=ROUNDS)
        if missed or not np.all(np.isfinite(x)):
            return None
        found = unpack(x)
        return found[:, :12], np.where(slow[:, None], found[:, 12:], 0.0)

    def _inverse(self) -> Complex | None:
        """Inverses (n, 12 + f, 12 + f) of the mean equations, one per k; constants h belong to constant k."""
        n, f = len(self.w), len(self.free)
        A = np.zeros((n, 12 + f, 12 + f), dtype=np.complex128)
        A[:, :12, :12] = -self.J.mean(axis=0)
        A[:, range(12), range(12)] += 1j * self.w[:, None]
        A[:, range(12, 12 + f), range(12, 12 + f)] = 1.0
        A[self.slow, 12:, 12:] = 0.0
        A[self.slow, :12, 12:], A[self.slow, 12:, :12] = -self.push.mean(axis=0), self.free
        try:
            found = np.asarray(np.linalg.inv(A), dtype=np.complex128)
        except np.linalg.LinAlgError:
            return None
        return found if np.all(np.isfinite(found)) else None
