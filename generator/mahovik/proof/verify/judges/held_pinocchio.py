"""Pinocchio with the joint of a held carrier itself: revolute, prismatic, helical, spherical or planar.

The root joint stands at the pivot, or on the axis of a screw. Its velocity is u and its acceleration u_dot, as these
joints have the components of their twists on axes that move with the carrier. Any other closed set of freedoms is a
composite of screws, one a freedom, with all angles zero at the pose of the state: its velocity is u there, and its
acceleration is u_dot less what its screws turn of each other. What the joint carries is the reaction.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pinocchio as pin

from mahovik.core.stand.hold import is_closed
from mahovik.core.stand.model import Freedom, Hold, Stand, Vec3
from mahovik.core.stand.state import State
from mahovik.proof.verify.judges.pinocchio_judge import ROOT, outside_forces
from mahovik.proof.verify.judges.rigid import Array, JudgeError, Values, attitude, tree


class HeldPinocchio:
    """A held stand in Pinocchio. JudgeError: Pinocchio has no joint of these freedoms."""

    name = "pinocchio"
    version = pin.__version__

    def __init__(self, stand: Stand) -> None:
        assert stand.hold is not None
        self.stand, self.count = stand, len(stand.hold.freedoms)
        self._in_E1, joint, self._rates = _joint(stand.hold)
        self.model = pin.Model()
        self.model.gravity.linear = np.array(stand.gravity)
        self.model.addJoint(0, joint, pin.SE3.Identity(), "hold")
        places: dict[str, Any] = {}
        for body in tree(stand):
            place = pin.SE3(body.axes, body.position)
            place = (self._in_E1.inverse() if body.parent is None else places[body.parent]) * place
            inertia = pin.Inertia(body.mass, body.center, body.inertia)
            if body.turns:
                number = self.model.addJoint(ROOT, pin.JointModelRX(), place, body.name)
                self.model.appendBodyToJoint(number, inertia, pin.SE3.Identity())
            else:
                places[body.name] = place
                self.model.appendBodyToJoint(ROOT, inertia, place)
        self._places = places

    def evaluate(self, state: State) -> dict[str, Values]:
        """`forward`: u_dot, V_dot, reaction for given phi_ddot; `coupled`: these, phi_ddot for given tau; `torque`."""
        C = attitude(self.stand, state).as_matrix()
        self.model.jointPlacements[ROOT] = pin.SE3(C, np.array(state.position)) * self._in_E1
        data = self.model.createData()
        m = self.count
        q = pin.neutral(self.model)
        q[self.model.nq - len(state.phi) :] = state.phi
        v = np.concatenate([self._rates * np.array(state.u), state.phi_dot])
        bias_rates = self._joint_bias(data, q, v)
        outside = outside_forces(self.model, self._places, state)
        full = np.triu(pin.crba(self.model, data, q))
        full = full + np.triu(full, 1).T
        bias = pin.rnea(self.model, data, q, v, np.zeros(self.model.nv), outside).copy()
        u_dot = np.linalg.solve(full[:m, :m], -bias[:m] - full[:m, m:] @ np.array(state.phi_ddot))
        wanted = self._rates * np.array(state.u_dot) - bias_rates
        torque = pin.rnea(self.model, data, q, v, np.concatenate([wanted, state.phi_ddot]), outside)[m:].copy()
        found = pin.aba(self.model, data, q, v, np.concatenate([np.zeros(m), state.tau]), outside).copy()
        return {
            "forward": {
                "u_dot": (u_dot + bias_rates) / self._rates,
                **self._carrier_values(data, q, v, np.concatenate([u_dot, state.phi_ddot]), outside),
            },
            "coupled": {
                "u_dot": (found[:m] + bias_rates) / self._rates,
                "phi_ddot": found[m:],
                **self._carrier_values(data, q, v, found, outside),
            },
            "torque": {"tau": torque},
        }

    def _joint_bias(self, data: Any, q: Array, v: Array) -> Array:
        """What V_dot is beside S times the accelerations of the joint, along S (m); zero of all joints but composites.

        Columns of the S of a composite change while its screws turn each other, by a motion that is along S as well.
        """
        pin.forwardKinematics(self.model, data, q, v, np.zeros(self.model.nv))
        pin.computeJointJacobians(self.model, data, q)
        S = pin.getJointJacobian(self.model, data, ROOT, pin.ReferenceFrame.LOCAL)[:, : self.count]
        return np.asarray(np.linalg.lstsq(S, data.a[ROOT].vector, rcond=None)[0])

    def _carrier_values(self, data: Any, q: Array, v: Array, rates: Array, outside: pin.StdVec_Force) -> Values:
        """Wrench of the root joint on the carrier, and V_dot, in E1 about O1."""
        pin.rnea(self.model, data, q, v, rates, outside)
        reaction = self._in_E1.act(data.f[ROOT]).vector.copy()
        pin.forwardKinematics(self.model, data, q, v, rates)
        return {"reaction": reaction, "V_dot": self._in_E1.act(data.a[ROOT]).vector.copy()}


def _joint(hold: Hold) -> tuple[pin.SE3, Any, Array]:
    """Place in E1 of the root joint, the joint, and its velocities at u = 1, in the order of the file."""
    kinds = [freedom.kind for freedom in hold.freedoms]
    if not kinds or not is_closed(hold):
        raise JudgeError("pinocchio: no joint has these freedoms, expected a closed set of freedoms, at least one")
    axes = np.array([freedom.direction for freedom in hold.freedoms]).T
    if kinds == ["turn"] * 3 and np.allclose(axes, np.eye(3)):
        return pin.SE3(np.eye(3), np.array(hold.pivot)), pin.JointModelSpherical(), np.ones(3)
    if kinds == ["slide", "slide", "turn"] and np.allclose(np.cross(axes[:, 0], axes[:, 1]), axes[:, 2]):
        return pin.SE3(axes, np.array(hold.pivot)), pin.JointModelPlanar(), np.ones(3)
    places, joints, rates = zip(*(_screw(freedom, hold.pivot) for freedom in hold.freedoms), strict=True)
    if len(joints) == 1:
        return places[0], joints[0], np.array(rates)
    composite, before = pin.JointModelComposite(), pin.SE3.Identity()
    for place, joint in zip(places, joints, strict=True):
        composite.addJoint(joint, before.inverse() * place)
        before = place
    return before, composite, np.array(rates)


def _screw(freedom: Freedom, pivot: Vec3) -> tuple[pin.SE3, Any, float]:
    """Place in E1 of the joint of one freedom, the joint, and its velocity at u = 1.

    A twist (v, omega) is a screw about the axis along omega through c = omega x v / omega^2, with the advance
    h = omega . v / omega^2 in m/rad: v = h omega + c x omega.
    """
    direction, at_pivot = np.array(freedom.direction), pin.SE3(np.eye(3), np.array(pivot))
    if freedom.kind == "turn":
        return at_pivot, pin.JointModelRevoluteUnaligned(direction / np.linalg.norm(direction)), 1.0
    if freedom.kind == "slide":
        return at_pivot, pin.JointModelPrismaticUnaligned(direction / np.linalg.norm(direction)), 1.0
    v, omega = np.array(freedom.twist[:3]), np.array(freedom.twist[3:])
    if not omega.any():
        rate = float(np.linalg.norm(v))
        return at_pivot, pin.JointModelPrismaticUnaligned(v / rate), rate
    rate, square = float(np.linalg.norm(omega)), float(omega @ omega)
    joint = pin.JointModelHelicalUnaligned(omega / rate, float(omega @ v) / square)
    return pin.SE3(np.eye(3), np.cross(omega, v) / square), joint, rate
