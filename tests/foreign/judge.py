"""Forces of a URDF by Pinocchio, beside those of a stand."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from mahovik.out.foreign.model import Joint
from mahovik.out.foreign.original import forces_of
from mahovik.out.foreign.stand import ImportedStand


def names(joints: tuple[Joint, ...]) -> list[str]:
    return list(dict.fromkeys(joint.label for joint in joints))


def difference(path: Path, made: ImportedStand, count: int = 5, seed: int = 1) -> float:
    """Largest difference of forces and torques at random states, relative to the largest that Pinocchio finds.

    A root that is called world is the world, any other free. Laws of the stand are left out.
    """
    import pinocchio as pin

    text = path.read_text()
    held = '<link name="world"' in text
    model = pin.buildModelFromXML(text) if held else pin.buildModelFromXML(text, pin.JointModelFreeFlyer())
    model.gravity.linear = np.array(made.stand.gravity)
    data, rng = model.createData(), np.random.default_rng(seed)
    wheels = [model.joints[model.getJointId(name)].idx_v for name in names(made.wheels)]
    free = [model.joints[model.getJointId(name)] for name in (names(made.held) if held else ["root_joint"])]
    moving = [k for joint in free for k in range(joint.idx_v, joint.idx_v + joint.nv)]
    frame = model.getFrameId(made.carrier)
    theirs, ours = [], []
    for _ in range(count):
        way, v, a = np.zeros((3, model.nv))
        for values in (way, v, a):
            values[moving + wheels] = rng.normal(size=len(moving + wheels))
        q = pin.integrate(model, pin.neutral(model), way)
        torque = pin.rnea(model, data, q, v, a)
        pin.forwardKinematics(model, data, q, v, a)
        pin.updateFramePlacements(model, data)
        V = pin.getFrameVelocity(model, data, frame, pin.LOCAL).vector
        V_dot = pin.getFrameAcceleration(model, data, frame, pin.LOCAL).vector
        J = pin.computeFrameJacobian(model, data, q, frame, pin.LOCAL).reshape(6, -1)
        place = data.oMf[frame]
        state = {"position": place.translation, "V": V, "V_dot": V_dot, "phi": way[wheels]}
        rates = {"phi_dot": v[wheels], "phi_ddot": a[wheels]}
        forces, torques = forces_of(made, place.rotation, laws=False, **state, **rates)
        ours.append(np.concatenate([J[:, np.array(moving, dtype=int)].T @ forces, torques]))
        theirs.append(torque[moving + wheels])
    return float(np.abs(np.array(ours) - np.array(theirs)).max() / np.abs(np.array(theirs)).max())
