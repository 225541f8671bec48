"""Faults in Theta and K, (2): tensors, parallel axes, masses."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, TypeVar

import numpy as np

from mahovik.core.stand.model import Body
from mahovik.proof.diagnose.fault import Fault
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import Fixed, Placed, Spinning
from mahovik.proof.reference.screw import cross

AnyBody = TypeVar("AnyBody", bound=Body)


def parallel_axes(body: Body) -> Array:
    """-m <rc> <rc> (3x3; kg m2)."""
    rc = np.array(body.center_of_mass)
    return -body.mass * cross(rc) @ cross(rc)


def with_tensor(Theta: Array, J: Array) -> Array:
    """Theta with another tensor of inertia about the origin (3x3)."""
    found = Theta.copy()
    found[3:, 3:] = J
    return found


def rows(J: Array) -> Any:
    """A tensor as the stand has it."""
    return tuple(tuple(float(x) for x in row) for row in J)


def with_other_products(body: AnyBody) -> AnyBody:
    """The body with products of inertia of the other sign."""
    J = np.array(body.inertia)
    return replace(body, inertia=rows(2 * np.diag(np.diag(J)) - J))


def without_arm(k: Placed, Theta: Array) -> Array:
    """L Theta L^T (6x6) with its moments of inertia left about the body's own origin."""
    found = k.L @ Theta @ k.L.T
    C = k.L[:3, :3]
    found[3:, 3:] = C @ Theta[3:, 3:] @ C.T
    return np.asarray(found)


class LostAsymmetry(Fault):
    """J22 - J33 of the flywheels is missing: both transverse moments of inertia are taken as their mean."""

    name = "J22 - J33 missing"
    equation = "(2), (6)"
    look = "one transverse moment of inertia where there are two; harmonic 2 of the inertia"

    def theta(self, body: Body) -> Array:
        Theta = super().theta(body)
        J = Theta[3:, 3:].copy()
        J[1, 1] = J[2, 2] = (J[1, 1] + J[2, 2]) / 2
        return with_tensor(Theta, J)


class ExchangedMoments(Fault):
    """J22 and J33 of the flywheels are exchanged."""

    name = "J22 and J33 exchanged"
    equation = "(2)"
    look = "the order of the transverse moments of inertia, and which axis is the second at phase zero"

    def theta(self, body: Body) -> Array:
        Theta = super().theta(body)
        J = Theta[3:, 3:].copy()
        J[1, 1], J[2, 2] = J[2, 2], J[1, 1]
        return with_tensor(Theta, J)


class DoubledSpinInertia(Fault):
    """The moment of inertia of the flywheels about their spin axis, J11, is doubled."""

    name = "spin inertia doubled"
    equation = "(2)"
    look = "J11 counted in the rotor and in the motor; a radius of gyration taken for a radius"

    def theta(self, body: Body) -> Array:
        Theta = super().theta(body)
        J = Theta[3:, 3:].copy()
        J[0, 0] *= 2
        return with_tensor(Theta, J)


class ProductsSign(Fault):
    """The products of inertia of all bodies have the wrong sign."""

    name = "products of inertia, sign"
    equation = "(2)"
    look = "J12 = -int(xy) in a stand file; a CAD program may give +int(xy)"
    bodies = "all"

    def read_body(self, body: AnyBody) -> AnyBody:
        return with_other_products(super().read_body(body))


class ProductsSignOfFlywheels(Fault):
    """The products of inertia of the flywheels have the wrong sign."""

    name = "products of inertia, sign, flywheels"
    equation = "(2)"
    look = "J12 = -int(xy) in a stand file; a CAD program may give +int(xy)"

    def read_body(self, body: AnyBody) -> AnyBody:
        return with_other_products(super().read_body(body))


class ProductsSignOfCarrier(Fault):
    """The products of inertia of carrier and instruments have the wrong sign."""

    name = "products of inertia, sign, carrier"
    equation = "(2)"
    look = "J12 = -int(xy) in a stand file; a CAD program may give +int(xy)"
    bodies = "fixed"

    def read_body(self, body: AnyBody) -> AnyBody:
        return with_other_products(super().read_body(body))


class NoProductsOfCarrier(Fault):
    """The products of inertia of carrier and instruments are missing."""

    name = "products of inertia missing, carrier"
    equation = "(2)"
    look = "a diagonal taken where the stand file has a tensor"
    bodies = "fixed"

    def read_body(self, body: AnyBody) -> AnyBody:
        read = super().read_body(body)
        return replace(read, inertia=rows(np.diag(np.diag(np.array(read.inertia)))))


class CentralTakenAsOrigin(Fault):
    """The parallel axis theorem is missing: inertia given about the centre of mass is taken as about the origin."""

    name = "parallel axis theorem missing"
    equation = "(2)"
    look = "`inertia_about` of each body: J = Jc - m <rc> <rc>"
    bodies = "all"

    def read_body(self, body: AnyBody) -> AnyBody:
        return replace(super().read_body(body), inertia_about="origin")


