"""Faults in how a state is read: units, signs, orders, frames."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import cast

import numpy as np

from mahovik.core.stand.model import Flywheel, Sequence, Stand, Vec3
from mahovik.core.stand.state import State
from mahovik.proof.diagnose.fault import Fault
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.rotation import quaternion_rotation


class SpeedReversed(Fault):
    """The speeds of the flywheels have the wrong sign; phases and accelerations are right."""

    name = "phi', sign"
    equation = "state"
    look = "phi' counts about the first axis, right-handed"

    def speed(self, s: Flywheel, phi_dot: float) -> float:
        return -super().speed(s, phi_dot)


class SpeedInRpm(Fault):
    """The speeds of the flywheels are taken in revolutions a minute."""

    name = "phi' in rpm"
    equation = "state"
    look = "phi' is in rad/s"

    def speed(self, s: Flywheel, phi_dot: float) -> float:
        return super().speed(s, phi_dot) * math.pi / 30


class SpeedInDegrees(Fault):
    """The speeds of the flywheels are taken in degrees a second."""

    name = "phi' in degrees"
    equation = "state"
    look = "phi' is in rad/s"

    def speed(self, s: Flywheel, phi_dot: float) -> float:
        return math.radians(super().speed(s, phi_dot))


class SpeedIgnored(Fault):
    """The speeds of the flywheels are ignored."""

    name = "phi' ignored"
    equation = "state"
    look = "whether phi_dot reaches the equations"

    def speed(self, s: Flywheel, phi_dot: float) -> float:
        return 0.0


class AbsoluteSpeed(Fault):
    """The speed of a flywheel is taken as its absolute one: the carrier's turning about the axis is left out of it."""

    name = "phi' taken as absolute"
    equation = "state"
    look = "phi' is relative to the mount: omega_s = Cs^T omega + e1 phi'"

    def speed(self, s: Flywheel, phi_dot: float) -> float:
        axis = self.wheel_transfer(s, 0.0)[:3, 0]
        return super().speed(s, phi_dot) - float(axis @ self.V[3:])


class AccelerationReversed(Fault):
    """The accelerations of the flywheels have the wrong sign everywhere."""

    name = "phi'', sign"
    equation = "state"
    look = "phi'' counts as phi' does"

    def acceleration(self, s: Flywheel, phi_ddot: float) -> float:
        return -super().acceleration(s, phi_ddot)


class AnglesInDegrees(Fault):
    """The attitude angles are taken in degrees."""

    name = "attitude angles in degrees"
    equation = "state"
    look = "angles are in rad"

    def read_state(self, state: State) -> State:
        read = super().read_state(state)
        if read.angles is None:
            return read
        return replace(read, angles=cast(Vec3, tuple(math.radians(each) for each in read.angles)))


class AnglesReversedOrder(Fault):
    """The attitude angles are read in the order phi, theta, psi."""

    name = "order of attitude angles"
    equation = "state"
    look = "psi, theta, phi: the first turn first"

    def read_state(self, state: State) -> State:
        read = super().read_state(state)
        return read if read.angles is None else replace(read, angles=read.angles[::-1])


class AttitudeTransposed(Fault):
    """The attitude is transposed: C turns from E0 to E1 (of angles and quaternions alike)."""

    name = "attitude transposed"
    equation = "C"
    look = "x0 = C x1; a conjugated quaternion does the same"

    def rotation(self) -> Array:
        return super().rotation().T


class QuaternionConjugated(Fault):
    """The quaternion is conjugated; attitude angles are right."""

    name = "quaternion conjugated"
    equation = "C"
    look = "x0 = q x1 q^-1"

    def rotation(self) -> Array:
        C = super().rotation()
        return C if self.state.quaternion is None else C.T


