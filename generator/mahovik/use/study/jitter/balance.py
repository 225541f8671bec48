"""Harmonic balance of the carrier's motion over the phases of all flywheels, at any constant speeds: (8) in full.

The state about rest is a function on a torus, y(theta), one phase theta_s per flywheel that turns. It obeys

    sum_s phi_s' dy/dtheta_s = y'(theta, y),

so that coefficient k obeys i k . phi' y_k = [y'(theta, y)]_k. Newton's method; its linear equations are solved by
GMRES, preconditioned by their mean over all phases. Kept are all k up to an order. Where nothing outside acts, momentum
takes the place of (8), see `conserved`. What the others would add is measured twice: the accelerations that the literal
reference (8) finds along the motion at random phases differ by `left_out`; and `missing` is the motion, to first order,
by the lines that the equations still have up to MORE higher orders.

Directions without a restoring force are kept from drifting: of all motions the one is found whose mean pose is that of
rest and whose mean rotation is zero, for any phases. Where momentum is conserved nothing is needed for that.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.errors import CheckError
from mahovik.proof.reference import pieces
from mahovik.proof.reference.forward import forward
from mahovik.use.plan.array import Array, Complex
from mahovik.use.plan.forward import Drive
from mahovik.use.study.jitter.conserved import Conserved, conserves, solve
from mahovik.use.study.jitter.linearised import Linearised
from mahovik.use.study.jitter.torus import Torus, Whole
from mahovik.use.study.response.scene import Scene

STEPS = 20
SETTLED = 1e-11
"""Relative size of a last step of Newton's method."""

SMALL = 0.01
"""Part of a settled step that its linear equations may be off: more accuracy changes nothing."""

SAME = 0.1
"""The linear equations serve for further steps as long as each step is at most this part of the one before."""

ROUNDING = 1e-15
"""m/s2, rad/s2: smaller amplitudes of V* count as zero."""

LARGEST = 2.0
"""rad: limit near the edge of the chart."""

SLOW = 1e-9
"""Part of the fastest speed below which a combination k . phi' is a constant, as of two flywheels of one speed."""

ENOUGH = 1e-6
"""Accelerations left out, relative, at which no higher order is tried."""

ENOUGH_POSE = 1e-4
"""Pose left out, relative, likewise: slow beats of higher orders move far with small accelerations."""

LITTLE = 1e-6
"""Part of the other below which a displacement or turning of the carrier is not judged."""

MORE = 2
"""Orders above the kept ones whose remaining lines are found."""

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
    left_out  largest remaining acceleration by the literal reference at SAMPLES random phases, part of the largest
    missing   (m, 6): coefficients of the pose (x, r) left out, of all k up to `missing_order`; None: too many
    missing_w (m; rad/s): their k . phi', 0 for constants
    short     why no higher order was found though this one leaves out too much; empty: it does not
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
    missing: Complex | None = None
    missing_w: Array = field(default_factory=lambda: np.zeros(0))
    missing_order: int = 0
    short: str = ""

    @property
    def pose_left_out(self) -> float:
        """Sum of the amplitudes left out of the pose as a part of the sum of those found: of x or r, the larger.

        0 where they are not known.
        """
        if self.missing is None:
            return 0.0
        radius = _radius(self.scene)
        left, whole = (
            [
                size * float(np.linalg.norm(np.abs(c[moving, i : i + 3]).sum(axis=0)))
                for i, size in ((0, 1.0), (3, radius))
            ]
            for c, moving in ((self.missing, self.missing_w != 0.0), (self.c, (self.torus.k != 0).any(axis=1)))
        )
        least = LITTLE * max(whole)
        return max(a / max(b, least) for a, b in zip(left, whole, strict=True)) if least else 0.0

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
        if found.left_out <= ENOUGH and found.pose_left_out <= ENOUGH_POSE:
            return found
        try:
            found = search.at(higher)
        except CheckError as error:
            return replace(found, short=str(error))
    return found


