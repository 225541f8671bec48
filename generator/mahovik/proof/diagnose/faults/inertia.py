"""Faults in Theta and K, (2): tensors, parallel axes, masses; and in what unbalance adds, static and dynamic.

Static unbalance: the centre of mass is off the axis. Dynamic unbalance: products of inertia with the axis.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from mahovik.core.stand.model import Body
from mahovik.proof.diagnose.edits import FORCE, MOMENT, body, column_of_I, column_of_J, inertia, tensor, theta, zero
from mahovik.proof.diagnose.fault import Edit, Fault
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import PlacedBody, SpinningFlywheel, inertia_about_origin
from mahovik.proof.reference.screw import cross

E, OFF = np.eye(3), 1.0 - np.eye(3)
"""Factors that keep the moments, or the products, of a tensor of inertia."""

TRANSVERSE = np.diag([0.0, 1.0, -1.0])

FIRST_MOMENT = np.kron(1.0 - np.eye(2), np.ones((3, 3)))
"""Factor that keeps the off-diagonal blocks of a 6x6 matrix."""

FORCE_BLOCK = np.kron(np.diag([1.0, 0.0]), np.ones((3, 3)))


def rows(J: Array) -> Any:
    """A tensor as in a stand."""
    return tuple(tuple(float(x) for x in row) for row in J)


def scaled_tensor(factor: Array) -> Any:
    """A body whose tensor is read times a factor, element by element."""
    return body(lambda k: replace(k, inertia=rows(factor * np.array(k.inertia))))


def parallel_axes(J: Array, k: Body, share: float) -> Array:
    """J with a share of the parallel axis term of inertia that is given about the centre of mass."""
    rc = np.array(k.center_of_mass)
    return J if k.inertia_about == "origin" else J - share * k.mass * cross(rc) @ cross(rc)


def without_arm(right: Array, k: PlacedBody) -> Array:
    """L Theta L^T (6x6) with its moments of inertia left about the body's own origin."""
    found, C = right.copy(), k.L[:3, :3]
    found[3:, 3:] = C @ k.Theta[3:, 3:] @ C.T
    return found


