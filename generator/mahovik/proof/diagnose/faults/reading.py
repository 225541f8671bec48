"""Faults at the surface: how a state is read (units, signs, orders, frames), and what is answered."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from mahovik.core.stand.model import Flywheel, Vec3
from mahovik.core.stand.state import Quaternion, State
from mahovik.proof.diagnose.edits import attitude, pieces, stand, state, twist, value, values, wheel, wheel_at
from mahovik.proof.diagnose.fault import Case, Edit, Fault
from mahovik.proof.reference.array import Array, Values, solve
from mahovik.proof.reference.bodies import mount_transfer
from mahovik.proof.reference.hold import twists
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.rotation import carrier_rotation, flywheel_mounting
from mahovik.proof.reference.screw import block_diagonal


def absolute_speed(phi_dot: float, s: Flywheel, case: Case) -> float:
    """phi_s' less the turning of the carrier about the flywheel's axis."""
    axis = mount_transfer(case.stand, s.mount)[:3, :3] @ flywheel_mounting(s)[:, 0]
    return phi_dot - float(axis @ np.array(case.state.V[3:]))


def angles(change: Callable[[Vec3], Any]) -> Edit:
    """Edit of the attitude angles, if the state has them."""
    return state(lambda x: x if x.angles is None else replace(x, angles=change(x.angles)))


def quaternion(change: Callable[[Quaternion], Any]) -> Edit:
    """Edit of the quaternion, if the state has one."""
    return state(lambda x: x if x.quaternion is None else replace(x, quaternion=change(x.quaternion)))


def in_E0(V: Array, case: Case) -> Array:
    """Components in E1 of a twist (6) given in E0."""
    C = carrier_rotation(case.stand, case.state)
    return np.concatenate([C.T @ V[:3], C.T @ V[3:]])


def in_degrees(right: State, case: Case) -> State:
    """The state whose angular velocity, or of a held carrier the speeds of its turning freedoms, were in degrees."""
    V, hold = np.array(right.V), case.stand.hold
    if hold is None:
        return replace(right, V=tuple(np.concatenate([V[:3], np.radians(V[3:])])))
    S = twists(hold)
    u = np.where(np.any(S[3:] != 0.0, axis=0), np.radians(right.u), right.u)
    return replace(right, V=tuple(S @ u), u=tuple(u))


def of_mass_center(V: Array, case: Case) -> Array:
    """The twist (6) of O1, of that with v of the carrier's centre of mass."""
    return np.concatenate([V[:3] - np.cross(V[3:], np.array(case.stand.carrier.center_of_mass)), V[3:]])


# fmt: off
READING_FAULTS = (
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
    Fault("phi' taken as absolute", "state", "flywheels", [wheel_at("phi_dot", absolute_speed)],
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
    Fault("omega in degrees", "state", "all", [Edit("state", in_degrees)],
          "omega of V is taken in degrees a second",
          "omega is in rad/s"),
    Fault("V with angular part first", "state", "all", [twist(lambda V, case: np.roll(V, 3))],
          "V is read with its angular part first",
          "linear part first, in V and in wrenches"),
)
# fmt: on


def acceleration_of_O1(V_dot: Array, right: Values, at: Pieces, case: Case) -> Array:
    """V* (6) with omega x v added."""
    return np.asarray(V_dot + np.concatenate([np.cross(at.V[3:], at.V[:3]), np.zeros(3)]))


def about_origin(Z0: Array, right: Values, at: Pieces, case: Case) -> Array:
    """Z (6) about the origin of E0, in the axes of E1."""
    Z: Array = right["Z"]
    return np.concatenate([Z[:3], Z[3:] + np.cross(np.array(case.state.position), Z[:3])])


def without_rate(right: Values, at: Pieces, case: Case) -> Values:
    """(10), (11) without D; a held carrier answers q, q' and q'' only, which have no D: they stay as they are."""
    if "D" not in right:
        return right
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
ANSWER_FAULTS = (
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
