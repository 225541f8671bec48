"""Run-up from rest into a periodic programme, and run-down: by shooting, the carrier free to deviate on the way.

Flywheels fade the programme in or out, with free additions. With x from 0 (rest) to 1 (the programme's t = 0) and
w(x) = x^3 (10 - 15 x + 6 x^2): mean speeds grow by w, the periodic part by w^2; additions are c_s0 (1 - w), a free
angle of rest, and c_sj b_j(x), quintic B-splines inside. Any c keeps rest at one end and the programme, with two
derivatives, at the other. Coarse nodes first, then bounds, then nodes fine enough to trust; the table and its report.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np
from scipy.interpolate import BSpline, CubicSpline

from mahovik.core.motion.functions import Angles, Samples
from mahovik.core.motion.programme import Programme, RunUpTable
from mahovik.core.motion.required import Bounds, RequiredMotion
from mahovik.core.stand.model import Stand
from mahovik.errors import CheckError, StateError
from mahovik.use.numeric.course import (
    INTERVALS,
    CarrierCourse,
    Chart,
    Equilibrium,
    course,
    equilibrium,
    forced_defects,
    linearise,
    linearise_along,
)
from mahovik.use.numeric.mechanics import Mechanics
from mahovik.use.numeric.residual import Drive, Linear, drive
from mahovik.use.numeric.se3 import Array
from mahovik.use.plan.objective import RHO, UNITS, ExceededBound
from mahovik.use.plan.outcome import Budget, motor_shortage
from mahovik.use.plan.step import Model, Range, Rules, descend, size

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

    @staticmethod
    def of(programme: Programme, duration: float, t: Array, *, up: bool, splines: int = SPLINES) -> TransientFamily:
        """The family that runs up into a periodic programme in `duration` s, or from it down to rest."""
        sign = 1.0 if up else -1.0
        x = t / duration if up else 1.0 - t / duration
        rate = sign / duration  # dx/dt
        w, w1, w2 = x**3 * (10.0 - 15.0 * x + 6.0 * x**2), 30.0 * (x - x**2) ** 2, 60.0 * (x - x**2) * (1.0 - 2.0 * x)
        integral = x**4 * (2.5 - 3.0 * x + x**2)  # of w; 1/2 at x = 1
        turn = 2.0 * np.pi * np.array(programme.winding) / programme.span  # rad/s
        period, there = programme.span * np.arange(256) / 256, sign * duration * (x - 1.0)
        mean = (programme.at(period).phi - np.outer(period, turn)).mean(axis=0)
        phi, phi_dot, p2 = programme.at(there)
        p, p1 = phi - np.outer(there, turn) - mean, phi_dot - turn
        s, s1, s2 = (y[:, None] for y in (w * w, 2.0 * w * w1 * rate, 2.0 * (w1 * w1 + w * w2) * rate**2))
        fixed = Angles(
            mean + np.outer(sign * duration * (integral - 0.5), turn) + s * p,
            np.outer(w, turn) + s * p1 + s1 * p,
            np.outer(w1 * rate, turn) + s * p2 + 2.0 * s1 * p1 + s2 * p,
        )
        knots = np.arange(-5.0, splines + 11.0) / (splines + 5)
        spline = BSpline(knots, np.eye(splines + 10)[:, 5:-5], 5)  # those at the ends reach beyond them
        pairs = ((1.0 - w, spline(x)), (-w1, spline(x, 1)), (-w2, spline(x, 2)))
        return TransientFamily(t, fixed, np.stack([np.column_stack(pair) * rate**k for k, pair in enumerate(pairs)]))

    @property
    def P(self) -> int:
        """Unknowns per flywheel."""
        return int(self.basis.shape[2])

    def angles(self, c: Array) -> Angles:
        """phi, phi', phi'' (M, N each) of unknowns c (N, P)."""
        return Angles(*(fixed + added @ c.T for fixed, added in zip(self.offset, self.basis, strict=True)))


NODES = 64
"""Nodes per period of the fastest harmonic or flywheel."""
FEWEST = 48
"""Fewest blocks of NODES: enough for the splines."""


