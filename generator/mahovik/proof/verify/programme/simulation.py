"""The carrier by (8) and (10) under given flywheel angles: item 2, simulation; item 7, stability; and equilibrium."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from mahovik.core.motion.programme import Angles, Programme, Samples
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand.coordinates import coordinates_of
from mahovik.core.stand.model import Stand
from mahovik.errors import StateError
from mahovik.proof.reference.array import Array, solve
from mahovik.proof.reference.forward import forward
from mahovik.proof.reference.hold import held_forward, twists
from mahovik.proof.reference.rotation import check_attitude, kinematic_matrix
from mahovik.proof.verify.programme.finding import Finding, check_limit
from mahovik.proof.verify.programme.held import coordinate_rates
from mahovik.proof.verify.programme.mechanics import Scale, norm, pieces_at, state_at, twist

Course = Callable[[Array], Angles]

RTOL = 1e-12
STEP_ERROR = 1e-9
"""Error of a step, over the amplitude."""

STEPS_OF_SPAN = 32
"""Least number of steps in a span: the error estimate of a step misses jumps of phi's third derivative at rows."""

FURTHEST = 100.0
"""Largest distance from the required motion, in amplitudes, at which the simulation goes on."""


def rate(stand: Stand, y: Array, phi: Array, phi_dot: Array, phi_ddot: Array) -> Array:
    """dy/dt of y = (q, V): q' = A^-1 V by (10), V* by (8). StateError at a singular attitude.

    Of a held carrier y = (q, u), with the coordinates and speeds of its freedoms.
    """
    if stand.hold is not None:
        q, u = np.split(y, 2)
        at = pieces_at(stand, q, twists(stand.hold) @ u, phi, phi_dot)
        return np.concatenate([coordinate_rates(stand, q, u), held_forward(at, stand.hold, phi_ddot).u_dot])
    q, V = y[:6], y[6:]
    check_attitude(stand.angles, q[3:])
    at = pieces_at(stand, q, V, phi, phi_dot)
    return np.concatenate([solve(kinematic_matrix(stand.angles, q[3:]), V), forward(at, phi_ddot)])


def simulate(
    stand: Stand,
    angles: Course,
    start: Array,
    t: Array,
    scale: Scale,
    longest: float,
    error: float = STEP_ERROR,
    furthest: float = np.inf,
) -> Array:
    """y = (q, V) (M, 12) at the times t (M), which begin at the start; no step longer than `longest` (s); see `rate`.

    `error`: of a step, share of the amplitude. StateError where the motion cannot be followed, or is `furthest`
    amplitudes from the start.
    """
    from scipy.integrate import solve_ivp

    count = coordinates_of(stand).count
    lengths = _lengths(stand, scale)
    atol, rates = _absolute(stand, scale, error), _rates(stand, angles)

    def margin(_: float, y: Array) -> float:
        away = np.abs(y[:count] - start[:count])
        return float(furthest - np.max(away / lengths))

    margin.terminal = True  # type: ignore[attr-defined]  # for SciPy: the event ends the run
    events = margin if np.isfinite(furthest) else None
    span = (t[0], t[-1])
    first = float(min(longest, t[-1] - t[0]))
    found = solve_ivp(
        rates, span, start, "DOP853", t, events=events, rtol=RTOL, atol=atol, max_step=longest, first_step=first
    )
    if found.status == 1:
        raise StateError(f"{furthest:g} amplitudes from the required motion at t = {found.t_events[0][0]:.6g} s")
    if not found.success or not np.all(np.isfinite(found.y)):
        raise StateError(f"the simulation stops at t = {found.t[-1] if len(found.t) else 0.0:.6g} s: {found.message}")
    return np.asarray(found.y.T)


def simulate_rows(
    stand: Stand, angles: Course, start: Array, rows: Array, scale: Scale, longest: float, error: float = STEP_ERROR
) -> Array:
    """y = (q, V) (M, 12) at the rows (M, s) of a table; no step goes over a row, where the third derivative jumps.

    See `simulate`. The same method from row to row, without interpolation inside a step, which is not needed here.
    """
    from scipy.integrate import DOP853

    starts, steps = rows[:-1], np.diff(rows)
    asked = np.append(starts[:, None] + DOP853.C[: DOP853.n_stages] * steps[:, None], (starts + steps)[:, None], axis=1)
    atol, rates = _absolute(stand, scale, error), _keep_last(_rates(stand, _tabulate(angles, asked.ravel())))
    states = [start]
    for begin, end in pairwise(rows.tolist()):
        step = min(longest, end - begin)
        solver = DOP853(rates, begin, states[-1], end, rtol=RTOL, atol=atol, max_step=step, first_step=step)
        message = None
        while solver.status == "running":
            message = solver.step()
        if solver.status == "failed" or not np.all(np.isfinite(solver.y)):
            raise StateError(f"the simulation stops at t = {solver.t:.6g} s: {message or 'not finite'}")
        states.append(solver.y)
    return np.array(states)


