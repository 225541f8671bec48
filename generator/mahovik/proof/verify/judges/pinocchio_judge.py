"""Pinocchio as a judge: free-flyer and revolute joints; CRBA, RNEA, ABA.

Its twists are (linear; angular) in the body's frame, and its spatial acceleration is the derivative of their
components: V and V* as docs/model.md has them, without conversion.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import pinocchio as pin

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.proof.verify.judges.rigid import (
    Array,
    Values,
    about_first,
    attitude,
    frames,
    free_answers,
    quaternion_rate,
    tree,
)

ROOT = 1
"""The carrier's joint; flywheel s has ROOT + 1 + s."""


class PinocchioJudge:
    """See OutsideJudge."""

    name = "pinocchio"
    version = pin.__version__

    def __init__(self, stand: Stand) -> None:
        self.stand = stand
        self.model = pin.Model()
        self.model.gravity.linear = np.array(stand.gravity)
        self._places: dict[str, Any] = {}  # on the carrier: of the carrier and the instruments
        self._fixed = []
        for body in tree(stand):
            place = pin.SE3(body.axes, body.position)
            inertia = pin.Inertia(body.mass, body.center, body.inertia)
            if body.parent is None:
                self.model.addJoint(0, pin.JointModelFreeFlyer(), place, body.name)
            else:
                place = self._places[body.parent] * place
            if body.turns:
                joint = self.model.addJoint(ROOT, pin.JointModelRX(), place, body.name)
                self.model.appendBodyToJoint(joint, inertia, pin.SE3.Identity())
            else:
                self._places[body.name] = place
                self._fixed.append(body.name)
                self.model.appendBodyToJoint(ROOT, inertia, place)
        self._frames = {
            frame.name: self.model.addFrame(
                pin.Frame(
                    f"at {frame.name}",
                    ROOT,
                    0,
                    self._places[frame.mount] * pin.SE3(frame.axes, frame.position),
                    pin.FrameType.OP_FRAME,
                )
            )
            for frame in frames(stand)
        }
        self.data = self.model.createData()

    def evaluate(self, state: State) -> Values:
        """See OutsideJudge."""
        q, v = self._configuration(state)
        outside = outside_forces(self.model, self._places, state)
        phi_ddot = np.array(state.phi_ddot)
        full = np.triu(pin.crba(self.model, self.data, q))
        full = full + np.triu(full, 1).T
        bias = pin.rnea(self.model, self.data, q, v, np.zeros(self.model.nv), outside).copy()
        accelerations = pin.aba(self.model, self.data, q, v, np.array([0.0] * 6 + list(state.tau)), outside).copy()
        given = np.concatenate([state.V_dot, phi_ddot])
        forces = pin.rnea(self.model, self.data, q, v, given, outside).copy()
        mounts = [self._mount(number, phi) for number, phi in enumerate(state.phi)]
        found = free_answers(full, bias, phi_ddot, accelerations, forces, mounts)
        return {**found, "points": self._points(q, v, given)}

    def rates(self, y: Array, tau: Array) -> Array:
        """See OutsideJudge; y = (position, quaternion, phi, V, phi_dot), the quaternion with w last."""
        N = len(tau)
        q, v = y[: 7 + N].copy(), y[7 + N :]
        q[3:7] /= np.linalg.norm(q[3:7])
        turn = pin.Quaternion(q[3:7]).matrix()
        accelerations = pin.aba(self.model, self.data, q, v, np.concatenate([np.zeros(6), tau]))
        w_first = quaternion_rate(np.roll(q[3:7], 1), v[3:6])
        return np.concatenate([turn @ v[:3], np.roll(w_first, -1), v[6:], accelerations])

    def own_coordinates(self, state: State) -> Array:
        """See OutsideJudge."""
        return np.concatenate(self._configuration(state))

    def pose_and_velocity(self, y: Array) -> tuple[Array, Array, Array, Array, Array]:
        """See OutsideJudge."""
        q, v = np.split(y, [self.model.nq])
        C = pin.Quaternion(q[3:7] / np.linalg.norm(q[3:7])).matrix()
        return q[:3], C, v[:6], q[7:], v[6:]

    def _configuration(self, state: State) -> tuple[Array, Array]:
        turn = attitude(self.stand, state).as_quat()  # w last, as here
        return np.concatenate([state.position, turn, state.phi]), np.concatenate([state.V, state.phi_dot])

    def _mount(self, number: int, phi: float) -> Array:
        """Joint force in the axes that do not turn."""
        force, turn = self.data.f[ROOT + 1 + number], about_first(phi)
        return np.concatenate([turn @ force.linear, turn @ force.angular])

    def _points(self, q: Array, v: Array, given: Array) -> dict[str, Values]:
        pin.forwardKinematics(self.model, self.data, q, v, given)
        pin.updateFramePlacements(self.model, self.data)
        found = {}
        for name, frame in self._frames.items():
            place, own = self.data.oMf[frame], pin.ReferenceFrame.LOCAL
            acceleration = pin.getFrameClassicalAcceleration(self.model, self.data, frame, own)
            found[name] = {
                "position": place.translation.copy(),
                "C": place.rotation.copy(),
                "twist": pin.getFrameVelocity(self.model, self.data, frame, own).vector.copy(),
                "specific_force": acceleration.linear - place.rotation.T @ np.array(self.stand.gravity),
                "angular_acceleration": acceleration.angular.copy(),
            }
        return found


def outside_forces(model: Any, places: Mapping[str, Any], state: State) -> pin.StdVec_Force:
    """Run-time wrenches, joint by joint, in its frame. `places`: bodies that are fixed in the root joint's frame."""
    found = [pin.Force.Zero() for _ in range(model.njoints)]
    for name, wrench in state.wrench.items():
        force = pin.Force(np.array(wrench))
        if name in places:
            found[ROOT] += places[name].act(force)
        else:
            found[model.getJointId(name)] += force
    vector = pin.StdVec_Force()
    vector.extend(found)
    return vector
