"""Faults in how wrenches of bodies are carried to E1, and in those given at run time, (7)."""

from __future__ import annotations

import numpy as np

from mahovik.proof.diagnose.edits import minus, wrench, wrench_on_carrier, zero
from mahovik.proof.diagnose.fault import Fault
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import PlacedBody, SpinningFlywheel
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.rotation import C1
from mahovik.proof.reference.screw import block_diagonal


def at_mass_center(P: Array, k: PlacedBody, at: Pieces) -> Array:
    """A wrench (6) whose force acts at the centre of mass."""
    return np.concatenate([P[:3], P[3:] + np.cross(np.array(k.body.center_of_mass), P[:3])])


def in_axes_at_zero(P: Array, k: PlacedBody, at: Pieces) -> Array:
    """A wrench (6) of the flywheel's axes at phase zero, in Es."""
    assert isinstance(k, SpinningFlywheel)
    return block_diagonal(C1(k.phi)).T @ P


def rotated_wrench(P: Array, k: PlacedBody) -> Array:
    """A wrench (6) in the axes of E1, about the body's own origin."""
    return block_diagonal(k.L[:3, :3]) @ P


# fmt: off
FAULTS = (
    Fault("wrench about the wrong point", "(7)", "all", [wrench_on_carrier(rotated_wrench)],
          "Wrenches of instruments and flywheels act without the arm of their place: moments about their own origins",
          "Lp P_p, Ls P_s: the force's moment about O1"),
    Fault("arm of wrenches, sign", "(7)", "all", [wrench_on_carrier(lambda P, k: 2 * rotated_wrench(P, k) - k.L @ P)],
          "The arm of wrenches of instruments and flywheels has the wrong sign",
          "<O> in T: O x force"),
    Fault("run-time wrench does not turn", "(7)", "flywheels", [wrench(in_axes_at_zero, "run-time")],
          "The run-time wrench of a flywheel does not turn with it: it is taken in the axes of phase zero",
          "a run-time wrench of a flywheel is in Es, which turns with phi"),
    Fault("run-time wrench ignored", "(7)", "all", [wrench(zero, "run-time")],
          "Run-time wrenches are ignored",
          "`wrench` of the state"),
    Fault("run-time wrench, sign", "(7)", "all", [wrench(minus, "run-time")],
          "Run-time wrenches have the wrong sign: of the body instead of on it",
          "`wrench` of the state acts on the body"),
    Fault("run-time wrench about the centre of mass", "(7)", "all", [wrench(at_mass_center, "run-time")],
          "The force of run-time wrenches acts at the centre of mass of the body, not at its origin",
          "the moment of a run-time wrench is about the origin of the body's frame"),
)