@dataclass(frozen=True, eq=False)
class Amplitude:
    """Unit of errors: the motion's largest displacement and twist in the norm |root x| of the inertia.

    root    (m, m): x^T K0 x = |root x|^2 along the freedoms
    """

    root: Array
    displacement: float
    twist: float

    @staticmethod
    def of(chart: Chart, motion: RequiredMotion, programme: Programme) -> Amplitude:
        """Amplitudes of a periodic motion; of one that holds the carrier still, what the flywheels can reach."""
        S = chart.frame.S
        root = np.asarray(np.linalg.cholesky(S.T @ chart.mechanics.mean_inertia @ S).T)
        M = max(64, 16 * max(motion.harmonics, default=1))
        y = chart.of(motion.at(motion.span * np.arange(M) / M, programme.bias))
        displacement, twist = (float(np.linalg.norm(x @ root.T, axis=1).max()) for x in np.hsplit(y, 2))
        if twist > 0.0:
            return Amplitude(root, displacement, twist)
        Omega = 2.0 * np.pi / motion.span
        able = chart.mechanics.able(Omega)
        return Amplitude(root, able / Omega**2, able / Omega)

    def shares(self, y: Array) -> Array:
        """Dimensionless (2 m, ...) form of small differences of states (2 m, ...)."""
        pose, speeds = np.split(y, 2)
        return np.concatenate([self.root @ pose / self.displacement, self.root @ speeds / self.twist])


