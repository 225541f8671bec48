"""The boundary-value problem of a run-up or run-down: the carrier's course between rest and a periodic programme.

Flywheels fade the programme in or out, with free additions. With x from 0 (rest) to 1 (the programme's t = 0) and
w(x) = x^3 (10 - 15 x + 6 x^2): mean speeds grow by w, the periodic part by w^2; additions are c_s0 (1 - w), a free
angle of rest, and c_sj b_j(x), quintic B-splines inside. Any c keeps rest at one end and the programme, with two
derivatives, at the other.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.interpolate import BSpline

from mahovik.core.motion.functions import Angles, Samples
from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.use.numeric import (
    INTERVALS,
    Array,
    BlockElimination,
    CarrierCourse,
    Chart,
    Drive,
    Equilibrium,
    Linear,
    Mechanics,
    acceleration_rates,
    course,
    drive,
    equilibrium,
    integrate,
    linearise,
    linearise_along,
)

SPLINES = 6
"""B-splines per flywheel."""


@dataclass(frozen=True, eq=False)
class TransientFamily:
    """The family of motions at times t (M, s) of 0..duration: unknowns c (N, P; rad), P = 1 + splines.

    offset phi, phi', phi'' (M, N each) for c = 0
    basis  (3, M, P): derivatives of a flywheel's phi, phi', phi'' by each of its c
    """

    t: Array
    offset: Angles
    basis: Array

    @property
    def P(self) -> int:
        """Unknowns per flywheel."""
        return int(self.basis.shape[2])

    def angles(self, c: Array) -> Angles:
        """phi, phi', phi'' (M, N each) of unknowns c (N, P)."""
        return Angles(*(fixed + added @ c.T for fixed, added in zip(self.offset, self.basis, strict=True)))


def transient_family(
    programme: Programme, duration: float, t: Array, *, up: bool, splines: int = SPLINES
) -> TransientFamily:
    """The family that runs up into a periodic programme in `duration` s, or from it down to rest."""
    sign = 1.0 if up else -1.0
    x = t / duration if up else 1.0 - t / duration
    rate = sign / duration  # dx/dt
    w, w1, w2 = _step(x)
    to_programme = sign * duration * (x - 1.0)
    turn = 2.0 * np.pi * np.array(programme.winding) / programme.span  # rad/s
    mean, p, p1, p2 = _periodic(programme, to_programme)
    far = np.outer(sign * duration * (_step_integral(x) - 0.5), turn)
    s, s1, s2 = (y[:, None] for y in (w * w, 2.0 * w * w1 * rate, 2.0 * (w1 * w1 + w * w2) * rate**2))
    fixed = Angles(
        mean + far + s * p,
        np.outer(w, turn) + s * p1 + s1 * p,
        np.outer(w1 * rate, turn) + s * p2 + 2.0 * s1 * p1 + s2 * p,
    )
    basis = np.stack(
        [
            np.column_stack([start, inside]) * rate**k
            for k, (start, inside) in enumerate(zip((1.0 - w, -w1, -w2), _splines(splines, x), strict=True))
        ]
    )
    return TransientFamily(t, fixed, basis)


def _step(x: Array) -> tuple[Array, Array, Array]:
    """w and its two derivatives by x."""
    return (
        x**3 * (10.0 - 15.0 * x + 6.0 * x**2),
        30.0 * x**2 * (1.0 - x) ** 2,
        60.0 * x * (1.0 - x) * (1.0 - 2.0 * x),
    )


def _step_integral(x: Array) -> Array:
    """Integral of w from 0 to x; 1/2 at x = 1."""
    return np.asarray(x**4 * (2.5 - 3.0 * x + x**2))


def _periodic(programme: Programme, t: Array) -> tuple[Array, Array, Array, Array]:
    """Mean (N), and the periodic part without it with two derivatives (M, N), at times t."""
    turn = 2.0 * np.pi * np.array(programme.winding) / programme.span
    period = programme.span * np.arange(256) / 256
    mean = (programme.at(period).phi - np.outer(period, turn)).mean(axis=0)
    at = programme.at(t)
    return mean, at.phi - np.outer(t, turn) - mean, at.phi_dot - turn, at.phi_ddot


def _splines(count: int, x: Array) -> tuple[Array, Array, Array]:
    """Quintic B-splines with their support inside 0..1, uniform knots, and two derivatives by x: (M, count) each."""
    knots = np.arange(-5.0, count + 11.0) / (count + 5)
    inside = np.eye(count + 10)[:, 5:-5]  # B-splines at the ends reach beyond them
    spline = BSpline(knots, inside, 5)
    return spline(x), spline.derivative(1)(x), spline.derivative(2)(x)


NODES = 64
"""Nodes per period of the fastest harmonic or flywheel."""
FEWEST = 48
"""Fewest blocks of NODES: enough for the splines."""


@dataclass(frozen=True, eq=False)
class Amplitude:
    """Unit of errors: the motion's largest displacement and twist in the norm |root x| of the inertia.

    root    6x6: x^T K0 x = |root x|^2; of a held carrier m x m, along its freedoms
    """

    root: Array
    displacement: float
    twist: float

    def shares(self, y: Array) -> Array:
        """Dimensionless (12, ...) form of small differences of states (12, ...); of a held carrier 2 m."""
        pose, speeds = np.split(y, 2)
        return np.concatenate([self.root @ pose / self.displacement, self.root @ speeds / self.twist])


@dataclass(frozen=True, eq=False)
class Flight:
    """Result of unknowns c (N, P): the flywheels' motion, rest, the carrier's course, and its terminal error.

    error   (12): terminal error, in amplitudes
    """

    c: Array
    drive: Drive
    rest: Equilibrium
    course: CarrierCourse
    error: Array

    @property
    def size(self) -> float:
        """Terminal error; see `size`."""
        return size(self.error)


