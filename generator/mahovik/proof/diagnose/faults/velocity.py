"""Faults in the velocity terms of (4)-(9): Phi K, K*, J phi'; and in I phi''."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mahovik.proof.diagnose.edits import column_of_J, convection, drive, minus, pieces, rate, reaction, wheel, zero
from mahovik.proof.diagnose.fault import Fault
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import SpinningFlywheel
from mahovik.proof.reference.screw import Phi, f, spin


def first_half(s: SpinningFlywheel) -> Array:
    """Ls [<e>] Theta_s Ls^T phi_s' (6x6) of (6)."""
    return np.asarray(s.L @ spin @ s.Theta @ s.L.T * s.phi_dot)


def part(V: Array, row: int, column: int) -> Array:
    """Phi(V) (6x6) with nothing but one block (3x3)."""
    found, block = np.zeros((6, 6)), (slice(3 * row, 3 * row + 3), slice(3 * column, 3 * column + 3))
    found[block] = Phi(V)[block]
    return found


# fmt: off
FAULTS = (
    Fault("K* missing", "(5), (6)", "flywheels", [rate(zero)],
          "K* is missing: the change of K as the flywheels turn",
          "K* V in (5): sum of Ls ([<e>] Theta_s - Theta_s [<e>]) Ls^T phi_s'"),
    Fault("K*, sign", "(6)", "flywheels", [rate(minus)],
          "K* has the wrong sign",
          "[<e>] Theta_s - Theta_s [<e>], in this order"),
    Fault("second half of K* missing", "(6)", "flywheels", [rate(lambda right, s: first_half(s))],
          "Half of K* is missing: [<e>] Theta_s is there, - Theta_s [<e>] is not",
          "both factors of Ls Theta_s Ls^T turn: (6) has two terms"),
    Fault("first half of K* missing", "(6)", "flywheels", [rate(lambda right, s: right - first_half(s))],
          "Half of K* is missing: - Theta_s [<e>] is there, [<e>] Theta_s is not",
          "both factors of Ls Theta_s Ls^T turn: (6) has two terms"),
    Fault("phi' not squared", "(5)", "flywheels",
          [column_of_J(lambda turning, spinning, s: turning + s.L @ spin @ s.Theta @ f)],
          "phi' is not squared in the terms of unbalance: Ls [<e>] Theta_s f phi' instead of phi'^2",
          "the last term of (5), which the print has without the square"),
    Fault("phi'^2 terms missing", "(5), (9)", "flywheels", [column_of_J(lambda turning, spinning, s: turning)],
          "The terms with phi'^2 are missing: the unbalance has no centripetal part",
          "Ls [<e>] phi' in J_s"),
    Fault("phi'^2 terms, sign", "(5), (9)", "flywheels",
          [column_of_J(lambda turning, spinning, s: turning - spinning)],
          "The terms with phi'^2 have the wrong sign: the unbalance pulls inward where it should pull outward",
          "the order of factors in <e> rc: it is e1 x rc"),
    Fault("gyroscopic terms of spin missing", "(9)", "flywheels", [column_of_J(lambda turning, spinning, s: spinning)],
          "The gyroscopic terms of the flywheels' own spin are missing: Phi Ls Theta_s f phi' of J_s",
          "omega x h of each flywheel in J_s"),
    Fault("gyroscopic terms of spin, sign", "(9)", "flywheels",
          [column_of_J(lambda turning, spinning, s: spinning - turning)],
          "The gyroscopic terms of the flywheels' own spin have the wrong sign",
          "omega x h, not h x omega, in J_s"),
    Fault("J phi', sign", "(8), (9)", "flywheels", [column_of_J(lambda turning, spinning, s: -turning - spinning)],
          "J phi' has the wrong sign as a whole",
          "J phi' stands on the left of (8)"),
    Fault("J phi' missing", "(8), (9)", "flywheels", [column_of_J(lambda turning, spinning, s: np.zeros(6))],
          "J phi' is missing altogether",
          "the terms of phi' that do not come with K"),
    Fault("Phi K missing", "(4), (9)", "all", convection(zero),
          "Phi K is missing: V* is treated as if E1 did not turn",
          "Phi Z in (4): Z is written in axes that move"),
    Fault("Phi K, sign", "(4), (9)", "all", convection(minus),
          "Phi K has the wrong sign",
          "Phi Z stands on the left of (4): omega x p, v x p + omega x h"),
    Fault("v x p missing", "(4)", "all",
          [*convection(lambda right, V, at: right - part(V, 1, 0) @ at.K),
           pieces(lambda at: replace(at, J=at.J - part(at.V_r, 1, 0) @ at.I)),
           drive(lambda P, s, at: part(s.twist(at.V), 1, 0) @ s.Theta @ s.twist(at.V))],
          "v x p is missing in Phi: the lower left block <v>",
          "Phi = [[<omega>, 0], [<v>, <omega>]]: O1 moves, so the moment of momentum has a term v x p"),
    Fault("omega x p missing", "(4)", "all", convection(lambda right, V, at: right - part(V, 0, 0) @ at.K),
          "omega x p is missing: V* is taken as the acceleration of O1, not as the derivative of components in E1",
          "the upper left block <omega> of Phi in Phi K"),
    Fault("omega x h missing", "(4)", "all", convection(lambda right, V, at: right - part(V, 1, 1) @ at.K),
          "omega x h is missing: the gyroscopic moment of the carrier with its flywheels locked",
          "the lower right block <omega> of Phi in Phi K"),
    Fault("omega x h, sign", "(4)", "all", convection(lambda right, V, at: right - 2 * part(V, 1, 1) @ at.K),
          "omega x h of the carrier has the wrong sign",
          "omega x h, not h x omega, in Phi K"),
    Fault("I phi'', sign", "(8)", "all", [reaction(minus)],
          "I phi'' has the wrong sign: the flywheels' acceleration pushes the carrier the wrong way",
          "I phi'' stands on the left of (8)"),
    Fault("phi'' not used", "(8)", "flywheels", [wheel("phi_ddot", lambda phi_ddot: 0.0)],
          "phi'' of the flywheels is not used",
          "whether phi_ddot reaches the equations"),
    Fault("I phi'' missing", "(8)", "all", [reaction(zero)],
          "I phi'' is missing in the carrier's equation",
          "what accelerated flywheels do to the carrier"),
)
