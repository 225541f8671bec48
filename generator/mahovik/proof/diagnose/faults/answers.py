"""Faults in what is answered: frames, derivatives, factors."""

from __future__ import annotations

import numpy as np

from mahovik.proof.diagnose.equations import Values
from mahovik.proof.diagnose.fault import Fault
from mahovik.proof.reference.array import Array


class AnsweredAcceleration(Fault):
    """V* is answered as the acceleration of O1, v* + omega x v, instead of the derivative of components in E1."""

    name = "V* as the acceleration of O1"
    equation = "V*"
    look = "V* of the contract is the derivative of the components of V in E1"

    def told(self, want: str, values: Values) -> Values:
        found = super().told(want, values)
        if "V_dot" not in found:
            return found
        turned = np.concatenate([np.cross(self.V[3:], self.V[:3]), np.zeros(3)])
        return {**found, "V_dot": found["V_dot"] + turned}


class AnsweredInE0(Fault):
    """V* is answered in the axes of E0."""

    name = "V* in E0"
    equation = "V*"
    look = "V* of the contract is in E1"

    def told(self, want: str, values: Values) -> Values:
        found = super().told(want, values)
        if "V_dot" not in found:
            return found
        V_dot = found["V_dot"]
        return {**found, "V_dot": np.concatenate([self.C @ V_dot[:3], self.C @ V_dot[3:]])}


class AnsweredAngularFirst(Fault):
    """V* is answered with its angular part first."""

    name = "V* with angular part first"
    equation = "V*"
    look = "linear part first"

    def told(self, want: str, values: Values) -> Values:
        found = super().told(want, values)
        if "V_dot" not in found:
            return found
        return {**found, "V_dot": np.roll(found["V_dot"], 3)}


class MomentumNotShifted(Fault):
    """The momentum in E0 is about O1: its moment is not carried to the origin of E0."""

    name = "Z0 about O1"
    equation = "(1)"
    look = "L1 Z with <O1> in T"

    def in_E0(self, Z: Array) -> Array:
        return np.concatenate([self.C @ Z[:3], self.C @ Z[3:]])


class MomentumNotTurned(Fault):
    """The momentum in E0 is in the axes of E1."""

    name = "Z0 in E1"
    equation = "(1)"
    look = "L1 Z with C in L1"

    def in_E0(self, Z: Array) -> Array:
        return np.asarray(Z + np.concatenate([np.zeros(3), np.cross(np.array(self.state.position), Z[:3])]))


class EnergyDoubled(Fault):
    """The kinetic energy lacks its factor of one half."""

    name = "energy not halved"
    equation = "energy"
    look = "V^T Theta V / 2"

    def energy(self) -> float:
        return 2 * super().energy()


class EnergyWithoutCoupling(Fault):
    """The kinetic energy lacks the coupling of carrier and flywheels, V^T I phi'."""

    name = "energy without V^T I phi'"
    equation = "energy"
    look = "the flywheel's energy is of its whole twist V_s"

    def energy(self) -> float:
        return super().energy() - float(self.V @ self.I @ self.phi_dot)


class NoKinematicRate(Fault):
    """D = A' of the generalized coordinates is missing."""

    name = "D missing"
    equation = "(10), (11)"
    look = "V* = A q'' + D q'"

    def kinematic_rate(self, angles: Array, rates: Array) -> Array:
        return np.zeros((6, 6))


class AccelerometerGravityReversed(Fault):
    """An accelerometer is made to feel gravity with the wrong sign: acceleration plus gravity."""

    name = "specific force, sign of gravity"
    equation = "points"
    look = "specific force is acceleration minus gravity: +9.81 upward at rest"

    def felt_gravity(self) -> Array:
        return -super().felt_gravity()


class AccelerometerWithoutGravity(Fault):
    """An accelerometer does not feel gravity: the specific force is the plain acceleration."""

    name = "specific force without gravity"
    equation = "points"
    look = "specific force is acceleration minus gravity"

    def felt_gravity(self) -> Array:
        return np.zeros(3)


class PointWithoutCentripetal(Fault):
    """The acceleration of points lacks omega x v: v* is taken for the acceleration."""

    name = "omega x v of points missing"
    equation = "points"
    look = "v* + omega x v at the point"

    def point_acceleration(self, V_p: Array, V_p_dot: Array) -> Array:
        return V_p_dot[:3]
