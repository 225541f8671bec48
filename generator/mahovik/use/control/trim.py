"""The wanted motion of servos and the carrier's response to its corrections; the slow trim that makes these.

Linear equations along the motion, x' = A(t) x + B(t) c, are derivatives of (8) along the programme, exact in the
flywheels' motion. With the monodromy matrix Phi of a period, the periodic response to c has x(0) = (1 - Phi)^-1 p,
where p is the end of a period that starts from x(0) = 0.

The trim corrects Fourier coefficients of the programme from harmonics of the carrier's measured error. Along the
programme the nominal, linear model gives the effect of small corrections c of mean and harmonics of each flywheel on
the harmonics E of the settled carrier: E = G c + E_0. After each window of measurement

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
from scipy.interpolate import CubicSpline

from mahovik.core.motion.functions import Angles, Course, Samples
from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.motion.servo import Trim
from mahovik.core.stand.model import Stand
from mahovik.errors import CheckError, StateError, UsageError
from mahovik.use.numeric.course import (
    INTERVALS,
    BlockElimination,
    Chart,
    course,
    equilibrium,
    forced_defects,
    linearise,
    linearise_along,
)
from mahovik.use.numeric.mechanics import Mechanics
from mahovik.use.numeric.residual import Drive, drive, prescribe, torques
from mahovik.use.numeric.se3 import Array, Complex
from mahovik.use.plan.problem import harmonics

TORQUES = 512
"""Samples per period for the torques' Fourier coefficients."""
NODES = 64
"""Nodes per turn of the flywheels, for the run-up's torques."""
_TAIL = 1e-9


@dataclass(frozen=True, eq=False)
class ReferenceMotion:
    """A programme of a stand for a required motion. `exact`: the programme before tabulation."""

    stand: Stand
    motion: RequiredMotion
    programme: Programme
    exact: Programme

    @staticmethod
    def of(stand: Stand, motion: RequiredMotion, programme: Programme, rows: int | None) -> ReferenceMotion:
        """Programme with `rows` nodes of quintic Hermite per period, as in firmware; None: exact. Raises UsageError.

        A finite programme is a table of its own: rows are None.
        """
        return ReferenceMotion(stand, motion, programme if rows is None else tabulate(programme, rows), programme)

    def angles(self, t: Array) -> Angles:
        """phi, phi', phi'' (M, N each; rad, s) at times t (M, s): of the programme, and of its run-up before t = 0.

        Before and after a finite programme the flywheels turn evenly.
        """
        result = self.programme.at(t)
        if not self.programme.periodic:
            beyond = t - np.clip(t, 0.0, self.programme.span)
            even = beyond != 0.0
            result.phi[even] += beyond[even, None] * result.phi_dot[even]
            result.phi_ddot[even] = 0.0
            return result
        table, up = self.programme.runup, t < 0.0
        if table is None or not up.any():
            return result
        early = table.at(t[up] + table.duration)
        for all_, before in zip(result, early, strict=True):
            all_[up] = before
        for derivative in result[1:]:
            derivative[t < -table.duration] = 0.0
        return result

    def required_course(self, t: Array) -> Array:
        """Required q (M, 6; m, rad; held M, m) of the carrier at times t (M, s); before t = 0 its mean pose.

        Before and after a finite motion it rests where that begins and ends.
        """
        if not self.motion.periodic:
            return self.motion.at(np.clip(t, 0.0, self.motion.span), self.programme.bias).q
        q = self.motion.at(t, self.programme.bias).q
        q[t < 0.0] = self.motion.mean + self.programme.bias
        return q

    def torques(self, t: Array) -> Array:
        """Drive torques (M, N; N m) of the nominal stand at times t (M, s), at the required motion or on the run-up."""
        if not self.programme.periodic:
            inside = np.clip(t, 0.0, self.motion.span)
            mechanics = Mechanics.of(self.programme.planned_for(self.stand))
            at = prescribe(mechanics, self.motion.at(inside), self.programme.bias)
            return torques(at, *self.programme.at(inside))
        coefficients, k = self._coefficients
        turns = np.outer((t / self.motion.span) % 1.0, k)
        result = np.real(np.exp(2j * np.pi * turns) @ coefficients)
        if np.any(t < 0.0):
            result[t < 0.0] = self._on_runup(t[t < 0.0])
        return np.asarray(result)

    @cached_property
    def _on_runup(self) -> Any:
        """Torques of the run-up at times before 0 (s): the carrier is free on the way, (8) from rest."""
        table, mechanics = self.programme.runup, Mechanics.of(self.stand)
        assert table is not None
        turns = max([1, *self.motion.harmonics, *(abs(n) for n in self.programme.winding)])
        count = INTERVALS * max(1, round(NODES * turns * table.duration / self.motion.span / INTERVALS))
        t = np.linspace(0.0, table.duration, count + 1)
        chart = Chart.at(mechanics, self.motion.mean + self.programme.bias)
        angles = table.at(t)
        driven = drive(mechanics, *angles)
        start = equilibrium(chart, angles.phi[0]).y
        y = course(chart, driven, t[1], start, np.tile(start, (len(t), 1)), None).y
        spline = CubicSpline(t - table.duration, linearise_along(chart, driven, y, angles.phi_ddot).tau)
        return lambda times: spline(np.maximum(times, -table.duration))

    @cached_property
    def _coefficients(self) -> tuple[Complex, Array]:
        """Harmonics of the drive torques, complex (H, N): mean first; and their numbers (H)."""
        t = self.motion.span * np.arange(TORQUES) / TORQUES
        at = prescribe(Mechanics.of(self.stand), self.motion.at(t), self.programme.bias)
        coefficients = np.fft.rfft(torques(at, *self.programme.at(t)), axis=0) / TORQUES
        coefficients[1:] *= 2.0
        size = np.abs(coefficients).max(axis=1)
        last = int(np.flatnonzero(size > _TAIL * size.max(initial=1e-300)).max(initial=0))
        return coefficients[: last + 1], np.arange(0.0, last + 1.0)


