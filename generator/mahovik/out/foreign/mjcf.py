"""MJCF -> ForeignModel: MuJoCo's own compiler reads the file: defaults, includes, angles, inertias of shapes.

Features that act on the motion, but that a stand does not have, are refused; features without effect are reported.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from mahovik.core.stand.problems import Problems
from mahovik.core.stand.units import show
from mahovik.errors import ForeignError, UsageError
from mahovik.out.foreign.model import Array, ForeignModel, Frame, Link, Place, RigidMass, Spin
from mahovik.out.foreign.xml import read_xml

INSTALL = "pip install mujoco, or the extra `judges`"
_WORLD = 0
_FREE, _BALL, _SLIDE, _HINGE = range(4)
"""Types of joints, as MuJoCo numbers them."""


def read_mjcf(path: Path) -> ForeignModel:
    """The model of an MJCF file, with every problem found.

    Raises ForeignError if MuJoCo's compiler refuses the file, UsageError without MuJoCo.
    """
    name = read_xml(path, "mujoco").get("model", "")
    return _Reader(compile_model(path), Problems(path.name), name).model()


def compile_model(path: Path) -> Any:
    """The file as compiled by MuJoCo, an MjModel. Raises ForeignError if it is refused, UsageError without MuJoCo."""
    try:
        import mujoco
    except ImportError as error:
        raise UsageError(f"MuJoCo, which reads MJCF, is not installed ({error.name or error}): {INSTALL}") from None
    try:
        with without_log():
            return mujoco.MjModel.from_xml_path(str(path))
    except ValueError as error:
        said = " ".join(str(error).split()).removeprefix("Error: ").removeprefix("XML Error: ")
        raise ForeignError([f"{path.name}: MuJoCo refuses it: {said}"]) from None


class _Reader:
    """One compiled model."""

    def __init__(self, model: Any, problems: Problems, name: str) -> None:
        import mujoco

        self._mj = mujoco
        self._model = model
        self._name = name
        self.problems = problems
        self._notes: list[str] = []
        self._names = [model.body(i).name or f"body{i}" for i in range(model.nbody)]
        self._children: list[list[int]] = [[] for _ in range(model.nbody)]
        for i in range(1, model.nbody):
            self._children[model.body_parentid[i]].append(i)

    def model(self) -> ForeignModel:
        """The moving bodies; none unless they are one tree of finite numbers."""
        self._refuse_what_acts()
        finite = self._finite()
        root = self._root()
        if root is None or not finite:
            return ForeignModel(self._name, "body", None, (), (), None, (), tuple(self.problems.lines))
        inside = self._below(root)
        limits, said = torque_limits(self._model)
        self._notes += said
        links = [self._link(body, body == root, limits) for body in inside]
        frames = [self._frame(site) for site in self._sites(inside)]
        self._tell(inside)
        disabled = self._model.opt.disableflags & self._mj.mjtDisableBit.mjDSBL_GRAVITY
        gravity = np.zeros(3) if disabled else np.array(self._model.opt.gravity)
        free = _FREE in self._joints(root) if self._joints(root) in ([], [_FREE]) else None  # None: refused above
        notes, problems = tuple(self._notes), tuple(self.problems.lines)
        return ForeignModel(self._name, "body", gravity, tuple(links), tuple(frames), free, notes, problems)

    # -- unsupported features -----------------------------------------------------------------------------------------

    def _refuse_what_acts(self) -> None:
        model, add = self._model, self.problems.add
        for count, of, noun in ((model.neq, model.equality, "equality"), (model.ntendon, model.tendon, "tendon")):
            for i in range(count):
                add(f"{noun} {show(of(i).name or str(i))}", "constrains the motion, which a stand cannot have")
        for count, noun in ((model.nflex, "flex"), (model.nplugin, "plugin")):
            if count:
                add(f"{count} {noun}: a stand has only rigid bodies and its own laws")
        for key in ("density", "viscosity"):
            if getattr(model.opt, key):
                add(
                    "option",
                    key,
                    "MuJoCo's fluid is not that of a stand: set it to 0, see damping and added_mass",
                )
        for i in range(1, model.nbody):
            if model.body_gravcomp[i]:
                add(f"body {show(self._names[i])}", "gravcomp: a stand has no such force, see buoyancy")
        for i in range(model.nactuator):
            if model.actuator_armature[i]:
                add(f"actuator {show(model.actuator(i).name or str(i))}", "armature: inertia without a body")

    def _finite(self) -> bool:
        """Whether all numbers are finite; MuJoCo's compiler accepts NaN and infinity."""
        model, before = self._model, len(self.problems.lines)
        for key in ("body_pos", "body_quat", "body_ipos", "body_iquat", "body_mass", "body_inertia"):
            for i in _not_finite(getattr(model, key)):
                self.problems.add(f"body {show(self._names[i])}", key.removeprefix("body_"), "is not finite")
        joints = {key: getattr(model, f"jnt_{key}") for key in ("pos", "axis", "stiffness", "range", "actfrcrange")}
        joints |= {"ref": model.qpos0[model.jnt_qposadr]}
        joints |= {
            key: getattr(model, f"dof_{key}")[model.jnt_dofadr] for key in ("damping", "armature", "frictionloss")
        }
        for key, values in joints.items():
            for i in _not_finite(values):
                self.problems.add(f"joint {show(model.joint(i).name or str(i))}", key, "is not finite")
        if _not_finite(model.opt.gravity):
            self.problems.add("option", "gravity", "is not finite")
        return len(self.problems.lines) == before

    def _refuse_of_joint(self, joint: int, where: str) -> None:
        """Refuse features of a joint beyond a drive torque and friction."""
        model, add = self._model, self.problems.add
        dof = model.jnt_dofadr[joint]
        if model.jnt_limited[joint]:
            add(where, "has a range: a flywheel turns without end")
        if model.jnt_stiffness[joint] or np.any(model.jnt_stiffnesspoly[joint]):
            add(where, "stiffness: a flywheel has no spring")
        if model.dof_armature[dof]:
            add(where, "armature: inertia without a body: give it to the body as inertia about the axis")
        if np.any(model.dof_dampingpoly[dof]):
            add(where, "damping that is not linear in the speed")

    # -- bodies --------------------------------------------------------------------------------------------------------

    def _below(self, body: int) -> list[int]:
        """A body and all on it, parents first."""
        found = [body]
        for each in found:  # grows as it goes
            found += self._children[each]
        return found

    def _joints(self, body: int) -> list[int]:
        """Types of the joints of a body."""
        first = self._model.body_jntadr[body]
        return [int(self._model.jnt_type[first + i]) for i in range(self._model.body_jntnum[body])]

    def _root(self) -> int | None:
        """The carrier: the body of the world that is free, or on which something turns."""
        moving = [b for b in self._children[_WORLD] if any(self._joints(each) for each in self._below(b))]
        still = len(self._children[_WORLD]) - len(moving)
        if len(moving) == 1:
            if still:
                self._notes.append(
                    f"left out: what does not move of the world, {still} bod{'y' if still == 1 else 'ies'}"
                )
            return moving[0]
        names = ", ".join(show(self._names[b]) for b in moving)
        found = f"{len(moving)} bodies of the world move, {names}" if moving else "no body moves"
        self.problems.add(f"{found}: expected one, the carrier with its flywheels")
        return None

    def _link(self, body: int, root: bool, limits: dict[int, float]) -> Link:
        model, name = self._model, self._names[body]
        where = f"body {show(name)}"
        kinds = self._joints(body)
        spin = None
        if len(kinds) > 1:
            self.problems.add(where, f"has {len(kinds)} joints: a flywheel has one")
        elif kinds:
            joint = int(model.body_jntadr[body])
            joint_name = model.joint(joint).name
            of_joint = f"joint {show(joint_name)}" if joint_name else f"joint of {where}"
            if kinds[0] == _HINGE and root:
                self.problems.add(of_joint, "turns on the world itself: a flywheel is on a carrier")
            elif kinds[0] == _HINGE:
                self._refuse_of_joint(joint, of_joint)
                spin = self._spin(joint, joint_name or f"of {name}", limits)
            elif kinds[0] == _FREE:
                self._check_free(joint, of_joint)
            else:
                reason = "ball" if kinds[0] == _BALL else "slide"
                self.problems.add(of_joint, f"{reason}: a flywheel turns about one axis, as a hinge does")
        parent = None if root else self._names[model.body_parentid[body]]
        place = Place(np.array(model.body_pos[body]), self._matrix(model.body_quat[body]))
        return Link(name, parent, place, self._mass(body), spin)

    def _check_free(self, joint: int, where: str) -> None:
        """Refuse friction or a spring of the carrier's free joint."""
        dofs = slice(self._model.jnt_dofadr[joint], self._model.jnt_dofadr[joint] + 6)
        for key in ("damping", "dampingpoly", "armature", "frictionloss"):
            if np.any(getattr(self._model, f"dof_{key}")[dofs]):
                self.problems.add(where, f"{key.removesuffix('poly')}: not of a carrier that moves freely")
        if self._model.jnt_stiffness[joint] or np.any(self._model.jnt_stiffnesspoly[joint]):
            self.problems.add(where, "stiffness: not of a carrier that moves freely, see [suspension]")

    def _spin(self, joint: int, name: str, limits: dict[int, float]) -> Spin:
        model = self._model
        dof, flags, off = model.jnt_dofadr[joint], model.opt.disableflags, self._mj.mjtDisableBit
        damped, rubs = not flags & off.mjDSBL_DAMPER, not flags & off.mjDSBL_FRICTIONLOSS
        return Spin(
            name,
            joint,
            np.array(model.jnt_axis[joint]),
            np.array(model.jnt_pos[joint]),
            float(model.qpos0[model.jnt_qposadr[joint]]),
            float(model.dof_damping[dof]) if damped else 0.0,
            float(model.dof_frictionloss[dof]) if rubs else 0.0,
            limits.get(joint),
        )

    def _mass(self, body: int) -> RigidMass | None:
        model = self._model
        mass, moments = float(model.body_mass[body]), np.array(model.body_inertia[body])
        if not mass and not moments.any():
            return None
        axes = self._matrix(model.body_iquat[body])
        inertia = axes @ np.diag(moments) @ axes.T
        return RigidMass(mass, np.array(model.body_ipos[body]), (inertia + inertia.T) / 2)

    def _matrix(self, quaternion: Array) -> Array:
        found = np.zeros(9)
        self._mj.mju_quat2Mat(found, quaternion)
        return found.reshape(3, 3)

    # -- features without effect --------------------------------------------------------------------------------------

    def _sites(self, inside: Sequence[int]) -> list[int]:
        """Named places."""
        return [
            i for i in range(self._model.nsite) if self._model.site_bodyid[i] in inside and self._model.site(i).name
        ]

    def _frame(self, site: int) -> Frame:
        model = self._model
        place = Place(np.array(model.site_pos[site]), self._matrix(model.site_quat[site]))
        return Frame(model.site(site).name, self._names[model.site_bodyid[site]], place)

    def _tell(self, inside: list[int]) -> None:
        """Report the features left out."""
        model, off = self._model, self._mj.mjtDisableBit
        counts = {"geom": model.ngeom, "sensor": model.nsensor, "camera": model.ncam, "light": model.nlight}
        counts |= {"keyframe": model.nkey, "site without a name": model.nsite - len(self._sites(inside))}
        words = [f"{n} {noun}{'' if n == 1 or ' ' in noun else 's'}" for noun, n in counts.items() if n > 0]
        if words:
            self._notes.append(f"left out, without effect on the equations: {', '.join(words)}")
        meets = np.isin(model.geom_bodyid, inside) & ((model.geom_contype != 0) | (model.geom_conaffinity != 0))
        touching = int(meets.sum())
        contacts = not model.opt.disableflags & (off.mjDSBL_CONTACT | off.mjDSBL_CONSTRAINT)
        if contacts and (touching or model.npair):
            self._notes.append(f"a stand has no contacts: {touching} geoms that could touch something do not here")


