"""The periodic steady state of the carrier under flywheels at constant speeds: (8) in full, by Fourier collocation.

With a common period the torus of `balance` has one phase, that of the period: y is a trigonometric polynomial of H
harmonics, for the phases of the flywheels as they are.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg import expm

from mahovik.core.stand.model import Stand
from mahovik.errors import CheckError
from mahovik.use.numeric.course import equilibrium
from mahovik.use.numeric.se3 import Array, Complex
from mahovik.use.vibration.balance import newton
from mahovik.use.vibration.scene import FREE, Scene
from mahovik.use.vibration.speeds import Turning, common_period
from mahovik.use.vibration.torus import Torus
from mahovik.use.vibration.torus_motion import gyration_radius, rounding_rates
from mahovik.use.vibration.view import FullMotion, Observable

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
    natural      (Hz): frequencies of the linear equations, mean over the period, ascending, without free ones
    """

    scene: Scene
    turning: Turning
    y: Array
    V_dot: Array
    phi: Array
    hold: Array
    multiplier: float
    natural: Array

    @property
    def motion(self) -> FullMotion:
        """The motion at the nodes."""
        speeds = np.broadcast_to(self.turning.speeds, self.phi.shape)
        return FullMotion(self.scene, self.phi, speeds, self.y, self.V_dot, self.hold)

    def values(self, seen: Observable) -> Array:
        """What is seen at the nodes (M, axes)."""
        return seen.full(self.motion)[:, : len(seen.axes)]

    def harmonics(self, seen: Observable) -> Complex:
        """(H + 1, axes) complex amplitudes a_k: what is seen is the real part of sum a_k exp(i k base t)."""
        return harmonics(self.values(seen))

    @property
    def stable(self) -> bool:
        """Whether deviations do not grow."""
        return self.multiplier <= 1.0 + UNSTABLE

    @property
    def frequencies(self) -> Array:
        """Frequencies (H + 1, Hz) of the points' harmonics."""
        return np.asarray(np.arange(len(self.y) // 2 + 1) * self.turning.base / (2.0 * np.pi))


def harmonics(values: Array) -> Complex:
    """Complex amplitudes (H + 1, ...) of values (M, ...) at the nodes of a period."""
    result = np.fft.rfft(values, axis=0) * (2.0 / len(values))
    result[0] /= 2.0
    return np.asarray(result)


def periodic_response(
    stand: Stand | Scene, speeds: Sequence[float], phases: Sequence[float] | None = None
) -> Periodic:  # fmt: skip
    """The periodic steady state near rest under flywheels at constant `speeds` (N, rad/s).

    Harmonics are doubled until the highest ones are negligible.
    `stand`: or its Scene, for many speeds; `phases` (N, rad) at t = 0, default 0.
    Raises UsageError: no common period. CheckError: no equilibrium, or no steady state is found.
    """
    scene = Scene.of(stand) if isinstance(stand, Stand) else stand
    turning = common_period(speeds)
    start = np.zeros(len(turning.turns)) if phases is None else np.array(phases, dtype=np.float64)
    if not turning.base:
        return _at_rest(scene, turning, start)
    constant, enough, before = np.array(turning.speeds), KINKED_TAIL if scene.stand.has_kinks else TAIL, np.inf
    rounding, fastest, why = rounding_rates(scene, constant), float(np.abs(constant).max()), ""
    H, c = max(8, PER_TURN * max(map(abs, turning.turns))), np.zeros((1, 2 * scene.count), dtype=np.complex128)
    while H <= MOST and not why:
        torus = Torus.of(1, H)
        turned = np.outer(np.arange(torus.M) / torus.M, np.array(turning.turns, dtype=np.float64))
        phi = np.asarray(start + 2.0 * np.pi * np.remainder(turned, 1.0))
        drive = scene.drive(phi, np.broadcast_to(constant, phi.shape))
        w, slow = np.asarray(turning.base * torus.k[:, 0], dtype=np.float64), np.zeros(1, dtype=np.int64)
        solved = newton(scene, torus, drive, w, slow, torus.pad(c), rounding, fastest)
        if solved is None:
            why = "an undamped resonance, or the carrier moves too violently"
            continue
        c, h, y = solved.c, solved.h[0].real, torus.values(solved.c)
        pushed = (scene.effect_of_wrench(drive) @ h)[:, scene.count :]
        V_dot = scene.chart.acceleration(drive, y) + scene.twist(pushed)
        tail = _tail(scene, V_dot, len(c))
        if tail <= enough or (tail <= COARSE and (tail > before / 2 or 2 * H > MOST)):
            J = scene.chart.jacobian(drive, y)
            multiplier = largest_multiplier(J, turning.period)
            hold = scene.wrench @ h
            return Periodic(scene, turning, scene.whole(y), V_dot, phi, hold, multiplier, natural(J))
        before, H = tail, 2 * H
    at, why = (
        ", ".join(f"{x:.6g}" for x in constant),
        why or f"its harmonics do not fall off within {MOST} of the period",
    )
    raise CheckError(f"{scene.stand.name} at speeds {at} rad/s: no periodic steady state found: {why}")


def _at_rest(scene: Scene, turning: Turning, phases: Array) -> Periodic:
    """Result with all flywheels at rest: one node, no harmonics."""
    y = equilibrium(scene.chart, phases).y[None] if scene.count else np.zeros((1, 0))
    J = scene.chart.jacobian(scene.drive(phases[None], np.zeros((1, len(phases)))), y)
    growing = float(np.linalg.eigvals(J[0]).real.max(initial=0.0)) > np.sqrt(FREE)
    multiplier = np.inf if growing else 1.0
    return Periodic(
        scene, turning, scene.whole(y), np.zeros((1, 6)), phases[None], np.zeros(6), multiplier, natural(J)
    )  # fmt: skip


def _tail(scene: Scene, V_dot: Array, count: int) -> float:
    """Part of the largest harmonic of V* (M, 6), of so many, that the highest third holds; 0 if it is rounding."""
    sizes = np.abs(np.fft.rfft(V_dot, axis=0)) / len(V_dot)
    harmonic = (sizes * np.repeat([1.0, gyration_radius(scene)], 3)).max(axis=1)[:count]
    last = float(harmonic[2 * len(harmonic) // 3 :].max())
    return 0.0 if last <= ROUNDING else last / float(harmonic.max())


def largest_multiplier(J: Array, period: float) -> float:
    """Largest modulus of the multipliers of dy' = J dy over a `period`, s: exponentials between middles of nodes."""
    monodromy = np.eye(J.shape[1])
    if not J.size:
        return 1.0
    for factor in expm(J * (period / len(J))):
        monodromy = factor @ monodromy
    return float(np.abs(np.linalg.eigvals(monodromy)).max())


def natural(J: Array) -> Array:
    """Natural frequencies (Hz) of the mean of J, ascending, without free directions and non-oscillating modes."""
    values = np.linalg.eigvals(J.mean(axis=0))
    swinging = values.imag > max(1e-6 * float(np.abs(values).max(initial=0.0)), 1e-6)
    return np.sort(np.abs(values[swinging])) / (2.0 * np.pi)
