"""MuJoCo with the joint of a held carrier itself: hinges, slides or a ball in place of the free joint.

At the pose of the state all its coordinates are zero. Slides come first, and MuJoCo keeps their axes in the world,
where those of S move with the carrier: with u_v the velocity of the pivot, u_v* is what MuJoCo has less omega x u_v. So
omega x u_v must be along the slides. On a knife edge it is across them: MuJoCo's carrier is held in the world there,
where that of the stand is held in its own axes, and this is another motion.
"""

from __future__ import annotations

from xml.etree import ElementTree as ET

import mujoco
import numpy as np

from mahovik.core.stand.hold import is_closed
from mahovik.core.stand.model import Hold, Stand
from mahovik.core.stand.state import State
from mahovik.proof.verify.judges.mujoco_judge import mjcf
from mahovik.proof.verify.judges.rigid import Array, JudgeError, Values, attitude, tree


class HeldMujoco:
    """A held stand in MuJoCo. JudgeError: its joints are no slides followed by turns, or no closed set."""

    name = "mujoco"
    version = mujoco.__version__

    def __init__(self, stand: Stand) -> None:
        assert stand.hold is not None
        self.stand, self.hold = stand, stand.hold
        self._elements = _joints(stand.hold)
        self._turning = [body for body in tree(stand) if body.turns]

    def evaluate(self, state: State) -> dict[str, Values]:
        """`forward`: u_dot, reaction for given phi_ddot; `coupled`: these and phi_ddot for given tau; and `torque`."""
        model = self._model(state)
        data = mujoco.MjData(model)
        m = len(self.hold.freedoms)
        joints = [model.joint(body.name).id for body in self._turning]
        order = np.array([*range(m), *(model.jnt_dofadr[joint] for joint in joints)])
        for joint, phi in zip(joints, state.phi, strict=True):
            data.qpos[model.jnt_qposadr[joint]] = phi
        data.qvel[order] = np.concatenate([state.u, state.phi_dot])
        data.qfrc_applied[order] = np.concatenate([np.zeros(m), state.tau])
        mujoco.mj_kinematics(model, data)
        self._apply(model, data, state)
        mujoco.mj_forward(model, data)
        outside = np.zeros(model.nv)
        for name in state.wrench:
            number = model.body(name).id
            force, moment = np.split(data.xfrc_applied[number], 2)
            mujoco.mj_applyFT(model, data, force, moment, data.xipos[number], number, outside)
        turning = self._turning_of(state)
        own = data.qacc[order].copy()
        mujoco.mj_rnePostConstraint(model, data)
        coupled = {"u_dot": own[:m] - turning, "phi_ddot": own[m:], "reaction": self._reaction(model, data)}
        full = np.zeros((model.nv, model.nv))
        mujoco.mj_fullM(model, data, full)
        full, bias = full[np.ix_(order, order)], (data.qfrc_bias - outside)[order]
        rates = np.linalg.solve(full[:m, :m], -bias[:m] - full[:m, m:] @ np.array(state.phi_ddot))
        data.qacc[order] = np.concatenate([rates, state.phi_ddot])
        mujoco.mj_rnePostConstraint(model, data)
        forward = {"u_dot": rates - turning, "reaction": self._reaction(model, data)}
        data.qacc[order] = np.concatenate([np.array(state.u_dot) + turning, state.phi_ddot])
        mujoco.mj_inverse(model, data)
        return {"forward": forward, "coupled": coupled, "torque": {"tau": (data.qfrc_inverse - outside)[order][m:]}}

    def _model(self, state: State) -> mujoco.MjModel:
        """MuJoCo's model with the carrier at the pose of the state, where all coordinates of the hold are zero."""
        root = ET.fromstring(mjcf(self.stand))
        carrier = root.find("worldbody/body")
        assert carrier is not None
        free = carrier.find("freejoint")
        assert free is not None
        carrier.remove(free)
        for k, element in enumerate(self._elements):
            carrier.insert(k, element)
        carrier.set("pos", " ".join(repr(float(x)) for x in state.position))
        q = attitude(self.stand, state).as_quat(scalar_first=True)
        carrier.set("quat", " ".join(repr(float(x)) for x in q))
        return mujoco.MjModel.from_xml_string(ET.tostring(root, encoding="unicode"))

    def _apply(self, model: mujoco.MjModel, data: mujoco.MjData, state: State) -> None:
        """Run-time wrenches, in the world about each body's centre of mass."""
        for name, wrench in state.wrench.items():
            number = model.body(name).id
            axes, force = data.xmat[number].reshape(3, 3), np.array(wrench[:3])
            moment = np.array(wrench[3:]) - np.cross(model.body_ipos[number], force)
            data.xfrc_applied[number] = np.concatenate([axes @ force, axes @ moment])

    def _turning_of(self, state: State) -> Array:
        """omega x u_v along each slide, which MuJoCo's accelerations have beside u_dot."""
        kinds = [freedom.kind for freedom in self.hold.freedoms]
        directions = _directions(self.hold)
        parts: dict[str, Array] = {"slide": np.zeros(3), "turn": np.zeros(3)}
        for kind, direction, speed in zip(kinds, directions, state.u, strict=True):
            parts[kind] = parts[kind] + direction * speed
        turning = np.cross(parts["turn"], parts["slide"])
        return np.array([turning @ d if kind == "slide" else 0.0 for kind, d in zip(kinds, directions, strict=True)])

    def _reaction(self, model: mujoco.MjModel, data: mujoco.MjData) -> Array:
        """Force of the world on the carrier through the joint, in E1 about O1."""
        number = model.body(self.stand.carrier.name).id
        moment, force = np.split(data.cfrc_int[number], 2)
        moment = moment + np.cross(data.subtree_com[number] - data.xpos[number], force)
        axes = data.xmat[number].reshape(3, 3)
        return np.concatenate([axes.T @ force, axes.T @ moment])


def _directions(hold: Hold) -> list[Array]:
    return [np.array(freedom.direction) / np.linalg.norm(freedom.direction) for freedom in hold.freedoms]


def _joints(hold: Hold) -> list[ET.Element]:
    """The joints in MJCF, in the order of the file."""
    kinds = [freedom.kind for freedom in hold.freedoms]
    pivot = " ".join(repr(float(x)) for x in hold.pivot)
    if "twist" in kinds:
        raise JudgeError("mujoco: no joint moves along a twist, expected slides and turns")
    directions = _directions(hold)
    if kinds == ["turn"] * 3 and np.allclose(directions, np.eye(3)):
        return [ET.Element("joint", name="hold", type="ball", pos=pivot)]
    turns = kinds.count("turn")
    if turns > 1 or kinds != ["slide"] * (len(kinds) - turns) + ["turn"] * turns:
        raise JudgeError("mujoco: no joints have these freedoms, expected slides, then one turn; or three turns")
    if not is_closed(hold):
        raise JudgeError(
            "mujoco: its slides keep their directions in the world, those of this hold turn with the carrier, expected "
            "a closed set of freedoms"
        )
    words = {"turn": "hinge", "slide": "slide"}
    return [
        ET.Element("joint", name=f"hold{k}", type=words[kind], pos=pivot, axis=" ".join(repr(float(x)) for x in axis))
        for k, (kind, axis) in enumerate(zip(kinds, directions, strict=True))
    ]
