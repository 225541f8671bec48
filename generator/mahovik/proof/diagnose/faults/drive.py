"""Faults in the drive torque and in the coupled form."""

from __future__ import annotations

import numpy as np

from mahovik.proof.diagnose.equations import Values
from mahovik.proof.diagnose.fault import Fault
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import Spinning


class TorqueWithoutSpinUp(Fault):
    """The drive torque lacks phi'' Theta: what accelerates the flywheel itself."""

    name = "torque without phi''"
    equation = "tau"
    look = "f phi'' in V_s*"

    def own_acceleration(self, k: Spinning, phi_ddot: float) -> Array:
        return np.zeros(6)


class TorqueWithoutBase(Fault):
    """The drive torque lacks the acceleration of the base."""

    name = "torque without base acceleration"
    equation = "tau"
    look = "Ls^T V* in V_s*"

    def base_acceleration(self, k: Spinning, V_dot: Array) -> Array:
        return np.zeros(6)


class TorqueWithoutTransport(Fault):
    """The drive torque lacks the turning of the flywheel's axes in V_s*: - phi' [<e>] Ls^T V."""

    name = "transport term of V_s* missing"
    equation = "tau"
    look = "V_s* = Ls^T V* - phi' [<e>] Ls^T V + f phi''"

    def transport(self, k: Spinning, V: Array) -> Array:
        return np.zeros(6)


class TransportReversed(Fault):
    """The transport term of V_s*, phi' [<e>] Ls^T V, has the wrong sign."""

    name = "transport term of V_s*, sign"
    equation = "tau"
    look = "V_s* = Ls^T V* - phi' [<e>] Ls^T V + f phi''"

    def transport(self, k: Spinning, V: Array) -> Array:
        return -super().transport(k, V)


class TorqueWithoutGyroscopic(Fault):
    """The drive torque lacks the gyroscopic terms Phi(V_s) Z_s."""

    name = "torque without Phi(V_s) Z_s"
    equation = "tau"
    look = "omega_s x h_s + v_s x p_s about the spin axis: zero only for a symmetric, balanced flywheel"

    def gyroscopic(self, k: Spinning, V_s: Array) -> Array:
        return np.zeros(6)


class TorqueGyroscopicReversed(Fault):
    """The gyroscopic terms Phi(V_s) Z_s of the drive torque have the wrong sign."""

    name = "Phi(V_s) Z_s of torque, sign"
    equation = "tau"
    look = "tau = f^T (Theta_s V_s* + Phi(V_s) Z_s) - f^T P_s"

    def gyroscopic(self, k: Spinning, V_s: Array) -> Array:
        return -super().gyroscopic(k, V_s)


class TorqueWithoutWrench(Fault):
    """The drive torque lacks the wrenches on the flywheel: the moment of its weight about the axis, damping, given."""

    name = "torque without P_s"
    equation = "tau"
    look = "- f^T P_s"

    def own_wrench(self, k: Spinning) -> Array:
        return np.zeros(6)


class TorqueWrenchReversed(Fault):
    """The wrenches on the flywheel enter its drive torque with the wrong sign."""

    name = "P_s of torque, sign"
    equation = "tau"
    look = "- f^T P_s: the drive holds against them"

    def own_wrench(self, k: Spinning) -> Array:
        return -super().own_wrench(k)


class TorqueReversed(Fault):
    """The drive torque has the wrong sign: that of the flywheel on its mount."""

    name = "torque, sign"
    equation = "tau"
    look = "tau is of the mount on the flywheel, about its axis"

    def torque(self) -> Values:
        return {"tau": -super().torque()["tau"]}

    def given_tau(self) -> Array:
        return -super().given_tau()


class MountsNotTurned(Fault):
    """The mount wrench is written in axes that turn with the flywheel."""

    name = "mount wrench in turning axes"
    equation = "mount wrench"
    look = "diag(C1, C1)(phi) before Theta_s V_s* + ..."

    def in_mount(self, k: Spinning, load: Array) -> Array:
        return load


class MountsReversed(Fault):
    """The mount wrench has the wrong sign: of the flywheel on the mount."""

    name = "mount wrench, sign"
    equation = "mount wrench"
    look = "it is of the mount on the flywheel"

    def in_mount(self, k: Spinning, load: Array) -> Array:
        return -super().in_mount(k, load)


class NoCarrierInDrives(Fault):
    """In the coupled form the flywheels do not feel the carrier's acceleration: I^T is missing."""

    name = "I^T missing in the coupled form"
    equation = "coupled"
    look = "[[K, I], [I^T, Theta_ff]] is symmetric"

    def of_carrier(self) -> Array:
        return np.zeros_like(super().of_carrier())


class SpinInertiaAtFixedCarrier(Fault):
    """The spin inertia of the coupled form is that about an axis through the centre of mass, not through Os."""

    name = "Theta_ff about the centre of mass"
    equation = "coupled"
    look = "f^T Theta_s f is about Os: it has m rc^2 of the unbalance"

    def spin_inertia(self, k: Spinning) -> float:
        _, y, z = k.body.center_of_mass
        return super().spin_inertia(k) - k.body.mass * (y * y + z * z)