class _Search:
    """Newton's method at one order after the other, each from the last."""

    def __init__(self, scene: Scene, speeds: Array, phases: Array) -> None:
        self.scene, self.speeds, self.phases = scene, speeds, phases
        self.turning = tuple(int(s) for s in np.flatnonzero(speeds))
        self.fastest = float(np.abs(speeds).max(initial=0.0)) or 1.0
        self.before: tuple[Torus, Complex] | None = None
        self.conserves = conserves(scene)

    def at(self, order: int) -> Balance:
        """The motion at an order. Raises CheckError."""
        torus = Torus.of(len(self.turning), order)
        w, slow = self._frequencies(torus)
        if self.conserves:
            return self._by_momentum(order, torus, w, slow)
        given = self._drive(torus.nodes)
        f = self.scene.free.shape[1]
        push = self.scene.effect_of_wrench(given)
        c, h = self._start(torus), np.zeros((len(torus.k), f), dtype=np.complex128)
        size = np.repeat([1.0, self.fastest], 6)
        linear, before = None, np.inf
        for _ in range(STEPS):
            y = torus.values(c)
            if not np.all(np.isfinite(y)) or np.abs(y[:, 3:6]).max() > LARGEST:
                break
            rate = self.scene.chart.rate(given, y) + (push @ torus.values(h)[:, :, None])[:, :, 0]
            if linear is None:
                J = self.scene.jacobian(given, y, rate[:, 6:])
                linear = Linearised(torus, J, push, self.scene.free_displacement, w, slow, size)
            settled = SETTLED * np.abs(c / size).max() + ROUNDING / self.fastest**2
            step = linear.solve(torus.coefficients(rate) - 1j * w[:, None] * c, c, SMALL * settled)
            if step is None:
                break
            c, h = c + step[0], h + step[1]
            change = np.abs(step[0] / size).max()
            if change <= SETTLED * np.abs(c / size).max() + ROUNDING / self.fastest**2:
                self.before = torus, c
                return self._with_missing(self._result(order, torus, c, h), linear, h)
            if change > SAME * before:  # the linear equations of an earlier step help little here
                linear = None
            before = change
        raise self._failure(order)

    def _by_momentum(self, order: int, torus: Torus, w: Array, slow: Whole) -> Balance:
        """The motion of a stand that keeps its momentum. Raises CheckError."""
        own = Conserved.of(torus, self._drive(torus.nodes))
        found = solve(own, w, slow, self._start(torus)[:, 3:6])
        if found is None:
            raise self._failure(order)
        c = own.state(found.r, found.L, slow)
        self.before = torus, c
        result = self._result(order, torus, c, np.zeros((len(w), 6), dtype=np.complex128))
        larger = self._larger(order)
        if larger is None:
            return result
        w, slow = self._frequencies(larger)
        beyond = Conserved.of(larger, self._drive(larger.nodes))
        missing = beyond.remainder(found.r, found.L, c[:, :3], w, slow, found.near)
        return _with(result, missing, w, slow, order + MORE)

    def _with_missing(self, found: Balance, linear: Linearised, h: Complex) -> Balance:
        """A motion with what it leaves out of (8)."""
        larger = self._larger(found.order)
        if larger is None:
            return found
        w, slow = self._frequencies(larger)
        inverse = linear.inverse(w, slow)
        if inverse is None:
            return found
        c, held = larger.pad(found.c), larger.pad(h)
        given = self._drive(larger.nodes)
        rate = self.scene.chart.rate(given, larger.values(c))
        rate += (self.scene.effect_of_wrench(given) @ larger.values(held)[:, :, None])[:, :, 0]
        left = larger.coefficients(rate) - 1j * w[:, None] * c
        missing = (inverse[:, :6, :12] @ left[:, :, None])[:, :, 0]
        return _with(found, missing, w, slow, found.order + MORE)

    def _larger(self, order: int) -> Torus | None:
        """The torus of the orders whose remaining lines are found; None: too many nodes."""
        try:
            return Torus.of(len(self.turning), order + MORE)
        except CheckError:
            return None

    def _frequencies(self, torus: Torus) -> tuple[Array, Whole]:
        """k . phi' (n; rad/s) and the places of those that are constant."""
        w = torus.frequencies(self.speeds[list(self.turning)])
        return w, np.flatnonzero(np.abs(w) <= SLOW * self.fastest)

    def _failure(self, order: int) -> CheckError:
        given_text = ", ".join(f"{x:.6g}" for x in self.speeds)
        return CheckError(
            f"{self.scene.stand.name} at speeds {given_text} rad/s: no steady motion found to order {order}: an "
            "undamped resonance, a carrier that moves too violently, or a beat too slow to be resolved"
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
        held = (self.scene.effect_of_wrench(given) @ found.torus.at(h, theta)[:, :, None])[:, 6:, 0]
        exact = np.array([_forward(self.scene, y[i], phi[i], self.speeds) for i in range(len(theta))])
        left = y_dot[:, 6:] - exact - held
        pose = y_dot[:, :6] - self.scene.chart.rate(given, y)[:, :6]
        parts = [_largest(self.scene, a, b) for a, b in ((left, exact), (pose, y_dot[:, :6]))]
        return max(parts)


def _with(found: Balance, missing: Complex, w: Array, slow: Whole, order: int) -> Balance:
    w = w.copy()
    w[slow] = 0.0
    return replace(found, missing=missing, missing_w=w, missing_order=order)


def _radius(scene: Scene) -> float:
    """Radius of gyration, m."""
    return float(np.sqrt(np.trace(scene.K[3:, 3:]) / np.trace(scene.K[:3, :3])))


def _largest(scene: Scene, off: Array, whole: Array) -> float:
    """Largest of off (M, 6) as a part of the largest of `whole`, rotations times the radius of gyration."""
    radius = _radius(scene)
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
