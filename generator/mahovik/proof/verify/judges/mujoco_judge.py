"""MuJoCo as a judge: a free joint and hinges; its composite inertia, mj_inverse, mj_forward, joint forces, sites.

Its free joint has the linear velocity in E0 and the angular one in the body's axes, and accelerations are derivatives
of these: v_E0' = C (v* + omega x v). Everything else here follows from that.
"""

from __future__ import annotations

from xml.etree import ElementTree as ET

import mujoco
import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.proof.verify.judges.rigid import (
    Array,
    RigidBody,
    Values,
    attitude,
    frames,
    free_answers,
    quaternion_rate,
    tree,
)


class MujocoJudge:
    """See OutsideJudge. Raises ValueError where MuJoCo takes no such bodies."""

    name = "mujoco"
    version = mujoco.__version__

    def __init__(self, stand: Stand) -> None:
        self.stand = stand
        self._bodies = tree(stand)
        self.model = mujoco.MjModel.from_xml_string(mjcf(stand))
        self.data = mujoco.MjData(self.model)
        joints = [self.model.joint(body.name).id for body in self._bodies if body.turns]
        # MuJoCo numbers depth first: flywheels of instruments come before those of the carrier
        self._q = np.array([*range(7), *(self.model.jnt_qposadr[joint] for joint in joints)])
        self._v = np.array([*range(6), *(self.model.jnt_dofadr[joint] for joint in joints)])
        self._ids = {body.name: self.model.body(body.name).id for body in self._bodies}

    def evaluate(self, state: State) -> Values:
        """See OutsideJudge."""
        model, data = self.model, self.data
        C, phi_ddot = self._set_state(state), np.array(state.phi_ddot)
        turning = self._turning(C, state)
        data.qfrc_applied[self._v] = [0.0] * 6 + list(state.tau)
        mujoco.mj_forward(model, data)
        outside = np.zeros(model.nv)
        for name in state.wrench:
            number = self._ids[name]
            force, moment = np.split(data.xfrc_applied[number], 2)
            mujoco.mj_applyFT(model, data, force, moment, data.xipos[number], number, outside)
        order = self._v
        T = np.eye(model.nv)
        T[:3, :3] = C
        full = np.zeros((model.nv, model.nv))
        mujoco.mj_fullM(model, data, full)
        full = full[np.ix_(order, order)]
        bias = T.T @ (full @ turning + (data.qfrc_bias - outside)[order])
        accelerations = T.T @ (data.qacc[order] - turning)
        full = T.T @ full @ T
        given = np.concatenate([state.V_dot, phi_ddot])
        data.qacc[order] = T @ given + turning
        mujoco.mj_inverse(model, data)
        forces = T.T @ (data.qfrc_inverse - outside)[order]
        mujoco.mj_rnePostConstraint(model, data)
        mounts = [self._mount(body) for body in self._bodies if body.turns]
        found = free_answers(full, bias, phi_ddot, accelerations, forces, mounts)
        return {**found, "points": {frame.name: self._point(frame.name) for frame in frames(self.stand)}}

    def rates(self, y: Array, tau: Array) -> Array:
        """See OutsideJudge; y = (qpos, qvel), flywheels in the stand's order."""
        data = self.data
        qpos, qvel = np.split(y, [self.model.nq])
        data.qpos[self._q] = qpos
        data.qpos[3:7] /= np.linalg.norm(qpos[3:7])
        data.qvel[self._v] = qvel
        data.xfrc_applied[:] = 0.0
        data.qfrc_applied[self._v] = np.concatenate([np.zeros(6), tau])
        mujoco.mj_forward(self.model, data)
        turned = quaternion_rate(data.qpos[3:7], qvel[3:6])
        return np.concatenate([qvel[:3], turned, qvel[6:], data.qacc[self._v]])

    def own_coordinates(self, state: State) -> Array:
        """See OutsideJudge."""
        self._set_state(state)
        return np.concatenate([self.data.qpos[self._q], self.data.qvel[self._v]])

    def pose_and_velocity(self, y: Array) -> tuple[Array, Array, Array, Array, Array]:
        """See OutsideJudge."""
        qpos, qvel = np.split(y, [self.model.nq])
        C = _matrix(qpos[3:7] / np.linalg.norm(qpos[3:7]))
        return qpos[:3], C, np.concatenate([C.T @ qvel[:3], qvel[3:6]]), qpos[7:], qvel[6:]

    def _set_state(self, state: State) -> Array:
        """Put the state into MuJoCo's; returns C."""
        turn = attitude(self.stand, state)
        C, data = turn.as_matrix(), self.data
        data.qpos[self._q] = [*state.position, *turn.as_quat(scalar_first=True), *state.phi]
        data.qvel[self._v] = [*(C @ np.array(state.V[:3])), *state.V[3:], *state.phi_dot]
        data.xfrc_applied[:] = 0.0
        mujoco.mj_kinematics(self.model, data)
        for name, wrench in state.wrench.items():
            number = self._ids[name]
            axes, force = data.xmat[number].reshape(3, 3), np.array(wrench[:3])
            moment = np.array(wrench[3:]) - np.cross(self.model.body_ipos[number], force)
            data.xfrc_applied[number] = np.concatenate([axes @ force, axes @ moment])
        return np.asarray(C)

    def _turning(self, C: Array, state: State) -> Array:
        """What qacc has beside the derivative of the components of V."""
        found = np.zeros(self.model.nv)
        found[:3] = C @ np.cross(state.V[3:], state.V[:3])
        return found

    def _mount(self, body: RigidBody) -> Array:
        """Force of the parent on a flywheel, about Os, in its axes at phi_s = 0."""
        data, number = self.data, self._ids[body.name]
        moment, force = np.split(data.cfrc_int[number], 2)
        moment = moment + np.cross(data.subtree_com[1] - data.xpos[number], force)
        axes = data.xmat[self._ids[body.parent or ""]].reshape(3, 3) @ body.axes
        return np.concatenate([axes.T @ force, axes.T @ moment])

    def _point(self, name: str) -> Values:
        """Motion of a point; MuJoCo adds minus gravity to accelerations, which is what an accelerometer reads."""
        site = self.model.site(f"at {name}").id
        velocity, acceleration = np.zeros(6), np.zeros(6)
        mujoco.mj_objectVelocity(self.model, self.data, mujoco.mjtObj.mjOBJ_SITE, site, velocity, 1)
        mujoco.mj_objectAcceleration(self.model, self.data, mujoco.mjtObj.mjOBJ_SITE, site, acceleration, 1)
        return {
            "position": self.data.site_xpos[site].copy(),
            "C": self.data.site_xmat[site].reshape(3, 3).copy(),
            "twist": np.roll(velocity, 3),
            "specific_force": acceleration[3:],
            "angular_acceleration": acceleration[:3],
        }


