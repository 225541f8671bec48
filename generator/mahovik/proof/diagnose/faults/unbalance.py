"""Faults in what unbalance adds: static (the centre of mass off the axis), dynamic (products of inertia)."""

from __future__ import annotations

from dataclasses import replace
from typing import TypeVar

import numpy as np

from mahovik.core.stand.model import Body
from mahovik.proof.diagnose.fault import Fault
from mahovik.proof.diagnose.faults.inertia import rows, with_tensor
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import Spinning
from mahovik.proof.reference.inertia import inertia_about_origin

AnyBody = TypeVar("AnyBody", bound=Body)


class NoStaticUnbalance(Fault):
    """The static unbalance of the flywheels is missing: their centre of mass is taken to be on the spin axis."""

    name = "static unbalance missing"
    equation = "(2), (5)"
    look = "components 2 and 3 of m rc of each flywheel"

    def read_body(self, body: AnyBody) -> AnyBody:
        read = super().read_body(body)
        J = rows(inertia_about_origin(read))
        along = (read.center_of_mass[0], 0.0, 0.0)
        return replace(read, center_of_mass=along, inertia=J, inertia_about="origin")


class StaticUnbalanceReversed(Fault):
    """The static unbalance of the flywheels is taken on the other side of the spin axis."""

    name = "static unbalance, sign"
    equation = "(2), (5)"
    look = "the angle of the unbalance from the second axis at phase zero; a correction mass for the unbalance itself"

    def read_body(self, body: AnyBody) -> AnyBody:
        read = super().read_body(body)
        J = rows(inertia_about_origin(read))
        x, y, z = read.center_of_mass
        return replace(read, center_of_mass=(x, -y, -z), inertia=J, inertia_about="origin")


class NoDynamicUnbalance(Fault):
    """The dynamic unbalance of the flywheels is missing: J12 and J13 are taken as zero."""

    name = "dynamic unbalance missing"
    equation = "(2), (5)"
    look = "J12, J13 of each flywheel about Os: the couple that turns with it"

    def theta(self, body: Body) -> Array:
        Theta = super().theta(body)
        J = Theta[3:, 3:].copy()
        J[0, 1:] = J[1:, 0] = 0.0
        return with_tensor(Theta, J)


class DynamicUnbalanceReversed(Fault):
    """The dynamic unbalance of the flywheels, J12 and J13, has the wrong sign."""

    name = "dynamic unbalance, sign"
    equation = "(2), (5)"
    look = "J12 = -U_d cos b, J13 = -U_d sin b for a dynamic unbalance U_d at b"

    def theta(self, body: Body) -> Array:
        Theta = super().theta(body)
        J = Theta[3:, 3:].copy()
        J[0, 1:] *= -1.0
        J[1:, 0] *= -1.0
        return with_tensor(Theta, J)


class ProductsExchanged(Fault):
    """The products of inertia J12 and J13 of the flywheels are exchanged."""

    name = "products of inertia exchanged"
    equation = "(2), (5)"
    look = "which of the transverse axes is the second, which the third"

    def theta(self, body: Body) -> Array:
        Theta = super().theta(body)
        J = Theta[3:, 3:].copy()
        J[0, 1:], J[1:, 0] = J[0, :0:-1].copy(), J[:0:-1, 0].copy()
        return with_tensor(Theta, J)


class NoTransverseProduct(Fault):
    """The product of inertia J23 of the flywheels is missing."""

    name = "J23 missing"
    equation = "(2), (6)"
    look = "J23 of each flywheel: it is no unbalance, but a part of the asymmetry"

    def theta(self, body: Body) -> Array:
        Theta = super().theta(body)
        J = Theta[3:, 3:].copy()
        J[1, 2] = J[2, 1] = 0.0
        return with_tensor(Theta, J)


class NoTangentialForce(Fault):
    """The tangential force of the static unbalance is missing: the force rows of I_s phi''."""

    name = "tangential force of unbalance missing"
    equation = "(8), (9)"
    look = "the force rows of I_s = Ls Theta_s f"

    def coupling(self, k: Spinning) -> Array:
        found = super().coupling(k).copy()
        found[:3] = 0.0
        return found


class NoCentripetalForce(Fault):
    """The centripetal force of the static unbalance is missing: the force rows with phi'^2."""

    name = "centripetal force of unbalance missing"
    equation = "(5), (9)"
    look = "the force rows of Ls [<e>] Theta_s f phi'^2"

    def spinning(self, k: Spinning) -> Array:
        found = super().spinning(k).copy()
        found[:3] = 0.0
        return found


class NoCentripetalMoment(Fault):
    """The moment of the dynamic unbalance is missing: the moment rows with phi'^2."""

    name = "moment rows of phi'^2 missing"
    equation = "(5), (9)"
    look = "the moment rows of Ls [<e>] Theta_s f phi'^2"

    def spinning(self, k: Spinning) -> Array:
        found = super().spinning(k).copy()
        found[3:] = 0.0
        return found


class NoUnbalanceMoment(Fault):
    """The forces of the unbalance act without their moment about O1: I_s and J_s are taken about Os."""

    name = "unbalance without the arm of Os"
    equation = "(8), (9)"
    look = "Ls = T [C] with <Os> in T, in I_s and J_s"

    def coupling(self, k: Spinning) -> Array:
        return self._about_Os(k, super().coupling(k))

    def spinning(self, k: Spinning) -> Array:
        return self._about_Os(k, super().spinning(k))

    @staticmethod
    def _about_Os(k: Spinning, wrench: Array) -> Array:
        arm = k.L[3:, :3] @ k.L[:3, :3].T
        return np.concatenate([wrench[:3], wrench[3:] - arm @ wrench[:3]])
