"""A model of another program in MuJoCo: read, and asked for the forces of random motions, as the stand is."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.core.stand.law import HeldLaw
from mahovik.core.stand.model import MountingAxes, rest_state
from mahovik.errors import ForeignError, UsageError
from mahovik.out.foreign.model import Array, Model, read_xml, rows
from mahovik.out.foreign.reader import Reader, Urdf
from mahovik.out.foreign.sdf import Sdf
from mahovik.out.foreign.stand import ImportedStand
from mahovik.proof.reference import evaluate

INSTALL = 'pip install "mahovik[import]"'
LIMIT = 1e-9
"""Largest relative difference of forces that rounding can cause."""

_READERS = {"robot": Urdf, "mujoco": Reader, "sdf": Sdf}


def read(path: Path, gravity: Array | None) -> tuple[Model, Any]:
    """The tree of a URDF, MJCF or SDF file, and the model as MuJoCo compiled it, an MjModel.

    `gravity`: m/s2, of a format that has none. Raises ForeignError if it is refused, UsageError without MuJoCo.
    """
    root = read_xml(path)
    try:
        import mujoco
    except ImportError as error:
        raise UsageError(f"{path.name}: is read with {error.name or error}, which is not there: {INSTALL}") from None
    reader = _READERS[root.tag](mujoco, path, root)
    try:
        with without_log():
            spec = reader.parsed(gravity)
            reader.bare(spec)
            model = _compiled(spec)
    except ValueError as error:
        said = " ".join(str(error).split()).removeprefix("Error: ").removeprefix("XML Error: ")
        raise ForeignError([f"{path.name}: MuJoCo refuses it: {said}"]) from None
    return reader.model(spec, model), model


def _compiled(spec: Any) -> Any:
    """The model of a spec. A body without mass on joints has some while the compiler looks, which wants one."""
    spec.compiler.fusestatic = False
    empty = [body for body in spec.bodies if body.joints and not body.mass and not body.geoms]
    empty = [body for body in empty if not np.nan_to_num([*body.inertia, *body.fullinertia]).any()]
    for body in empty:
        body.explicitinertial, body.mass, body.ipos, body.inertia = True, 1.0, np.zeros(3), np.ones(3)
        body.fullinertia = [np.nan, 0, 0, 0, 0, 0]
    model = spec.compile()
    for body in empty:
        model.body_mass[body.id], model.body_inertia[body.id] = 0.0, 0.0
    return model


@contextmanager
def without_log() -> Iterator[None]:
    """Suppress MuJoCo's warnings; what is wrong with a model is found and told here."""
    import mujoco

    before = mujoco.get_mju_user_warning()
    mujoco.set_mju_user_warning(lambda _: None)
    try:
        with warnings.catch_warnings(action="ignore"):
            yield
    finally:
        mujoco.set_mju_user_warning(before)