def mjcf(stand: Stand) -> str:
    """The stand as MJCF. Principal axes are found here: those of MuJoCo's compiler are good to 1e-12 only."""
    root = ET.Element("mujoco", model=stand.name)
    ET.SubElement(root, "compiler", angle="radian", inertiafromgeom="false", autolimits="false")
    option = ET.SubElement(root, "option", gravity=_text(stand.gravity))
    ET.SubElement(option, "flag", contact="disable", constraint="disable")
    found: dict[str | None, ET.Element] = {None: ET.SubElement(root, "worldbody")}
    for body in tree(stand):
        place = {"pos": _text(body.position), "quat": _text(_quaternion(body.axes))}
        element = ET.SubElement(found[body.parent], "body", {"name": body.name, **place})
        found[body.name] = element
        if body.parent is None:
            ET.SubElement(element, "freejoint")
        if body.turns:
            ET.SubElement(element, "joint", name=body.name, type="hinge", axis="1 0 0", pos="0 0 0")
        if body.mass > 0.0 or np.any(body.inertia):
            moments, axes = np.linalg.eigh(body.inertia)
            axes = axes * np.linalg.det(axes)
            inertial = {"pos": _text(body.center), "quat": _text(_quaternion(axes)), "diaginertia": _text(moments)}
            ET.SubElement(element, "inertial", {"mass": _text([body.mass]), **inertial})
    for frame in frames(stand):
        place = {"pos": _text(frame.position), "quat": _text(_quaternion(frame.axes))}
        ET.SubElement(found[frame.mount], "site", {"name": f"at {frame.name}", **place})
    return ET.tostring(root, encoding="unicode")


def _text(numbers: Array | tuple[float, ...] | list[float]) -> str:
    return " ".join(repr(float(x)) for x in numbers)


def _quaternion(axes: Array) -> Array:
    """Quaternion of a rotation (3x3), w first."""
    found = np.zeros(4)
    mujoco.mju_mat2Quat(found, np.ascontiguousarray(axes).ravel())
    return found


def _matrix(quaternion: Array) -> Array:
    found = np.zeros(9)
    mujoco.mju_quat2Mat(found, quaternion)
    return found.reshape(3, 3)
