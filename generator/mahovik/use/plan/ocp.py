"""(13) as it is printed, by CasADi and IPOPT: the judge of the planner, with which it shares no formula.

x = (phi, phi') and u = phi'' of all flywheels; minimise J(x, u) subject to (12) at every time, x in E_x, u in E_u; a
periodic motion closes with its windings, a finite one has x(t0) = x0. So no part phi_+ need keep det I_+ from zero.
(12) and the drive torques are those of the second derivation, from energies, at the pose of the carrier that the
planner's programme has; the pose by time is the literal reference's.

Direct collocation: in every interval the states are polynomials of degree d through its start and d Gauss nodes. Time
is in 1/Omega, torques are in J_s Omega^2, rows of (12) in the norm of residuals. Between the nodes (12) does not hold:
the planner makes the motion exact from there.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from importlib.util import find_spec
from typing import Any, cast

import numpy as np

from mahovik.core.motion.functions import Angles, Fourier, Samples
from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand.hold import twists
from mahovik.core.stand.model import Stand, Vec6, rest_state
from mahovik.errors import UsageError
from mahovik.use.numeric.se3 import Array
from mahovik.use.plan.objective import Cost
from mahovik.use.plan.outcome import Budget, OnProgress, Plan, PlanOptions
from mahovik.use.plan.planner import plan_motion
from mahovik.use.plan.problem import FlywheelMotion, Problem
from mahovik.use.plan.search import with_shortest_period

INTERVALS, DEGREE = 24, 4
"""Intervals of a motion with one harmonic, 8 more for each higher one, and degree."""
FINITE_INTERVALS = 48
INSIDE = 0.98
"""Part of the bounds that the nodes keep to, so that the exact motion next to them keeps to the bounds."""
FEASIBLE = 1e-4
"""Largest violation of a row from which the planner still makes a motion exact."""
_OPTIONS = {
    "print_time": False, "error_on_fail": False, "ipopt.print_level": 0, "ipopt.sb": "yes",
    "ipopt.linear_solver": "mumps", "ipopt.max_iter": 300, "ipopt.tol": 1e-6, "ipopt.acceptable_tol": 1e-4,
    "ipopt.constr_viol_tol": 1e-7, "ipopt.mu_init": 1e-4, "ipopt.bound_push": 1e-4, "ipopt.bound_frac": 1e-4,
    "ipopt.fixed_variable_treatment": "make_constraint",
}  # fmt: skip


@dataclass(frozen=True, eq=False)
class Mesh:
    """K intervals of equal length over [0, 1], d nodes each: M = K d nodes, K (d + 1) + 1 columns of a state."""

    K: int
    d: int = DEGREE

    @cached_property
    def gauss(self) -> tuple[Array, Array]:
        """Gauss points in (0, 1) (d), and their weights, whose sum is 1."""
        x, w = np.polynomial.legendre.leggauss(self.d)
        return (1.0 + x) / 2.0, w / 2.0

    @cached_property
    def nodes(self) -> Array:
        """Times (M,) of the nodes."""
        return np.asarray((np.arange(self.K)[:, None] + self.gauss[0]).ravel() / self.K)

    @cached_property
    def times(self) -> Array:
        """Times of all columns of a state."""
        local = np.concatenate([[0.0], self.gauss[0]])
        return np.append((np.arange(self.K)[:, None] + local).ravel() / self.K, 1.0)

    @property
    def at_nodes(self) -> list[int]:
        """Columns (M,) of the nodes."""
        return [k * (self.d + 1) + j for k in range(self.K) for j in range(1, self.d + 1)]

    @property
    def weights(self) -> Array:
        """Weights (M,) of the nodes in a mean."""
        return np.tile(self.gauss[1] / self.K, self.K)

    def interpolate(self, x: Array, order: int = 0) -> Array:
        """(columns, len(x)): a state times this is its value, or derivative, at times x in [0, 1]."""
        knots, k = np.concatenate([[0.0], self.gauss[0]]), np.clip((x * self.K).astype(int), 0, self.K - 1)
        result = np.zeros((self.K * (self.d + 1) + 1, len(x)))
        for j, knot in enumerate(knots):
            rest = np.delete(knots, j)
            polynomial = np.polynomial.Polynomial.fromroots(rest) / np.prod(knot - rest)
            values = polynomial.deriv(order)(x * self.K - k) if order else polynomial(x * self.K - k)
            result[k * (self.d + 1) + j, np.arange(len(x))] = values * self.K**order
        return result

    @cached_property
    def jumps(self) -> Array:
        """(columns, K): a state times this is the jump from the end of each interval to what follows."""
        ends = replace(self, K=1).interpolate(np.ones(1))[:-1, 0]
        result = np.zeros((self.K * (self.d + 1) + 1, self.K))
        for k in range(self.K):
            result[k * (self.d + 1) : (k + 1) * (self.d + 1), k] = ends
            result[(k + 1) * (self.d + 1), k] = -1.0
        return result


@dataclass(frozen=True, eq=False)
class Solution:
    """What IPOPT found: phi, phi' (N, columns of the mesh; rad, rad/s), J of (13) by the nodes, its status in words."""

    mesh: Mesh
    span: float
    phi: Array
    phi_dot: Array
    objective: float
    words: str
    iterations: int
    usable: bool

    def at(self, t: Array) -> Angles:
        """Angles (M, N) at times t (M, s)."""
        E, D = self.mesh.interpolate(t / self.span), self.mesh.interpolate(t / self.span, 1) / self.span
        return Angles(E.T @ self.phi.T, E.T @ self.phi_dot.T, D.T @ self.phi_dot.T)


