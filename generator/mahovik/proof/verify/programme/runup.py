"""Run-up and run-down: tables between rest and the programme, the carrier free to deviate on the way."""

from __future__ import annotations

import numpy as np

from mahovik.core.motion.programme import Programme, RunUpTable
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand.model import Stand
from mahovik.errors import StateError
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.hold import acceleration, twists
from mahovik.proof.reference.rotation import attitude, rotation_vector
from mahovik.proof.reference.torque import torque
from mahovik.proof.verify.programme.finding import Finding, Tolerance, check_limit, largest
from mahovik.proof.verify.programme.held import displacement
from mahovik.proof.verify.programme.mechanics import Scale, pieces_at, state_at, twist
from mahovik.proof.verify.programme.simulation import rest_near, simulate_rows
from mahovik.proof.verify.programme.table import EXCEEDED, bound_findings, samples_finding

STEP_ERROR = 1e-8
"""Error of a step over the amplitude: the end of a run-up has a wider tolerance than a programme."""

STEPS = 24
"""Least number of steps in a period; there is at least one for each row."""


def runup_findings(
    stand: Stand, motion: RequiredMotion, programme: Programme, scale: Scale, tolerance: Tolerance
) -> list[Finding]:
    """Findings for each table: rows, joint with the programme, rest at the other end, end of the carrier, bounds."""
    found = []
    for name, given in (("run-up", programme.runup), ("run-down", programme.rundown)):
        if given is None:
            continue
        found.append(samples_finding(f"{name} table", given.samples, tolerance.table))
        found.append(_joint(name, programme, given, tolerance.joint))
        found.append(_rest(name, given, tolerance.joint))
        found += _motion(name, stand, motion, programme, given, scale, tolerance.runup)
    return found


def _joint(name: str, programme: Programme, given: RunUpTable, limit: float) -> Finding:
    """Finding on the joint of table and programme: phi up to whole turns, phi', phi'' as shares of their peaks."""
    row = -1 if name == "run-up" else 0
    samples, at = given.samples, programme.at(np.zeros(1))
    turns = (samples.phi[row] - at.phi[0]) / (2 * np.pi)
    errors = [2 * np.pi * np.abs(turns - np.round(turns))]
    for own, theirs in ((samples.phi_dot, at.phi_dot), (samples.phi_ddot, at.phi_ddot)):
        peak = max(largest(own), largest(theirs), 1e-300)
        errors.append(np.abs(own[row] - theirs[0]) / peak)
    worst = np.max(errors, axis=1, initial=0.0)
    i = int(np.argmax(worst))
    return check_limit(
        f"{name} joint", float(worst[i]), limit, f"{('phi', 'phi_dot', 'phi_ddot')[i]} at the programme's t = 0"
    )


def _rest(name: str, given: RunUpTable, limit: float) -> Finding:
    row = 0 if name == "run-up" else -1
    errors = []
    for column in (given.samples.phi_dot, given.samples.phi_ddot):
        peak = largest(column) or 1.0
        errors.append(largest(column[row]) / peak)
    return check_limit(f"{name} rest", max(errors), limit, "phi', phi'' of the flywheels at rest, share of their peaks")


def _motion(
    name: str, stand: Stand, motion: RequiredMotion, programme: Programme, given: RunUpTable, scale: Scale, limit: float
) -> list[Finding]:
    """Findings on the carrier by (8), from equilibrium to the required state or the reverse, and on its bounds."""
    up = name == "run-up"
    required = motion.at(np.zeros(1), programme.bias)
    q, y_required = required.q[0], state_at(stand, required.q[0], required.q_dot[0])
    mean = motion.mean + programme.bias
    t = given.samples.t
    longest = min(programme.span, given.duration) / STEPS
    try:
        rest = rest_near(stand, given.samples.phi[0 if up else -1], mean, scale.K0)
        start = np.concatenate([rest.q, np.zeros_like(rest.q)]) if up else y_required
        y = simulate_rows(stand, given.at, start, t, scale, longest, STEP_ERROR)
        if up:
            x, left = np.split(y[-1] - y_required, 2)
        else:
            end, left = np.split(y[-1], 2)
            x = end - rest_near(stand, given.samples.phi[-1], end, scale.K0).q
    except StateError as error:
        return [Finding(f"{name} end", np.inf, limit, False, str(error))]
    apart = twist(stand, q, x)
    shift = rest.free @ (rest.free.T @ (scale.K0 @ apart))  # where the stand may as well have begun elsewhere
    shares = (scale.displacement_share(apart - shift), scale.twist_share(left if scale.S is None else scale.S @ left))
    strayed = deviation(stand, y, mean)
    words = (
        f"carrier at the end, pose {shares[0]:.2g}, twist {shares[1]:.2g} of the amplitude; on the way "
        f"{1e3 * strayed[0]:.3g} mm, {1e3 * strayed[1]:.3g} mrad from the mean pose"
    )
    angles = given.at(t)
    tau = torques_along(stand, y, angles) if motion.bounds.torque is not None else np.zeros_like(angles.phi)
    names = tuple(s.name for s in stand.flywheels)
    bounds = [
        each
        for each in bound_findings(motion.bounds, names, angles, tau, np.zeros_like(angles.phi), f"{name} ")
        if not each.name.endswith("angle")
    ]
    if motion.bounds.deviation is not None:
        over = strayed / np.array(motion.bounds.deviation)
        words_over = f"{strayed[0]:.6g} m, {strayed[1]:.6g} rad from the mean pose"
        bounds.append(check_limit(f"{name} bound deviation", float(over.max()), EXCEEDED, words_over))
    return [check_limit(f"{name} end", max(shares), limit, words), *bounds]


def deviation(stand: Stand, y: Array, mean: Array) -> Array:
    """Largest distance of O1 (m) and angle of E1 (rad) from the pose `mean`, along states y (M, 12; held M, 2 m)."""
    if stand.hold is not None:
        away = np.array([displacement(stand, q, mean) for q in np.hsplit(y, 2)[0]])
        return np.asarray(away.max(axis=0))
    back = attitude(stand.angles, *mean[3:]).T
    turned = [np.linalg.norm(rotation_vector(back @ attitude(stand.angles, *q[3:6]))) for q in y]
    return np.array([np.linalg.norm(y[:, :3] - mean[:3], axis=1).max(), max(turned)])


def torques_along(stand: Stand, y: Array, angles: tuple[Array, Array, Array]) -> Array:
    """Drive torques tau (M, N; N m) along states (q, V), held (q, u), while nothing prescribes the carrier's motion."""
    found = []
    for row, phi, phi_dot, phi_ddot in zip(y, *angles, strict=True):
        q, V = np.split(row, 2)
        at = pieces_at(stand, q, V if stand.hold is None else twists(stand.hold) @ V, phi, phi_dot)
        found.append(torque(at, acceleration(at, stand, phi_ddot), phi_ddot))
    return np.array(found)