def _lengths(stand: Stand, scale: Scale) -> Array:
    """Displacement along each coordinate that has the whole amplitude; m, rad."""
    if scale.S is not None:
        return np.array([scale.amplitude / norm(scale.K0, each) for each in scale.S.T])
    return np.repeat(scale.lengths(), 3)


def _absolute(stand: Stand, scale: Scale, error: float) -> Array:
    """(12; m, rad, m/s, rad/s): this share of the amplitude."""
    lengths, faster = _lengths(stand, scale), scale.speed / scale.amplitude
    return error * np.concatenate([lengths, lengths * faster])


def _rates(stand: Stand, angles: Course) -> Callable[[float, Array], Array]:
    """`rate` by time."""

    def rates(now: float, y: Array) -> Array:
        phi, phi_dot, phi_ddot = angles(np.array([now]))
        return rate(stand, y, phi[0], phi_dot[0], phi_ddot[0])

    return rates


def _tabulate(angles: Course, times: Array) -> Course:
    """A course whose angles at `times` (M, s) are evaluated all at once; at any other time one by one."""
    found = {float(t): row for t, *row in zip(times, *(each[:, None] for each in angles(times)), strict=True)}

    def angles_at(t: Array) -> Angles:
        row = found.get(float(t[0]))
        return angles(t) if row is None else Angles(*row)

    return angles_at


def _keep_last(rates: Callable[[float, Array], Array]) -> Callable[[float, Array], Array]:
    """Rates of which the last answer is kept, since a step begins with what the one before ended with."""
    last: list[tuple[float, Array, Array]] = []

    def rates_at(now: float, y: Array) -> Array:
        if not last or last[0][0] != now or not np.array_equal(last[0][1], y):
            last[:] = [(now, y.copy(), rates(now, y))]
        return last[0][2]

    return rates_at


def simulation_finding(
    stand: Stand, motion: RequiredMotion, programme: Programme, scale: Scale, limit: float
) -> Finding:
    """The carrier's distance from the required motion over one span, from the required state at t = 0."""
    rows = None
    if motion.slew is not None and isinstance(
        programme.course, Samples
    ):  # its torques bend within a hundredth of the time
        rows = programme.course.t
    t = np.linspace(0.0, programme.span, 16 * max([*motion.harmonics, 12]) + 1) if rows is None else rows
    course = motion.at(t, programme.bias)
    start = state_at(stand, course.q[0], course.q_dot[0])
    try:
        longest = programme.span / STEPS_OF_SPAN
        if rows is None:
            y = simulate(stand, programme.at, start, t, scale, longest, furthest=FURTHEST)
        else:
            y = simulate_rows(stand, programme.at, start, rows, scale, longest)
    except StateError as error:
        return Finding("simulation", np.inf, limit, False, str(error))
    apart = y[:, : course.q.shape[1]] - course.q
    shares = [scale.displacement_share(twist(stand, q, x)) for q, x in zip(course.q, apart, strict=True)]
    i = int(np.argmax(shares))
    away = f"O1 {1e3 * np.linalg.norm(apart[i, :3]):.2g} mm, angles {1e3 * np.linalg.norm(apart[i, 3:]):.2g} mrad"
    if stand.hold is not None:
        own = coordinates_of(stand)
        parts = zip(own.names, np.abs(apart[i]), own.unit_names, strict=True)
        away = ", ".join(f"{name} {1e3 * x:.2g}{f' m{unit}' if unit else 'e-3'}" for name, x, unit in parts)
    words = f"of (8) from the required state: largest at t = {t[i]:.6g} s, {away} away"
    return check_limit("simulation", float(shares[i]), limit, words)


STEPS_OF_PERIOD = 12
"""Least number of steps in a period, and two for every turn and harmonic: the carrier is slower than its excitation.

Ten to a period leave the multipliers of the example stands right to 1e-5.
"""

DIFFERENCE = 1e-6
"""Step of a difference, over 1 + the number itself: multipliers are right to about five digits."""


def multipliers(stand: Stand, motion: RequiredMotion, programme: Programme) -> tuple[complex, ...]:
    """The 12 eigenvalues of the monodromy matrix, held 2 m: the largest modulus first, of a pair that with Im > 0.

    x' = A(t) x along the required motion, y = (q, V), over a period by Magnus's fourth-order steps with A at the
    two points of Gauss. StateError at a singular attitude.
    """
    from scipy.linalg import expm

    steps = max(STEPS_OF_PERIOD, 2 * max([*motion.harmonics, *map(abs, programme.winding)], default=0))
    h = programme.span / steps
    monodromy = np.eye(2 * coordinates_of(stand).count)
    for step in range(steps):
        early, late = ((step + 0.5 + side * np.sqrt(3) / 6) * h for side in (-1, 1))
        A1, A2 = (_linear(stand, motion, programme, t) for t in (early, late))
        exponent = h / 2 * (A1 + A2) + np.sqrt(3) / 12 * h**2 * (A2 @ A1 - A1 @ A2)
        monodromy = expm(exponent) @ monodromy
    found = [complex(z) for z in np.linalg.eigvals(monodromy)]
    # moduli of a pair may differ in the last digits
    return tuple(sorted(found, key=lambda z: (-round(abs(z), 12), -round(z.real, 12), -z.imag)))