def tabulate(programme: Programme, rows: int) -> Programme:
    """The programme as a table of `rows` uniform nodes per period."""
    if rows < 4:
        raise UsageError(f"table {rows}: expected at least 4 nodes")
    if not programme.periodic:
        raise UsageError(f"table {rows}: the programme is finite, a table of its own")
    t = programme.span * np.arange(rows) / rows
    return programme.with_course(Samples(t, *programme.at(t)))


ORBIT_NODES = 96
"""Least nodes per period of the fastest part."""
_SINGULAR = 1e-7
"""Part of the largest singular value of 1 - Phi below which a direction is free: nothing returns the carrier."""
_MOST = 12
_STEP = 1e-6


@dataclass(frozen=True, eq=False)
class Orbit:
    """One period of the carrier at M + 1 uniform nodes, the last one period after the first.

    chart, drive   the stand's equations about the mean pose, and the flywheels' sums at the nodes
    phi_ddot       (M + 1, N)
    y              (M + 1, 12; held M + 1, 2 m): states of the chart
    near           the linear equations along it
    free           (M + 1, 12, 12; held 2 m, 2 m): propagation of a deviation at the first node; the last is the
                   monodromy matrix
    q              (M + 1, 6; held M + 1, m): coordinates of the required motion
    """

    chart: Chart
    span: float
    drive: Drive
    phi_ddot: Array
    y: Array
    near: BlockElimination
    free: Array
    q: Array

    @property
    def monodromy(self) -> Array:
        """Phi (12, 12; held 2 m, 2 m)."""
        return np.asarray(self.free[-1])

    @property
    def t(self) -> Array:
        """Times of the nodes (M + 1), s."""
        return np.linspace(0.0, self.span, len(self.y))

    def periodic_start(self, ends: Array) -> Array:
        """x(0) (12, n; held 2 m, n) with x(0) = Phi x(0) + ends; the smallest one if directions are free."""
        return np.asarray(np.linalg.lstsq(np.eye(len(self.monodromy)) - self.monodromy, ends, rcond=_SINGULAR)[0])

    def response(self, basis: Array) -> Array:
        """x (M + 1, 12, N, P): the carrier's periodic response to phi_s = c_sj basis_j, at c_sj = 1; held 2 m, not 12.

        basis (3, M + 1, P): functions of a period at the nodes, with two derivatives.
        """
        N, P, n = self.phi_ddot.shape[1], basis.shape[2], self.y.shape[1]
        linear = linearise_along(self.chart, self.drive, self.y, self.phi_ddot)
        defects = forced_defects(self.drive, linear, basis, self.span / (len(self.y) - 1))
        ends = self.near.solve(defects, np.zeros((n, N * P)))[-1]
        return self.near.solve(defects, self.periodic_start(ends)).reshape(-1, n, N, P)

    def coordinates(self) -> Array:
        """dq/dx (M + 1, 6, 6; held M + 1, m, m): derivatives of q (m, rad) by the pose in y, along the motion."""
        columns, count = [], self.chart.count
        still = np.zeros_like(self.q)
        for i in range(count):
            aside = np.zeros(count)
            aside[i] = _STEP
            ends = (self.chart.of(Course(self.q + sign * aside, still, still))[:, :count] for sign in (1, -1))
            columns.append(np.subtract(*ends) / (2.0 * _STEP))
        return np.asarray(np.linalg.inv(np.stack(columns, axis=2)))


