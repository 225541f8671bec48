"""Jitter to first order: lines in the spectrum of a point by the carrier's response to each flywheel's unbalance.

Flywheels of one speed share a line, and their phases matter there: they are chosen so that the amplitudes cancel as far
as possible.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.use.numeric import Array, Complex
from mahovik.use.vibration.band import in_band
from mahovik.use.vibration.chain import Chain, Makers
from mahovik.use.vibration.quiet.options import Interval, QuietOptions
from mahovik.use.vibration.scene import Scene
from mahovik.use.vibration.torus_motion import state_at
from mahovik.use.vibration.view import LinearMotion, find_view


@dataclass(frozen=True, eq=False)
class Amplitudes:
    """Amplitudes to first order in unbalance, exact in the carrier: suspension, damping, fluid, gyroscopic moments.

    Every flywheel s turns at constant speed; its contribution is Re(a_s exp(i |phi_s'| t)), a_s linear in exp(+-i
    phi_s). axes (directions, 3) of the point, or of E1 for the reaction of a hold.
    """

    scene: Scene
    chain: Chain
    axes: Array

    @staticmethod
    def of(stand: Stand, options: QuietOptions) -> Amplitudes:
        """Amplitudes about the rest. Raises CheckError: no equilibrium; StateError."""
        scene = Scene.of(stand)
        chain = Chain.of(
            scene, find_view(stand, options.point, options.measure), Makers(), np.zeros(len(stand.flywheels))
        )
        return Amplitudes(scene, chain, np.array(options.axes))

    def at(self, speeds: Array) -> Complex:
        """Amplitudes (axes x N) at these speeds (N, rad/s), for phases zero; zero for a flywheel at rest."""
        a = self.chain.seen.linear(self._motion(speeds))[0, :, :, 0]
        return np.asarray(self.axes @ np.where(speeds[:, None] == 0.0, 0.0, a).T)

    def start(self, speeds: Array, phases: Array) -> State:
        """State at t = 0 on the steady motion, to first order; exactly where the hold allows."""
        motion = self._motion(speeds)
        pose = np.where(speeds[:, None] == 0.0, 0.0, motion.pose[0, :, :, 0])
        turned = np.exp(1j * np.sign(speeds) * phases)
        x, V = (turned @ each for each in (pose, 1j * motion.omega[0][:, None] * pose))
        own = np.concatenate([x.real, V.real]).reshape(2, 6) @ np.linalg.pinv(self.scene.S).T
        return state_at(self.scene, self.scene.whole(own.reshape(1, -1))[0], phases, speeds)

    def _motion(self, speeds: Array) -> LinearMotion:
        omega, wrench = self.chain.plant.unbalance(speeds[None], np.zeros(len(speeds)))
        return self.chain.by_unbalance(speeds[None], np.where(omega == 0.0, 1.0, omega), wrench)


SWEEPS = 400


def cancel(a: Complex, rng: np.random.Generator, starts: int = 48) -> tuple[Array, float]:
    """Angles psi (m; the first 0) that minimise |sum_k a_k exp(i psi_k)|^2, and the minimum; a: axes x m.

    Each angle in turn is set to its best value for the others, which never increases the sum, from many starts at once;
    Newton's method refines the best.
    """
    m = a.shape[1]
    if m == 1:
        return np.zeros(1), float(np.sum(np.abs(a) ** 2))
    R = a.conj().T @ a
    z = np.exp(1j * rng.uniform(-np.pi, np.pi, (starts, m)))
    before = np.full(starts, np.inf)
    for sweep in range(SWEEPS):
        for k in range(m):
            others = z @ R[k] - z[:, k] * R[k, k]
            size = np.abs(others)
            z[:, k] = np.where(size > 0.0, -others / np.where(size > 0.0, size, 1.0), z[:, k])
        if sweep % 10 == 9:
            now = _powers(a, z)
            if np.all(before - now <= 1e-9 * now):
                break
            before = now
    psi = np.angle(z[int(np.argmin(_powers(a, z)))])
    psi = _newton(a, psi)
    psi = np.angle(np.exp(1j * (psi - psi[0])))
    return psi, power(a, psi)


def power(a: Complex, psi: Array) -> float:
    """|sum_k a_k exp(i psi_k)|^2."""
    return float(np.sum(np.abs(a @ np.exp(1j * psi)) ** 2))


def _powers(a: Complex, z: Complex) -> Array:
    return np.asarray(np.sum(np.abs(z @ a.T) ** 2, axis=1))


def _newton(a: Complex, psi: Array) -> Array:
    """Damped Gauss-Newton steps on the real rows of the sum, as long as they reduce it."""
    damping, now = 1e-6, power(a, psi)
    for _ in range(60):
        terms = a * np.exp(1j * psi)
        total, slopes = terms.sum(axis=1), (1j * terms)[:, 1:]
        rows, r = np.vstack([slopes.real, slopes.imag]), np.concatenate([total.real, total.imag])
        H = rows.T @ rows
        step = np.linalg.solve(H + damping * (np.trace(H) / len(H) + 1e-300) * np.eye(len(H)), -(rows.T @ r))
        tried = psi + np.append(0.0, step)
        then = power(a, tried)
        if then < now:
            psi, now, damping = tried, then, max(damping * 0.1, 1e-14)
        else:
            damping *= 10.0
            if damping > 1e6:
                break
    return psi


SAME = 1e-9
"""Relative difference of speeds below which two flywheels turn together: a beat lasts years."""


@dataclass(frozen=True, eq=False)
class Line:
    """frequency (Hz); flywheels (indices); amplitude (axes, complex) of their sum; apart: sum of their mean squares."""

    frequency: float
    flywheels: tuple[int, ...]
    amplitude: Complex
    apart: float

    @property
    def mean_square(self) -> float:
        """Mean square in time, summed over axes."""
        return float(np.sum(np.abs(self.amplitude) ** 2)) / 2.0


def groups(speeds: Array) -> list[tuple[int, ...]]:
    """Groups of flywheels of equal speed, by magnitude of speed, without those at rest."""
    found: list[list[int]] = []
    for s in np.argsort(np.abs(speeds), kind="stable"):
        size = abs(speeds[s])
        if size == 0.0:
            continue
        if found and size - abs(speeds[found[-1][0]]) <= SAME * size:
            found[-1].append(int(s))
        else:
            found.append([int(s)])
    return [tuple(sorted(each)) for each in found]


def lines(speeds: Array, phases: Array, a: Complex) -> list[Line]:
    """The lines of these speeds and phases at t = 0 (rad); a (axes x N): amplitudes at phase zero."""
    turned = a * np.exp(1j * np.sign(speeds) * phases)
    found = []
    for group in groups(speeds):
        part = turned[:, group]
        frequency = float(abs(speeds[group[0]])) / (2.0 * np.pi)
        found.append(Line(frequency, group, part.sum(axis=1), float(np.sum(np.abs(part) ** 2)) / 2.0))
    return found


def mean_square(found: list[Line], band: Interval) -> float:
    """Mean square of all lines in the band."""
    return sum(each.mean_square for each in found if in_band(each.frequency, band))


def uncontrolled_mean_square(speeds: Array, a: Complex, band: Interval) -> float:
    """Mean square in the band if no phase is held, the mean over all phases; speeds in rad/s."""
    inside_band = in_band(np.abs(speeds) / (2.0 * np.pi), band) & (speeds != 0.0)
    return float(np.sum(np.abs(a[:, inside_band]) ** 2)) / 2.0


def best_phases(
    speeds: Array, a: Complex, band: Interval, rng: np.random.Generator, starts: int = 48
) -> tuple[Array, float]:
    """Phases at t = 0 (N, rad) that minimise the mean square in the band, and the minimum.

    The first of a group that turns together has phase zero; so has a flywheel that turns alone or outside the band.
    """
    phases, total = np.zeros(len(speeds)), 0.0
    for group in groups(speeds):
        if not in_band(float(abs(speeds[group[0]])) / (2.0 * np.pi), band):
            continue
        psi, least = cancel(a[:, group], rng, starts)
        phases[list(group)] = np.sign(speeds[list(group)]) * psi
        total += least / 2.0
    return phases, total