def size(error: Array) -> float:
    """The larger part of a terminal error (12; held 2 m): pose or twist."""
    return float(max(np.linalg.norm(part) for part in np.split(error, 2)))


@dataclass(frozen=True, eq=False)
class Boundary:
    """Run-up (`up`) or run-down between rest and the programme's t = 0.

    In directions that are free at rest the carrier may begin (or end) anywhere: no pose is required there.

    chart   about the mean pose
    family  at 4 B + 1 nodes
    joint   y (12; held 2 m, as all states are then) of the required motion at t = 0
    """

    chart: Chart
    amplitude: Amplitude
    family: TransientFamily
    joint: Array
    up: bool

    @property
    def spacing(self) -> float:
        """Time between nodes, s."""
        return float(self.family.t[1] - self.family.t[0])

    def fly(self, c: Array, before: Flight | None = None, guess: Array | None = None) -> Flight:
        """Flight of c (N, P); `before`: a flight with similar unknowns, or `guess`: states (M, 12).

        Raises CheckError: there is no rest. StateError: the carrier moves too violently.
        """
        near = None
        if before is not None:
            near, guess = before.course.near, before.course.y
        given, rest, found, error = self._follow(self.family.angles(c), guess, near)
        return Flight(c, given, rest, found, error)

    def table_error(self, table: Samples, guess: Array) -> float:
        """Terminal error (see `size`) of a table as it is read, on this problem's nodes; `guess`: states (M, 12)."""
        return size(self._follow(table.at(self.family.t), guess, None)[3])

    def _follow(
        self, angles: Angles, guess: Array | None, near: BlockElimination | None
    ) -> tuple[Drive, Equilibrium, CarrierCourse, Array]:
        given = drive(self.chart.mechanics, *angles)
        rest = equilibrium(self.chart, angles.phi[0 if self.up else -1])
        start, end = (rest.y, self.joint) if self.up else (self.joint, rest.y)
        if guess is None:
            guess = np.tile(start, (len(self.family.t), 1))
        found = course(self.chart, given, self.spacing, start, guess, near)
        return given, rest, found, self.amplitude.shares(rest.projection @ (found.y[-1] - end))

    def linearise(self, flight: Flight) -> Linear:
        """Torques along a flight, and derivatives of (8) and of the torques by the flywheels' motion."""
        return linearise_along(self.chart, flight.drive, flight.course.y, self.family.angles(flight.c).phi_ddot)

    def linearise_again(self, flight: Flight) -> Flight:
        """The same flight with the linear equations along its own course."""
        near = linearise(self.chart, flight.drive, self.spacing, flight.course.y)
        return replace(flight, course=replace(flight.course, near=near))

    def sensitivity(self, flight: Flight) -> tuple[Array, Array]:
        """Derivatives by c: of the terminal error (12, N P), and of the states at all nodes (M, 12, N P).

        As exact as the flight's linear equations: call `linearise_again` first.
        """
        (N, P), m = flight.c.shape, self.chart.count
        rates = np.zeros((len(self.family.t), 2 * m, N, P))
        for B, basis in zip(acceleration_rates(flight.drive, self.linearise(flight)), self.family.basis, strict=True):
            rates[:, m:] += B[:, :, :, None] * basis[:, None, None, :]
        at_rest = self.family.basis[0, 0 if self.up else -1]
        rest = (flight.rest.by_phi[:, :, None] * at_rest).reshape(2 * m, N * P)
        start = rest if self.up else np.zeros_like(rest)
        defects = integrate(rates.reshape(-1, 2 * m, N * P), self.spacing)
        states = flight.course.near.solve(defects, start)
        end = states[-1] if self.up else states[-1] - rest
        return self.amplitude.shares(flight.rest.projection @ end), states


def boundary(
    mechanics: Mechanics,
    motion: RequiredMotion,
    programme: Programme,
    duration: float,
    *,
    up: bool,
    nodes: int = NODES,
    splines: int = SPLINES,
) -> Boundary:
    """The problem of a programme for a motion, with about `nodes` nodes per period of its fastest part.

    The number of blocks is a power of two, like the number of nodes of tables in C: both can then have the same nodes.
    """
    fastest = max([1, *motion.harmonics, *(abs(n) for n in programme.winding)])
    B = 2 ** round(np.log2(nodes / NODES * max(fastest * NODES * duration / motion.span / INTERVALS, FEWEST)))
    t = np.linspace(0.0, duration, INTERVALS * B + 1)
    chart = Chart.at(mechanics, motion.mean + programme.bias)
    return Boundary(
        chart,
        amplitude_of(chart, motion, programme),
        transient_family(programme, duration, t, up=up, splines=splines),
        chart.of(motion.at(np.zeros(1), programme.bias))[0],
        up,
    )


def amplitude_of(chart: Chart, motion: RequiredMotion, programme: Programme) -> Amplitude:
    """Amplitude of a periodic motion; for a carrier held still, what the flywheels can do at the period's frequency."""
    S = chart.mechanics.freedoms
    root = np.asarray(np.linalg.cholesky(S.T @ chart.mechanics.mean_inertia @ S).T)
    M = max(64, 16 * max(motion.harmonics, default=1))
    y = chart.of(motion.at(motion.span * np.arange(M) / M, programme.bias))
    displacement, twist = (float(np.linalg.norm(x @ root.T, axis=1).max()) for x in np.hsplit(y, 2))
    if twist > 0.0:
        return Amplitude(root, displacement, twist)
    Omega = 2.0 * np.pi / motion.span
    able = chart.mechanics.able(Omega)
    return Amplitude(root, able / Omega**2, able / Omega)
