"""Slow trim: corrections of the programme's Fourier coefficients from harmonics of the carrier's measured error.

Along the programme the nominal, linear model says what small corrections c of mean and harmonics of each flywheel do to
the harmonics E of the carrier, E = G c + E_0, once it has settled. After each window of measuring

    c <- c - g G^+ E,

G^+ of least norm (corrections of harmonic k weigh 1 + k^2, as in plan/levenberg), in directions that G reaches. With
the real stand's G' instead of G and a carrier that has settled, errors in those directions go as (1 - g G' G^+)^n, so
every g up to 1 converges where |(G' - G) G^+| < 1. A carrier that has not settled is taken into account exactly: the
state at the beginning of a window and c form a linear system from window to window, whose spectral radius decides.
Flywheels are taken to follow their corrections at once: the servo is faster than a window by far.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mahovik.control.orbit import Orbit, along_required, nodes
from mahovik.errors import UsageError
from mahovik.motion.programme import Programme
from mahovik.motion.required import RequiredMotion
from mahovik.motion.servo import Trim
from mahovik.plan.array import Array
from mahovik.plan.residual import Mechanics
from mahovik.stand.model import Stand

REACHED = 1e-3
"""Part of the largest singular value of G, scaled, below which a direction counts as out of reach."""


@dataclass(frozen=True, eq=False)
class TrimDesign:
    """What the trim does, by the nominal model.

    trim       what is wanted
    span       period of the programme, s
    response   G (12 H, N (2 H + 1)): harmonics 1..H of the error of x, y, z (m), psi, theta, phi (rad), for each first
               the cosines of six, then their sines; by coefficients of each flywheel in turn: mean, cosines 1..H, sines
               1..H (rad)
    matrix     (N (2 H + 1), 12 H): -g G^+; zero for coordinates that are not measured
    unit       (12 H): the size that a share of the motion's amplitude has in each row
    theta      (N): f^T Theta_s f, kg m2: torque of a correction's acceleration
    window     (12 + r, 12 + r): from window to window, the carrier's deviation and the r directions of c
    """

    trim: Trim
    span: float
    response: Array
    matrix: Array
    unit: Array
    theta: Array
    window: Array

    @property
    def rank(self) -> int:
        """Directions of the error that are corrected."""
        return len(self.window) - 12

    @cached_property
    def radius(self) -> float:
        """Spectral radius of `window`: what is left of a deviation a window later, in the long run."""
        return float(np.abs(np.linalg.eigvals(self.window)).max())

    @cached_property
    def margin(self) -> float:
        """How wrong G may be and the settled trim still converges: of its norm, a share."""
        share = self.response / self.unit[:, None]
        back = self.matrix * self.unit / self.trim.gain
        return float(1.0 / (np.linalg.norm(back, 2) * np.linalg.norm(share, 2)))

    def left(self, error: Array) -> Array:
        """What of harmonics E (12 H) of an error no correction reaches, by the nominal model."""
        return np.asarray(error + self.response @ (self.matrix @ error) / self.trim.gain)


def design_trim(stand: Stand, motion: RequiredMotion, programme: Programme, trim: Trim) -> TrimDesign:
    """The trim of a servo for a stand that follows a programme.

    Raises UsageError: the motion is not periodic, nothing is in reach, or the trim does not converge.
    """
    if not programme.periodic:
        raise UsageError("trim: the programme is finite, expected a periodic one; leave [trim] out")
    H, mechanics = trim.harmonics, Mechanics.of(stand)
    orbit = along_required(mechanics, motion, programme, nodes(motion, programme, H))
    unit = _units(orbit, mechanics, H)
    G = _harmonics(orbit, orbit.response(_basis(orbit, H)), H)
    measured = np.tile(np.isin(np.arange(6), trim.coordinates), 2 * H)
    weight = np.tile(1.0 / np.sqrt(1.0 + np.array([0, *range(1, H + 1), *range(1, H + 1)]) ** 2.0), mechanics.N)
    U, sigma, Vt = np.linalg.svd((G / unit[:, None])[measured] * weight, full_matrices=False)
    kept = sigma > REACHED * sigma[0]
    back = np.zeros((len(weight), len(unit)))
    back[:, measured] = weight[:, None] * (Vt[kept].T / sigma[kept]) @ U[:, kept].T / unit[measured]
    matrix = -trim.gain * back
    found = TrimDesign(
        trim, orbit.span, G, matrix, unit, mechanics.tables.Theta_ff, _window(orbit, trim, H, matrix, G, weight, Vt[kept])
    )
    if not found.radius < 1.0:
        raise UsageError(
            f"trim: does not converge, errors grow by {found.radius:.3g} a window; take less `gain` than {trim.gain:g} "
            f"or more `settling` than {trim.settling} periods"
        )
    return found


def _basis(orbit: Orbit, H: int) -> Array:
    """(3, M + 1, 2 H + 1): 1, cos 1..H, sin 1..H of the programme's phase, with two derivatives by time."""
    k = np.arange(1.0, H + 1.0)
    a, w = 2.0 * np.pi * np.outer(orbit.t / orbit.span, k), 2.0 * np.pi * k / orbit.span
    c, s, one = np.cos(a), np.sin(a), np.ones((len(a), 1))
    return np.stack(
        [np.hstack([one, c, s]), np.hstack([0 * one, -w * s, w * c]), np.hstack([0 * one, -w * w * c, -w * w * s])]
    )


