"""Faults in where and how flywheels and instruments are mounted, and in their phase."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from mahovik.core.stand.model import Flywheel, Instrument, MountingAngles, MountingAxes
from mahovik.proof.diagnose.edits import body, mounting, place, wheel
from mahovik.proof.diagnose.fault import Fault
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import FixedBody, MountedFlywheel
from mahovik.proof.reference.rotation import C1, C2, C3
from mahovik.proof.reference.screw import T, wrench_to_parent


def in_other_order(s: MountedFlywheel) -> Array:
    """C2(theta) C3(psi) C1(zero) of a mounting by angles."""
    given = s.body.mounting
    return C2(given.theta) @ C3(given.psi) @ C1(given.zero) if isinstance(given, MountingAngles) else s.C


def exchange_mounting_angles(s: Flywheel) -> Flywheel:
    """A flywheel with the first two of its mounting angles exchanged."""
    given = s.mounting
    if not isinstance(given, MountingAngles):
        return s
    return replace(s, mounting=replace(given, psi=given.theta, theta=given.psi))


def from_zero(s: Flywheel) -> Flywheel:
    """A flywheel with zero for the third of its mounting angles."""
    return replace(s, mounting=replace(s.mounting, zero=0.0)) if isinstance(s.mounting, MountingAngles) else s


def with_long_axis(s: MountedFlywheel) -> Array:
    """The mounting with a first axis as long as `axis`."""
    given = s.body.mounting
    return s.C * np.array([math.hypot(*given.axis), 1.0, 1.0]) if isinstance(given, MountingAxes) else s.C


def transpose_rotation(k: FixedBody) -> FixedBody:
    """An instrument whose axes are the rows of its rotation."""
    if not isinstance(k.body, Instrument):
        return k
    return replace(k, L=wrench_to_parent(np.array(k.body.position), k.L[:3, :3].T))


# fmt: off
FAULTS = (
    Fault("mounting transposed", "(2): Ls", "flywheels", [mounting(lambda s: s.C.T)],
          "The mounting of the flywheels is transposed: it turns from mount to flywheel where it should turn back",
          "columns of Cs are the flywheel's axes in its mount; C1(phi) stands on the right"),
    Fault("order of mounting angles", "(2): Ls", "flywheels", [mounting(in_other_order)],
          "The angles of the mounting are applied in another order: C2(theta) C3(psi) instead of C3(psi) C2(theta)",
          "Cs = C3(psi) C2(theta) C1(phi), whatever sequence the carrier has"),
    Fault("mounting angles exchanged", "(2): Ls", "flywheels", [body(exchange_mounting_angles)],
          "The first two angles of the mounting are exchanged: theta is read where psi stands",
          "`angles` of a flywheel are psi, theta, zero"),
    Fault("spin axis reversed", "(2): Ls", "flywheels", [mounting(lambda s: s.C @ np.diag([-1.0, 1.0, -1.0]))],
          "The spin axis of the flywheels points the other way (the second axis is where it should be)",
          "the direction of each spin axis, from which phi' counts"),
    Fault("phi0 ignored", "(2): Ls", "flywheels", [body(from_zero)],
          "The zero of the phase is ignored: phi0 of the mounting angles is taken as zero",
          "the third of the mounting angles: phi_s counts from it"),
    Fault("zero of the phase, a quarter turn behind", "(2): Ls", "flywheels",
          [wheel("phi", lambda phi: phi - math.pi / 2)],
          "The phase is zero at the third axis instead of the second: it is a quarter turn behind",
          "`zero` is the direction of the second axis at phase zero"),
    Fault("zero of the phase, a quarter turn ahead", "(2): Ls", "flywheels",
          [wheel("phi", lambda phi: phi + math.pi / 2)],
          "The zero of the phase is a quarter turn ahead of the second axis",
          "`zero` is the direction of the second axis at phase zero"),
    Fault("zero of the phase, half a turn", "(2): Ls", "flywheels", [wheel("phi", lambda phi: phi + math.pi)],
          "The zero of the phase is off by half a turn",
          "the sign of the direction `zero`, or of the unbalance's angle"),
    Fault("phase, sign", "(2): Ls", "flywheels", [wheel("phi", lambda phi: -phi)],
          "The phase of the flywheels turns the wrong way; speeds and accelerations have the right sign",
          "C1(phi) is active: its element 32 is +sin(phi)"),
    Fault("phase ignored", "(2): Ls", "flywheels", [wheel("phi", lambda phi: 0.0)],
          "The phase of the flywheels is ignored: they are always at phase zero",
          "whether phi reaches the equations"),
    Fault("phase in degrees", "(2): Ls", "flywheels", [wheel("phi", math.radians)],
          "The phase of the flywheels is taken in degrees",
          "phi is in rad"),
    Fault("mount ignored", "(2): Ls = Lp L", "flywheels", [place(lambda s: replace(s, L_mount=np.eye(6)))],
          "Flywheels on an instrument are placed as if on the carrier: the instrument's place and axes are left out",
          "`mount` of each flywheel"),
    Fault("flywheel position ignored", "(2): Ls", "flywheels", [place(lambda s: replace(s, T=np.eye(6)))],
          "The place of the flywheels is ignored: Os is taken at the origin of the mount",
          "<Os> in T of Ls = T [C]"),
    Fault("flywheel position, sign", "(2): Ls", "flywheels",
          [place(lambda s: replace(s, T=T(-np.array(s.body.position))))],
          "The place of the flywheels has the wrong sign: from Os to the mount",
          "Os is the flywheel's origin in its mount; <O> b = O x b"),
    Fault("instrument rotation transposed", "(2): Lp", "fixed", [place(transpose_rotation)],
          "The rotation of the instruments is transposed, for themselves; flywheels and points on them are right",
          "columns of Cp are the instrument's axes in E1"),
    Fault("axis of any length not normalised", "(2): Ls", "flywheels", [mounting(with_long_axis)],
          "The spin axis given by its direction is not brought to unit length",
          "`axis` and `zero` of a mounting have any length"),
)
