"""A slew's own items: the course of the carrier begins, goes and ends as demanded; the motors can give the torques."""

from __future__ import annotations

import numpy as np

from mahovik.core.motion.motor import available_torque, required_torque
from mahovik.core.motion.programme import Angles, Programme
from mahovik.core.motion.required import RequiredMotion, Slew
from mahovik.core.stand.model import Stand
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.rotation import attitude
from mahovik.proof.reference.task import task_rows
from mahovik.proof.verify.programme.finding import Finding, check_limit, largest
from mahovik.proof.verify.programme.mechanics import pieces_at, twist, twist_rate
from mahovik.proof.verify.programme.table import EXCEEDED

POINTS = 400
"""Times along the slew."""

ARCSEC = np.pi / 648000.0
END = 1.0
"""Accepted distance from the demanded attitude or line of sight at the end, arcsec."""

ALONG = 1e-6
"""Accepted distance from the shortest turn, share of it, and of what rests at the end from rest, share of its peak."""


def slew_findings(stand: Stand, motion: RequiredMotion, programme: Programme) -> list[Finding]:
    """Findings on the course that the programme keeps; that (8) follows this course is judged besides."""
    slew = motion.slew
    assert slew is not None
    t = np.linspace(0.0, programme.span, POINTS + 1)
    course, angles = motion.at(t), programme.at(t)
    C = np.array([attitude(stand.angles, *q[3:]) for q in course.q])
    V = np.array([twist(stand, q, q_dot) for q, q_dot in zip(course.q, course.q_dot, strict=True)])
    begins = max(largest(course.q[0, :3] - np.array(slew.position)), _angle_between(C[0], slew.start), largest(V[0]))
    found = [check_limit("slew start", begins, 1e-9, "pose and twist at t = 0: m, rad, s")]
    rates, accelerations = [], []
    for q, q_dot, q_ddot, v, phi, phi_dot in zip(*course, V, angles.phi, angles.phi_dot, strict=True):
        rows = task_rows(pieces_at(stand, q, v, phi, phi_dot), stand, slew.task)
        rates.append(rows.S @ v)
        accelerations.append(rows.acceleration(twist_rate(stand, q, q_dot, q_ddot)))
    return [*found, *_turn(slew, C), *_rows(slew, np.array(rates), np.array(accelerations))]


def _angle_between(C: Array, other: Array) -> float:
    """Angle between two attitudes, rad; exact where it is small."""
    D = C.T @ other
    sine = np.linalg.norm([D[2, 1] - D[1, 2], D[0, 2] - D[2, 0], D[1, 0] - D[0, 1]]) / 2.0
    return float(np.arctan2(sine, (np.trace(D) - 1.0) / 2.0))


def _rotation(slew: Slew, sigma: float) -> Array:
    """The rotation in E0 by sigma about the normal: Rodrigues' formula."""
    x, y, z = slew.normal
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.asarray(np.eye(3) + np.sin(sigma) * cross + (1.0 - np.cos(sigma)) * cross @ cross)


def _turn(slew: Slew, C: Array) -> list[Finding]:
    """The end, and the way there: the shortest turn."""
    if slew.kind == "still":
        return []
    if slew.kind == "attitude":
        wanted = _rotation(slew, slew.angle) @ slew.start
        end = _angle_between(C[-1], wanted)
        turned = C @ slew.start.T
        sines = np.array([[R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]] for R in turned]) / 2.0
        aside = largest(sines - np.outer(sines @ slew.normal, slew.normal))
        what = "attitude"
    else:
        sight = C @ slew.axis
        wanted = _rotation(slew, slew.angle) @ slew.start @ slew.axis
        end = float(np.arctan2(np.linalg.norm(np.cross(sight[-1], wanted)), sight[-1] @ wanted))
        aside = largest(sight @ slew.normal)
        what = "line of sight"
    return [
        check_limit("slew end", end / ARCSEC, END, f"arcsec between the {what} at the end and the demanded one"),
        check_limit("slew path", aside / slew.angle, ALONG, f"of the {what} aside from the shortest turn, share of it"),
    ]


def _rows(slew: Slew, rates: Array, accelerations: Array) -> list[Finding]:
    """Rest at the end by the angular rows; no acceleration by the linear ones."""
    angular = np.array([row.component.startswith("w") for row in slew.task.rows])
    found = []
    if angular.any():
        peak = largest(rates[:, angular]) or 1.0
        value = largest(rates[-1, angular]) / peak
        found.append(check_limit("slew rest", value, ALONG, f"rates of the rows at the end, share of {peak:.3g} rad/s"))
    if not angular.all():
        scale = largest(accelerations[:, angular]) or 1.0
        value = largest(accelerations[:, ~angular]) / scale
        words = f"accelerations of the linear rows, m/s2, over {scale:.3g} rad/s2 of the angular ones"
        found.append(check_limit("slew rows", value, ALONG, words))
    return found


def motor_torques(stand: Stand, angles: Angles, tau: Array) -> Array:
    """Torques of the motors themselves (M, N; N m) in drive torques tau (M, N), which friction is part of."""
    found = np.array(tau)
    for s, wheel in enumerate(stand.flywheels):
        if wheel.motor is not None:
            pairs = zip(tau[:, s], angles.phi_dot[:, s], strict=True)
            found[:, s] = [required_torque(wheel.motor, float(drive), float(speed)) for drive, speed in pairs]
    return found


def motor_findings(stand: Stand, t: Array, angles: Angles, tau: Array) -> list[Finding]:
    """The torque that each motor itself gives, with its friction, over what it can at that speed; and the speed."""
    worst = {"motor torque": (0.0, ""), "motor speed": (0.0, "")}
    for s, wheel in enumerate(stand.flywheels):
        if wheel.motor is None:
            continue
        for now, speed, drive in zip(t, angles.phi_dot[:, s], tau[:, s], strict=True):
            own = required_torque(wheel.motor, float(drive), float(speed))
            most = available_torque(wheel.motor, own, float(speed))
            share = abs(own) / most if most > 0.0 else np.inf * (own != 0.0)
            if share > worst["motor torque"][0]:
                worst["motor torque"] = (share, f"{wheel.name} at t = {now:.5g} s: {abs(own):.6g} of {most:.6g} N m")
            share = abs(float(speed)) / (wheel.motor.speed or np.inf)
            if wheel.motor.speed is not None and share > worst["motor speed"][0]:
                words = f"{wheel.name} at t = {now:.5g} s: {abs(speed):.6g} of {wheel.motor.speed:.6g} rad/s"
                worst["motor speed"] = (share, words)
    return [check_limit(name, share, EXCEEDED, words) for name, (share, words) in worst.items() if words]
