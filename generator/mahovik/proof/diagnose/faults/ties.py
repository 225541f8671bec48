"""Faults in suspension and legs, (7)."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mahovik.core.stand.model import Leg, Suspension
from mahovik.proof.diagnose.fault import Fault
from mahovik.proof.reference.array import Array


class NoSuspensionStiffness(Fault):
    """The stiffness of the suspension is missing."""

    name = "suspension stiffness missing"
    equation = "(7)"
    look = "-(stiffness x)"

    def displacement(self, law: Suspension) -> Array:
        return np.zeros(6)


class NoSuspensionDamping(Fault):
    """The damping of the suspension is missing."""

    name = "suspension damping missing"
    equation = "(7)"
    look = "-(damping V)"

    def suspension(self, law: Suspension) -> Array:
        return super().suspension(law) + np.array(law.damping) @ self.V


class SuspensionInE0(Fault):
    """The displacement of the suspension is taken in the axes of E0, not of E1."""

    name = "suspension displacement in E0"
    equation = "(7)"
    look = "C^T (O1 - position)"

    def displacement(self, law: Suspension) -> Array:
        x = super().displacement(law)
        return np.concatenate([np.array(self.state.position) - np.array(law.position), x[3:]])


class SuspensionRotationReversed(Fault):
    """The rotation vector of the suspension has the wrong sign: from E1 to the equilibrium."""

    name = "suspension rotation, sign"
    equation = "(7)"
    look = "rotation vector of C_eq^T C"

    def displacement(self, law: Suspension) -> Array:
        x = super().displacement(law)
        return np.concatenate([x[:3], -x[3:]])


class NoSuspensionRotation(Fault):
    """The rotation of the carrier does not act on the suspension."""

    name = "suspension rotation missing"
    equation = "(7)"
    look = "elements 4 to 6 of x"

    def displacement(self, law: Suspension) -> Array:
        x = super().displacement(law)
        return np.concatenate([x[:3], np.zeros(3)])


class EquilibriumAttitudeIgnored(Fault):
    """The equilibrium attitude of the suspension is ignored."""

    name = "equilibrium attitude ignored"
    equation = "(7)"
    look = "`angles` of `suspension`: C_eq"

    def displacement(self, law: Suspension) -> Array:
        return super().displacement(replace(law, angles=(0.0, 0.0, 0.0)))


class EquilibriumPlaceIgnored(Fault):
    """The equilibrium position of the suspension is ignored."""

    name = "equilibrium position ignored"
    equation = "(7)"
    look = "`position` of `suspension`"

    def displacement(self, law: Suspension) -> Array:
        return super().displacement(replace(law, position=(0.0, 0.0, 0.0)))


class NoLegs(Fault):
    """The legs are missing."""

    name = "legs missing"
    equation = "(7)"
    look = "`leg` of the stand file"

    def leg(self, leg: Leg) -> Array:
        return np.zeros(6)


class LegsReversed(Fault):
    """The legs push where they should pull."""

    name = "legs, sign"
    equation = "(7)"
    look = "a leg longer than its unstretched length pulls the carrier to the ground point"

    def leg(self, leg: Leg) -> Array:
        return -super().leg(leg)


class NoLegDamping(Fault):
    """The damping of the legs is missing."""

    name = "leg damping missing"
    equation = "(7)"
    look = "damping times the rate of length"

    def leg(self, leg: Leg) -> Array:
        return super().leg(replace(leg, damping=0.0))


class LegDampingReversed(Fault):
    """The damping of the legs has the wrong sign."""

    name = "leg damping, sign"
    equation = "(7)"
    look = "the rate of length is positive where the leg grows"

    def leg(self, leg: Leg) -> Array:
        return super().leg(replace(leg, damping=-leg.damping))


class UnstretchedLengthIgnored(Fault):
    """The unstretched length of the legs is ignored."""

    name = "unstretched length ignored"
    equation = "(7)"
    look = "stiffness (length - unstretched length)"

    def leg(self, leg: Leg) -> Array:
        return super().leg(replace(leg, length=0.0))


class LegsWithoutMoment(Fault):
    """The forces of the legs act at O1: their moment is missing."""

    name = "moment of legs missing"
    equation = "(7)"
    look = "carrier point x force"

    def leg(self, leg: Leg) -> Array:
        P = super().leg(leg)
        return np.concatenate([P[:3], np.zeros(3)])