def _harmonics(orbit: Orbit, states: Array, H: int) -> Array:
    """Rows (12 H, n): cosines of six, then sines, of harmonics 1..H of q for states (M + 1, 12, ...) of a period."""
    flat = states[:-1, :6].reshape(len(states) - 1, 6, -1)
    q = orbit.coordinates()[:-1] @ flat
    M = len(q)
    a = 2.0 * np.pi * np.outer(np.arange(1, H + 1), np.arange(M)) / M
    found = [2.0 / M * np.einsum("km,min->kin", wave, q) for wave in (np.cos(a), np.sin(a))]
    return np.stack(found, axis=1).reshape(12 * H, -1)


def _units(orbit: Orbit, mechanics: Mechanics, H: int) -> Array:
    """(12 H): a metre and a radian in each row, by the inertia: both the same share of the motion."""
    K0 = mechanics.mean_inertia
    length = np.repeat([1.0 / np.sqrt(K0[0, 0]), 1.0 / np.sqrt(np.trace(K0[3:, 3:]) / 3.0)], 3)
    return np.tile(length, 2 * H)


def _window(orbit: Orbit, trim: Trim, H: int, matrix: Array, G: Array, weight: Array, directions: Array) -> Array:
    """See TrimDesign.window. The carrier's deviation is that from the periodic motion of c = 0, at a window's begin."""
    Phi = orbit.monodromy
    periods = trim.settling + trim.averaging
    free = _harmonics(orbit, orbit.free, H)  # of a deviation at the beginning of a period
    seen = sum(
        (np.linalg.matrix_power(Phi, n) for n in range(trim.settling, periods)), np.zeros((12, 12))
    ) / trim.averaging  # fmt: skip
    Q = free @ seen
    basis = (directions * weight).T  # c = basis u; every correction lies in it
    up = np.linalg.pinv(basis)
    N = len(weight) // (2 * H + 1)
    X = orbit.response(_basis(orbit, H))[0].reshape(12, N * (2 * H + 1)) @ basis
    over = np.linalg.matrix_power(Phi, periods)
    r = len(directions)
    top = np.hstack([over, (np.eye(12) - over) @ X])
    bottom = np.hstack([up @ matrix @ Q, np.eye(r) + up @ matrix @ (G @ basis - Q @ X)])
    return np.vstack([top, bottom])
