"""Faults in added mass."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mahovik.core.stand.model import Instrument
from mahovik.proof.diagnose.edits import added_mass, convection, pieces, value, wrench, zero
from mahovik.proof.diagnose.fault import Fault
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import PlacedBody
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.screw import Phi, force_at

COUPLING = np.kron(1.0 - np.eye(2), np.ones((3, 3)))
"""Factor that keeps the blocks of a 6x6 matrix that couple translation and rotation."""

MUNK = np.kron(np.array([[0.0, 0.0], [1.0, 0.0]]), np.ones((3, 3)))
"""Factor that keeps the block <v> of Phi."""


def with_added_weight(P: Array, k: PlacedBody, at: Pieces) -> Array:
    """Weight (6) with that of the mean translational added mass."""
    given = getattr(k.body, "added_mass", None)
    if given is None:
        return P
    mass = np.trace(np.array(given)[:3, :3]) / 3
    return P + force_at(mass * k.L[:3, :3].T @ at.gravity, np.zeros(3))


# fmt: off
FAULTS = (
    Fault("added mass missing", "(2)", "fixed", [added_mass(zero)],
          "Added mass is missing altogether",
          "Lambda_1 + sum of Lambda_p in K"),
    Fault("added mass of instruments missing", "(2)", "fixed",
          [added_mass(lambda Lambda, k: Lambda * (not isinstance(k.body, Instrument)))],
          "The added mass of the instruments is missing; that of the carrier is there",
          "sum of Lambda_p in K"),
    Fault("added mass of instruments in their axes", "(2)", "fixed",
          [added_mass(lambda Lambda, k: k.L @ Lambda @ k.L.T)],
          "The added mass of the instruments is taken in their own frame, and carried to O1 once too often",
          "Lambda_p is about O1 in E1, for an instrument as well"),
    Fault("added mass missing in Phi K", "(9)", "all", convection(lambda right, V, at: right - Phi(V) @ at.Lambda),
          "Added mass is missing in Phi K: its Coriolis and Munk terms are not there; K has it",
          "M = Phi K + K* with the whole K"),
    Fault("Coriolis terms of added mass, sign", "(9)", "all",
          convection(lambda right, V, at: right - 2 * Phi(V) @ at.Lambda),
          "The Coriolis terms of added mass have the wrong sign",
          "Phi Lambda V_r on the left of (8)"),
    Fault("added mass missing before V*", "(8)", "all",
          [pieces(lambda at: replace(at, K=at.K_bodies)),
           value("J0", lambda J0, values, at, case: J0 + Phi(at.V) @ at.Lambda @ values["A"])],
          "Added mass is missing in K V*: its Coriolis terms are there, its inertia is not",
          "K before V* with Lambda"),
    Fault("Munk moment missing", "(4), (9)", "all", convection(lambda right, V, at: right - MUNK * Phi(V) @ at.Lambda),
          "The Munk moment is missing: v x p of the added mass",
          "the block <v> of Phi, times Lambda"),
    Fault("added mass only diagonal", "(2)", "fixed", [added_mass(lambda Lambda, k: np.eye(6) * Lambda)],
          "Of the added mass only the diagonal is used",
          "the off-diagonal elements of Lambda"),
    Fault("coupling of added mass, sign", "(2)", "fixed", [added_mass(lambda Lambda, k: Lambda * (1 - 2 * COUPLING))],
          "The blocks of added mass that couple translation and rotation have the wrong sign",
          "the off-diagonal blocks of Lambda: linear part first, about O1"),
    Fault("added mass with weight", "(7)", "fixed", [wrench(with_added_weight, "weight")],
          "Added mass is given weight",
          "added mass is in K and Phi K only, never in the weight"),
)
