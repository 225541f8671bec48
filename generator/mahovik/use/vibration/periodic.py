"""The periodic steady state of the carrier under flywheels at constant speeds: (8) in full, by Fourier collocation.

y at 2 H + 1 uniform nodes is a trigonometric polynomial of H harmonics, found by Newton's method. Its linear equations
are solved by GMRES, preconditioned by their mean over the period, harmonic by harmonic; what varies in it is small
where unbalance is.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg import expm
from scipy.sparse.linalg import LinearOperator, gmres
from scipy.spatial.transform import Rotation

from mahovik.core.stand.model import Stand
from mahovik.errors import CheckError
from mahovik.proof.reference.rotation import carrier_rotation
from mahovik.use.plan.array import Array, Complex
from mahovik.use.study.rest import rest
from mahovik.use.vibration.scene import FREE, Scene, coordinates
from mahovik.use.vibration.speeds import Turning, common_period
from mahovik.use.vibration.torus import odd_length
from mahovik.use.vibration.view import FullMotion, Observable

ACCURATE = 1e-7
"""Accuracy of GMRES in one step of Newton's method."""

RESTART, ROUNDS = 60, 5


def derivative(y: Array, base: float) -> Array:
    """dy/dt at the nodes (M odd, ...), base: 2 pi / period (rad/s)."""
    M = len(y)
    spectrum = np.fft.rfft(y, axis=0)
    k = np.arange(len(spectrum)).reshape(-1, *(1,) * (y.ndim - 1))
    return np.asarray(np.fft.irfft(1j * base * k * spectrum, M, axis=0))


