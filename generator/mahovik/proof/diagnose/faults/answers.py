"""Faults in what is answered: frames, derivatives, factors."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mahovik.proof.diagnose.edits.answers import value, values
from mahovik.proof.diagnose.edits.matrices import pieces
from mahovik.proof.diagnose.fault import Case, Fault
from mahovik.proof.reference.array import Array, Values
from mahovik.proof.reference.linear import solve
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.screw import block_diagonal


def acceleration_of_O1(V_dot: Array, right: Values, at: Pieces, case: Case) -> Array:
    """V* (6) with omega x v added."""
    return np.asarray(V_dot + np.concatenate([np.cross(at.V[3:], at.V[:3]), np.zeros(3)]))


def about_origin(Z0: Array, right: Values, at: Pieces, case: Case) -> Array:
    """Z (6) about the origin of E0, in the axes of E1."""
    Z: Array = right["Z"]
    return np.concatenate([Z[:3], Z[3:] + np.cross(np.array(case.state.position), Z[:3])])


def without_rate(right: Values, at: Pieces, case: Case) -> Values:
    """(10), (11) without D."""
    D, A = right["D"], right["A"]
    q_ddot = right["q_ddot"] + solve(A, D @ solve(A, at.V_r))
    return {**right, "D": np.zeros((6, 6)), "J0": right["J0"] - at.K @ D, "q_ddot": q_ddot}


def without_centripetal(points: dict[str, Values], right: Values, at: Pieces, case: Case) -> dict[str, Values]:
    """Points whose specific force lacks omega x v."""
    return {
        name: {**own, "specific_force": own["specific_force"] - np.cross(own["twist"][3:], own["twist"][:3])}
        for name, own in points.items()
    }


# fmt: off
FAULTS = (
    Fault("V* as the acceleration of O1", "V*", "all", [value("V_dot", acceleration_of_O1)],
          "V* is answered as the acceleration of O1, v* + omega x v, instead of the derivative of components in E1",
          "V* of the contract is the derivative of the components of V in E1"),
    Fault("V* in E0", "V*", "all", [value("V_dot", lambda V_dot, right, at, case: block_diagonal(at.C) @ V_dot)],
          "V* is answered in the axes of E0",
          "V* of the contract is in E1"),
    Fault("V* with angular part first", "V*", "all", [value("V_dot", lambda V_dot, *_: np.roll(V_dot, 3))],
          "V* is answered with its angular part first",
          "linear part first"),
    Fault("Z0 about O1", "(1)", "all", [value("Z0", lambda Z0, right, at, case: block_diagonal(at.C) @ right["Z"])],
          "The momentum in E0 is about O1: its moment is not carried to the origin of E0",
          "L1 Z with <O1> in T"),
    Fault("Z0 in E1", "(1)", "all", [value("Z0", about_origin)],
          "The momentum in E0 is in the axes of E1",
          "L1 Z with C in L1"),
    Fault("energy not halved", "energy", "all", [value("energy", lambda energy, *_: 2 * energy)],
          "The kinetic energy lacks its factor of one half",
          "V^T Theta V / 2"),
    Fault("energy without V^T I phi'", "energy", "all",
          [value("energy", lambda energy, right, at, case: energy - at.V @ at.I @ at.phi_dot)],
          "The kinetic energy lacks the coupling of carrier and flywheels, V^T I phi'",
          "the flywheel's energy is of its whole twist V_s"),
    Fault("D missing", "(10), (11)", "all", [values("generalized", without_rate)],
          "D = A' of the generalized coordinates is missing",
          "V* = A q'' + D q'"),
    Fault("specific force, sign of gravity", "points", "all", [pieces(lambda at: replace(at, gravity=-at.gravity))],
          "An accelerometer is made to feel gravity with the wrong sign: acceleration plus gravity",
          "specific force is acceleration minus gravity: +9.81 upward at rest"),
    Fault("specific force without gravity", "points", "all", [pieces(lambda at: replace(at, gravity=0 * at.gravity))],
          "An accelerometer does not feel gravity: the specific force is the plain acceleration",
          "specific force is acceleration minus gravity"),
    Fault("omega x v of points missing", "points", "all", [value("points", without_centripetal)],
          "The acceleration of points lacks omega x v: v* is taken for the acceleration",
          "v* + omega x v at the point"),
)
