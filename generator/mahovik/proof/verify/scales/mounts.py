"""Scales of drive torques, mount wrenches and points: one body at a time, by lengths."""

from __future__ import annotations

from typing import Any

import numpy as np

from mahovik.proof.reference.points import point_transfers
from mahovik.proof.verify.scales.magnitudes import Array, Magnitudes, origin, screw
from mahovik.proof.verify.scales.parts import length
from mahovik.proof.verify.scales.wrenches import own_scale


def flywheel_wrenches(m: Magnitudes, V_dot: Array, phi_ddot: Array) -> Array:
    """Scale of Theta_s V_s* + Phi(V_s) Z_s - P_s (Nx6): force and moment by their lengths."""
    v, omega = length(m.S_V[:3]), length(m.S_V[3:])
    a, alpha = length(V_dot[:3]), length(V_dot[3:])
    found = np.zeros((len(m.speed), 6))
    for row, s in enumerate(m.at.flywheels):
        spin, arm = abs(s.phi_dot), length(origin(s.L))
        mass, first_moment = s.body.mass, s.body.mass * length(np.array(s.body.center_of_mass))
        J = float(np.trace(s.Theta[3:, 3:]))
        v_s, omega_s = v + arm * omega, omega + spin
        a_s = a + arm * alpha + spin * v_s
        alpha_s = alpha + spin * omega + abs(phi_ddot[row])
        p, h = mass * v_s + first_moment * omega_s, first_moment * v_s + J * omega_s
        force = mass * a_s + first_moment * alpha_s + omega_s * p
        moment = first_moment * a_s + J * alpha_s + omega_s * h + v_s * p
        P = own_scale(m.stand, m.state, m.at, s.body.name)
        found[row] = screw(force + length(P[:3]), moment + length(P[3:]))
    return found


def given_motion(m: Magnitudes) -> Array:
    """The same for the V_dot and phi_ddot of the state."""
    return flywheel_wrenches(m, np.array(m.state.V_dot), np.array(m.state.phi_ddot, dtype=np.float64))


def torque(m: Magnitudes) -> dict[str, Any]:
    """tau."""
    return {"tau": given_motion(m)[:, 3]}


def mounts(m: Magnitudes) -> dict[str, Any]:
    """mount_wrench."""
    return {"mount_wrench": given_motion(m)}


def points(m: Magnitudes) -> dict[str, Any]:
    """points: values of each by name."""
    V_dot = np.array(m.state.V_dot)
    v, omega = length(m.at.V[:3]), length(m.at.V[3:])
    a, alpha = length(V_dot[:3]), length(V_dot[3:])
    gravity, away = length(m.at.gravity), length(np.array(m.state.position))
    found = {}
    for name, L in point_transfers(m.stand):
        arm = length(origin(L))
        moved = v + arm * omega
        found[name] = {
            "position": np.full(3, away + arm),
            "C": np.ones((3, 3)),
            "twist": screw(moved, omega),
            "specific_force": np.full(3, a + arm * alpha + omega * moved + gravity),
            "angular_acceleration": np.full(3, alpha),
        }
    return {"points": found}