def _not_finite(values: Array) -> list[int]:
    """Rows in which a number is NaN or infinite."""
    return [i for i, row in enumerate(values) if not np.isfinite(row).all()]


def torque_limits(model: Any) -> tuple[dict[int, float], list[str]]:
    """Largest drive torque, N m, by number of the joint, and messages about actuators, one line each.

    A motor (force = gain times control) limits by its force range, its control range and the joint's own range,
    times the gear; every other actuator is a law of control, which a stand does not have.
    """
    import mujoco

    limits: dict[int, float] = {}
    notes = []
    for joint in range(model.njnt):
        if model.jnt_actfrclimited[joint]:
            limits[joint] = float(np.abs(model.jnt_actfrcrange[joint]).max())
    for i in range(model.nactuator):
        name = f"actuator {show(model.actuator(i).name or str(i))}"
        on_joint = model.actuator_trntype[i] in (int(mujoco.mjtTrn.mjTRN_JOINT), int(mujoco.mjtTrn.mjTRN_JOINTINPARENT))
        gear = abs(float(model.actuator_gear[i][0]))
        motor = (
            model.actuator_gaintype[i] == int(mujoco.mjtGain.mjGAIN_FIXED)
            and model.actuator_biastype[i] == int(mujoco.mjtBias.mjBIAS_NONE)
            and model.actuator_dyntype[i] == int(mujoco.mjtDyn.mjDYN_NONE)
        )
        if not (on_joint and motor):
            what = "a law of control" if on_joint else "not on a joint"
            notes.append(f"{name}: {what}, left out: drives of a stand take torques")
            continue
        if model.actuator_damping[i] or np.any(model.actuator_dampingpoly[i]):
            notes.append(f"{name}: its damping is left out: see motor.viscous")
        given = []
        if model.actuator_forcelimited[i]:
            given.append(float(np.abs(model.actuator_forcerange[i]).max()) * gear)
        if model.actuator_ctrllimited[i]:
            gain = abs(float(model.actuator_gainprm[i][0]))
            given.append(float(np.abs(model.actuator_ctrlrange[i]).max()) * gain * gear)
        joint = int(model.actuator_trnid[i][0])
        given += [limits[joint]] if joint in limits else []
        if given and math.isfinite(min(given)):
            limits[joint] = min(given)
    return limits, notes


@contextmanager
def without_log() -> Iterator[None]:
    """Suppress MuJoCo's warnings; the reader finds and reports problems of a model itself."""
    import mujoco

    before = mujoco.get_mju_user_warning()
    mujoco.set_mju_user_warning(lambda _: None)
    try:
        yield
    finally:
        mujoco.set_mju_user_warning(before)
