"""Pinocchio with the joint of a held carrier itself: revolute, prismatic, spherical or planar in place of a free-flyer.

The root joint stands at the pivot; its velocity is u and its acceleration u_dot, as these joints have the components of
their twists on axes that move with the carrier. What it carries is the reaction.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pinocchio as pin

from mahovik.core.stand.model import Hold, Stand
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
        self._axes, joint = _joint(stand.hold)
        self._in_E1 = pin.SE3(self._axes, np.array(stand.hold.pivot))
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
        v = np.concatenate([state.u, state.phi_dot])
        outside = outside_forces(self.model, self._places, state)
        full = np.triu(pin.crba(self.model, data, q))
        full = full + np.triu(full, 1).T
        bias = pin.rnea(self.model, data, q, v, np.zeros(self.model.nv), outside).copy()
        u_dot = np.linalg.solve(full[:m, :m], -bias[:m] - full[:m, m:] @ np.array(state.phi_ddot))
        torque = pin.rnea(self.model, data, q, v, np.concatenate([state.u_dot, state.phi_ddot]), outside)[m:].copy()
        found = pin.aba(self.model, data, q, v, np.concatenate([np.zeros(m), state.tau]), outside).copy()
        return {
            "forward": {
                "u_dot": u_dot,
                **self._carrier_values(data, q, v, np.concatenate([u_dot, state.phi_ddot]), outside),
            },
            "coupled": {"u_dot": found[:m], "phi_ddot": found[m:], **self._carrier_values(data, q, v, found, outside)},
            "torque": {"tau": torque},
        }

    def _carrier_values(self, data: Any, q: Array, v: Array, rates: Array, outside: pin.StdVec_Force) -> Values:
        """Wrench of the root joint on the carrier, and V_dot, in E1 about O1."""
        pin.rnea(self.model, data, q, v, rates, outside)
        reaction = self._in_E1.act(data.f[ROOT]).vector.copy()
        pin.forwardKinematics(self.model, data, q, v, rates)
        return {"reaction": reaction, "V_dot": self._in_E1.act(data.a[ROOT]).vector.copy()}


def _joint(hold: Hold) -> tuple[Array, Any]:
    """Axes (3x3, in E1) of the root joint, and the joint: its velocities are u in the order of the file."""
    kinds = [freedom.kind for freedom in hold.freedoms]
    if "twist" in kinds:
        raise JudgeError("pinocchio: no joint moves along a twist, expected slides and turns")
    directions = [np.array(freedom.direction) / np.linalg.norm(freedom.direction) for freedom in hold.freedoms]
    if kinds == ["turn"]:
        return np.eye(3), pin.JointModelRevoluteUnaligned(directions[0])
    if kinds == ["slide"]:
        return np.eye(3), pin.JointModelPrismaticUnaligned(directions[0])
    if kinds == ["turn"] * 3 and np.allclose(directions, np.eye(3)):
        return np.eye(3), pin.JointModelSpherical()
    if kinds == ["slide", "slide", "turn"] and np.allclose(np.cross(directions[0], directions[1]), directions[2]):
        return np.column_stack(directions), pin.JointModelPlanar()
    raise JudgeError("pinocchio: no joint has these freedoms, expected a turn, a slide, three turns, or a plane")
