"""Slow trim: corrections of the programme's Fourier coefficients from harmonics of the carrier's measured error.

Along the programme the nominal, linear model gives the effect of small corrections c of mean and harmonics of each
flywheel on the harmonics E of the settled carrier: E = G c + E_0. After each window of measurement

    c <- c - g G^+ E,

with G^+ of least norm in directions that G reaches (corrections of harmonic k weigh 1 + k^2, as in planning, and
their effect on the next higher harmonics counts as well). With the real stand's G' instead of G and a settled carrier,
errors in those directions decay as (1 - g G' G^+)^n, so every g up to 1 converges if |(G' - G) G^+| < 1. A carrier that
has not settled is taken into account exactly: the state at the beginning of a window and c form a linear system from
window to window, and its spectral radius decides. Flywheels are assumed to follow their corrections at once: the servo
is much faster than a window.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.motion.servo import Trim
from mahovik.core.stand.model import Stand
from mahovik.errors import UsageError
from mahovik.use.control.reference_motion import Orbit, nodes, required_orbit
from mahovik.use.numeric.mechanics import Mechanics
from mahovik.use.numeric.se3 import Array
from mahovik.use.plan.basis import harmonics

QUICK = 8.0
"""Time constants of the corrections' smoothing during the settling."""

BEYOND, SPILL = 2, 30.0
"""Number of harmonics above the corrected ones to protect, and weight of the effect on them in G^+, in G's norm."""

UNDAMPED = 1e-5
"""Part of a swing that a window takes away at least where friction or damping acts."""

REACH = 1e-3
"""Part of the largest singular value of G, scaled, below which a direction counts as out of reach."""


@dataclass(frozen=True, eq=False)
class TrimDesign:
    """Design of the trim, by the nominal model.

    trim       options in the servo file
    span       period of the programme, s
    response   G (C T, N T), T = 2 H + 1: mean, cos 1, sin 1, cos 2, ... of each measured coordinate in turn (m, rad)
               by the mean, cos 1, sin 1, ... of each flywheel in turn (rad)
    matrix     g G^+ (N T, C T): change of corrections by the error; zero for the means, which are not corrected
    unit       (C T): a metre, or the equivalent in each row, by the inertia
    theta      (N): f^T Theta_s f, kg m2: torque of a correction's acceleration
    window     (n + r, n + r): from window to window, the carrier's deviation, n = 12 (held 2 m), and the r directions
               of c
    rank       r: number of corrected directions of the error
    """

    trim: Trim
    span: float
    response: Array
    matrix: Array
    unit: Array
    theta: Array
    window: Array
    rank: int

    @cached_property
    def radius(self) -> float:
        """Spectral radius of `window`: decay of a deviation per window, in the long run."""
        return float(np.abs(np.linalg.eigvals(self.window)).max())

    @cached_property
    def undamped(self) -> bool:
        """Whether a deviation of the carrier stays as it is, to UNDAMPED in a window, without corrections."""
        n = len(self.window) - self.rank
        return bool(np.abs(np.linalg.eigvals(self.window[:n, :n])).max(initial=0.0) > 1.0 - UNDAMPED)

    @cached_property
    def margin(self) -> float:
        """Largest relative error of G with which the settled trim still converges."""
        back = self.matrix * self.unit / self.trim.gain
        seen = np.any(back != 0.0, axis=0)
        share = (self.response / self.unit[:, None])[seen]
        return float(1.0 / (np.linalg.norm(back, 2) * np.linalg.norm(share, 2)))


def design_trim(stand: Stand, motion: RequiredMotion, programme: Programme, trim: Trim) -> TrimDesign:
    """The trim of a servo for a stand that follows a programme.

    Raises UsageError: the motion is not periodic, nothing is in reach, or the trim does not converge.
    """
    if not programme.periodic:
        raise UsageError("trim: the programme is finite, expected a periodic one; remove [trim]")
    H, mechanics = trim.harmonics, Mechanics.of(stand)
    orbit = required_orbit(mechanics, motion, programme, nodes(motion, programme, H + BEYOND))
    k = np.array([0, *np.repeat(np.arange(1, H + 1), 2)])  # harmonic of each term
    seen, above = np.split(_correction_terms(orbit, trim), [len(k)], axis=1)
    unit = np.repeat(_units(mechanics)[list(trim.coordinates)], len(k))
    G = seen.reshape(len(unit), -1)
    moving = np.tile(k > 0, len(trim.coordinates))
    scaled = (G / unit[:, None])[moving]
    spill = (
        above.reshape(-1, G.shape[1]) / np.repeat(_units(mechanics)[list(trim.coordinates)], above.shape[1])[:, None]
    )
    spill *= SPILL / np.linalg.norm(scaled, 2)
    norm = np.diag(np.tile(1.0 + k**2.0, mechanics.N)) + spill.T @ spill
    weight = np.linalg.inv(np.linalg.cholesky(norm)).T  # corrections weight z have the norm |z|
    U, sigma, Vt = np.linalg.svd(scaled @ weight, full_matrices=False)
    kept = sigma > REACH * sigma[0]
    basis = weight @ Vt[kept].T
    matrix = np.zeros((len(weight), len(unit)))
    matrix[:, moving] = trim.gain * (basis / sigma[kept]) @ U[:, kept].T / unit[moving]
    window = _window(orbit, trim, matrix, G, basis)
    trim_design = TrimDesign(trim, orbit.span, G, matrix, unit, mechanics.tables.Theta_ff, window, basis.shape[1])
    if not trim_design.radius < 1.0:
        more = (
            "; nothing damps the carrier: add friction or damping"
            if stand.hold is not None and trim_design.undamped
            else ""
        )
        raise UsageError(
            f"trim: does not converge, errors grow by {trim_design.radius:.3g} per window; "
            f"use a `gain` below {trim.gain:g} "
            f"or a `settling` above {trim.settling} periods{more}"
        )
    return trim_design