class OriginTakenAsCentral(Fault):
    """Inertia given about the origin is taken as about the centre of mass: a parallel axis term too many."""

    name = "inertia about the wrong point"
    equation = "(2)"
    look = "`inertia_about` of each body: what is about the origin is carried nowhere"
    bodies = "all"

    def read_body(self, body: AnyBody) -> AnyBody:
        return replace(super().read_body(body), inertia_about="center_of_mass")


class ParallelAxesTwice(Fault):
    """The parallel axis theorem is applied twice to inertia given about the centre of mass."""

    name = "parallel axis theorem twice"
    equation = "(2)"
    look = "J = Jc - m <rc> <rc>, once"
    bodies = "all"

    def theta(self, body: Body) -> Array:
        Theta = super().theta(body)
        if body.inertia_about == "origin":
            return Theta
        return with_tensor(Theta, Theta[3:, 3:] + parallel_axes(body))


class ParallelAxesReversed(Fault):
    """The parallel axis term of inertia given about the centre of mass has the wrong sign."""

    name = "parallel axis theorem, sign"
    equation = "(2)"
    look = "J = Jc - m <rc> <rc>: the moments about the origin are the larger ones"
    bodies = "all"

    def theta(self, body: Body) -> Array:
        Theta = super().theta(body)
        if body.inertia_about == "origin":
            return Theta
        return with_tensor(Theta, Theta[3:, 3:] - 2 * parallel_axes(body))


class WheelInertiaNotCarried(Fault):
    """The inertia of the flywheels in K is left about their own origin Os, not carried to O1."""

    name = "flywheel inertia about Os"
    equation = "(2)"
    look = "Ls Theta_s Ls^T: m r^2 of the place of each flywheel"

    def wheel_mass(self, k: Spinning) -> Array:
        return without_arm(k, k.Theta)


class InstrumentInertiaNotCarried(Fault):
    """The inertia of the instruments in K is left about their own origin Op, not carried to O1."""

    name = "instrument inertia about Op"
    equation = "(2)"
    look = "Lp Theta_p Lp^T: m r^2 of the place of each instrument"

    def fixed_mass(self, k: Fixed) -> Array:
        return without_arm(k, k.Theta)


class WheelsNotInK(Fault):
    """The flywheels are not in K: Ls Theta_s Ls^T is missing."""

    name = "flywheels missing in K"
    equation = "(2)"
    look = "K is of all bodies, the flywheels as if locked"

    def wheel_mass(self, k: Spinning) -> Array:
        return np.zeros((6, 6))


class WheelMassNotInTotal(Fault):
    """The mass of the flywheels is missing in the total mass; their moments of inertia are there."""

    name = "flywheel mass missing in the total"
    equation = "(2)"
    look = "the force rows of K: m E of every flywheel"

    def wheel_mass(self, k: Spinning) -> Array:
        found = super().wheel_mass(k).copy()
        found[:3, :3] = 0.0
        return found


class WheelMassTwice(Fault):
    """The flywheels are counted twice in K, once more as a part of the carrier."""

    name = "flywheels twice in K"
    equation = "(2)"
    look = "whether the carrier's mass and inertia are those without flywheels"

    def wheel_mass(self, k: Spinning) -> Array:
        return 2 * super().wheel_mass(k)


class WheelCouplingDropped(Fault):
    """The first moment of the flywheels is missing in K: translation and rotation are not coupled by them."""

    name = "first moment of flywheels missing in K"
    equation = "(2)"
    look = "the off-diagonal blocks of Ls Theta_s Ls^T"

    def wheel_mass(self, k: Spinning) -> Array:
        found = super().wheel_mass(k).copy()
        found[:3, 3:] = found[3:, :3] = 0.0
        return found


class CarrierMassCentreAtOrigin(Fault):
    """The centre of mass of carrier and instruments is taken to be at the origin of their frame, in inertia."""

    name = "carrier's centre of mass missing in inertia"
    equation = "(2)"
    look = "m <rc> in Theta_1 and Theta_p"
    bodies = "fixed"

    def theta(self, body: Body) -> Array:
        Theta = super().theta(body).copy()
        Theta[:3, 3:] = Theta[3:, :3] = 0.0
        return Theta


class MassCentreReversed(Fault):
    """The centre of mass of carrier and instruments is taken on the other side of their origin."""

    name = "carrier's centre of mass, sign"
    equation = "(2), (7)"
    look = "rc points from the origin of the frame to the centre of mass"
    bodies = "fixed"

    def read_body(self, body: AnyBody) -> AnyBody:
        read = super().read_body(body)
        x, y, z = read.center_of_mass
        return replace(read, center_of_mass=(-x, -y, -z))