# fmt: off
INERTIA_FAULTS = (
    Fault("J22 - J33 missing", "(2), (6)", "flywheels", [tensor(lambda J, k: J - (J[1, 1] - J[2, 2]) / 2 * TRANSVERSE)],
          "J22 - J33 of the flywheels is missing: both transverse moments of inertia are taken as their mean",
          "one transverse moment of inertia where there are two; harmonic 2 of the inertia"),
    Fault("J22 and J33 exchanged", "(2)", "flywheels", [tensor(lambda J, k: J - (J[1, 1] - J[2, 2]) * TRANSVERSE)],
          "J22 and J33 of the flywheels are exchanged",
          "the order of the transverse moments of inertia, and which axis is the second at phase zero"),
    Fault("spin inertia doubled", "(2)", "flywheels", [tensor(lambda J, k: J + J[0, 0] * np.diag([1.0, 0.0, 0.0]))],
          "The moment of inertia of the flywheels about their spin axis, J11, is doubled",
          "J11 counted in the rotor and in the motor; a radius of gyration taken for a radius"),
    Fault("products of inertia, sign", "(2)", "all", [scaled_tensor(E - OFF)],
          "The products of inertia of all bodies have the wrong sign",
          "J12 = -int(xy) in a stand file; a CAD program may give +int(xy)"),
    Fault("products of inertia, sign, flywheels", "(2)", "flywheels", [scaled_tensor(E - OFF)],
          "The products of inertia of the flywheels have the wrong sign",
          "J12 = -int(xy) in a stand file; a CAD program may give +int(xy)"),
    Fault("products of inertia, sign, carrier", "(2)", "fixed", [scaled_tensor(E - OFF)],
          "The products of inertia of carrier and instruments have the wrong sign",
          "J12 = -int(xy) in a stand file; a CAD program may give +int(xy)"),
    Fault("products of inertia missing, carrier", "(2)", "fixed", [scaled_tensor(E)],
          "The products of inertia of carrier and instruments are missing",
          "a diagonal taken where the stand file has a tensor"),
    Fault("parallel axis theorem missing", "(2)", "all", [body(lambda k: replace(k, inertia_about="origin"))],
          "The parallel axis theorem is missing: inertia given about the centre of mass is taken as about the origin",
          "`inertia_about` of each body: J = Jc - m <rc> <rc>"),
    Fault("inertia about the wrong point", "(2)", "all", [body(lambda k: replace(k, inertia_about="center_of_mass"))],
          "Inertia given about the origin is taken as about the centre of mass: a parallel axis term too many",
          "`inertia_about` of each body: what is about the origin is carried nowhere"),
    Fault("parallel axis theorem twice", "(2)", "all", [tensor(lambda J, k: parallel_axes(J, k, 1.0))],
          "The parallel axis theorem is applied twice to inertia given about the centre of mass",
          "J = Jc - m <rc> <rc>, once"),
    Fault("parallel axis theorem, sign", "(2)", "all", [tensor(lambda J, k: parallel_axes(J, k, -2.0))],
          "The parallel axis term of inertia given about the centre of mass has the wrong sign",
          "J = Jc - m <rc> <rc>: the moments about the origin are the larger ones"),
    Fault("flywheel inertia about Os", "(2)", "flywheels", [inertia(without_arm)],
          "The inertia of the flywheels in K is left about their own origin Os, not carried to O1",
          "Ls Theta_s Ls^T: m r^2 of the place of each flywheel"),
    Fault("instrument inertia about Op", "(2)", "fixed", [inertia(without_arm)],
          "The inertia of the instruments in K is left about their own origin Op, not carried to O1",
          "Lp Theta_p Lp^T: m r^2 of the place of each instrument"),
    Fault("flywheels missing in K", "(2)", "flywheels", [inertia(zero)],
          "The flywheels are not in K: Ls Theta_s Ls^T is missing",
          "K is of all bodies, the flywheels as if locked"),
    Fault("flywheel mass missing in the total", "(2)", "flywheels",
          [inertia(lambda right, k: right * (1 - FORCE_BLOCK))],
          "The mass of the flywheels is missing in the total mass; their moments of inertia are there",
          "the force rows of K: m E of every flywheel"),
    Fault("flywheels twice in K", "(2)", "flywheels", [inertia(lambda right, k: 2 * right)],
          "The flywheels are counted twice in K, once more as a part of the carrier",
          "whether the carrier's mass and inertia are those without flywheels"),
    Fault("first moment of flywheels missing in K", "(2)", "flywheels",
          [inertia(lambda right, k: right * (1 - FIRST_MOMENT))],
          "The first moment of the flywheels is missing in K: translation and rotation are not coupled by them",
          "the off-diagonal blocks of Ls Theta_s Ls^T"),
    Fault("carrier's centre of mass missing in inertia", "(2)", "fixed",
          [theta(lambda Theta, k: Theta * (1 - FIRST_MOMENT))],
          "The centre of mass of carrier and instruments is taken to be at the origin of their frame, in inertia",
          "m <rc> in Theta_1 and Theta_p"),
    Fault("carrier's centre of mass, sign", "(2), (7)", "fixed",
          [body(lambda k: replace(k, center_of_mass=tuple(-x for x in k.center_of_mass)))],
          "The centre of mass of carrier and instruments is taken on the other side of their origin",
          "rc points from the origin of the frame to the centre of mass"),
)
# fmt: on


AXIAL = np.array([[0.0, 1.0, 1.0], [1.0, 0.0, 0.0], [1.0, 0.0, 0.0]])
"""Factor that keeps J12 and J13."""

PRODUCT_23 = np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]])
"""Factor that keeps J23."""


def static_unbalance(change_of: Callable[[float, float], tuple[float, float]]) -> Edit:
    """Another place of the centre of mass across the axis, with the same moments of inertia about Os."""

    def change(s: Any) -> Any:
        x, y, z = s.center_of_mass
        inertia = rows(inertia_about_origin(s))
        return replace(s, center_of_mass=(x, *change_of(y, z)), inertia=inertia, inertia_about="origin")

    return body(change)


