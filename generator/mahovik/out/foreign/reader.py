"""Models as MuJoCo reads them: MJCF and URDF by its own parsers, SDF by a class that makes an MjSpec of its own.

Its compiler knows defaults, includes, angles, inertias of shapes. What acts on the motion, but is nothing that a stand
has, is refused by name.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.core.stand.tables import Problems
from mahovik.core.stand.units import show
from mahovik.errors import ForeignError, UsageError
from mahovik.out.foreign.model import Array, Body, Joint, Model, Place, RigidMass, left_out, numbers, tree_order

MIMIC = "mimic: a flywheel cannot be coupled to another joint"


_URDF = {
    "robot": "link joint mujoco",
    "link": "inertial origin",
    "inertial": "origin mass inertia",
    "joint": "origin parent child axis limit dynamics mimic",
}
"""Children that are read, by the name of the element."""
_URDF_HARMLESS = "visual collision material transmission gazebo sensor calibration safety_controller ros2_control"

_URDF_KINDS = ("revolute", "continuous", "prismatic", "planar", "floating", "fixed")


class Reader:
    """One MJCF file.

    Readers of other formats make an MjSpec of theirs. Of joints they say what MuJoCo does not: `ranges`, rad or m, None
    without an end, `numbers` and `labels`, their names, in the file; of bodies `added_mass`.
    """

    noun = "body"

    def __init__(self, mujoco: Any, path: Path, root: ET.Element) -> None:
        self.mujoco, self.path, self.root = mujoco, path, root
        self.problems, self.notes = Problems(path.name), list[str]()
        self.ranges: dict[str, tuple[float, float] | None] = {}
        self.numbers: dict[str, int] = {}
        self.labels: dict[str, str] = {}
        self.added_mass: dict[str, Array] = {}
        self.has_gravity = True

    def parsed(self, gravity: Array | None) -> Any:
        """The file as parsed, an MjSpec."""
        if gravity is not None:
            raise UsageError("gravity: a model of MuJoCo has its own")
        return self.mujoco.MjSpec.from_file(str(self.path))

    def limit(self, joint: str, kind: str, lower: str | None, upper: str | None, velocity: str, effort: str) -> None:
        """What a joint's limit says, in words of the file; `lower` and `upper` None where they have no meaning."""
        where, self.ranges[joint] = f"joint {show(joint)}", None
        if lower is not None and upper is not None:
            try:
                least, most = numbers(f"{lower} {upper}", 2)
            except ValueError:
                words = f"expected two numbers, found {show(lower)} and {show(upper)}; without an end it is continuous"
                self.problems.add(where, "limit, lower and upper", words)
                return
            if least > most:
                self.problems.add(where, "limit", f"lower {least:g} is above upper {most:g}")
            self.ranges[joint] = least, most
            kind = "fixed" if least == most else kind
        if velocity and kind != "fixed" and not velocity.startswith("-"):  # negative: there is none
            self.notes.append(f"{where}: its velocity limit {velocity} is left out: see motor.speed")
        if effort and kind != "fixed" and not _bounds(effort):
            self.notes.append(f"{where}: effort {effort} is read as no limit of the torque")

    def stop(self) -> None:
        """Raises ForeignError if there are problems."""
        if self.problems.lines:
            raise ForeignError(self.problems.lines)

    def bare(self, spec: Any) -> None:
        """Take out what has no effect, so that files of shapes need not be there; name what has no name."""
        for i, body in enumerate(spec.bodies):
            body.name = body.name or f"body{i}"
            for joint in body.joints:
                joint.name, (least, most) = joint.name or f"of {body.name}", joint.range
                if joint.limited == self.mujoco.mjtLimited.mjLIMITED_AUTO and least >= most and (least or most):
                    unread = f"joint {show(joint.name)}: range {least:g} {most:g} does not rise, and is none to MuJoCo"
                    self.notes += [] if joint.name in self.ranges else [unread]
        always = spec.compiler.inertiafromgeom == self.mujoco.mjtInertiaFromGeom.mjINERTIAFROMGEOM_TRUE
        unused = [
            g for g in spec.geoms
            if g.parent.name == "world" or (g.parent.explicitinertial and not always) or _is_massless(g)
        ]  # fmt: skip
        lists = {"geom": unused, "sensor": spec.sensors, "camera": spec.cameras, "light": spec.lights, "key": spec.keys}
        words = [f"{len(n)} {noun}{'' if len(n) == 1 else 's'}" for noun, n in lists.items() if n]
        if words:
            self.notes.append(f"left out, without effect on the equations: {', '.join(words)}")
        touching = [g for g in spec.geoms if g.parent.name != "world" and (g.contype or g.conaffinity)]
        if touching:
            self.notes.append(f"a stand has no contacts: {len(touching)} geoms that could touch something do not here")
        for element in (*spec.sensors, *spec.keys, *spec.pairs, *spec.excludes, *spec.skins, *unused):
            spec.delete(element)
        for geom in spec.geoms:
            geom.material = ""
        used = {geom.meshname for geom in spec.geoms}
        for element in (*spec.materials, *spec.textures, *(mesh for mesh in spec.meshes if mesh.name not in used)):
            spec.delete(element)
        folder = self.path.parent / spec.compiler.meshdir
        for mesh in spec.meshes:
            if mesh.file and not (folder / mesh.file).is_file():
                on = ", ".join(show(geom.parent.name) for geom in spec.geoms if geom.meshname == mesh.name)
                why = f"its file {mesh.file} is not in {folder}, but the inertia of body {on} comes of it"
                self.problems.add(f"mesh {show(mesh.name)}", f"{why}: put it there, or give the body its <inertial>")
        self.stop()

    def model(self, spec: Any, model: Any) -> Model:
        """The tree, with every problem."""
        self._refuse_what_acts(model)
        keys = "body_pos body_quat body_ipos body_mass body_inertia jnt_pos jnt_axis jnt_range jnt_stiffness qpos0"
        for key in (*keys.split(), "dof_damping", "dof_frictionloss", "dof_armature", "jnt_actfrcrange"):
            if not np.isfinite(getattr(model, key)).all():
                self.problems.add(key.replace("_", ", ", 1), "has a number that is not finite")
        self.stop()
        names = ["", *(model.body(i).name for i in range(1, model.nbody))]
        written = {body.id: body for body in spec.bodies}
        drives, bodies = self._drives(model), []
        for i in range(1, model.nbody):
            first = int(model.body_jntadr[i])
            joints = tuple(self._joint(model, first + k, drives) for k in range(model.body_jntnum[i]))
            place, mass = Place(np.array(model.body_pos[i]), _matrix(model.body_quat[i])), _mass(model, i, written[i])
            empty = not mass.mass and not mass.inertia.any()
            parent, fluid = names[model.body_parentid[i]], self.added_mass.get(names[i])
            bodies.append(Body(names[i], parent, place, None if empty else mass, joints, fluid))
        sites = [i for i in range(model.nsite) if model.site(i).name and model.site_bodyid[i]]
        places = [Place(np.array(model.site_pos[i]), _matrix(model.site_quat[i])) for i in sites]
        points = [(model.site(i).name, names[model.site_bodyid[i]], at) for i, at in zip(sites, places, strict=True)]
        self.stop()
        gravity = np.array(model.opt.gravity) * (not self._is_off(model, "GRAVITY")) if self.has_gravity else None
        return Model(spec.modelname, self.noun, gravity, tuple(bodies), tuple(points), tuple(self.notes))

    def _is_off(self, model: Any, what: str) -> bool:
        """Whether a flag of the file switches something off."""
        return bool(model.opt.disableflags & getattr(self.mujoco.mjtDisableBit, f"mjDSBL_{what}"))

    def _joint(self, model: Any, i: int, drives: dict[int, float]) -> Joint:
        dof, name = model.jnt_dofadr[i], model.joint(i).name
        position = model.jnt_qposadr[i]
        if np.any(model.jnt_stiffnesspoly[i]) or np.any(model.dof_dampingpoly[dof]):
            self.problems.add(f"joint {show(name)}", "a spring or damping that is not linear is no law of a stand")
        kind = ("free", "ball", "slide", "hinge")[model.jnt_type[i]]
        has_coordinate = kind in ("slide", "hinge")  # others have a quaternion
        ends = (float(model.jnt_range[i][0]), float(model.jnt_range[i][1])) if model.jnt_limited[i] else None
        return Joint(
            name,
            self.labels.get(name, name),
            kind,
            np.array(model.jnt_axis[i]),
            np.array(model.jnt_pos[i]),
            self.numbers.get(name, i),
            zero=float(model.qpos0[position]) * has_coordinate,
            damping=float(model.dof_damping[dof]) * (not self._is_off(model, "DAMPER")),
            friction=float(model.dof_frictionloss[dof]) * (not self._is_off(model, "FRICTIONLOSS")),
            stiffness=float(model.jnt_stiffness[i]) * (not self._is_off(model, "SPRING")),
            spring_zero=float(model.qpos_spring[position]) * has_coordinate,
            armature=float(model.dof_armature[dof]),
            range=self.ranges.get(name, ends),
            effort=drives.get(i),
        )

    def _refuse_what_acts(self, model: Any) -> None:
        add = self.problems.add
        for count, of, noun in ((model.neq, model.equality, "equality"), (model.ntendon, model.tendon, "tendon")):
            for i in range(count):
                add(f"{noun} {show(of(i).name or str(i))}", "constrains the motion, which a stand cannot have")
        for count, noun in ((model.nflex, "flex"), (model.nplugin, "plugin")):
            if count:
                add(f"{count} {noun}: a stand has only rigid bodies and its own laws")
        for key in ("density", "viscosity"):
            if getattr(model.opt, key):
                add("option", key, "MuJoCo's fluid is not that of a stand: set it to 0, see damping and added_mass")
        if not np.isfinite(model.opt.gravity).all():
            add("option", "gravity", "is not finite")
        for i in range(1, model.nbody):
            if model.body_gravcomp[i]:
                add(f"body {show(model.body(i).name)}", "gravcomp: a stand has no such force, see buoyancy")
        for i in range(model.nactuator):
            if model.actuator_armature[i]:
                add(f"actuator {show(model.actuator(i).name or str(i))}", "armature: inertia without a body")

    def _drives(self, model: Any) -> dict[int, float]:
        """Largest drive torque, N m, by number of the joint; what else actuators are becomes notes.

        A motor (force = gain times control) limits by its force range, its control range and the joint's own range,
        times the gear; every other actuator is a law of control, which a stand does not have.
        """
        mj = self.mujoco
        limits: dict[int, float] = {}
        for joint in range(model.njnt):
            if model.jnt_actfrclimited[joint]:
                limits[joint] = float(np.abs(model.jnt_actfrcrange[joint]).max())
        for i in range(model.nactuator):
            name = f"actuator {show(model.actuator(i).name or str(i))}"
            on_joint = model.actuator_trntype[i] in (int(mj.mjtTrn.mjTRN_JOINT), int(mj.mjtTrn.mjTRN_JOINTINPARENT))
            plain = (mj.mjtGain.mjGAIN_FIXED, mj.mjtBias.mjBIAS_NONE, mj.mjtDyn.mjDYN_NONE)
            kind = (model.actuator_gaintype[i], model.actuator_biastype[i], model.actuator_dyntype[i])
            if not on_joint or kind != tuple(map(int, plain)):
                what = "a law of control" if on_joint else "not on a joint"
                self.notes.append(f"{name}: {what}, left out: drives of a stand take torques")
                continue
            if model.actuator_damping[i] or np.any(model.actuator_dampingpoly[i]):
                self.notes.append(f"{name}: its damping is left out: see motor.viscous")
            joint, gear = int(model.actuator_trnid[i][0]), abs(float(model.actuator_gear[i][0]))
            gain = abs(float(model.actuator_gainprm[i][0]))
            bounds = [limits[joint]] if joint in limits else []
            if model.actuator_forcelimited[i]:
                bounds.append(float(np.abs(model.actuator_forcerange[i]).max()) * gear)
            if model.actuator_ctrllimited[i]:
                bounds.append(float(np.abs(model.actuator_ctrlrange[i]).max()) * gain * gear)
            if bounds and math.isfinite(min(bounds)):
                limits[joint] = min(bounds)
        return limits