def node_function(stand: Stand, problem: Problem, cost: Cost) -> Any:
    """(phi, v, a, mean speeds, inputs of the second derivation) -> R of (12) (m), tau (N), J(x, u), at one time.

    phi, v, a (N each) are angles, phi'/Omega, phi''/Omega^2. Inputs in the order of `carrier_inputs`.
    """
    import casadi as ca

    from mahovik.proof.second.system import Second

    second, N, Omega = Second(stand), problem.N, cost.Omega
    system = second.system
    carrier, drive = system.inertial_force(system.inputs["V_dot"], system.inputs["phi_ddot"])
    applied, of_wrenches = system.applied_force()
    forces = second.as_function("forces", {"R": applied - carrier, "drive": drive - of_wrenches}).expand()
    phi, v, a, mean = (ca.SX.sym(name, N) for name in ("phi", "v", "a", "mean"))
    inputs = {name: ca.SX.sym(name, *of.shape) for name, of in system.inputs.items() if not name.startswith("phi")}
    wrenches = forces(**inputs, phi=phi, phi_dot=v * Omega, phi_ddot=a * Omega**2)
    unit, drives = cost.spin_inertia * Omega**2, cost.drives
    tau, speed = wrenches["drive"], v * Omega
    motor = tau + drives.viscous * speed + drives.coulomb * ca.tanh(speed / drives.coulomb_speed)
    rows = {
        "acceleration": a,
        "torque": tau / unit,
        "speed_variation": v - mean,
        "power": (drives.resistance * (motor / drives.constant) ** 2 + motor * speed) / (unit * Omega),
    }
    J = sum(ca.dot(cost.weights[kind], row**2) for kind, row in rows.items())
    R = ca.DM(problem.norm.root / problem.norm.demand) @ wrenches["R"]
    return ca.Function("node", [phi, v, a, mean, ca.veccat(*inputs.values())], [R, tau / unit, J])


def carrier_inputs(stand: Stand, motion: RequiredMotion, bias: Array, t: Array) -> Array:
    """Inputs (P, M) of the second derivation that the carrier's motion prescribes at times t (M, s)."""
    from scipy.spatial.transform import Rotation

    from mahovik.proof.second.system import Second
    from mahovik.proof.verify.programme.mechanics import carrier_at

    second, columns, rest = Second(stand), [], rest_state(stand)
    for q, q_dot, q_ddot in zip(*motion.at(t, bias), strict=True):
        at = carrier_at(stand, q, q_dot)
        turned = cast("tuple[float, float, float, float]", tuple(np.roll(Rotation.from_matrix(at.C).as_quat(), 1)))
        V, V_dot = (cast(Vec6, tuple(x)) for x in (at.A @ q_dot, at.A @ q_ddot + at.drift))
        state = replace(rest, position=tuple(at.O1), quaternion=turned, V=V, V_dot=V_dot)
        values = second.arguments(state)
        names = [name for name in second.system.inputs if not name.startswith("phi")]
        columns.append(np.concatenate([np.asarray(values[name], dtype=np.float64).ravel("F") for name in names]))
    return np.array(columns).T


