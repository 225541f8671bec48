"""Item 2: the carrier by (8) and (10) under given flywheel angles, from a given state, by SciPy's DOP853."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise

import numpy as np

from mahovik.core.motion.programme import Angles, Programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand.model import Stand
from mahovik.errors import StateError
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.forward import forward
from mahovik.proof.reference.linear import solve
from mahovik.proof.reference.rotation import check_attitude, kinematic_matrix
from mahovik.proof.verify.programme.along import pieces_at, twist
from mahovik.proof.verify.programme.finding import Finding, judged
from mahovik.proof.verify.programme.scale import Scale

Course = Callable[[Array], Angles]

RTOL = 1e-12
STEP_ERROR = 1e-9
"""Error of a step, over the amplitude."""

STEPS = 32
"""A span at least: at the rows of a table the third derivative of phi jumps, to which a step's estimate is blind."""

FURTHEST = 100.0
"""Amplitudes from the required motion: a carrier that is thrown off further is not followed."""


def rate(stand: Stand, y: Array, phi: Array, phi_dot: Array, phi_ddot: Array) -> Array:
    """dy/dt of y = (q, V): q' = A^-1 V by (10), V* by (8). StateError at a singular attitude."""
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
    """y = (q, V) (M, 12) at the times t (M), which begin at the start; no step longer than `longest` (s).

    `error`: of a step, share of the amplitude. StateError where the motion cannot be followed, or is `furthest`
    amplitudes from the start.
    """
    from scipy.integrate import solve_ivp

    m, rad = scale.lengths()
    atol, rates = _absolute(scale, error), _rates(stand, angles)

    def left(_: float, y: Array) -> float:
        away = np.abs(y[:6] - start[:6])
        return float(furthest - max(away[:3].max() / m, away[3:].max() / rad))

    left.terminal = True  # type: ignore[attr-defined]  # for SciPy: the event ends the run
    events = left if np.isfinite(furthest) else None
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

    See `simulate`. From row to row the same method, without what interpolates inside a step: nobody asks there.
    """
    from scipy.integrate import DOP853

    starts, steps = rows[:-1], np.diff(rows)
    asked = np.append(starts[:, None] + DOP853.C[: DOP853.n_stages] * steps[:, None], (starts + steps)[:, None], axis=1)
    atol, rates = _absolute(scale, error), _remembered(_rates(stand, _tabled(angles, asked.ravel())))
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


def _absolute(scale: Scale, error: float) -> Array:
    """(12; m, rad, m/s, rad/s): this share of the amplitude."""
    m, rad = scale.lengths()
    faster = scale.speed / scale.amplitude
    return error * np.repeat([m, rad, m * faster, rad * faster], 3)


def _rates(stand: Stand, angles: Course) -> Callable[[float, Array], Array]:
    """`rate` by time."""

    def rates(now: float, y: Array) -> Array:
        phi, phi_dot, phi_ddot = angles(np.array([now]))
        return rate(stand, y, phi[0], phi_dot[0], phi_ddot[0])

    return rates


def _tabled(angles: Course, times: Array) -> Course:
    """The same, where those at `times` (M, s) are evaluated all at once; at any other time one by one."""
    found = {float(t): row for t, *row in zip(times, *(each[:, None] for each in angles(times)), strict=True)}

    def tabled(t: Array) -> Angles:
        row = found.get(float(t[0]))
        return angles(t) if row is None else Angles(*row)

    return tabled


def _remembered(rates: Callable[[float, Array], Array]) -> Callable[[float, Array], Array]:
    """The same; the last answer is kept, since a step begins with what the one before ended with."""
    last: list[tuple[float, Array, Array]] = []

    def remembered(now: float, y: Array) -> Array:
        if not last or last[0][0] != now or not np.array_equal(last[0][1], y):
            last[:] = [(now, y.copy(), rates(now, y))]
        return last[0][2]

    return remembered


def finding(stand: Stand, motion: RequiredMotion, programme: Programme, scale: Scale, limit: float) -> Finding:
    """The carrier's distance from the required motion over one span, from the required state at t = 0."""
    t = np.linspace(0.0, programme.span, 16 * max([*motion.harmonics, 12]) + 1)
    course = motion.at(t, programme.bias)
    start = np.concatenate([course.q[0], twist(stand, course.q[0], course.q_dot[0])])
    try:
        y = simulate(stand, programme.at, start, t, scale, programme.span / STEPS, furthest=FURTHEST)
    except StateError as error:
        return Finding("simulation", np.inf, limit, False, str(error))
    apart = y[:, :6] - course.q
    shares = [scale.of_displacement(twist(stand, q, x)) for q, x in zip(course.q, apart, strict=True)]
    i = int(np.argmax(shares))
    words = (
        f"of (8) from the required state: largest at t = {t[i]:.6g} s, "
        f"O1 {1e3 * np.linalg.norm(apart[i, :3]):.2g} mm, angles {1e3 * np.linalg.norm(apart[i, 3:]):.2g} mrad away"
    )
    return judged("simulation", float(shares[i]), limit, words)
