"""Faults in the drive torque, in mount wrenches and in the coupled form."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from mahovik.proof.diagnose.edits import Motion, drive, each_wheel, minus, mount_wrench, state, value, values
from mahovik.proof.diagnose.fault import Case, Fault
from mahovik.proof.reference.array import Array, Values
from mahovik.proof.reference.bodies import SpinningFlywheel
from mahovik.proof.reference.coupled import spin_up_torque
from mahovik.proof.reference.forward import forward
from mahovik.proof.reference.hold import held_forward
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.rotation import C1
from mahovik.proof.reference.screw import Phi, block_diagonal, f, spin


def base(P_s: Array, s: SpinningFlywheel, at: Motion) -> Array:
    """Theta_s Ls^T V* (6)."""
    return np.asarray(s.Theta @ s.L.T @ at.V_dot)


def spin_up(P_s: Array, s: SpinningFlywheel, at: Motion) -> Array:
    """Theta_s f phi_s'' (6)."""
    return np.asarray(s.Theta @ f * at.phi_ddot)


def transport(P_s: Array, s: SpinningFlywheel, at: Motion) -> Array:
    """-phi_s' Theta_s [<e>] Ls^T V (6)."""
    return np.asarray(-s.phi_dot * s.Theta @ spin @ s.L.T @ at.V)


def gyroscopic(P_s: Array, s: SpinningFlywheel, at: Motion) -> Array:
    """Phi(V_s) Z_s (6)."""
    V_s = s.twist(at.V)
    return np.asarray(Phi(V_s) @ s.Theta @ V_s)


def double(
    part: Callable[[Array, SpinningFlywheel, Motion], Array],
) -> Callable[[Array, SpinningFlywheel, Motion], Array]:
    """A part of the equation two times: without it, its sign is wrong."""
    return lambda P_s, s, at: 2 * part(P_s, s, at)


def about_mass_center(at: Pieces, number: int, s: SpinningFlywheel) -> Pieces:
    """The pieces with the spin inertia about an axis through the centre of mass."""
    _, y, z = s.body.center_of_mass
    Theta_ff = at.Theta_ff.copy()
    Theta_ff[number, number] -= s.body.mass * (y * y + z * z)
    return replace(at, Theta_ff=Theta_ff)


def without_carrier(right: Values, at: Pieces, case: Case) -> Values:
    """The coupled form without I^T: the flywheels first, then the carrier."""
    phi_ddot = spin_up_torque(at, np.array(case.state.tau)) / np.diag(at.Theta_ff)
    hold = case.stand.hold
    moved = {"V_dot": forward(at, phi_ddot)} if hold is None else dict(vars(held_forward(at, hold, phi_ddot)))
    return {**moved, "phi_ddot": phi_ddot}


# fmt: off
FAULTS = (
    Fault("torque without phi''", "tau", "flywheels", [drive(spin_up)],
          "The drive torque lacks phi'' Theta: what accelerates the flywheel itself",
          "f phi'' in V_s*"),
    Fault("torque without base acceleration", "tau", "flywheels", [drive(base)],
          "The drive torque lacks the acceleration of the base",
          "Ls^T V* in V_s*"),
    Fault("transport term of V_s* missing", "tau", "flywheels", [drive(transport)],
          "The drive torque lacks the turning of the flywheel's axes in V_s*: - phi' [<e>] Ls^T V",
          "V_s* = Ls^T V* - phi' [<e>] Ls^T V + f phi''"),
    Fault("transport term of V_s*, sign", "tau", "flywheels", [drive(double(transport))],
          "The transport term of V_s*, phi' [<e>] Ls^T V, has the wrong sign",
          "V_s* = Ls^T V* - phi' [<e>] Ls^T V + f phi''"),
    Fault("torque without Phi(V_s) Z_s", "tau", "flywheels", [drive(gyroscopic)],
          "The drive torque lacks the gyroscopic terms Phi(V_s) Z_s",
          "omega_s x h_s + v_s x p_s about the spin axis: zero only for a symmetric, balanced flywheel"),
    Fault("Phi(V_s) Z_s of torque, sign", "tau", "flywheels", [drive(double(gyroscopic))],
          "The gyroscopic terms Phi(V_s) Z_s of the drive torque have the wrong sign",
          "tau = f^T (Theta_s V_s* + Phi(V_s) Z_s) - f^T P_s"),
    Fault("torque without P_s", "tau", "flywheels", [drive(lambda P_s, s, at: -P_s)],
          "The drive torque lacks the wrenches on the flywheel: "
          "the moment of its weight about the axis, damping, given",
          "- f^T P_s"),
    Fault("P_s of torque, sign", "tau", "flywheels", [drive(lambda P_s, s, at: -2 * P_s)],
          "The wrenches on the flywheel enter its drive torque with the wrong sign",
          "- f^T P_s: the drive holds against them"),
    Fault("torque, sign", "tau", "all",
          [state(lambda x: replace(x, tau=tuple(-each for each in x.tau))), value("tau", minus)],
          "The drive torque has the wrong sign: that of the flywheel on its mount",
          "tau is of the mount on the flywheel, about its axis"),
    Fault("mount wrench in turning axes", "mount wrench", "flywheels",
          [mount_wrench(lambda P, s: block_diagonal(C1(s.phi)).T @ P)],
          "The mount wrench is written in axes that turn with the flywheel",
          "diag(C1, C1)(phi) before Theta_s V_s* + ..."),
    Fault("mount wrench, sign", "mount wrench", "flywheels", [mount_wrench(minus)],
          "The mount wrench has the wrong sign: of the flywheel on the mount",
          "it is of the mount on the flywheel"),
    Fault("I^T missing in the coupled form", "coupled", "all", [values("coupled", without_carrier)],
          "In the coupled form the flywheels do not feel the carrier's acceleration: I^T is missing",
          "[[K, I], [I^T, Theta_ff]] is symmetric"),
    Fault("Theta_ff about the centre of mass", "coupled", "flywheels", [each_wheel(about_mass_center)],
          "The spin inertia of the coupled form is that about an axis through the centre of mass, not through Os",
          "f^T Theta_s f is about Os: it has m rc^2 of the unbalance"),
)