def solve(problem: Problem, start: Programme, mesh: Mesh, seconds: float | None = None) -> Solution:
    """(13) from the flywheels' motion of a programme. The end of the time (s) gives IPOPT's last point."""
    import casadi as ca

    stand, motion, N = problem.stand, problem.motion, problem.N
    lowest = min(motion.harmonics, default=1)
    cost = Cost.of(problem.mechanics, motion.objective, 2.0 * np.pi / motion.span * lowest)
    Omega, bias, turn = cost.Omega, np.array(start.bias), 2.0 * np.pi * np.array(start.winding, dtype=np.float64)
    node, M = node_function(stand, problem, cost), len(mesh.nodes)
    inputs = carrier_inputs(stand, motion, bias, mesh.nodes * motion.span)
    X, U, mean = ca.MX.sym("X", 2 * N, len(mesh.times)), ca.MX.sym("U", N, M), ca.MX.sym("mean", N)
    at_nodes, span = X[:, mesh.at_nodes], motion.span * Omega
    speeds = np.tile((turn / span)[:, None], M)
    R, tau, J = node.map(M)(at_nodes[:N, :], at_nodes[N:, :], U, speeds, inputs)
    derive, jumps = (ca.sparsify(ca.DM(x)) for x in (mesh.interpolate(mesh.nodes, 1), mesh.jumps))
    zero = [(X @ derive - span * ca.vertcat(at_nodes[N:, :], U)) / M, X @ jumps, R]
    limits, angle = _limits(problem, cost), motion.bounds.angle is not None
    if motion.periodic:
        zero.append(X[:, -1] - X[:, 0] - ca.DM(np.concatenate([turn, 0.0 * turn])))
    swing = at_nodes[:N, :] - turn[:, None] * mesh.nodes - ca.repmat(mean, 1, M)
    zero.append(swing @ ca.DM(mesh.weights) if angle else mean)
    bounded = {"torque": tau, "angle": swing}
    kept = [name for name in bounded if getattr(motion.bounds, name) is not None]
    g = ca.veccat(*zero, *(bounded[name] for name in kept))
    high = np.concatenate([np.zeros(sum(x.numel() for x in zero)), *(np.tile(limits[name], M) for name in kept)])
    low_x, high_x = _state_bounds(problem, limits, np.array(start.winding), len(mesh.times))
    free = np.full(N, np.inf)
    upper = np.concatenate([high_x.ravel("F"), np.tile(limits["acceleration"], M), free])
    lower = np.concatenate([low_x.ravel("F"), -np.tile(limits["acceleration"], M), -free])
    if not motion.periodic:
        first = start.at(np.zeros(1))
        lower[N : 2 * N] = upper[N : 2 * N] = first.phi_dot[0] / Omega
        if motion.bounds.start.phi is not None:
            lower[:N] = upper[:N] = first.phi[0]
    begin, within = start.at(mesh.times * motion.span), start.at(mesh.nodes * motion.span)
    x0 = [np.vstack([begin.phi.T, begin.phi_dot.T / Omega]).ravel("F"), (within.phi_ddot / Omega**2).ravel()]
    x0.append((within.phi.T - turn[:, None] * mesh.nodes) @ mesh.weights if angle else 0.0 * turn)
    z, f = ca.veccat(X, U, mean), J @ ca.DM(mesh.weights)
    posed: Any = {"x": z, "f": f, "g": g}
    options: Any = _OPTIONS | ({} if seconds is None else {"ipopt.max_wall_time": max(seconds, 1e-3)})
    solver = ca.nlpsol("ocp", "ipopt", posed, options)
    solution = solver(x0=np.concatenate(x0), lbx=lower, ubx=upper, lbg=-high, ubg=high)
    violation = float(np.maximum(np.abs(np.asarray(solution["g"]).ravel()) - high, 0.0).max(initial=0.0))
    states = np.asarray(solution["x"]).ravel()[: 2 * N * len(mesh.times)].reshape(2 * N, -1, order="F")
    stats = solver.stats()
    words, iterations = str(stats["return_status"]).replace("_", " ").lower(), int(stats["iter_count"])
    objective, usable = float(solution["f"]), violation < FEASIBLE
    return Solution(mesh, motion.span, states[:N], states[N:] * Omega, objective, words, iterations, usable)


def _limits(problem: Problem, cost: Cost) -> dict[str, Array]:
    """Magnitudes (N) of every bound of the flywheels in the scales of a node; infinite without a bound."""
    units = {"speed": cost.Omega, "acceleration": cost.Omega**2, "torque": cost.spin_inertia * cost.Omega**2}
    bounds = {kind: getattr(problem.motion.bounds, kind) for kind in (*units, "angle")}
    return {
        kind: np.full(problem.N, np.inf) if most is None else np.array(most) / units.get(kind, 1.0) * INSIDE
        for kind, most in bounds.items()
    }


