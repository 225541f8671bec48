"""The check: simulation of the whole stand, by the emitted C or SciPy on the reference, independent of the search.

RMS in a band and the amplitude at a frequency are taken from the samples by one window with little leakage.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mahovik.core.motion.laws import Constant
from mahovik.core.motion.regime import FlywheelRegime, Regime
from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof.reference.motion import point_transfers
from mahovik.use.plan.array import Array, Complex
from mahovik.use.simulate import Case, simulate
from mahovik.use.vibration.band import EDGE, in_band
from mahovik.use.vibration.quiet.options import MEASURES, Interval, QuietOptions
from mahovik.use.vibration.view import REACTION

LOBE = 4.0
"""Half width of the window's main lobe, in 1/T; leakage beside it is 92 dB lower."""

_TERMS = (0.35875, 0.48829, 0.14128, 0.01168)  # Blackman-Harris (1978), four terms


def window(n: int) -> Array:
    """n samples of the window."""
    angle = 2.0 * np.pi * np.arange(n) / n
    return np.asarray(sum((-1.0) ** k * a * np.cos(k * angle) for k, a in enumerate(_TERMS)))


def band_rms(x: Array, every: float, band: Interval, integrals: int) -> float:
    """RMS (root of the sum over columns) in the band (Hz) of x (times x axes), `integrals` times integrated."""
    n = len(x)
    w = window(n)
    X = np.fft.rfft(w[:, None] * _without_trend(x, w), axis=0)
    f = np.fft.rfftfreq(n, every)
    inside = in_band(f, band) & (f > 0.0)
    power = np.sum(np.abs(X[inside]) ** 2, axis=1) / (2.0 * np.pi * f[inside]) ** (2 * integrals)
    return float(np.sqrt(2.0 * power.sum() / (n * np.sum(w**2))))


def line_amplitude(x: Array, every: float, frequency: float, integrals: int) -> float:
    """Amplitude (root of the sum of squares over columns) of the line at a frequency (Hz)."""
    w = window(len(x))
    turn = np.exp(-2j * np.pi * frequency * every * np.arange(len(x)))
    value = 2.0 * ((w * turn) @ _without_trend(x, w)) / w.sum()
    return float(np.linalg.norm(value)) / (2.0 * np.pi * frequency) ** integrals


def _without_trend(x: Array, w: Array) -> Array:
    """The samples without their weighted mean and slope."""
    t = np.linspace(-1.0, 1.0, len(x))
    basis = np.column_stack([np.ones_like(t), t])
    fit = np.linalg.lstsq(w[:, None] * basis, w[:, None] * x, rcond=None)[0]
    return np.asarray(x - basis @ fit)


SHORTEST, LONGEST, MOST = 1.0, 5.0, 20000
"""Shortest and longest simulated time, s; most samples, if a line just outside the band needs a longer time."""


@dataclass(frozen=True)
class Sampling:
    """Duration and time between samples, s."""

    until: float
    every: float

    @staticmethod
    def of(options: QuietOptions, speeds: Array) -> Sampling:
        """Sampling that separates lines from each other and from the band, as far as the longest time allows.

        Third harmonics of the flywheels are not aliased into the band.
        """
        f = np.unique(np.round(np.abs(speeds) / (2 * math.pi), 9))
        f = f[f > 0.0]
        beats = min((float(x) for x in np.diff(f) if x > 1e-9), default=math.inf)
        edges = min(
            (abs(float(x) - edge) for x in f for edge in options.band if abs(x - edge) > EDGE * edge), default=math.inf
        )
        rate = max(2.56 * options.band[1], options.band[1] + 3.2 * float(f.max(initial=0.0)))
        until = max(1.5 * LOBE / beats, 20.0 / max(options.band[0], 0.1), SHORTEST)
        until = max(min(until, LONGEST), min(1.5 * LOBE / edges, MOST / rate))
        count = math.ceil(until * rate)
        return Sampling(until, until / count)


def regime_of(stand: Stand, speeds: Array, phases: Array) -> Regime:
    """Constant speeds, rad/s, and phases at t = 0, rad."""
    driven = zip(stand.flywheels, speeds.tolist(), phases.tolist(), strict=True)
    return Regime("quiet", tuple(FlywheelRegime(s.name, Constant(speed), phase) for s, speed, phase in driven), {})


REACTION_COLUMNS = {
    "force": [f"{REACTION}.{letter} [N]" for letter in "xyz"],
    "moment": [f"{REACTION}.{letter} [N m]" for letter in "kmn"],
}


def simulate_point(
    stand: Stand,
    options: QuietOptions,
    start: State,
    sampling: Sampling,
    backend: str = "c",
    progress: Callable[[float], None] | None = None,
) -> Array:
    """The measured motion, not integrated (times x axes): acceleration of the point or of its rotation; the reaction.

    Raises ToolchainError, StateError, KeyboardInterrupt.
    """
    speeds, phases = np.array(start.phi_dot), np.array(start.phi)
    longest = 0.1 / max(float(np.abs(speeds).max()), 1.0)
    case = Case(stand, regime_of(stand, speeds, phases), start, sampling.until, sampling.every, min(longest, 1e-3))
    run = simulate(case, backend, progress=progress)
    if run.interrupted:
        raise KeyboardInterrupt
    if run.stopped is not None:
        raise StateError(run.stopped)
    count = round(sampling.until / sampling.every)
    if options.point == REACTION:
        columns = REACTION_COLUMNS[options.measure]
        return np.asarray(np.column_stack([run[name] for name in columns])[:count] @ np.array(options.axes).T)
    L = point_transfers(stand)[options.point]

    def six(linear: str, angular: str, over: tuple[str, str]) -> Array:
        names = [f"{linear}_{a} [{over[0]}]" for a in "xyz"] + [f"{angular}_{a} [{over[1]}]" for a in "xyz"]
        return np.column_stack([run[name] for name in names])[:count] @ L

    V, V_dot = six("v", "omega", ("m/s", "rad/s")), six("v_dot", "omega_dot", ("m/s2", "rad/s2"))
    if MEASURES[options.measure].turning:
        return np.asarray(V[:, 3:] @ np.array(options.axes).T)
    return np.asarray((V_dot[:, :3] + np.cross(V[:, 3:], V[:, :3])) @ np.array(options.axes).T)


def expected_samples(speeds: Array, phases: Array, a: Complex, integrals: int, sampling: Sampling) -> Array:
    """The same samples from amplitudes a (axes x N, integrated), for the same transform."""
    count = round(sampling.until / sampling.every)
    t = sampling.every * np.arange(count)
    omega, sign = np.abs(speeds), np.sign(speeds)
    before = a * (1j * omega) ** integrals * np.exp(1j * sign * phases)
    return np.asarray((np.exp(1j * np.outer(t, omega)) @ before.T).real)