class AnglesTransposed(Fault):
    """The rotation by attitude angles is transposed; quaternions are right."""

    name = "rotation of angles transposed"
    equation = "C"
    look = "x0 = C x1, C of active elementary rotations"

    def rotation(self) -> Array:
        C = super().rotation()
        return C if self.state.quaternion is not None else C.T


class QuaternionOrder(Fault):
    """The quaternion is read with its scalar last: x, y, z, w instead of w, x, y, z."""

    name = "quaternion, scalar last"
    equation = "C"
    look = "w comes first"

    def rotation(self) -> Array:
        if self.state.quaternion is None:
            return super().rotation()
        x, y, z, w = self.state.quaternion
        return quaternion_rotation(w, x, y, z)


class AttitudeIgnored(Fault):
    """The attitude is ignored: E1 is always aligned with E0."""

    name = "attitude ignored"
    equation = "C"
    look = "`angles` or `quaternion` of the state"

    def rotation(self) -> Array:
        return np.eye(3)


class QuaternionIgnored(Fault):
    """A quaternion is ignored; attitude angles are used."""

    name = "quaternion ignored"
    equation = "C"
    look = "`quaternion` of the state"

    def rotation(self) -> Array:
        return super().rotation() if self.state.quaternion is None else np.eye(3)


def in_sequence(stand: Stand, sequence: Sequence) -> Stand:
    """The stand with another attitude sequence."""
    return replace(stand, angles=sequence)


class ShipSequence(Fault):
    """The attitude angles are taken in the ship sequence: C3 C2 C1."""

    name = "sequence, ship"
    equation = "C, (10)"
    look = "`angles` of the stand file"

    def read_stand(self, stand: Stand) -> Stand:
        return in_sequence(super().read_stand(stand), "ship")


class AircraftSequence(Fault):
    """The attitude angles are taken in the aircraft sequence: C2 C3 C1."""

    name = "sequence, aircraft"
    equation = "C, (10)"
    look = "`angles` of the stand file"

    def read_stand(self, stand: Stand) -> Stand:
        return in_sequence(super().read_stand(stand), "aircraft")


class EulerSequence(Fault):
    """The attitude angles are taken in Euler's sequence: C3 C1 C3."""

    name = "sequence, Euler"
    equation = "C, (10)"
    look = "`angles` of the stand file"

    def read_stand(self, stand: Stand) -> Stand:
        return in_sequence(super().read_stand(stand), "euler")


class PositionIgnored(Fault):
    """The position of O1 is ignored."""

    name = "position ignored"
    equation = "(1), (7)"
    look = "`position` in suspension, legs, Z in E0, points"

    def read_state(self, state: State) -> State:
        return replace(super().read_state(state), position=(0.0, 0.0, 0.0))


class TwistInE0(Fault):
    """V is taken as components in E0."""

    name = "V taken in E0"
    equation = "state"
    look = "V is in E1: its components are quasi-velocities"

    def twist(self, V: Array) -> Array:
        C = self.rotation()
        return np.concatenate([C.T @ V[:3], C.T @ V[3:]])


class TwistOfMassCentre(Fault):
    """v of V is taken as the velocity of the carrier's centre of mass, not of O1."""

    name = "v taken at the centre of mass"
    equation = "state"
    look = "V and V* are of O1"

    def twist(self, V: Array) -> Array:
        rc = np.array(self.stand.carrier.center_of_mass)
        return np.concatenate([V[:3] - np.cross(V[3:], rc), V[3:]])


class OmegaInDegrees(Fault):
    """omega of V is taken in degrees a second."""

    name = "omega in degrees"
    equation = "state"
    look = "omega is in rad/s"

    def twist(self, V: Array) -> Array:
        return np.concatenate([V[:3], np.radians(V[3:])])


class AngularFirst(Fault):
    """V is read with its angular part first."""

    name = "V with angular part first"
    equation = "state"
    look = "linear part first, in V and in wrenches"

    def twist(self, V: Array) -> Array:
        return np.concatenate([V[3:], V[:3]])
