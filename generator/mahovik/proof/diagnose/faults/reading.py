"""Faults in how a state is read: units, signs, orders, frames."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from mahovik.core.stand.model import Flywheel, Vec3
from mahovik.core.stand.state import Quaternion
from mahovik.proof.diagnose.edits.reading import attitude, stand, state, twist, wheel, wheel_at
from mahovik.proof.diagnose.fault import Case, Edit, Fault
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import flywheel_transfer
from mahovik.proof.reference.rotation import carrier_rotation


def absolute(phi_dot: float, s: Flywheel, case: Case) -> float:
    """phi_s' less the turning of the carrier about the flywheel's axis."""
    axis = flywheel_transfer(case.stand, s, 0.0)[:3, 0]
    return phi_dot - float(axis @ np.array(case.state.V[3:]))


def angles(change: Callable[[Vec3], Any]) -> Edit:
    """Attitude angles, where the state has them."""
    return state(lambda x: x if x.angles is None else replace(x, angles=change(x.angles)))


def quaternion(change: Callable[[Quaternion], Any]) -> Edit:
    """The quaternion, where the state has one."""
    return state(lambda x: x if x.quaternion is None else replace(x, quaternion=change(x.quaternion)))


def in_E0(V: Array, case: Case) -> Array:
    """Components in E1 of a twist (6) given in E0."""
    C = carrier_rotation(case.stand, case.state)
    return np.concatenate([C.T @ V[:3], C.T @ V[3:]])


def of_mass_center(V: Array, case: Case) -> Array:
    """The twist (6) of O1, of that with v of the carrier's centre of mass."""
    return np.concatenate([V[:3] - np.cross(V[3:], np.array(case.stand.carrier.center_of_mass)), V[3:]])


# fmt: off
FAULTS = (
    Fault("phi', sign", "state", "flywheels", [wheel("phi_dot", lambda phi_dot: -phi_dot)],
          "The speeds of the flywheels have the wrong sign; phases and accelerations are right",
          "phi' counts about the first axis, right-handed"),
    Fault("phi' in rpm", "state", "flywheels", [wheel("phi_dot", lambda phi_dot: phi_dot * math.pi / 30)],
          "The speeds of the flywheels are taken in revolutions a minute",
          "phi' is in rad/s"),
    Fault("phi' in degrees", "state", "flywheels", [wheel("phi_dot", math.radians)],
          "The speeds of the flywheels are taken in degrees a second",
          "phi' is in rad/s"),
    Fault("phi' ignored", "state", "flywheels", [wheel("phi_dot", lambda phi_dot: 0.0)],
          "The speeds of the flywheels are ignored",
          "whether phi_dot reaches the equations"),
    Fault("phi' taken as absolute", "state", "flywheels", [wheel_at("phi_dot", absolute)],
          "The speed of a flywheel is taken as its absolute one: "
          "the carrier's turning about the axis is left out of it",
          "phi' is relative to the mount: omega_s = Cs^T omega + e1 phi'"),
    Fault("phi'', sign", "state", "flywheels", [wheel("phi_ddot", lambda phi_ddot: -phi_ddot)],
          "The accelerations of the flywheels have the wrong sign everywhere",
          "phi'' counts as phi' does"),
    Fault("attitude angles in degrees", "state", "all", [angles(lambda a: tuple(map(math.radians, a)))],
          "The attitude angles are taken in degrees",
          "angles are in rad"),
    Fault("order of attitude angles", "state", "all", [angles(lambda a: a[::-1])],
          "The attitude angles are read in the order phi, theta, psi",
          "psi, theta, phi: the first turn first"),
    Fault("attitude transposed", "C", "all", [attitude(lambda C, x: C.T)],
          "The attitude is transposed: C turns from E0 to E1 (of angles and quaternions alike)",
          "x0 = C x1; a conjugated quaternion does the same"),
    Fault("quaternion conjugated", "C", "all", [quaternion(lambda q: (q[0], -q[1], -q[2], -q[3]))],
          "The quaternion is conjugated; attitude angles are right",
          "x0 = q x1 q^-1"),
    Fault("rotation of angles transposed", "C", "all", [attitude(lambda C, x: C.T if x.quaternion is None else C)],
          "The rotation by attitude angles is transposed; quaternions are right",
          "x0 = C x1, C of active elementary rotations"),
    Fault("quaternion, scalar last", "C", "all", [quaternion(lambda q: (q[3], *q[:3]))],
          "The quaternion is read with its scalar last: x, y, z, w instead of w, x, y, z",
          "w comes first"),
    Fault("attitude ignored", "C", "all", [attitude(lambda C, x: np.eye(3))],
          "The attitude is ignored: E1 is always aligned with E0",
          "`angles` or `quaternion` of the state"),
    Fault("quaternion ignored", "C", "all", [quaternion(lambda q: None)],
          "A quaternion is ignored; attitude angles are used",
          "`quaternion` of the state"),
    Fault("sequence, ship", "C, (10)", "all", [stand(angles="ship")],
          "The attitude angles are taken in the ship sequence: C3 C2 C1",
          "`angles` of the stand file"),
    Fault("sequence, aircraft", "C, (10)", "all", [stand(angles="aircraft")],
          "The attitude angles are taken in the aircraft sequence: C2 C3 C1",
          "`angles` of the stand file"),
    Fault("sequence, Euler", "C, (10)", "all", [stand(angles="euler")],
          "The attitude angles are taken in Euler's sequence: C3 C1 C3",
          "`angles` of the stand file"),
    Fault("position ignored", "(1), (7)", "all", [state(lambda x: replace(x, position=(0.0, 0.0, 0.0)))],
          "The position of O1 is ignored",
          "`position` in suspension, legs, Z in E0, points"),
    Fault("V taken in E0", "state", "all", [twist(in_E0)],
          "V is taken as components in E0",
          "V is in E1: its components are quasi-velocities"),
    Fault("v taken at the centre of mass", "state", "all", [twist(of_mass_center)],
          "v of V is taken as the velocity of the carrier's centre of mass, not of O1",
          "V and V* are of O1"),
    Fault("omega in degrees", "state", "all", [twist(lambda V, case: np.concatenate([V[:3], np.radians(V[3:])]))],
          "omega of V is taken in degrees a second",
          "omega is in rad/s"),
    Fault("V with angular part first", "state", "all", [twist(lambda V, case: np.roll(V, 3))],
          "V is read with its angular part first",
          "linear part first, in V and in wrenches"),
)
