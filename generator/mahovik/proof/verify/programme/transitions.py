"""Motions from rest or to rest: run-up and run-down, on which the carrier may deviate, and slews, with their motors."""

from __future__ import annotations

import numpy as np
from scipy.linalg import expm

from mahovik.core.motion.motor import available_torque, required_torque
from mahovik.core.motion.programme import Angles, Programme, RunUpTable
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand.model import Stand
from mahovik.errors import StateError
from mahovik.proof.reference.array import Array, vector
from mahovik.proof.reference.rotation import rotation_vector
from mahovik.proof.reference.screw import cross
from mahovik.proof.reference.task import task_rows
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.programme.items import Tolerance, bound_check, bound_checks, check, largest, rows_check
from mahovik.proof.verify.programme.mechanics import (
    Scale,
    displacement,
    moment,
    rest_near,
    simulate,
    torques_along,
    twist,
)

STEP_ERROR = 1e-8
"""Error of a step over the amplitude: the end of a run-up has a wider tolerance than a programme."""

STEPS = 24
"""Least number of steps in a period; there is at least one for each row."""


def runup_checks(
    stand: Stand, motion: RequiredMotion, programme: Programme, scale: Scale, tolerance: Tolerance
) -> list[Check]:
    """Items of each table: rows, joint with the programme, rest at the other end, end of the carrier, bounds."""
    items = []
    for name, table in (("run-up", programme.runup), ("run-down", programme.rundown)):
        if table is not None:
            rows, limit = table.samples, tolerance.joint
            columns = Angles(rows.phi, rows.phi_dot, rows.phi_ddot)
            joint, rest = (-1, 0) if name == "run-up" else (0, -1)
            begin = programme.at(np.zeros(1))
            turned = columns.phi[joint] - begin.phi[0]
            apart = [largest(turned - 2 * np.pi * np.round(turned / (2 * np.pi)))]
            for ours, theirs in zip(columns[1:], begin[1:], strict=True):
                apart.append(largest(ours[joint] - theirs[0]) / max(largest(ours), largest(theirs), 1e-300))
            column = ("phi", "phi_dot", "phi_ddot")[int(np.argmax(apart))]
            moving = max(largest(each[rest]) / (largest(each) or 1.0) for each in columns[1:])
            words = "phi', phi'' of the flywheels at rest, share of their peaks"
            items += [
                rows_check(f"{name} table", rows, tolerance.table),
                check(f"{name} joint", max(apart), limit, f"{column} at the programme's t = 0"),
                check(f"{name} rest", moving, limit, words),
                *_way(name, stand, motion, programme, table, scale, tolerance.runup),
            ]
    return items


def _way(
    name: str, stand: Stand, motion: RequiredMotion, programme: Programme, table: RunUpTable, scale: Scale, limit: float
) -> list[Check]:
    """The carrier by (8), from equilibrium to the required state or the reverse, and bounds on the way."""
    required, mean = motion.at(np.zeros(1), programme.bias), motion.mean + programme.bias
    q, start, t = required.q[0], np.concatenate([required.q[0], required.q_dot[0]]), table.samples.t
    longest, up = min(programme.span, table.duration) / STEPS, name == "run-up"
    try:
        if up:
            rest = rest_near(stand, table.samples.phi[0], mean, scale.K0)
            start = np.concatenate([rest.q, np.zeros_like(q)])
        y = simulate(stand, table.at, start, t, scale, longest, error=STEP_ERROR, rows=True)
        if not up:
            rest = rest_near(stand, table.samples.phi[-1], y[-1, : len(q)], scale.K0)
    except StateError as error:
        return [check(f"{name} end", np.inf, limit, str(error))]
    end, end_dot = np.split(y[-1], 2)
    apart = twist(stand, q, end - (q if up else rest.q))
    shift = rest.free @ (rest.free.T @ (scale.K0 @ apart))  # where the stand may as well have begun elsewhere
    left = twist(stand, end, end_dot) - (twist(stand, q, required.q_dot[0]) if up else 0.0)
    shares = scale.displacement_share(apart - shift), scale.twist_share(left)
    strayed = deviation(stand, y, mean)
    words = (
        f"carrier at the end, pose {shares[0]:.2g}, twist {shares[1]:.2g} of the amplitude; on the way "
        f"{1e3 * strayed[0]:.3g} mm, {1e3 * strayed[1]:.3g} mrad from the mean pose"
    )
    angles, bounds = table.at(t), motion.bounds
    tau = torques_along(stand, y, angles) if bounds.torque is not None else np.zeros_like(angles.phi)
    items = [check(f"{name} end", max(shares), limit, words)]
    items += bound_checks(bounds, programme.flywheels, angles, tau, None, f"{name} ")
    if bounds.deviation is not None:
        names = ("O1 from the mean pose, m", "E1 from the mean pose, rad")
        items.append(bound_check(f"{name} bound deviation", strayed[None], np.array(bounds.deviation), names, ""))
    return items


