"""Faults in gravity, weight, and wrenches of bodies, (7)."""

from __future__ import annotations

import numpy as np

from mahovik.core.stand.model import Body
from mahovik.proof.diagnose.fault import Fault
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import Placed, Spinning
from mahovik.proof.reference.rotation import C1
from mahovik.proof.reference.screw import block_diagonal, force_at


def without_moment(P: Array) -> Array:
    """A wrench (6) without its moment."""
    return np.concatenate([P[:3], np.zeros(3)])


class GravityReversed(Fault):
    """Gravity has the wrong sign."""

    name = "gravity, sign"
    equation = "(7)"
    look = "`gravity` is the acceleration of free fall in E0, third component -9.81 where z is up"

    def gravity_in_E1(self) -> Array:
        return -super().gravity_in_E1()


class NoGravity(Fault):
    """Gravity is ignored."""

    name = "gravity ignored"
    equation = "(7)"
    look = "`gravity` of the stand file"

    def gravity_in_E1(self) -> Array:
        return np.zeros(3)


class GravityNotTurned(Fault):
    """Gravity is not turned into the carrier's axes: it always has its components of E0."""

    name = "gravity not turned into E1"
    equation = "(7)"
    look = "C^T g"

    def gravity_in_E1(self) -> Array:
        return np.array(self.stand.gravity)


class GravityTurnedBack(Fault):
    """Gravity is turned by C where C^T is right."""

    name = "gravity turned by C"
    equation = "(7)"
    look = "C^T g: C carries from E1 to E0"

    def gravity_in_E1(self) -> Array:
        return np.asarray(self.C @ np.array(self.stand.gravity))


class NoWeightOfWheels(Fault):
    """The weight of the flywheels is missing."""

    name = "weight of flywheels missing"
    equation = "(7)"
    look = "the weight of every body, flywheels too"

    def weight(self, body: Body, gravity: Array) -> Array:
        return np.zeros(6)


class HubWeight(Fault):
    """The weight of the flywheels acts at the hub Os, not at their centre of mass."""

    name = "weight at the hub"
    equation = "(7)"
    look = "the moment rc x m g of each flywheel: its line of action moves with the phase"

    def weight(self, body: Body, gravity: Array) -> Array:
        return without_moment(super().weight(body, gravity))


class WeightAtOrigin(Fault):
    """The weight of carrier and instruments acts at the origin of their frame: its moment is missing."""

    name = "moment of weight missing"
    equation = "(7)"
    look = "rc x m g of carrier and instruments"
    bodies = "fixed"

    def weight(self, body: Body, gravity: Array) -> Array:
        return without_moment(super().weight(body, gravity))


class MomentOfWeightReversed(Fault):
    """The moment of the weight of all bodies has the wrong sign."""

    name = "moment of weight, sign"
    equation = "(7)"
    look = "rc x m g, not m g x rc"
    bodies = "all"

    def weight(self, body: Body, gravity: Array) -> Array:
        P = super().weight(body, gravity)
        return np.concatenate([P[:3], -P[3:]])


class NoWeightOfCarrier(Fault):
    """The weight of carrier and instruments is missing; that of the flywheels is there."""

    name = "weight of carrier missing"
    equation = "(7)"
    look = "the weight of every body"
    bodies = "fixed"

    def weight(self, body: Body, gravity: Array) -> Array:
        return np.zeros(6)


class BuoyancyAtOrigin(Fault):
    """Buoyancy acts at the origin of the body (O1 of the carrier), not at the centre of buoyancy."""

    name = "buoyancy at O1"
    equation = "(7)"
    look = "`center` of `buoyancy`"
    bodies = "all"

    def buoyancy(self, body: Body, gravity: Array) -> Array:
        return without_moment(super().buoyancy(body, gravity))


class BuoyancyAtMassCentre(Fault):
    """Buoyancy acts at the centre of mass, not at the centre of buoyancy."""

    name = "buoyancy at the centre of mass"
    equation = "(7)"
    look = "`center` of `buoyancy`: the righting moment comes from the two centres being apart"
    bodies = "all"

    def buoyancy(self, body: Body, gravity: Array) -> Array:
        return force_at(super().buoyancy(body, gravity)[:3], np.array(body.center_of_mass))


class BuoyancyReversed(Fault):
    """Buoyancy pulls down."""

    name = "buoyancy, sign"
    equation = "(7)"
    look = "-displaced_mass g"
    bodies = "all"

    def buoyancy(self, body: Body, gravity: Array) -> Array:
        return -super().buoyancy(body, gravity)


class NoBuoyancy(Fault):
    """Buoyancy is missing."""

    name = "buoyancy missing"
    equation = "(7)"
    look = "`buoyancy` of carrier, instruments, flywheels"
    bodies = "all"

    def buoyancy(self, body: Body, gravity: Array) -> Array:
        return np.zeros(6)


class WrenchWithoutArm(Fault):
    """Wrenches of instruments and flywheels act without the arm of their place: moments about their own origins."""

    name = "wrench about the wrong point"
    equation = "(7)"
    look = "Lp P_p, Ls P_s: the force's moment about O1"
    bodies = "all"

    def carried(self, k: Placed, P: Array) -> Array:
        return block_diagonal(k.L[:3, :3]) @ P


class WrenchArmReversed(Fault):
    """The arm of wrenches of instruments and flywheels has the wrong sign."""

    name = "arm of wrenches, sign"
    equation = "(7)"
    look = "<O> in T: O x force"
    bodies = "all"

    def carried(self, k: Placed, P: Array) -> Array:
        moved = super().carried(k, P)
        return 2 * block_diagonal(k.L[:3, :3]) @ P - moved


class WrenchNotTurned(Fault):
    """The run-time wrench of a flywheel does not turn with it: it is taken in the axes of phase zero."""

    name = "run-time wrench does not turn"
    equation = "(7)"
    look = "a run-time wrench of a flywheel is in Es, which turns with phi"

    def run_time(self, k: Placed) -> Array:
        assert isinstance(k, Spinning)
        return block_diagonal(C1(k.phi)).T @ super().run_time(k)


class NoRunTimeWrench(Fault):
    """Run-time wrenches are ignored."""

    name = "run-time wrench ignored"
    equation = "(7)"
    look = "`wrench` of the state"
    bodies = "all"

    def run_time(self, k: Placed) -> Array:
        return np.zeros(6)


class RunTimeWrenchReversed(Fault):
    """Run-time wrenches have the wrong sign: of the body instead of on it."""

    name = "run-time wrench, sign"
    equation = "(7)"
    look = "`wrench` of the state acts on the body"
    bodies = "all"

    def run_time(self, k: Placed) -> Array:
        return -super().run_time(k)


class RunTimeWrenchAtMassCentre(Fault):
    """The force of run-time wrenches acts at the centre of mass of the body, not at its origin."""

    name = "run-time wrench about the centre of mass"
    equation = "(7)"
    look = "the moment of a run-time wrench is about the origin of the body's frame"
    bodies = "all"

    def run_time(self, k: Placed) -> Array:
        P = super().run_time(k)
        return np.asarray(P + np.concatenate([np.zeros(3), np.cross(np.array(k.body.center_of_mass), P[:3])]))
