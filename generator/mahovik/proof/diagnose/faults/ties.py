"""Faults in suspension and legs, (7)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from mahovik.core.stand.model import Stand, Suspension
from mahovik.core.stand.state import State
from mahovik.proof.diagnose.edits.matrices import FORCE, minus, zero
from mahovik.proof.diagnose.edits.wrenches import wrench
from mahovik.proof.diagnose.fault import Case, Edit, Fault
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.wrenches import suspension_displacement


def suspension(**values: Any) -> Edit:
    """Other values of the suspension."""

    def edit(stand: Stand, case: Case) -> Stand:
        law = stand.suspension
        return stand if law is None else replace(stand, suspension=replace(law, **values))

    return Edit("stand", edit)


def legs(key: str, factor: float) -> Edit:
    """A value of each leg times a factor."""

    def edit(stand: Stand, case: Case) -> Stand:
        return replace(stand, legs=tuple(replace(leg, **{key: factor * getattr(leg, key)}) for leg in stand.legs))

    return Edit("stand", edit)


def displacement(change: Callable[[Array, Suspension, State], Array]) -> Edit:
    """x (6; m, rad) of the suspension."""

    def edit(at: Pieces, case: Case) -> Pieces:
        law = case.stand.suspension
        if law is None:
            return at
        x = suspension_displacement(law, case.stand.angles, np.array(case.state.position), at.C)
        return replace(at, F=at.F - np.array(law.stiffness) @ (change(x, law, case.state) - x))

    return Edit("pieces", edit)


def in_E0(x: Array, law: Suspension, state: State) -> Array:
    """The displacement with its first half in E0."""
    return np.concatenate([np.array(state.position) - np.array(law.position), x[3:]])


# fmt: off
FAULTS = (
    Fault("suspension stiffness missing", "(7)", "all", [suspension(stiffness=((0.0,) * 6,) * 6)],
          "The stiffness of the suspension is missing",
          "-(stiffness x)"),
    Fault("suspension damping missing", "(7)", "all", [suspension(damping=((0.0,) * 6,) * 6)],
          "The damping of the suspension is missing",
          "-(damping V)"),
    Fault("suspension displacement in E0", "(7)", "all", [displacement(in_E0)],
          "The displacement of the suspension is taken in the axes of E0, not of E1",
          "C^T (O1 - position)"),
    Fault("suspension rotation, sign", "(7)", "all",
          [displacement(lambda x, law, state: x * np.repeat([1.0, -1.0], 3))],
          "The rotation vector of the suspension has the wrong sign: from E1 to the equilibrium",
          "rotation vector of C_eq^T C"),
    Fault("suspension rotation missing", "(7)", "all",
          [displacement(lambda x, law, state: x * np.repeat([1.0, 0.0], 3))],
          "The rotation of the carrier does not act on the suspension",
          "elements 4 to 6 of x"),
    Fault("equilibrium attitude ignored", "(7)", "all", [suspension(angles=(0.0, 0.0, 0.0))],
          "The equilibrium attitude of the suspension is ignored",
          "`angles` of `suspension`: C_eq"),
    Fault("equilibrium position ignored", "(7)", "all", [suspension(position=(0.0, 0.0, 0.0))],
          "The equilibrium position of the suspension is ignored",
          "`position` of `suspension`"),
    Fault("legs missing", "(7)", "all", [wrench(zero, "leg ")],
          "The legs are missing",
          "`leg` of the stand file"),
    Fault("legs, sign", "(7)", "all", [wrench(minus, "leg ")],
          "The legs push where they should pull",
          "a leg longer than its unstretched length pulls the carrier to the ground point"),
    Fault("leg damping missing", "(7)", "all", [legs("damping", 0.0)],
          "The damping of the legs is missing",
          "damping times the rate of length"),
    Fault("leg damping, sign", "(7)", "all", [legs("damping", -1.0)],
          "The damping of the legs has the wrong sign",
          "the rate of length is positive where the leg grows"),
    Fault("unstretched length ignored", "(7)", "all", [legs("length", 0.0)],
          "The unstretched length of the legs is ignored",
          "stiffness (length - unstretched length)"),
    Fault("moment of legs missing", "(7)", "all", [wrench(lambda P, k, at: P * FORCE, "leg ")],
          "The forces of the legs act at O1: their moment is missing",
          "carrier point x force"),
)
