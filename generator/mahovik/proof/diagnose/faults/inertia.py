"""Faults in Theta and K, (2): tensors, parallel axes, masses."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from mahovik.core.stand.model import Body
from mahovik.proof.diagnose.edits.matrices import inertia, tensor, theta, zero
from mahovik.proof.diagnose.edits.reading import body
from mahovik.proof.diagnose.fault import Fault
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import Placed
from mahovik.proof.reference.screw import cross

E, OFF = np.eye(3), 1.0 - np.eye(3)
"""Factors that keep the moments, or the products, of a tensor of inertia."""

TRANSVERSE = np.diag([0.0, 1.0, -1.0])

FIRST_MOMENT = np.kron(1.0 - np.eye(2), np.ones((3, 3)))
"""Factor that keeps the off-diagonal blocks of a 6x6 matrix."""

FORCE_BLOCK = np.kron(np.diag([1.0, 0.0]), np.ones((3, 3)))


def rows(J: Array) -> Any:
    """A tensor as a stand has it."""
    return tuple(tuple(float(x) for x in row) for row in J)


def as_read(factor: Array) -> Any:
    """A body whose tensor is read times a factor, element by element."""
    return body(lambda k: replace(k, inertia=rows(factor * np.array(k.inertia))))


def parallel_axes(J: Array, k: Body, share: float) -> Array:
    """J with a share of the parallel axis term of inertia that is given about the centre of mass."""
    rc = np.array(k.center_of_mass)
    return J if k.inertia_about == "origin" else J - share * k.mass * cross(rc) @ cross(rc)


def without_arm(right: Array, k: Placed) -> Array:
    """L Theta L^T (6x6) with its moments of inertia left about the body's own origin."""
    found, C = right.copy(), k.L[:3, :3]
    found[3:, 3:] = C @ k.Theta[3:, 3:] @ C.T
    return found


# fmt: off
FAULTS = (
    Fault("J22 - J33 missing", "(2), (6)", "flywheels", [tensor(lambda J, k: J - (J[1, 1] - J[2, 2]) / 2 * TRANSVERSE)],
          "J22 - J33 of the flywheels is missing: both transverse moments of inertia are taken as their mean",
          "one transverse moment of inertia where there are two; harmonic 2 of the inertia"),
    Fault("J22 and J33 exchanged", "(2)", "flywheels", [tensor(lambda J, k: J - (J[1, 1] - J[2, 2]) * TRANSVERSE)],
          "J22 and J33 of the flywheels are exchanged",
          "the order of the transverse moments of inertia, and which axis is the second at phase zero"),
    Fault("spin inertia doubled", "(2)", "flywheels", [tensor(lambda J, k: J + J[0, 0] * np.diag([1.0, 0.0, 0.0]))],
          "The moment of inertia of the flywheels about their spin axis, J11, is doubled",
          "J11 counted in the rotor and in the motor; a radius of gyration taken for a radius"),
    Fault("products of inertia, sign", "(2)", "all", [as_read(E - OFF)],
          "The products of inertia of all bodies have the wrong sign",
          "J12 = -int(xy) in a stand file; a CAD program may give +int(xy)"),
    Fault("products of inertia, sign, flywheels", "(2)", "flywheels", [as_read(E - OFF)],
          "The products of inertia of the flywheels have the wrong sign",
          "J12 = -int(xy) in a stand file; a CAD program may give +int(xy)"),
    Fault("products of inertia, sign, carrier", "(2)", "fixed", [as_read(E - OFF)],
          "The products of inertia of carrier and instruments have the wrong sign",
          "J12 = -int(xy) in a stand file; a CAD program may give +int(xy)"),
    Fault("products of inertia missing, carrier", "(2)", "fixed", [as_read(E)],
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