def _linear(stand: Stand, motion: RequiredMotion, programme: Programme, t: float) -> Array:
    """A (12x12; 2 m x 2 m of a held carrier): derivatives of (q', V*) by (q, V) at t, by differences."""
    course, angles = motion.at(np.array([t]), programme.bias), programme.at(np.array([t]))
    y = state_at(stand, course.q[0], course.q_dot[0])
    phi, phi_dot, phi_ddot = (each[0] for each in angles)
    here = rate(stand, y, phi, phi_dot, phi_ddot)
    A = np.zeros((len(y), len(y)))
    for i in range(len(y)):
        aside = y.copy()
        aside[i] += DIFFERENCE * (1.0 + abs(y[i]))
        A[:, i] = (rate(stand, aside, phi, phi_dot, phi_ddot) - here) / (aside[i] - y[i])
    return A


def floquet_finding(stand: Stand, motion: RequiredMotion, programme: Programme, limit: float) -> Finding:
    """The largest multiplier. Above 1 the motion is right, but something must hold it: a warning, no failure."""
    try:
        found = multipliers(stand, motion, programme)
    except StateError as error:
        return Finding("Floquet", np.inf, limit, False, str(error))
    value = abs(found[0])
    if value > limit:
        words = "largest multiplier: the motion is right, but not stable without feedback"
    elif value > 2 - limit:
        words = f"largest multiplier: neutral, the carrier {_neutral(found, limit - 1)}"
    else:
        words = f"largest multiplier: stable, disturbances decay by {value:.3g} a period"
    return Finding("Floquet", value, limit, bool(np.isfinite(value)), words, found)


def _neutral(found: tuple[complex, ...], near: float) -> str:
    """What multipliers of modulus 1 mean: one that is 1 itself keeps a displacement, any other one turns it on."""
    kept = [abs(z - 1) <= near for z in found if abs(z) > 1 - near]
    drifts = ["is free to drift"] if any(kept) else []
    return " and ".join([*drifts, *([] if all(kept) else ["swings undamped"])])


FREE = 1e-6
"""Part of the largest stiffness below which the stand is free to move in a direction."""

TURN = 1e-10
"""Length of the last step, rad and m."""


@dataclass(frozen=True, eq=False)
class Rest:
    """Equilibrium: q (6; held m) at rest, and the free directions (6, n): displacements in E1, orthogonal in K0."""

    q: Array
    free: Array


def rest_near(stand: Stand, phi: Array, q: Array, K0: Array) -> Rest:
    """The equilibrium for phases phi (N) that Newton's steps, least in K0, find from q. StateError: there is none.

    Of a held carrier along its freedoms: displacements are those of its coordinates, rates those of u.
    """
    S = np.eye(6) if stand.hold is None else twists(stand.hold)
    root, m = np.linalg.cholesky(S.T @ K0 @ S).T, S.shape[1]  # x^T K0 x = |root x|^2
    still = np.zeros(len(phi))
    for _ in range(50):
        pull = rate(stand, np.concatenate([q, np.zeros(m)]), phi, still, still)[m:]
        slopes = np.zeros((m, m))
        for i in range(m):
            aside = np.zeros(2 * m)
            aside[i] = 1e-6
            y = np.concatenate([q, np.zeros(m)])
            ahead, behind = (rate(stand, y + side * aside, phi, still, still)[m:] for side in (1, -1))
            slopes[:, i] = (ahead - behind) / 2e-6
        A = np.linalg.lstsq(S, np.column_stack([twist(stand, q, each) for each in np.eye(m)]), rcond=None)[0]
        stiffness = root @ slopes @ np.linalg.inv(root @ A)
        U, sigma, Vt = np.linalg.svd(stiffness)
        kept = sigma > FREE * max(sigma[0], 1e-9)
        x = np.linalg.solve(root, -(Vt[kept].T @ ((U[:, kept].T @ (root @ pull)) / sigma[kept])))
        step = np.linalg.solve(A, x)
        q = q + step * min(1.0, 0.3 / max(float(np.abs(step).max()), 1e-300))
        if np.abs(step).max() < TURN:
            left = U[:, ~kept].T @ (root @ pull)
            if np.linalg.norm(left) > 1e-6 * max(float(np.linalg.norm(stand.gravity)), 1.0) * root[0, 0]:
                break
            return Rest(q, S @ np.linalg.solve(root, Vt[~kept].T))
    raise StateError("no equilibrium to start from: with the flywheels at rest the carrier accelerates everywhere")