class Urdf(Reader):
    """One URDF; what MuJoCo does not read, the XML says: limits, order, mimic, elements that are left out."""

    noun = "link"

    def parsed(self, gravity: Array | None) -> Any:
        """The file as parsed, without shapes; a root that is not called world is free."""
        root, links, joints = self.root, self.root.findall("link"), self.root.findall("joint")
        self.notes += left_out(root, _URDF, _URDF_HARMLESS)
        for link in links:
            if link.find("origin") is not None:
                where = f"warning: link {show(link.get('name'))}"
                self.notes.append(f"{where}: its <origin> is not read: the place of a link is that of its joint")
            for shape in (*link.findall("visual"), *link.findall("collision")):
                link.remove(shape)
        edges = [(joint.get("name", ""), _end(joint, "parent"), _end(joint, "child")) for joint in joints]
        order = tree_order("link", [link.get("name", "") for link in links], edges, self.problems)
        for number, joint in enumerate(joints):
            name, kind, limit = joint.get("name", ""), joint.get("type", ""), joint.find("limit")
            if kind not in _URDF_KINDS:
                self.problems.add(f"joint {show(name)}", f"type {show(kind)}: expected one of {', '.join(_URDF_KINDS)}")
            bounds = {} if limit is None else dict(limit.attrib)
            if limit is not None and not _bounds(bounds.get("effort", "1")):
                del limit.attrib["effort"]  # MuJoCo's parser takes the size of a negative one
            ended = kind in ("revolute", "prismatic")
            ends = (bounds.get("lower", "") if ended else None, bounds.get("upper", "") if ended else None)
            self.numbers[name] = number
            self.labels |= {f"{name}_{axis}": name for axis in ("TX", "TY", "RZ") if kind == "planar"}
            self.limit(name, kind, *ends, bounds.get("velocity", ""), bounds.get("effort", ""))
            if joint.find("mimic") is not None:
                self.problems.add(f"joint {show(name)}", MIMIC)
        self.stop()
        floats = any(joint.get("type") == "floating" and _end(joint, "parent") == order[0] for joint in joints)
        base = next(link for link in links if link.get("name") == order[0])
        if floats and base.find("inertial") is not None and order[0] != "world":
            words = (
                "bears a floating joint, so that it is the world, but has mass: take its <inertial> or that joint away"
            )
            self.problems.add(f"link {show(order[0])}", words)
            self.stop()
        if floats and order[0] != "world":
            self.notes.append(f"link {show(order[0])}: bears a floating joint, so that it is the world")
        for element in root.iter() if floats else ():
            for key in ("name", "link"):
                if element.tag in ("link", "parent") and element.get(key) == order[0]:
                    element.set(key, "world")
        spec = self.mujoco.MjSpec.from_string(ET.tostring(root, encoding="unicode"))
        self.has_gravity, spec.option.gravity = gravity is not None, np.zeros(3) if gravity is None else gravity
        if not floats and order[0] != "world":
            spec.body(order[0]).add_freejoint()
        return spec


