"""The judge of motions by the C: SciPy's `solve_ivp` on the literal reference, slow, with kinematics of its own."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Sequence

import numpy as np
from scipy.integrate import solve_ivp

from mahovik.core.stand.hold import has_coordinates
from mahovik.core.stand.model import Stand, State
from mahovik.errors import StateError
from mahovik.proof import reference
from mahovik.proof.reference.algebra import quaternion_rotation
from mahovik.proof.reference.coordinates import coordinates_at, rates_at
from mahovik.proof.reference.motion import rates
from mahovik.use.simulate.case import Array, Case
from mahovik.use.simulate.course import NEEDS, Moments

RTOL, ATOL = 1e-10, 1e-12

ROWS = 100
"""Moments that are handed on at once."""

Rates = tuple[State, Array, Array, Array]
"""A state, V_dot, phi_ddot, and torques by motors and regime."""


def integrate(
    rate: Callable[[float, Array], Array], y: Array, begin: float, end: float, times: Sequence[float] = ()
) -> tuple[Array, Array]:
    """y at the end, and at times (rows). Raises StateError: the integration fails."""
    solution = solve_ivp(
        rate, (begin, end), y, "DOP853", rtol=RTOL, atol=ATOL, max_step=(end - begin) / 4, dense_output=len(times) > 0
    )
    if not solution.success:
        raise StateError(f"at t = {solution.t[-1]:.6g} s the integration fails: {solution.message}")
    return solution.y[:, -1], solution.sol(np.array(times)).T if len(times) else np.zeros((0, len(y)))


def rate(state: State, V_dot: Array, phi_ddot: Array) -> Array:
    """dy/dt of y = position, quaternion q, V, phases, speeds: C v, q (0, omega) / 2, accelerations."""
    w, x, y, z = state.quaternion or (1.0, 0.0, 0.0, 0.0)
    p, q, r = state.V[3:]
    turning = [-x * p - y * q - z * r, w * p + y * r - z * q, w * q + z * p - x * r, w * r + x * q - y * p]
    moving = quaternion_rotation(w, x, y, z) @ np.array(state.V[:3])
    return np.concatenate([moving, 0.5 * np.array(turning), V_dot, state.phi_dot, phi_ddot])


def accelerations(stand: Stand, state: State, tau: Array, phi_ddot: Array, driven: Array) -> tuple[Array, Array]:
    """V_dot, phi_ddot of a state, where torques drive those flywheels, and accelerations of the others are given."""
    at = reference.pieces(stand, state)
    u_dot, phi_ddot = rates(at, tau, phi_ddot, driven)
    return at.S @ u_dot, phi_ddot


def motion(case: Case, y: Array, needs: Collection[str] = NEEDS) -> Iterator[Moments]:
    """The motion of a case from y = position, quaternion, V at t = 0; as `course.motion` of one sample.

    Raises StateError if the motion leaves the computable range.
    """
    held = np.array(case.regime.has_speed_law, dtype=bool)
    N = len(held)

    def at(t: float, y: Array) -> Rates:
        (phi,), (phi_dot,), (phi_ddot,) = case.motion(np.array([t]))
        phi, phi_dot = np.where(held, phi, y[13 : 13 + N]), np.where(held, phi_dot, y[13 + N :])
        tau = case.torques(t, phi_dot)
        state = case.state(t, y[:3], y[3:7], y[7:13], phi, phi_dot)
        return state, *accelerations(case.stand, state, tau, phi_ddot, ~held), tau

    def slope(t: float, y: Array) -> Array:
        state, V_dot, phi_ddot, _ = at(t, y)
        return rate(state, V_dot, phi_ddot)

    y = np.concatenate([y, case.phi0, case.phi_dot0])
    rows = [(0.0, y)]
    now, many = 0.0, ROWS
    for end in (*case.regime.breaks(case.until), case.until):
        inside = case.times[(case.times > now) & (case.times <= end)].tolist()
        while now < end:
            piece, rest = inside[:many], inside[many:]
            stop = piece[-1] if rest else end
            try:
                y, rates = integrate(slope, y, now, stop, piece)
            except StateError:
                if len(piece) < 2:
                    raise
                many = len(piece) // 2  # the moments before it are kept
                continue
            rows += zip(piece, rates, strict=True)
            now, inside = stop, rest
            yield _moments(case, [(t, at(t, y)) for t, y in rows], [y[13 : 13 + N] for _, y in rows], held, needs)
            rows = []


def _moments(
    case: Case, rows: Sequence[tuple[float, Rates]], phases: Sequence[Array], held: Array, needs: Collection[str]
) -> Moments:
    """Moments (K, components, 1) of rows of accelerations, by the reference."""
    stand, t = case.stand, np.array([t for t, _ in rows])
    columns: dict[str, list[Array]] = {name: [] for name in ("state", *NEEDS)}
    want = ["torque", "points", *(["mounts"] if "loads" in needs else [])]
    for _, (state, V_dot, phi_ddot, tau) in rows:
        moving = case.moving(state, V_dot, phi_ddot)
        answers = reference.evaluate(stand, moving, want)
        numbers = [*state.position, *(state.quaternion or ()), *state.V, *state.phi, *state.phi_dot]
        columns["state"].append(np.array(numbers))
        columns["V_dot"].append(V_dot)
        columns["phi_ddot"].append(phi_ddot)
        columns["tau"].append(np.where(held, answers["torque" if "torque" in answers else "tau"], tau))
        parts = ("position", "C", "twist", "specific_force", "angular_acceleration")
        sensors = [np.ravel(reading[part]) for reading in answers["points"].values() for part in parts]
        columns["readings"].append(np.concatenate([np.zeros(0), *sensors]))
        columns["loads"].append(np.ravel(answers.get("mount_wrench", ())))
        hold = stand.hold
        if hold is not None:
            columns["reaction"].append(np.asarray(reference.evaluate(stand, moving, ["forward"])["reaction"]))
            if has_coordinates(hold):
                at, u = coordinates_at(stand, state), np.array(state.u)
                q_dot, _ = rates_at(hold, at.R, u, np.zeros(len(u)))
                orientation = () if at.orientation is None else at.orientation
                columns["coordinates"].append(np.concatenate([at.q, orientation, q_dot]))
    arrays = {name: np.array(values).reshape(len(t), -1, 1) for name, values in columns.items()}
    arrays["phi"] = np.where(held, case.motion(t)[0], np.array(phases).reshape(len(t), -1))[:, :, None]
    return Moments(t, **arrays)