def trim_members(design: TrimDesign, motion: RequiredMotion, programme: Programme, period: float) -> dict[str, Any]:
    """Members of the C's struct `trim_design`, SI, for samples every `period` s."""
    trim, T = design.trim, 2 * design.trim.harmonics + 1
    samples = design.span / period
    settling = round(trim.settling * samples)
    times = design.span * np.arange(64 * T) / (64 * T)
    q = motion.at(times, programme.bias).q[:, list(trim.coordinates)]
    target = _averages(trim.harmonics, len(times)) @ q  # (T, C)
    return {
        "settling": settling,
        "window": round(trim.averaging * samples),
        "smoothing": -math.expm1(-QUICK / settling) if settling > QUICK else 1.0,
        "limit": trim.limit,
        "omega": 2.0 * math.pi / design.span,
        "inertia": design.theta.tolist(),
        "target": target.T.tolist(),
        "matrix": design.matrix.tolist(),
    }


def _functions(orbit: Orbit, trim: Trim) -> Array:
    """(3, M + 1, T): 1, cos, sin, cos 2, ... of the programme's phase, with two derivatives by time."""
    return np.stack(harmonics(orbit.span, 2 * trim.harmonics + 1, orbit.t).matrices)


def _averages(H: int, M: int) -> Array:
    """(T, M): mean, cos, sin, cos 2, ... of M even samples of a period."""
    averages = harmonics(1.0, 2 * H + 1, np.arange(M) / M).value.T * (2.0 / M)
    averages[0] /= 2.0
    return np.asarray(averages)


def _correction_terms(orbit: Orbit, trim: Trim) -> Array:
    """(C, T + 2 BEYOND, N T): terms of the measured coordinates, and higher ones, by all corrections."""
    return _terms(orbit, orbit.response(_functions(orbit, trim)), trim, trim.harmonics + BEYOND)


def _terms(orbit: Orbit, states: Array, trim: Trim, highest: int) -> Array:
    """(C, T, P): mean, cos, sin ... of the measured coordinates for states (M + 1, n, ...) of a period."""
    count = orbit.chart.count
    flat = states[:-1, :count].reshape(len(states) - 1, count, -1)
    q = (orbit.coordinates()[:-1] @ flat)[:, list(trim.coordinates)]
    return np.asarray(np.einsum("tm,mcn->ctn", _averages(highest, len(q)), q))


def _units(mechanics: Mechanics) -> Array:
    """(6): a metre, and equivalent rotations, by the inertia; of a held carrier (m) each freedom by its own."""
    K0, S = mechanics.mean_inertia, mechanics.freedoms
    if mechanics.stand.hold is not None:
        return np.asarray(np.sqrt(K0[0, 0] / np.diag(S.T @ K0 @ S)))
    return np.repeat([1.0, math.sqrt(K0[0, 0] / (np.trace(K0[3:, 3:]) / 3.0))], 3)


def _window(orbit: Orbit, trim: Trim, matrix: Array, G: Array, basis: Array) -> Array:
    """See TrimDesign.window. The carrier's deviation is from the periodic motion with c = 0, at a window's start.

    basis (N T, r): every correction is basis u. With Phi the monodromy matrix, X the periodic motion's beginning by u,
    and Q the effect of a deviation at the beginning on the window's result: x <- Phi^n (x - X u) + X u and u <- u -
    matrix (G u + Q (x - X u)).
    """
    Phi, periods, n = orbit.monodromy, trim.settling + trim.averaging, len(orbit.monodromy)
    powers = (np.linalg.matrix_power(Phi, k) for k in range(trim.settling, periods))
    Q = (
        _terms(orbit, orbit.free, trim, trim.harmonics).reshape(matrix.shape[1], n)
        @ sum(powers, np.zeros((n, n)))
        / trim.averaging
    )
    X = orbit.response(_functions(orbit, trim))[0].reshape(n, -1) @ basis
    over, loss = np.linalg.matrix_power(Phi, periods), np.linalg.pinv(basis) @ matrix
    top = np.hstack([over, (np.eye(n) - over) @ X])
    return np.vstack([top, np.hstack([-loss @ Q, np.eye(basis.shape[1]) - loss @ (G @ basis - Q @ X)])])