def exchange(J: Array, _: object) -> Array:
    """J with J12 and J13 exchanged."""
    found = J.copy()
    found[0, 1:], found[1:, 0] = J[0, :0:-1], J[:0:-1, 0]
    return found


def about_Os(wrench: Array, s: SpinningFlywheel) -> Array:
    """A wrench (6) in E1 without the moment of its force about O1."""
    arm = s.L[3:, :3] @ s.L[:3, :3].T
    return np.concatenate([wrench[:3], wrench[3:] - arm @ wrench[:3]])


# fmt: off
UNBALANCE_FAULTS = (
    Fault("static unbalance missing", "(2), (5)", "flywheels", [static_unbalance(lambda y, z: (0.0, 0.0))],
          "The static unbalance of the flywheels is missing: their centre of mass is taken to be on the spin axis",
          "components 2 and 3 of m rc of each flywheel"),
    Fault("static unbalance, sign", "(2), (5)", "flywheels", [static_unbalance(lambda y, z: (-y, -z))],
          "The static unbalance of the flywheels is taken on the other side of the spin axis",
          "the angle of the unbalance from the second axis at phase zero; a correction mass for the unbalance itself"),
    Fault("static unbalance from axis 3", "(2), (5)", "flywheels", [static_unbalance(lambda y, z: (-z, y))],
          "The angle of the static unbalance is counted from the third axis instead of the second",
          "`static_at`: center_of_mass = r (0, cos a, sin a)"),
    Fault("dynamic unbalance missing", "(2), (5)", "flywheels", [tensor(lambda J, s: J * (1 - AXIAL))],
          "The dynamic unbalance of the flywheels is missing: J12 and J13 are taken as zero",
          "J12, J13 of each flywheel about Os: the couple that turns with it"),
    Fault("dynamic unbalance, sign", "(2), (5)", "flywheels", [tensor(lambda J, s: J * (1 - 2 * AXIAL))],
          "The dynamic unbalance of the flywheels, J12 and J13, has the wrong sign",
          "J12 = -U_d cos b, J13 = -U_d sin b for a dynamic unbalance U_d at b"),
    Fault("products of inertia exchanged", "(2), (5)", "flywheels", [tensor(exchange)],
          "The products of inertia J12 and J13 of the flywheels are exchanged",
          "which of the transverse axes is the second, which the third"),
    Fault("J23 missing", "(2), (6)", "flywheels", [tensor(lambda J, s: J * (1 - PRODUCT_23))],
          "The product of inertia J23 of the flywheels is missing",
          "J23 of each flywheel: it is no unbalance, but a part of the asymmetry"),
    Fault("tangential force of unbalance missing", "(8), (9)", "flywheels", [column_of_I(lambda I_s, s: I_s * MOMENT)],
          "The tangential force of the static unbalance is missing: the force rows of I_s phi''",
          "the force rows of I_s = Ls Theta_s f"),
    Fault("centripetal force of unbalance missing", "(5), (9)", "flywheels",
          [column_of_J(lambda turning, spinning, s: turning + spinning * MOMENT)],
          "The centripetal force of the static unbalance is missing: the force rows with phi'^2",
          "the force rows of Ls [<e>] Theta_s f phi'^2"),
    Fault("moment rows of phi'^2 missing", "(5), (9)", "flywheels",
          [column_of_J(lambda turning, spinning, s: turning + spinning * FORCE)],
          "The moment of the dynamic unbalance is missing: the moment rows with phi'^2",
          "the moment rows of Ls [<e>] Theta_s f phi'^2"),
    Fault("unbalance without the arm of Os", "(8), (9)", "flywheels",
          [column_of_I(about_Os), column_of_J(lambda turning, spinning, s: turning + about_Os(spinning, s))],
          "The forces of the unbalance act without their moment about O1: I_s and J_s are taken about Os",
          "Ls = T [C] with <Os> in T, in I_s and J_s"),
)
