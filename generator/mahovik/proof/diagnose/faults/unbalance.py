"""Faults in what unbalance adds: static (the centre of mass off the axis), dynamic (products of inertia)."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from mahovik.proof.diagnose.edits.matrices import FORCE, MOMENT, column_of_I, column_of_J, tensor
from mahovik.proof.diagnose.edits.reading import body
from mahovik.proof.diagnose.fault import Edit, Fault
from mahovik.proof.diagnose.faults.inertia import rows
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import Spinning
from mahovik.proof.reference.inertia import inertia_about_origin

AXIAL = np.array([[0.0, 1.0, 1.0], [1.0, 0.0, 0.0], [1.0, 0.0, 0.0]])
"""Factor that keeps J12 and J13."""

TRANSVERSE = np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]])
"""Factor that keeps J23."""


def static_unbalance(factor: float) -> Edit:
    """The static unbalance times a factor, with the same moments of inertia about Os."""

    def change(s: Any) -> Any:
        x, y, z = s.center_of_mass
        inertia = rows(inertia_about_origin(s))
        return replace(s, center_of_mass=(x, factor * y, factor * z), inertia=inertia, inertia_about="origin")

    return body(change)


def exchange(J: Array, _: object) -> Array:
    """J with J12 and J13 exchanged."""
    found = J.copy()
    found[0, 1:], found[1:, 0] = J[0, :0:-1], J[:0:-1, 0]
    return found


def about_Os(wrench: Array, s: Spinning) -> Array:
    """A wrench (6) in E1 without the moment of its force about O1."""
    arm = s.L[3:, :3] @ s.L[:3, :3].T
    return np.concatenate([wrench[:3], wrench[3:] - arm @ wrench[:3]])


# fmt: off
FAULTS = (
    Fault("static unbalance missing", "(2), (5)", "flywheels", [static_unbalance(0.0)],
          "The static unbalance of the flywheels is missing: their centre of mass is taken to be on the spin axis",
          "components 2 and 3 of m rc of each flywheel"),
    Fault("static unbalance, sign", "(2), (5)", "flywheels", [static_unbalance(-1.0)],
          "The static unbalance of the flywheels is taken on the other side of the spin axis",
          "the angle of the unbalance from the second axis at phase zero; a correction mass for the unbalance itself"),
    Fault("dynamic unbalance missing", "(2), (5)", "flywheels", [tensor(lambda J, s: J * (1 - AXIAL))],
          "The dynamic unbalance of the flywheels is missing: J12 and J13 are taken as zero",
          "J12, J13 of each flywheel about Os: the couple that turns with it"),
    Fault("dynamic unbalance, sign", "(2), (5)", "flywheels", [tensor(lambda J, s: J * (1 - 2 * AXIAL))],
          "The dynamic unbalance of the flywheels, J12 and J13, has the wrong sign",
          "J12 = -U_d cos b, J13 = -U_d sin b for a dynamic unbalance U_d at b"),
    Fault("products of inertia exchanged", "(2), (5)", "flywheels", [tensor(exchange)],
          "The products of inertia J12 and J13 of the flywheels are exchanged",
          "which of the transverse axes is the second, which the third"),
    Fault("J23 missing", "(2), (6)", "flywheels", [tensor(lambda J, s: J * (1 - TRANSVERSE))],
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