@without_log()
def compare(made: ImportedStand, model: Any, count: int = 20, seed: int = 1) -> dict[str, float]:
    """Largest difference of forces on the carrier and of torques of the flywheels from those of MuJoCo.

    At random states and accelerations, relative to the largest of MuJoCo's; NaN where one is. Without contacts, limits,
    dry friction and drives, with damping and springs where the stand has them. `model`: of `read`; it is changed.
    """
    import mujoco

    off = mujoco.mjtDisableBit
    model.opt.disableflags |= off.mjDSBL_CONTACT | off.mjDSBL_CONSTRAINT | off.mjDSBL_ACTUATION
    names = np.array([model.joint(i).name for i in range(model.njnt)], dtype=object)
    model.jnt_stiffness[~np.isin(names, made.passive)] = 0.0
    model.dof_damping[~np.isin(names[model.dof_jntid], made.passive)] = 0.0
    free = np.flatnonzero(np.isin(names[model.dof_jntid], [joint.name for joint in made.held]))
    numbers = np.array([model.joint(joint.name).id for joint in made.wheels], dtype=int)
    wheels, phases = model.jnt_dofadr[numbers], model.jnt_qposadr[numbers]
    moving = np.concatenate([free, wheels])
    data, rng, carrier = mujoco.MjData(model), np.random.default_rng(seed), model.body(made.carrier).id
    start = np.array(model.qpos0)
    for name, at in made.fixed:
        start[model.joint(name).qposadr] = at
    theirs: Any = []
    differences: Any = []
    for _ in range(count):
        way = np.zeros(model.nv)
        way[moving] = rng.uniform(-1.0, 1.0, len(moving))
        data.qpos[:] = start
        mujoco.mj_integratePos(model, data.qpos, way, 1.0)
        data.qvel[moving], data.qacc[moving] = rng.normal(size=(2, len(moving)))
        mujoco.mj_inverse(model, data)
        jacobians = np.zeros((4, 3, model.nv))
        mujoco.mj_jacBody(model, data, *jacobians[:2], carrier)
        mujoco.mj_jacDot(model, data, *jacobians[2:], data.xpos[carrier], carrier)
        C = data.xmat[carrier].reshape(3, 3)
        rates = C.T @ jacobians
        V, V_dot = (rates[:2] @ data.qvel).ravel(), (rates[:2] @ data.qacc + rates[2:] @ data.qvel).ravel()
        V_dot[:3] -= np.cross(V[3:], V[:3])  # of the components in E1
        state = {"position": data.xpos[carrier], "V": V, "V_dot": V_dot, "phi": data.qpos[phases]}
        forces, torques = forces_of(made, C, **state, phi_dot=data.qvel[wheels], phi_ddot=data.qacc[wheels])
        ours = np.concatenate([rates[:2].reshape(6, -1)[:, free].T @ forces, torques])
        theirs.append(data.qfrc_inverse[moving].copy())
        differences.append(ours - theirs[-1])
    sizes, differences = np.abs(theirs).max(axis=0), np.abs(differences).max(axis=0)
    parts = {"forces on the carrier": slice(0, len(free)), "torques of the flywheels": slice(len(free), None)}
    scales = {what: sizes[part].max(initial=0.0) for what, part in parts.items()}
    return {what: float(differences[parts[what]].max() / scale) for what, scale in scales.items() if scale}


def forces_of(made: ImportedStand, C: Array, laws: bool = True, **motion: Array) -> tuple[Array, Array]:
    """Wrench (6) that the carrier's motion needs, in E1 about O1, and drive torques (N), by the literal reference.

    Without hold, its friction and stops, fluid; armature of flywheels as in the original, not in the carrier's motion.
    `C`: attitude (3x3); `laws`: with those of the suspension; `given`: other numbers of a State.
    """
    kept = [law for law in made.stand.laws if laws and not isinstance(law, HeldLaw)]
    carrier = replace(made.stand.carrier, added_mass=rows(made.armature))
    stand = replace(made.stand.without_laws().with_laws(*kept), hold=None, carrier=carrier)
    w, x, y, z = Rotation.from_matrix(C).as_quat(scalar_first=True).tolist()
    V, V_dot, phi_dot, phi_ddot = (motion[key] for key in ("V", "V_dot", "phi_dot", "phi_ddot"))
    numbers_of: dict[str, Any] = {key: tuple(map(float, value)) for key, value in motion.items()}
    state = replace(rest_state(stand), quaternion=(w, x, y, z), **numbers_of)
    at = evaluate(stand, state, ("matrices", "torque"))
    forces = at["K"] @ V_dot + at["M"] @ V + at["J"] @ phi_dot + at["I"] @ phi_ddot - at["F"]
    torques = np.array(at["tau"])
    for k, (joint, wheel) in enumerate(zip(made.wheels, stand.flywheels, strict=True)):
        if a := joint.armature:
            assert isinstance(wheel.mounting, MountingAxes)
            axis = np.array(wheel.mounting.axis)
            forces[3:] -= a * (axis * phi_ddot[k] + np.cross(V[3:], axis) * phi_dot[k])
            torques[k] -= a * (axis @ V_dot[3:])
    return forces, torques
