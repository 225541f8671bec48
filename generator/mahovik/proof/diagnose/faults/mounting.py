"""Faults in where and how flywheels and instruments are mounted, and in their phase."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TypeVar

import numpy as np

from mahovik.core.stand.model import Body, Carrier, Flywheel, Instrument, MountingAngles, MountingAxes
from mahovik.proof.diagnose.fault import Fault
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import mount_transfer
from mahovik.proof.reference.rotation import C1, C2, C3, flywheel_rotation
from mahovik.proof.reference.screw import wrench_to_parent

AnyBody = TypeVar("AnyBody", bound=Body)


class TransposedMounting(Fault):
    """The mounting of the flywheels is transposed: it turns from mount to flywheel where it should turn back."""

    name = "mounting transposed"
    equation = "(2): Ls"
    look = "columns of Cs are the flywheel's axes in its mount; C1(phi) stands on the right"

    def wheel_transfer(self, s: Flywheel, phi: float) -> Array:
        turned = flywheel_rotation(s, 0.0).T @ C1(phi)
        return mount_transfer(self.stand, s.mount) @ wrench_to_parent(np.array(s.position), turned)


class MountingInOtherOrder(Fault):
    """The angles of the mounting are applied in another order: C2(theta) C3(psi) instead of C3(psi) C2(theta)."""

    name = "order of mounting angles"
    equation = "(2): Ls"
    look = "Cs = C3(psi) C2(theta) C1(phi), whatever sequence the carrier has"

    def wheel_transfer(self, s: Flywheel, phi: float) -> Array:
        if not isinstance(s.mounting, MountingAngles):
            return super().wheel_transfer(s, phi)
        turned = C2(s.mounting.theta) @ C3(s.mounting.psi) @ C1(s.mounting.zero + phi)
        return mount_transfer(self.stand, s.mount) @ wrench_to_parent(np.array(s.position), turned)


class ReversedAxis(Fault):
    """The spin axis of the flywheels points the other way (the second axis is where it should be)."""

    name = "spin axis reversed"
    equation = "(2): Ls"
    look = "the direction of each spin axis, from which phi' counts"

    def wheel_transfer(self, s: Flywheel, phi: float) -> Array:
        turned = flywheel_rotation(s, 0.0) @ np.diag([-1.0, 1.0, -1.0]) @ C1(phi)
        return mount_transfer(self.stand, s.mount) @ wrench_to_parent(np.array(s.position), turned)


class ZeroOfPhaseIgnored(Fault):
    """The zero of the phase is ignored: phi0 of the mounting angles is taken as zero."""

    name = "phi0 ignored"
    equation = "(2): Ls"
    look = "the third of the mounting angles: phi_s counts from it"

    def read_body(self, body: AnyBody) -> AnyBody:
        read = super().read_body(body)
        if isinstance(read, Flywheel) and isinstance(read.mounting, MountingAngles):
            return replace(read, mounting=replace(read.mounting, zero=0.0))
        return read


class ZeroAxisWrong(Fault):
    """The phase is zero at the third axis instead of the second: it is a quarter turn behind."""

    name = "zero of the phase, a quarter turn behind"
    equation = "(2): Ls"
    look = "`zero` is the direction of the second axis at phase zero"

    def phase(self, s: Flywheel, phi: float) -> float:
        return super().phase(s, phi) - math.pi / 2


class ZeroAxisAhead(Fault):
    """The zero of the phase is a quarter turn ahead of the second axis."""

    name = "zero of the phase, a quarter turn ahead"
    equation = "(2): Ls"
    look = "`zero` is the direction of the second axis at phase zero"

    def phase(self, s: Flywheel, phi: float) -> float:
        return super().phase(s, phi) + math.pi / 2


class HalfTurn(Fault):
    """The zero of the phase is off by half a turn."""

    name = "zero of the phase, half a turn"
    equation = "(2): Ls"
    look = "the sign of the direction `zero`, or of the unbalance's angle"

    def phase(self, s: Flywheel, phi: float) -> float:
        return super().phase(s, phi) + math.pi


class PhaseReversed(Fault):
    """The phase of the flywheels turns the wrong way; speeds and accelerations have the right sign."""

    name = "phase, sign"
    equation = "(2): Ls"
    look = "C1(phi) is active: its element 32 is +sin(phi)"

    def phase(self, s: Flywheel, phi: float) -> float:
        return -super().phase(s, phi)


class PhaseIgnored(Fault):
    """The phase of the flywheels is ignored: they are always at phase zero."""

    name = "phase ignored"
    equation = "(2): Ls"
    look = "whether phi reaches the equations"

    def phase(self, s: Flywheel, phi: float) -> float:
        return 0.0


class PhaseInDegrees(Fault):
    """The phase of the flywheels is taken in degrees."""

    name = "phase in degrees"
    equation = "(2): Ls"
    look = "phi is in rad"

    def phase(self, s: Flywheel, phi: float) -> float:
        return math.radians(super().phase(s, phi))


class PlacedOnCarrier(Fault):
    """Flywheels on an instrument are placed as if on the carrier: the instrument's place and axes are left out."""

    name = "mount ignored"
    equation = "(2): Ls = Lp L"
    look = "`mount` of each flywheel"

    def wheel_transfer(self, s: Flywheel, phi: float) -> Array:
        return wrench_to_parent(np.array(s.position), flywheel_rotation(s, phi))


class WheelsAtOrigin(Fault):
    """The place of the flywheels is ignored: Os is taken at the origin of the mount."""

    name = "flywheel position ignored"
    equation = "(2): Ls"
    look = "<Os> in T of Ls = T [C]"

    def wheel_transfer(self, s: Flywheel, phi: float) -> Array:
        return mount_transfer(self.stand, s.mount) @ wrench_to_parent(np.zeros(3), flywheel_rotation(s, phi))


class WheelsOnOtherSide(Fault):
    """The place of the flywheels has the wrong sign: from Os to the mount."""

    name = "flywheel position, sign"
    equation = "(2): Ls"
    look = "Os is the flywheel's origin in its mount; <O> b = O x b"

    def wheel_transfer(self, s: Flywheel, phi: float) -> Array:
        return mount_transfer(self.stand, s.mount) @ wrench_to_parent(-np.array(s.position), flywheel_rotation(s, phi))


class InstrumentTransposed(Fault):
    """The rotation of the instruments is transposed, for themselves; flywheels and points on them are right."""

    name = "instrument rotation transposed"
    equation = "(2): Lp"
    look = "columns of Cp are the instrument's axes in E1"

    def fixed_transfer(self, body: Carrier | Instrument) -> Array:
        L = super().fixed_transfer(body)
        if not isinstance(body, Instrument):
            return L
        return wrench_to_parent(np.array(body.position), L[:3, :3].T)


class AxisNotNormalised(Fault):
    """The spin axis given by its direction is not brought to unit length."""

    name = "axis of any length not normalised"
    equation = "(2): Ls"
    look = "`axis` and `zero` of a mounting have any length"

    def wheel_transfer(self, s: Flywheel, phi: float) -> Array:
        L = super().wheel_transfer(s, phi)
        if not isinstance(s.mounting, MountingAxes):
            return L
        turned = flywheel_rotation(s, 0.0)
        turned[:, 0] *= math.hypot(*s.mounting.axis)
        return mount_transfer(self.stand, s.mount) @ wrench_to_parent(np.array(s.position), turned @ C1(phi))