def _state_bounds(problem: Problem, limits: Mapping[str, Array], winding: Array, columns: int) -> tuple[Array, Array]:
    """Bounds of x (2N, columns): greatest speeds, and least speeds on the side of the winding."""
    slow, fast = -limits["speed"], limits["speed"].copy()
    if (least := problem.motion.bounds.speed_min) is not None:
        lowest = min(problem.motion.harmonics, default=1)
        scaled = np.array(least) * problem.motion.span / (2.0 * np.pi * lowest) / INSIDE
        slow = np.where((scaled > 0.0) & (winding >= 0), scaled, slow)
        fast = np.where((scaled > 0.0) & (winding < 0), -scaled, fast)
    free = np.full(problem.N, np.inf)
    low, high = (np.concatenate(pair)[:, None] for pair in ((-free, slow), (free, fast)))
    return np.tile(low, columns), np.tile(high, columns)


def plan_ocp(
    stand: Stand, motion: RequiredMotion, options: PlanOptions | None = None, on_progress: OnProgress = lambda _: None
) -> Plan:
    """A programme by (13): the planner's, solved again by IPOPT, made exact from there; the better of the two.

    `ocp` of the report has IPOPT's status, and J: of the planner's programme (`objective_of_start`), of the nodes
    (`objective_at_nodes`), of the result (`objective`). Raises UsageError where (13) has no solution in general.
    """
    options = options or PlanOptions()
    rows = twists(stand.hold).shape[1]
    if rows > len(stand.flywheels):
        words = f"the stand has {len(stand.flywheels)} flywheels; (13) needs at least {rows}"
        raise UsageError(f"method ocp: {words}; use fourier")
    if find_spec("casadi") is None:
        raise UsageError("method ocp: CasADi is not installed: pip install casadi, or use fourier")
    budget = Budget(0, options.seconds)
    quick = replace(motion, runup=None)
    plan = plan_motion(stand, quick, replace(options, seconds=budget.seconds_left(0.5), verify=False), on_progress)
    if not plan.programmes:
        return plan
    first = plan.programmes[0]
    highest = max(motion.harmonics, default=1)
    mesh = Mesh(INTERVALS + 8 * (highest - 1) if motion.periodic else FINITE_INTERVALS)
    starts: list[FlywheelMotion | Samples] = [start_of(first, motion)]
    report: dict[str, Any] = {"ipopt": "interrupted", "iterations": 0}
    try:
        run = solve(Problem.of(stand, quick), first, mesh, budget.seconds_left())
        report = {"ipopt": run.words, "iterations": run.iterations, "objective_at_nodes": run.objective}
        if run.usable:
            starts.insert(0, start_of(first, motion, run))
    except KeyboardInterrupt:
        budget.interrupt()
    best: Plan | None = None
    for start in starts:
        again = plan_motion(stand, motion, replace(options, start=start, seconds=budget.seconds_left()), on_progress)
        better = best is None or (again.status == "OK" and best.status != "OK")
        best = again if better else best
        if again.status == "OK" and _objective(again) <= _objective(plan) * (1.0 + 1e-6):
            break
    assert best is not None
    report |= {"intervals": mesh.K, "objective_of_start": _objective(plan), "objective": _objective(best)}
    told = tuple(
        replace(programme, report={**programme.report, "method": "ocp", "ocp": report}) for programme in best.programmes
    )
    return replace(best, programmes=told, interrupted=best.interrupted or budget.interrupted)


def _objective(plan: Plan) -> float:
    return float(cast(Any, plan.programmes[0].report["objective"])) if plan.programmes else np.inf


def start_of(programme: Programme, motion: RequiredMotion, run: Solution | None = None) -> FlywheelMotion | Samples:
    """The flywheels' motion of a programme, or of (13) from it, over the shortest period, for the planner."""
    at = programme.at if run is None else run.at
    if not motion.periodic:
        whole = np.linspace(0.0, motion.span, 1025)
        return Samples(whole, *at(whole))
    parts = round(motion.span / with_shortest_period(motion).span)
    fourier = programme.course
    H = len(fourier.cos) // parts if isinstance(fourier, Fourier) else 32
    t = np.asarray(np.arange(8 * H) * (motion.span / parts / (8 * H)))
    turned = at(t).phi - np.outer(t, 2.0 * np.pi / motion.span * np.array(programme.winding))
    spectrum = np.fft.rfft(turned, axis=0)[: H + 1].T / (8 * H)
    waves = np.empty((len(spectrum), 2 * H + 1))
    waves[:, 0] = spectrum[:, 0].real
    waves[:, 1::2], waves[:, 2::2] = 2.0 * spectrum[:, 1:].real, -2.0 * spectrum[:, 1:].imag
    return FlywheelMotion(
        motion.span / parts, np.array(programme.winding, dtype=np.float64) / parts, waves, np.array(programme.bias)
    )
