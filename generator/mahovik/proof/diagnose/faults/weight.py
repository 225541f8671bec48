"""Faults in gravity, weight, and wrenches of bodies, (7)."""

from __future__ import annotations

import numpy as np

from mahovik.proof.diagnose.edits.matrices import FORCE, MOMENT, minus, zero
from mahovik.proof.diagnose.edits.reading import stand, vector
from mahovik.proof.diagnose.edits.wrenches import carried, wrench
from mahovik.proof.diagnose.fault import Fault
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import Placed, Spinning
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.rotation import C1
from mahovik.proof.reference.screw import block_diagonal, force_at


def without_moment(P: Array, *_: object) -> Array:
    """A wrench (6) without its moment."""
    return np.asarray(P * FORCE)


def at_mass_center(P: Array, k: Placed, at: Pieces) -> Array:
    """A wrench (6) whose force acts at the centre of mass."""
    return np.concatenate([P[:3], P[3:] + np.cross(np.array(k.body.center_of_mass), P[:3])])


def in_axes_at_zero(P: Array, k: Placed, at: Pieces) -> Array:
    """A wrench (6) of the flywheel's axes at phase zero, in Es."""
    assert isinstance(k, Spinning)
    return block_diagonal(C1(k.phi)).T @ P


def rotated_wrench(P: Array, k: Placed) -> Array:
    """A wrench (6) in the axes of E1, about the body's own origin."""
    return block_diagonal(k.L[:3, :3]) @ P


# fmt: off
FAULTS = (
    Fault("gravity, sign", "(7)", "all", [vector("gravity", lambda g, C: -g)],
          "Gravity has the wrong sign",
          "`gravity` is the acceleration of free fall in E0, third component -9.81 where z is up"),
    Fault("gravity ignored", "(7)", "all", [stand(gravity=(0.0, 0.0, 0.0))],
          "Gravity is ignored",
          "`gravity` of the stand file"),
    Fault("gravity not turned into E1", "(7)", "all", [vector("gravity", lambda g, C: C @ g)],
          "Gravity is not turned into the carrier's axes: it always has its components of E0",
          "C^T g"),
    Fault("gravity turned by C", "(7)", "all", [vector("gravity", lambda g, C: C @ C @ g)],
          "Gravity is turned by C where C^T is right",
          "C^T g: C carries from E1 to E0"),
    Fault("weight of flywheels missing", "(7)", "flywheels", [wrench(zero, "weight")],
          "The weight of the flywheels is missing",
          "the weight of every body, flywheels too"),
    Fault("weight at the hub", "(7)", "flywheels", [wrench(without_moment, "weight")],
          "The weight of the flywheels acts at the hub Os, not at their centre of mass",
          "the moment rc x m g of each flywheel: its line of action moves with the phase"),
    Fault("moment of weight missing", "(7)", "fixed", [wrench(without_moment, "weight")],
          "The weight of carrier and instruments acts at the origin of their frame: its moment is missing",
          "rc x m g of carrier and instruments"),
    Fault("moment of weight, sign", "(7)", "all", [wrench(lambda P, k, at: P * (FORCE - MOMENT), "weight")],
          "The moment of the weight of all bodies has the wrong sign",
          "rc x m g, not m g x rc"),
    Fault("weight of carrier missing", "(7)", "fixed", [wrench(zero, "weight")],
          "The weight of carrier and instruments is missing; that of the flywheels is there",
          "the weight of every body"),
    Fault("buoyancy at O1", "(7)", "all", [wrench(without_moment, "buoyancy")],
          "Buoyancy acts at the origin of the body (O1 of the carrier), not at the centre of buoyancy",
          "`center` of `buoyancy`"),
    Fault("buoyancy at the centre of mass", "(7)", "all",
          [wrench(lambda P, k, at: force_at(P[:3], np.array(k.body.center_of_mass)), "buoyancy")],
          "Buoyancy acts at the centre of mass, not at the centre of buoyancy",
          "`center` of `buoyancy`: the righting moment comes from the two centres being apart"),
    Fault("buoyancy, sign", "(7)", "all", [wrench(minus, "buoyancy")],
          "Buoyancy pulls down",
          "-displaced_mass g"),
    Fault("buoyancy missing", "(7)", "all", [wrench(zero, "buoyancy")],
          "Buoyancy is missing",
          "`buoyancy` of carrier, instruments, flywheels"),
    Fault("wrench about the wrong point", "(7)", "all", [carried(rotated_wrench)],
          "Wrenches of instruments and flywheels act without the arm of their place: moments about their own origins",
          "Lp P_p, Ls P_s: the force's moment about O1"),
    Fault("arm of wrenches, sign", "(7)", "all", [carried(lambda P, k: 2 * rotated_wrench(P, k) - k.L @ P)],
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