def deviation(stand: Stand, y: Array, mean: Array) -> Array:
    """Largest distance of O1 (m) and angle of E1 (rad) from the pose `mean` (m), along states y (M, 2 m)."""
    return np.array([displacement(stand, q, mean) for q in np.hsplit(y, 2)[0]]).max(axis=0)


POINTS = 400
"""Times along a slew."""

ARCSEC = np.pi / 648000.0
END = 1.0
"""Accepted distance from the demanded attitude or line of sight at the end, arcsec."""

ALONG = 1e-6
"""Accepted distance from the shortest turn, share of it, and of what rests at the end from rest, share of its peak."""


def slew_checks(stand: Stand, motion: RequiredMotion, programme: Programme) -> list[Check]:
    """The course of a slew that the programme keeps begins, goes and ends as demanded; that (8) follows it is another
    item.
    """
    slew = motion.slew
    assert slew is not None
    t = np.linspace(0.0, programme.span, POINTS + 1)
    course, angles = motion.at(t), programme.at(t)
    C, rates, accelerations = [], [], []
    for q, q_dot, q_ddot, phi, phi_dot in zip(*course, angles.phi, angles.phi_dot, strict=True):
        now = moment(stand, q, q_dot, phi, phi_dot)
        rows = task_rows(now.at, stand, slew.task)
        C.append(now.carrier.C)
        rates.append(rows.S @ now.at.V)
        accelerations.append(rows.acceleration(now.V_dot(q_ddot)))
    begins = max(
        largest(course.q[0, :3] - vector(slew.position)),
        float(np.linalg.norm(rotation_vector(C[0].T @ slew.start))),
        largest(twist(stand, course.q[0], course.q_dot[0])),
    )
    items = [check("slew start", begins, 1e-9, "pose and twist at t = 0: m, rad, s")]
    if slew.kind != "still":
        wanted = expm(slew.angle * cross(slew.normal)) @ slew.start
        if slew.kind == "attitude":
            what, end = "attitude", float(np.linalg.norm(rotation_vector(C[-1].T @ wanted)))
            turned = np.array([rotation_vector(each @ slew.start.T) for each in C])
            aside = largest(turned - np.outer(turned @ slew.normal, slew.normal))
        else:
            sight, goal = np.array(C) @ slew.axis, wanted @ slew.axis
            what, end = "line of sight", float(np.arctan2(np.linalg.norm(np.cross(sight[-1], goal)), sight[-1] @ goal))
            aside = largest(sight @ slew.normal)
        items += [
            check("slew end", end / ARCSEC, END, f"arcsec between the {what} at the end and the demanded one"),
            check("slew path", aside / slew.angle, ALONG, f"of the {what} aside from the shortest turn, share of it"),
        ]
    angular = np.array([row.component.startswith("w") for row in slew.task.rows])
    turning, moving = np.array(rates)[:, angular], np.array(accelerations)
    if angular.any():
        peak = largest(turning) or 1.0
        words = f"rates of the rows at the end, share of {peak:.3g} rad/s"
        items.append(check("slew rest", largest(turning[-1]) / peak, ALONG, words))
    if not angular.all():
        peak = largest(moving[:, angular]) or 1.0
        words = f"accelerations of the linear rows, m/s2, over {peak:.3g} rad/s2 of the angular ones"
        items.append(check("slew rows", largest(moving[:, ~angular]) / peak, ALONG, words))
    return items


def motor_torques(stand: Stand, phi_dot: Array, tau: Array) -> tuple[Array, Array]:
    """Torques of the motors themselves in drive torques tau, which friction is part of, and what they can give.

    All (M, N; N m), at speeds phi_dot (M, N).
    """
    needed, most = np.array(tau), np.full_like(tau, np.inf)
    for s, motor in enumerate(wheel.motor for wheel in stand.flywheels):
        if motor is not None:
            for i, speed in enumerate(phi_dot[:, s].tolist()):
                needed[i, s] = required_torque(motor, float(tau[i, s]), speed)
                most[i, s] = available_torque(motor, float(needed[i, s]), speed)
    return needed, most


def motor_checks(stand: Stand, phi_dot: Array, tau: Array) -> list[Check]:
    """The torque that each motor itself gives, with its friction, over what it can at that speed; and the speed."""
    names, motors = [s.name for s in stand.flywheels], [s.motor for s in stand.flywheels]
    fastest = np.array([np.inf if motor is None or motor.speed is None else motor.speed for motor in motors])
    items = []
    if any(motor is not None for motor in motors):
        items.append(bound_check("motor torque", *motor_torques(stand, phi_dot, tau), names, "N m"))
    if np.isfinite(fastest).any():
        items.append(bound_check("motor speed", phi_dot, fastest, names, "rad/s"))
    return items