def nodes(motion: RequiredMotion, programme: Programme, highest: int = 1) -> int:
    """Number of intervals per period, enough for harmonics up to `highest`."""
    fastest = max([1, highest, *motion.harmonics, *(abs(n) for n in programme.winding)])
    return INTERVALS * -(-ORBIT_NODES * fastest // INTERVALS)


def required_orbit(mechanics: Mechanics, motion: RequiredMotion, programme: Programme, count: int) -> Orbit:
    """The orbit of a stand that matches its programme: the required motion itself, at `count` intervals per period."""
    t = np.linspace(0.0, motion.span, count + 1)
    required = motion.at(t, programme.bias)
    chart, drive, phi_ddot = _chart_and_sums(mechanics, motion, programme, t)
    y = chart.of(required)
    near = linearise(chart, drive, motion.span / count, y)
    free = _propagate(chart, near, count)
    return Orbit(chart, motion.span, drive, phi_ddot, y, near, free, required.q)


def settled_state(mechanics: Mechanics, motion: RequiredMotion, programme: Programme, count: int) -> Array:
    """y (12; held 2 m) at t = 0 of the periodic motion near the required one, for a stand unlike the programme's.

    In the chart of `required_orbit`. Raises CheckError: none is near.
    """
    orbit = required_orbit(mechanics, motion, programme, count)
    spacing, start, guess = orbit.span / count, orbit.y[0], orbit.y
    for _ in range(_MOST):
        try:
            carrier_course = course(orbit.chart, orbit.drive, spacing, start, guess, None)
        except StateError:
            break
        ends = carrier_course.y[-1] - carrier_course.y[0]
        if np.abs(ends).max() < 1e-10:
            return np.asarray(start)
        change = np.eye(2 * orbit.chart.count) - _propagate(orbit.chart, carrier_course.near, count)[-1]
        step = np.linalg.lstsq(change, ends, rcond=_SINGULAR)[0]
        left = ends - change @ step
        start, guess = start + step, carrier_course.y + step
        if np.abs(step).max() < 1e-9 or np.abs(left).max() > 0.5 * np.abs(ends).max():
            return np.asarray(start)  # the remainder is drift along free directions
    raise CheckError(
        f"{mechanics.stand.name}: with this mismatch no periodic motion is near the required one; use a smaller "
        "mismatch, or begin in the required state: begin = programme"
    )


def _propagate(chart: Chart, near: BlockElimination, count: int) -> Array:
    """Deviations (count + 1, n, n) of all n numbers of a state, each 1 at the first node, by the linear equations."""
    n = 2 * chart.count
    return near.solve(np.zeros((count // INTERVALS, INTERVALS, n, n)), np.eye(n))


def _chart_and_sums(
    mechanics: Mechanics, motion: RequiredMotion, programme: Programme, t: Array
) -> tuple[Chart, Drive, Array]:
    chart = Chart.at(mechanics, motion.mean + programme.bias)
    angles = programme.at(t)
    return chart, drive(mechanics, *angles), angles.phi_ddot


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
