"""The boundary-value problem of a run-up or run-down: start and required end of the carrier's course."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mahovik.core.motion.programme import Angles, Programme, Samples
from mahovik.core.motion.required import Course as Required
from mahovik.core.motion.required import RequiredMotion
from mahovik.use.plan.array import Array
from mahovik.use.plan.forward import (
    Chart,
    Course,
    Drive,
    Equilibrium,
    acceleration_rates,
    course,
    drive,
    equilibrium,
    linearise,
    linearise_along,
)
from mahovik.use.plan.forward.collocation import INTERVALS, Eliminated, integrate
from mahovik.use.plan.residual import Linear, Mechanics
from mahovik.use.plan.residual.norm import able_at
from mahovik.use.plan.runup.fade import SPLINES, Fade, fade

NODES = 64
"""Nodes per period of the fastest harmonic or flywheel."""
FEWEST = 48
"""Fewest blocks of NODES: enough for the splines."""


@dataclass(frozen=True, eq=False)
class Amplitude:
    """Unit of errors: the motion's largest displacement and twist in the norm |root x| of the inertia.

    root    6x6: x^T K0 x = |root x|^2
    """

    root: Array
    displacement: float
    twist: float

    def shares(self, y: Array) -> Array:
        """Dimensionless (12, ...) form of small differences of states (12, ...)."""
        return np.concatenate([self.root @ y[:6] / self.displacement, self.root @ y[6:] / self.twist])


@dataclass(frozen=True, eq=False)
class Flight:
    """Result of unknowns c (N, P): the flywheels' motion, rest, the carrier's course, and its terminal error.

    error   (12): terminal error, in amplitudes
    """

    c: Array
    given: Drive
    rest: Equilibrium
    course: Course
    error: Array

    @property
    def size(self) -> float:
        """Terminal error; see `size`."""
        return size(self.error)


def size(error: Array) -> float:
    """The larger part of a terminal error (12): pose or twist."""
    return float(max(np.linalg.norm(error[:6]), np.linalg.norm(error[6:])))


@dataclass(frozen=True, eq=False)
class Boundary:
    """Run-up (`up`) or run-down between rest and the programme's t = 0.

    In directions that are free at rest the carrier may begin (or end) anywhere: no pose is required there.

    chart   about the mean pose
    family  at 4 B + 1 nodes
    joint   y (12) of the required motion at t = 0
    """

    chart: Chart
    amplitude: Amplitude
    family: Fade
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
        given, rest, found, error = self._followed(self.family.angles(c), guess, near)
        return Flight(c, given, rest, found, error)

    def table_error(self, table: Samples, guess: Array) -> float:
        """Terminal error (see `size`) of a table as it is read, on this problem's nodes; `guess`: states (M, 12)."""
        return size(self._followed(table.at(self.family.t), guess, None)[3])

    def _followed(
        self, angles: Angles, guess: Array | None, near: Eliminated | None
    ) -> tuple[Drive, Equilibrium, Course, Array]:
        given = drive(self.chart.mechanics, *angles)
        rest = equilibrium(self.chart, angles.phi[0 if self.up else -1])
        start, end = (rest.y, self.joint) if self.up else (self.joint, rest.y)
        if guess is None:
            guess = np.tile(start, (len(self.family.t), 1))
        found = course(self.chart, given, self.spacing, start, guess, near)
        return given, rest, found, self.amplitude.shares(rest.held @ (found.y[-1] - end))

    def along(self, flight: Flight) -> Linear:
        """Torques along a flight, and derivatives of (8) and of the torques by the flywheels' motion."""
        return linearise_along(self.chart, flight.given, flight.course.y, self.family.angles(flight.c).phi_ddot)

    def relinearised(self, flight: Flight) -> Flight:
        """The same flight with the linear equations along its own course."""
        near = linearise(self.chart, flight.given, self.spacing, flight.course.y)
        return replace(flight, course=replace(flight.course, near=near))

    def sensitivity(self, flight: Flight) -> tuple[Array, Array]:
        """Derivatives by c: of the terminal error (12, N P), and of the states at all nodes (M, 12, N P).

        As exact as the flight's linear equations: call `relinearised` first.
        """
        N, P = flight.c.shape
        rates = np.zeros((len(self.family.t), 12, N, P))
        for B, basis in zip(acceleration_rates(flight.given, self.along(flight)), self.family.basis, strict=True):
            rates[:, 6:] += B[:, :, :, None] * basis[:, None, None, :]
        at_rest = self.family.basis[0, 0 if self.up else -1]
        rest = (flight.rest.by_phi[:, :, None] * at_rest).reshape(12, N * P)
        start = rest if self.up else np.zeros_like(rest)
        defects = integrate(rates.reshape(-1, 12, N * P), self.spacing)
        states = flight.course.near.solve(defects, start)
        end = states[-1] if self.up else states[-1] - rest
        return self.amplitude.shares(flight.rest.held @ end), states


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
    still = np.zeros((1, 6))
    chart = Chart.about(mechanics, Required((motion.mean + programme.bias)[None], still, still))
    return Boundary(
        chart,
        amplitude_of(chart, motion, programme),
        fade(programme, duration, t, up=up, splines=splines),
        chart.of(motion.at(np.zeros(1), programme.bias))[0],
        up,
    )


def amplitude_of(chart: Chart, motion: RequiredMotion, programme: Programme) -> Amplitude:
    """Amplitude of a periodic motion; for a carrier held still, what the flywheels can do at the period's frequency."""
    root = np.asarray(np.linalg.cholesky(chart.mechanics.mean_inertia).T)
    M = max(64, 16 * max(motion.harmonics, default=1))
    y = chart.of(motion.at(motion.span * np.arange(M) / M, programme.bias))
    displacement, twist = (float(np.linalg.norm(x @ root.T, axis=1).max()) for x in (y[:, :6], y[:, 6:]))
    if twist > 0.0:
        return Amplitude(root, displacement, twist)
    Omega = 2.0 * np.pi / motion.span
    able = able_at(chart.mechanics, Omega)
    return Amplitude(root, able / Omega**2, able / Omega)