def _bounds(effort: str) -> bool:
    """Whether the text of an effort may be a limit: 0, a negative and an infinite number are none."""
    try:
        return 0.0 < float(effort) < math.inf
    except ValueError:
        return True


def _end(joint: ET.Element, tag: str) -> str:
    """Name of the link at an end of a joint; "" where there is none."""
    end = joint.find(tag)
    return "" if end is None else end.get("link", "")


def _mass(model: Any, i: int, written: Any) -> RigidMass:
    """Mass properties of a compiled body; an inertia that the file has as six numbers without their way over axes."""
    axes, place = _matrix(model.body_iquat[i]), Place()
    inertia = axes @ np.diag(model.body_inertia[i]) @ axes.T
    a, b, c, d, e, f = written.fullinertia
    full = Place(axes=_matrix(written.iquat)).mass(
        RigidMass(0.0, np.zeros(3), np.array([[a, d, e], [d, b, f], [e, f, c]]))
    )
    if np.abs(full.inertia - inertia).max() < 1e-9 * np.abs(inertia).max():  # false where it is not given, nan
        inertia = full.inertia
    return place.mass(RigidMass(float(model.body_mass[i]), np.array(model.body_ipos[i]), inertia))


def _is_massless(geom: Any) -> bool:
    return not (geom.density if np.isnan(geom.mass) else geom.mass)


def _matrix(quaternion: Array) -> Array:
    return np.asarray(Rotation.from_quat(quaternion, scalar_first=True).as_matrix())