@dataclass(frozen=True, eq=False)
class Boundary:
    """Run-up (`up`) or run-down between rest and the programme's t = 0.

    In directions that are free at rest the carrier may begin (or end) anywhere: no pose is required there.

    chart   about the mean pose
    family  at 4 B + 1 nodes
    joint   y (2 m) of the required motion at t = 0
    """

    chart: Chart
    amplitude: Amplitude
    family: TransientFamily
    joint: Array
    up: bool

    @staticmethod
    def of(
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

        The number of blocks is a power of two, like the number of nodes of tables in C: both can have the same nodes.
        """
        fastest = max([1, *motion.harmonics, *(abs(n) for n in programme.winding)])
        B = 2 ** round(np.log2(nodes / NODES * max(fastest * NODES * duration / motion.span / INTERVALS, FEWEST)))
        t = np.linspace(0.0, duration, INTERVALS * B + 1)
        chart = Chart.at(mechanics, motion.mean + programme.bias)
        family = TransientFamily.of(programme, duration, t, up=up, splines=splines)
        joint = chart.of(motion.at(np.zeros(1), programme.bias))[0]
        return Boundary(chart, Amplitude.of(chart, motion, programme), family, joint, up)

    @property
    def spacing(self) -> float:
        """Time between nodes, s."""
        return float(self.family.t[1] - self.family.t[0])

    def fly(self, added: Array, before: Flight | None = None, guess: Array | None = None) -> Flight:
        """Flight of the additions c (N, P); `before`: a flight with similar ones, or `guess`: states (M, 2 m).

        Raises CheckError: there is no rest. StateError: the carrier moves too violently.
        """
        return self.follow(self.family.angles(added), added, before, guess)

    def follow(self, angles: Angles, added: Array, before: Flight | None = None, guess: Array | None = None) -> Flight:
        """Flight under any angles at the nodes (M, N each)."""
        driven = drive(self.chart.mechanics, *angles)
        rest = equilibrium(self.chart, angles.phi[0 if self.up else -1])
        start, end = (rest.y, self.joint) if self.up else (self.joint, rest.y)
        near, bounds = None, Bounds()
        if before is not None:
            near, guess, bounds = before.course.near, before.course.y, before.bounds
        if guess is None:
            guess = np.tile(start, (len(self.family.t), 1))
        carrier_course = course(self.chart, driven, self.spacing, start, guess, near)
        error = self.amplitude.shares(rest.projection @ (carrier_course.y[-1] - end))
        return Flight(self, added, angles, driven, rest, carrier_course, error, bounds)

    def interpolate(self, y: Array, other: Boundary) -> Array:
        """States y at these nodes, interpolated at those of another problem."""
        return np.asarray(CubicSpline(self.family.t, y)(other.family.t))


FAR = 0.3
"""Above this error a step minimises the additions, not itself: the motion stays near the plain fade."""
KEEP = 0.97
"""Part of the bounds that a flight shall keep to."""


@dataclass(frozen=True, eq=False)
class Flight:
    """Additions c (N, P), the flywheels' motion, rest, and the carrier's course; a point of the step routine.

    c      (2 m): terminal error, in amplitudes; the equations to be met
    bounds that hinge rows keep to; without any the additions alone matter
    """

    problem: Boundary
    added: Array
    angles: Angles
    drive: Drive
    rest: Equilibrium
    course: CarrierCourse
    c: Array
    bounds: Bounds = field(default_factory=Bounds)

    @property
    def size(self) -> float:
        """Terminal error: the larger part, pose or twist."""
        return float(max(np.linalg.norm(part) for part in np.split(self.c, 2)))

    @cached_property
    def linear(self) -> Linear:
        """Torques along the flight, and derivatives of (8) and of the torques by the flywheels' motion."""
        return linearise_along(self.problem.chart, self.drive, self.course.y, self.angles.phi_ddot)

    @cached_property
    def values(self) -> dict[str, Array]:
        """Deviation from the mean pose (M, 2; m, rad), speed, acceleration, torque (M, N) at the nodes."""
        away = self.problem.chart.displacement(self.course.y)
        return {
            "deviation": np.column_stack([np.linalg.norm(x, axis=1) for x in np.hsplit(away, 2)]),
            "speed": self.angles.phi_dot,
            "acceleration": self.angles.phi_ddot,
            "torque": self.linear.tau,
        }

    def shares(self, bounds: Bounds) -> dict[str, Array]:
        """Values over bound (M, 2 or N) at the nodes, by name, for each bound given."""
        limits = {name: getattr(bounds, name) for name in ("speed", "acceleration", "torque")}
        limits = {"deviation": bounds.deviation and bounds.deviation.limits, **limits}
        bounded = {name: limit for name, limit in limits.items() if limit is not None}
        return {name: np.abs(self.values[name]) / np.array(limit) for name, limit in bounded.items()}

    def largest(self, bounds: Bounds) -> float:
        """Largest part of a bound that is used; 0 without bounds."""
        return max((float(np.max(x)) for x in self.shares(bounds).values()), default=0.0)

    @property
    def value(self) -> float:
        """Half the sum of squares of the hinge rows."""
        over = (np.maximum(x - KEEP, 0.0) for x in self.shares(self.bounds).values())
        return RHO**2 / 2.0 * sum(float(np.vdot(x, x)) for x in over)

    def model(self) -> Model:
        """Derivatives by the additions."""
        A, states = self._sensitivity()
        n = self.added.size
        if self.shares(self.bounds):
            h, G = self._hinges(states)
            return Model(self.c, A, G.T @ h, G.T @ G, np.ones(n))
        far = float(self.size > FAR)
        return Model(self.c, A, far * self.added.ravel(), far * np.eye(n), np.ones(n))

    def moved(self, step: Array) -> Flight | None:
        """The flight after a step; None: the carrier moves too violently."""
        try:
            return self.problem.fly(self.added + step.reshape(self.added.shape), self)
        except StateError:
            return None

    def change(self, step: Array) -> float:
        """Largest change of an addition, rad."""
        return float(np.abs(step).max(initial=0.0))

    @property
    def table(self) -> Samples:
        """Table with a row at every second node."""
        return Samples(self.problem.family.t[::2], *(x[::2] for x in self.angles))

    def _sensitivity(self) -> tuple[Array, Array]:
        """Derivatives by c: of the terminal error (2 m, N P), and of the states at all nodes (M, 2 m, N P)."""
        boundary, (N, P), m = self.problem, self.added.shape, self.problem.chart.count
        near = linearise(boundary.chart, self.drive, boundary.spacing, self.course.y)
        at_rest = boundary.family.basis[0, 0 if boundary.up else -1]
        rest = (self.rest.by_phi[:, :, None] * at_rest).reshape(2 * m, N * P)
        defects = forced_defects(self.drive, self.linear, boundary.family.basis, boundary.spacing)
        states = near.solve(defects, rest if boundary.up else np.zeros_like(rest))
        end = states[-1] if boundary.up else states[-1] - rest
        return boundary.amplitude.shares(self.rest.projection @ end), states

    def _hinges(self, states: Array) -> tuple[Array, Array]:
        """RHO (share - KEEP) where that is above 0 (K), with derivatives (K, N P); torques by flywheels alone."""
        boundary, (N, P) = self.problem, self.added.shape
        basis, by = boundary.family.basis, self.linear
        h, G = [np.zeros(0)], [np.zeros((0, N * P))]
        for name, share in self.shares(self.bounds).items():
            rows, columns = np.nonzero(share > KEEP)
            h.append(share[rows, columns] - KEEP)
            signed = self.values[name][rows, columns]
            scale = share[rows, columns] / signed  # factor of the derivatives: sign over bound
            slopes = np.zeros((len(rows), N, P))
            k = np.arange(len(rows))
            if name == "deviation":
                pose = boundary.chart.displacement(self.course.y).reshape(-1, 2, 3)[rows, columns]
                moved = boundary.chart.displacement_change(self.course.y, states).reshape(-1, 2, 3, N * P)[
                    rows, columns
                ]
                slopes += np.einsum("ki,kip->kp", pose / signed[:, None], moved).reshape(-1, N, P)
            elif name == "torque":
                for slope, b in zip((by.tau_by_phi, by.tau_by_phi_dot, by.tau_by_phi_ddot), basis, strict=True):
                    slopes[k, columns] += slope[rows, columns, None] * b[rows]
            else:
                slopes[k, columns] = basis[1 if name == "speed" else 2][rows]
            G.append((slopes * scale[:, None, None]).reshape(-1, N * P))
        return RHO * np.concatenate(h), RHO * np.concatenate(G)


GOAL = 1e-8
"""Terminal error at the nodes, in amplitudes."""
ACCEPTED_ERROR = 1e-6
"""Accepted terminal error of the table, with nodes twice as dense."""
NOTHING = 1e-4
"""Singular value of the derivatives of the terminal error (1/rad), or part of the largest, that counts as zero."""
NEWTON = Rules(60, longest=0.5, span=60, rank=NOTHING, least=1.0, shrink=0.5, corrections=0)
"""Shooting: two equations a freedom and more unknowns, steps of least length, or to the least additions."""
INSIDE = Rules(24, longest=0.5, span=4, stall=0.9, rank=NOTHING, least=1.0)
"""Steps towards the bounds that keep the terminal conditions."""

_ATTEMPTS = ((6, 0.0), (10, 0.0), (10, 0.7), (10, 1.4), (14, 0.0))
"""Splines per flywheel, and range (rad) of the random first angles of rest about those of the plain fade."""
RICHER = (12, 20)
"""Splines per flywheel, tried in order while a bound is exceeded."""
_COARSE, _NO_LIMIT = 1e-4, 10**9

Problems = Callable[[int, int], Boundary]
"""Problem for given numbers of nodes and splines."""
DENSEST = 8 * NODES
"""Most nodes per period of the fastest part; half as many rows."""


@dataclass(frozen=True, eq=False)
class RunUpSolution:
    """A solution of the boundary-value problem, and the terminal error of its table with nodes twice as dense.

    steps     Newton steps of the successful attempt
    attempts  1: the first
    """

    flight: Flight
    error: float
    steps: int
    attempts: int


def solve(
    mechanics: Mechanics,
    motion: RequiredMotion,
    programme: Programme,
    duration: float,
    *,
    up: bool,
    seed: int = 0,
    budget: Budget | None = None,
) -> RunUpSolution:
    """A run-up (`up`) into the programme, or a run-down from it, in `duration` s.

    It keeps the motion's bounds if possible. The same programme and seed give the same result, unless the time of
    `budget` is over: then no attempt begins, and no step is taken towards the bounds.

    Raises CheckError: there is no rest, or no run-up was found.
    """
    budget = budget or Budget(_NO_LIMIT)
    rng = np.random.default_rng(seed)
    best = np.inf

    def problem(nodes: int, splines: int) -> Boundary:
        return Boundary.of(mechanics, motion, programme, duration, up=up, nodes=nodes, splines=splines)

    which, where = ("run-up", "into the programme") if up else ("run-down", "to rest")
    for number, (splines, spread) in enumerate(_ATTEMPTS):
        if budget.is_spent():
            ended = "interrupted" if budget.interrupted else "cut by time"
            raise CheckError(f"{which}: {ended} after {number} of {len(_ATTEMPTS)} attempts, none was found")
        coarse = problem(NODES, splines)
        added = np.zeros((mechanics.N, coarse.family.P))
        added[:, 0] = spread * rng.uniform(-1.0, 1.0, mechanics.N)
        try:
            flight, steps = shoot(coarse.fly(added), _COARSE, budget)
            best = min(best, flight.size)
            if flight.size > _COARSE:
                if not budget.is_spent() and is_out_of_reach(flight):
                    raise CheckError(
                        f"{which}: the surroundings cannot absorb the momentum of the programme, so no "
                        "run-up or run-down exists; a programme of rocking flywheels may have no momentum"
                    )
                continue
            result, error = _refine_nodes(problem, _keep_bounds(problem, flight, motion.bounds, budget))
        except StateError:
            continue
        return RunUpSolution(result, error, steps, number + 1)
    ends = f"ends {best:.2g} amplitudes away" if np.isfinite(best) else "moves too violently on the way"
    raise CheckError(
        f"{which}: none of {duration:g} s {where} was found in {len(_ATTEMPTS)} attempts: the carrier {ends}; "
        "make it longer (`runup`)"
    )


def shoot(start: Flight, goal: float, budget: Budget) -> tuple[Flight, int]:
    """Newton steps until the terminal error meets the goal or falls no more: the best flight, number of steps."""
    run = descend(replace(start, bounds=Bounds()), NEWTON, budget, lambda flight: flight.size <= goal)
    return run.point, run.steps


def is_out_of_reach(flight: Flight) -> bool:
    """Whether the remaining terminal error cannot be reduced by any flywheel motion, to first order."""
    A = flight.model().A
    left = flight.c - A @ Range.of(A, NOTHING, 1.0, null=False).least(flight.c)
    return size(left) > 0.5 * size(flight.c)


def _keep_bounds(problem: Problems, flight: Flight, bounds: Bounds, budget: Budget) -> Flight:
    """A flight inside the bounds or nearer to them: more splines while bounds are exceeded and time is left."""
    tried = [flight]
    for splines in (0, *RICHER):
        if flight.largest(bounds) <= (1.0 if splines else KEEP) or budget.is_spent():
            break
        if splines:
            richer = problem(NODES, splines)
            added = flight.problem.family.basis[0] @ flight.added.T
            added = np.linalg.lstsq(richer.family.basis[0], added, rcond=None)[0].T
            try:
                flight = shoot(richer.fly(added), _COARSE, budget)[0]
            except StateError:
                break
            if flight.size > _COARSE:
                break
        inside = descend(
            replace(flight, bounds=bounds), INSIDE, budget, lambda point: point.largest(bounds) <= KEEP
        ).point
        inside = shoot(inside, _COARSE, budget)[0]
        if inside.size <= _COARSE and inside.largest(bounds) < flight.largest(bounds):
            flight = inside
        tried.append(flight)
    return min(tried, key=lambda candidate: candidate.largest(bounds))


def _refine_nodes(problem: Problems, coarse: Flight) -> tuple[Flight, float]:
    """Refine the nodes until the table of the solution ends accurately: flight, terminal error of the table.

    Raises StateError if even the densest table does not.
    """
    flight, nodes, splines = coarse, 2 * NODES, coarse.problem.family.P - 1
    boundary = problem(nodes, splines)
    while nodes <= DENSEST:
        flight = boundary.fly(flight.added, guess=flight.problem.interpolate(flight.course.y, boundary))
        flight = shoot(flight, GOAL, Budget(6))[0]
        nodes *= 2
        denser = problem(nodes, splines)
        angles, guess = flight.table.at(denser.family.t), boundary.interpolate(flight.course.y, denser)
        error = denser.follow(angles, np.zeros((0, 0)), guess=guess).size
        if error <= ACCEPTED_ERROR:
            return flight, error
        boundary = denser
    raise StateError("the motion is too rough for the densest nodes")


def with_runup(
    stand: Stand,
    motion: RequiredMotion,
    programme: Programme,
    seed: int = 0,
    budget: Budget | None = None,
    say: Callable[[str], None] | None = None,
) -> Programme:
    """The programme with the tables `runup` and `rundown` that the motion file requests, and their report.

    A table that was not found is left out; its report has the reason under `reason`. Without `runup` in the motion file
    nothing changes. The same arguments give the same result, unless time or Ctrl-C ends the `budget`: then a table not
    found yet is left out. The run-up has half of the remaining seconds. `say` receives the name of the current search.
    """
    if motion.runup is None or not programme.periodic:
        return programme
    mechanics = Mechanics.of(stand)
    tables: dict[str, RunUpTable | None] = {}
    report: dict[str, Any] = dict(programme.report)
    whole = budget or Budget(0)
    for key, up in (("runup", True), ("rundown", False)):
        limited = Budget(_NO_LIMIT, whole.seconds_left(0.5 if up else 1.0), interrupted=whole.interrupted)
        if say is not None:
            say("run-up" if up else "run-down")
        try:
            solution = solve(mechanics, motion, programme, motion.runup, up=up, seed=seed, budget=limited)
        except KeyboardInterrupt:
            whole.interrupted = True
            tables[key], report[key] = None, {"reason": f"{'run-up' if up else 'run-down'}: interrupted"}
        except CheckError as error:
            tables[key], report[key] = None, {"reason": str(error)}
        else:
            table = RunUpTable(motion.runup, solution.flight.table)
            tables[key], report[key] = table, runup_figures(solution, motion, stand)
    return replace(programme, runup=tables["runup"], rundown=tables["rundown"], report=report)


def shortcomings(programme: Programme) -> tuple[str, ...]:
    """Problems of run-up and run-down, one per line: not found, or a bound exceeded."""
    lines = []
    for key in ("runup", "rundown"):
        report = programme.report.get(key, {})
        if "reason" in report:
            lines.append(report["reason"])
        lines += report.get("exceeded", ())
    return tuple(lines)


def runup_figures(solution: RunUpSolution, motion: RequiredMotion, stand: Stand) -> dict[str, Any]:
    """Report of a run-up: terminal error, largest deviation and its time, peaks, exceeded bounds."""
    values, t = solution.flight.values, solution.flight.problem.family.t
    name = "run-up" if solution.flight.problem.up else "run-down"
    at = np.argmax(values["deviation"], axis=0)
    exceeded = []
    for bound, share in solution.flight.shares(motion.bounds).items():
        i, k = np.unravel_index(int(np.argmax(share)), share.shape)
        if share[i, k] > 1.0:
            value, used = abs(float(values[bound][i, k])), float(share[i, k])
            of, unit = "the carrier", ("m", "rad")[k]
            if bound != "deviation":
                of, unit = stand.flywheels[k].name, UNITS[bound]
            excess = ExceededBound(bound, of, value, value / used, used, unit, float(t[i]))
            exceeded.append(f"{name}: {excess.words}")
    return {
        "terminal_error": solution.error,
        "steps": solution.steps,
        "attempts": solution.attempts,
        "deviation": {
            kind: {"largest": float(values["deviation"][i, k]), "t": float(t[i])}
            for k, (kind, i) in enumerate(zip(("linear", "angular"), at, strict=True))
        },
        "peak": {key: np.abs(values[key]).max(axis=0).tolist() for key in ("speed", "acceleration", "torque")}
        | motor_shortage(stand, values["speed"], values["torque"]),
        "exceeded": exceeded,
    }