@dataclass(frozen=True, eq=False)
class LinearSystem:
    """dy' = J dy + push dh + r with conditions: conditions . mean(dy) = c. The unknowns are dy (M, n) and dh (f).

    J (M, n, n); push (M, n, f): effect of the constant numbers h on y'; conditions (f, n); base: rad/s;
    size (n): scales of the unknowns.
    """

    J: Array
    push: Array
    conditions: Array
    base: float
    size: Array

    def solve(self, r: Array, c: Array) -> tuple[Array, Array] | None:
        """dy, dh; None if the equations are singular, at an undamped resonance."""
        M, n = r.shape
        f = len(c)
        inverse = self._inverse(M)
        if inverse is None:
            return None

        def pack(dy: Array, dh: Array) -> Array:
            return np.concatenate([(dy / self.size).ravel(), dh])

        def back(r: Array, c: Array) -> Array:
            spectrum = np.fft.rfft(r, axis=0).astype(np.complex128)
            right = np.concatenate([spectrum, np.zeros((len(spectrum), f))], axis=1)
            right[0, n:] = M * c
            found = (inverse @ right[:, :, None])[:, :, 0]
            return pack(np.fft.irfft(found[:, :n], M, axis=0), found[0, n:].real / M)

        def forward(x: Array) -> Array:
            dy, dh = x[: M * n].reshape(M, n) * self.size, x[M * n :]
            left = derivative(dy, self.base) - (self.J @ dy[:, :, None])[:, :, 0] - self.push @ dh
            return back(left, self.conditions @ dy.mean(axis=0))

        count = M * n + f
        operator = LinearOperator((count, count), matvec=forward, dtype=np.float64)
        x, missed = gmres(operator, back(r, c), rtol=ACCURATE, atol=0.0, restart=RESTART, maxiter=ROUNDS)
        if missed or not np.all(np.isfinite(x)):
            return None
        return x[: M * n].reshape(M, n) * self.size, x[M * n :]

    def _inverse(self, M: int) -> Complex | None:
        """Inverses (H + 1, n + f, n + f) of the mean equations, one per harmonic; constants h belong to the zeroth."""
        n, f = self.J.shape[1], len(self.conditions)
        k = np.arange(M // 2 + 1)
        A = np.zeros((len(k), n + f, n + f), dtype=np.complex128)
        A[:, :n, :n] = -self.J.mean(axis=0)
        A[:, range(n), range(n)] += 1j * self.base * k[:, None]
        A[0, :n, n:], A[0, n:, :n] = -self.push.mean(axis=0), self.conditions
        A[1:, range(n, n + f), range(n, n + f)] = 1.0
        try:
            found = np.asarray(np.linalg.inv(A), dtype=np.complex128)
        except np.linalg.LinAlgError:
            return None
        return found if np.all(np.isfinite(found)) else None


def resample(y: Array, M: int) -> Array:
    """The same trigonometric polynomial at M nodes (odd), without its highest harmonics if M is smaller."""
    spectrum = np.fft.rfft(y, axis=0)
    H = min(len(spectrum), M // 2 + 1)
    return np.asarray(np.fft.irfft(spectrum[:H], M, axis=0) * (M / len(y)))


PER_TURN = 4
"""Harmonics per turn of the fastest flywheel at first."""

MOST = 8192
"""Most harmonics of the common period."""

TAIL, KINKED_TAIL = 1e-10, 1e-7
"""Largest part of the largest harmonic of V* that the highest third may hold; otherwise harmonics are doubled.

Damping with magnitudes has kinks: harmonics fall only as the third power of their number.
"""

COARSE = 1e-6
"""Larger limit of that part, if more harmonics do not help or are too many; beyond it there is no result."""

ROUNDING = 1e-14
"""m/s2, rad/s2: smaller harmonics count as zero."""

STEPS = 30
NEWTON_TOLERANCE = 1e-12
"""Relative size of a last step of Newton's method."""

LARGEST = 2.0
"""rad: limit near the edge of the chart."""

UNSTABLE = 1e-3
"""Multipliers above 1 by more than this grow; less may be rounding of a neutral one."""


@dataclass(frozen=True, eq=False)
class Periodic:
    """A periodic steady state, at M uniform nodes of the common period.

    turning      base frequency and turns; the speeds are turning.speeds
    y, V_dot     (M, 12), (M, 6): states in the chart about rest, y = (x, r, V), and V*
    phi          (M, N): phases of the flywheels
    hold         (6; N, N m): constant wrench on the carrier in E1 that keeps its mean place along free directions;
                 zero to rounding if momentum is conserved
    multiplier   largest modulus of the multipliers of the linear equations along the course
    tail         part of the largest harmonic of V* that the highest third holds: possible gain of more harmonics
    natural      (Hz): frequencies of the linear equations, mean over the period, ascending, without free ones
    """

    scene: Scene
    turning: Turning
    y: Array
    V_dot: Array
    phi: Array
    hold: Array
    multiplier: float
    tail: float
    natural: Array

    def values(self, seen: Observable) -> Array:
        """What is seen at the nodes (M, axes)."""
        speeds = np.broadcast_to(self.turning.speeds, self.phi.shape)
        motion = FullMotion(self.scene, self.phi, speeds, self.y, self.V_dot, self.hold)
        return seen.full(motion)[:, : len(seen.axes)]

    def harmonics(self, seen: Observable) -> Complex:
        """(H + 1, axes) complex amplitudes a_k: what is seen is the real part of sum a_k exp(i k base t)."""
        values = self.values(seen)
        spectrum = np.fft.rfft(values, axis=0) * (2.0 / len(values))
        spectrum[0] /= 2.0
        return np.asarray(spectrum)

    @property
    def stable(self) -> bool:
        """Whether deviations do not grow."""
        return self.multiplier <= 1.0 + UNSTABLE

    @property
    def frequencies(self) -> Array:
        """Frequencies (H + 1, Hz) of the points' harmonics."""
        return np.asarray(np.arange(len(self.y) // 2 + 1) * self.turning.base / (2.0 * np.pi))


def periodic_response(
    stand: Stand | Scene,
    speeds: Sequence[float],
    phases: Sequence[float] | None = None,
) -> Periodic:
    """The periodic steady state near rest under flywheels at constant `speeds` (N, rad/s).

    `stand`: or its Scene, for many speeds; `phases` (N, rad) at t = 0, default 0.
    Raises UsageError: no common period. CheckError: no equilibrium, or no steady state is found.
    """
    scene = Scene.of(stand) if isinstance(stand, Stand) else stand
    turning = common_period(speeds)
    start = np.zeros(len(turning.turns)) if phases is None else np.array(phases, dtype=np.float64)
    if not turning.base:
        return _at_rest(scene, turning, start)
    if not scene.count:
        return _clamped_response(scene, turning, start)
    search = _Search(scene, turning, start)
    return search.result()


def phases_at(turning: Turning, phases: Array, M: int) -> Array:
    """Phases (M, N) of the flywheels at M nodes of the period."""
    t = np.arange(M)[:, None] / M
    return np.asarray(phases + 2.0 * np.pi * np.remainder(np.array(turning.turns, dtype=np.float64) * t, 1.0))


def _clamped_response(scene: Scene, turning: Turning, phases: Array) -> Periodic:
    """Result of a carrier that does not move: wrenches of the flywheels have few waves a turn."""
    M = odd_length(2 * max(8, PER_TURN * max(map(abs, turning.turns))) + 1)
    phi = phases_at(turning, phases, M)
    return Periodic(scene, turning, np.zeros((M, 12)), np.zeros((M, 6)), phi, np.zeros(6), 1.0, 0.0, np.zeros(0))


def _at_rest(scene: Scene, turning: Turning, phases: Array) -> Periodic:
    """Result with all flywheels at rest: one node, no harmonics."""
    state = rest(scene.stand, phases.tolist()).state
    chart = scene.chart
    turned = Rotation.from_matrix(chart.C.T @ carrier_rotation(scene.stand, state))
    x = (np.array(state.position) - chart.O1) @ chart.C
    y, V_dot = np.concatenate([x, turned.as_rotvec(), np.zeros(6)])[None], np.zeros((1, 6))
    given = scene.drive(phases[None], np.zeros((1, len(phases))))
    own = np.hstack([coordinates(scene.S, y), np.zeros((1, scene.count))])
    J = scene.jacobian(given, own, V_dot) if scene.count else np.zeros((1, 0, 0))
    growing = float(np.linalg.eigvals(J[0]).real.max(initial=0.0)) > np.sqrt(FREE)
    multiplier = np.inf if growing else 1.0
    return Periodic(scene, turning, y, V_dot, phases[None], np.zeros(6), multiplier, 0.0, natural(J))


class _Search:
    """Newton's method at a number of harmonics, doubled until the highest ones are negligible."""

    def __init__(self, scene: Scene, turning: Turning, phases: Array) -> None:
        self.scene, self.turning, self.phases = scene, turning, phases
        f = scene.free.shape[1]
        self.y, self.h = np.zeros((1, 2 * scene.count)), np.zeros(f)
        H = max(8, PER_TURN * max(map(abs, turning.turns)))
        enough = KINKED_TAIL if scene.stand.has_kinks else TAIL
        before = np.inf
        while True:
            self._solve(H)
            self.tail = self._tail()
            if self.tail <= enough or (self.tail <= COARSE and (self.tail > before / 2 or 2 * H > MOST)):
                return
            before, H = self.tail, 2 * H
            if H > MOST:
                raise CheckError(f"{self._failure()}: its harmonics do not fall off within {MOST} of the period")

    def _failure(self) -> str:
        given = ", ".join(f"{x:.6g}" for x in self.turning.speeds)
        return f"{self.scene.stand.name} at speeds {given} rad/s: no periodic steady state found"

    def _solve(self, H: int) -> None:
        """The course with H harmonics. Raises CheckError."""
        M = odd_length(2 * H + 1)
        scene, base = self.scene, self.turning.base
        phi = phases_at(self.turning, self.phases, M)
        self.given = given = scene.drive(phi, np.broadcast_to(self.turning.speeds, phi.shape))
        y, h, push = resample(self.y, M), self.h, scene.effect_of_wrench(given)
        fastest = base * max(map(abs, self.turning.turns))
        size = np.repeat([1.0, fastest], scene.count)
        for number in range(STEPS):
            rate = scene.rate(given, y) + push @ h
            left = rate - derivative(y, base)
            if number and np.abs(left).max() <= scene.noise:
                return
            J = scene.jacobian(given, y, scene.twist(rate[:, scene.count :]))
            linear = LinearSystem(J, push, scene.free_displacement, base, size)
            step = linear.solve(left, -scene.free_displacement @ y.mean(axis=0))
            if step is None:
                break
            y, h = y + step[0], h + step[1]
            self.y, self.h, self.J = y, h, J
            if not np.all(np.isfinite(y)) or np.abs(scene.whole(y)[:, 3:6]).max() > LARGEST:
                break
            if np.abs(step[0] / size).max() <= NEWTON_TOLERANCE * np.abs(y / size).max() + ROUNDING / fastest**2:
                return
        raise CheckError(f"{self._failure()}: an undamped resonance, or the carrier moves too violently")

    def _tail(self) -> float:
        """Part of the largest harmonic of V* that the highest third holds; 0 if it is rounding."""
        sizes = np.abs(np.fft.rfft(self.V_dot(), axis=0)) / len(self.y)
        each = (sizes * np.repeat([1.0, self._gyration_radius()], 3)).max(axis=1)
        last = float(each[2 * len(each) // 3 :].max())
        return 0.0 if last <= ROUNDING else last / float(each.max())

    def _gyration_radius(self) -> float:
        """Radius of gyration, m, to compare rotations with displacements."""
        K = self.scene.K
        return float(np.sqrt(np.trace(K[3:, 3:]) / np.trace(K[:3, :3])))

    def V_dot(self) -> Array:
        """V* (M, 6)."""
        scene = self.scene
        pushed = (scene.effect_of_wrench(self.given) @ self.h)[:, scene.count :]
        return scene.acceleration(self.given, self.y) + scene.twist(pushed)

    def result(self) -> Periodic:
        """The result of the course."""
        V_dot, y = self.V_dot(), self.scene.whole(self.y)
        multiplier = largest_multiplier(self.J, self.turning.period)
        hold = self.scene.wrench @ self.h
        phi = self.given.phi
        return Periodic(self.scene, self.turning, y, V_dot, phi, hold, multiplier, self.tail, natural(self.J))


def largest_multiplier(J: Array, period: float) -> float:
    """Largest modulus of the multipliers of dy' = J dy over a `period`, s: exponentials between middles of nodes."""
    monodromy = np.eye(J.shape[1])
    for each in expm(J * (period / len(J))):
        monodromy = each @ monodromy
    return float(np.abs(np.linalg.eigvals(monodromy)).max())


def natural(J: Array) -> Array:
    """Natural frequencies (Hz) of the mean of J, ascending, without free directions and non-oscillating modes."""
    values = np.linalg.eigvals(J.mean(axis=0))
    swinging = values.imag > max(1e-6 * float(np.abs(values).max(initial=0.0)), 1e-6)
    return np.sort(np.abs(values[swinging])) / (2.0 * np.pi)
