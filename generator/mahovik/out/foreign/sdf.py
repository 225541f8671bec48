"""SDF, Gazebo's format, as an MjSpec: poses in frames of any name, models in models, models of other files."""

from __future__ import annotations

from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.core.stand.units import show
from mahovik.out.foreign.model import Array, Place, RigidMass, left_out, numbers, parsed_xml, read_xml, tree_order
from mahovik.out.foreign.reader import MIMIC, Reader

_READ = {
    "sdf": "model world include",
    "world": "model include gravity",
    "model": "link joint frame pose static model include",
    "include": "uri name pose static",
    "link": "pose inertial gravity velocity_decay",
    "velocity_decay": "linear angular",
    "inertial": "mass pose inertia fluid_added_mass",
    "fluid_added_mass": "xx xy xz xp xq xr yy yz yp yq yr zz zp zq zr pp pq pr qq qr rr",
    "inertia": "ixx ixy ixz iyy iyz izz",
    "frame": "pose",
    "joint": "parent child pose axis",
    "axis": "xyz limit dynamics mimic use_parent_model_frame",
    "limit": "lower upper effort velocity",
    "dynamics": "damping friction spring_reference spring_stiffness",
}
"""Children that are read, by the name of the element."""

_HARMLESS = (
    "visual collision sensor plugin light particle_emitter projector audio_source audio_sink battery self_collide "
    "enable_wind allow_auto_disable kinematic must_be_base_link physics scene gui atmosphere wind "
    "magnetic_field spherical_coordinates material actor state road population"
)
_KINDS = {"revolute": "HINGE", "continuous": "HINGE", "prismatic": "SLIDE", "ball": "BALL", "fixed": ""}
_TRUE = ("true", "1")

Files = tuple[Path, ...]
"""The file that a model stands in, after those that include it."""


class Sdf(Reader):
    """One SDF file, and those that it includes: of its models the only one that is not static.

    A name is that in its model, after the names of the models around it: "arm::hand". Of each frame `_frames` has the
    one that its pose is given in, and the pose there; `_attached` has what frames that are not links are fixed on.
    """

    noun = "link"

    def __init__(self, mujoco: Any, path: Path, root: ET.Element) -> None:
        super().__init__(mujoco, path, root)
        self._frames: dict[str, tuple[str, Place]] = {}
        self._attached: dict[str, str] = {}
        self._links: dict[str, ET.Element] = {}
        self._joints: dict[str, tuple[str, ET.Element]] = {}
        self._axes_in_model = root.get("version", "") in ("1.0", "1.2", "1.3", "1.4")

    def parsed(self, gravity: Array | None) -> Any:
        """The model as an MjSpec, free where no joint holds it on the world."""
        world = self.root.find("world")
        self.notes += left_out(self.root, _READ, _HARMLESS)
        models = self._models(self.root if world is None else world, (self.path.resolve(),))
        self.stop()
        moving = [candidate for candidate in models if not candidate[0].get("static")] or models
        if len(moving) != 1:
            names = "".join(f", {show(model.get('name'))}" for model, *_ in moving)
            self.problems.add(f"{len(moving) or 'no'} models move{names}: expected one")
        self.stop()
        ((model, files, pose),) = moving
        self._add(model, "", files, self._pose(pose, "world", ""))
        self.stop()
        edges = [
            (name, self._body(scope, element, "parent"), self._body(scope, element, "child"))
            for name, (scope, element) in self._joints.items()
        ]
        order = tree_order("link", list(self._links), [edge for edge in edges if edge[1] != "world"], self.problems)
        self.stop()

        spec = self.mujoco.MjSpec()
        spec.modelname, spec.compiler.degree = model.get("name", ""), False
        above = {child: (joint, parent) for joint, parent, child in edges}
        for link in order:
            joint, parent = above.get(link, ("", "world"))
            self._add_link(spec.body(parent), link, self._place(parent).inverse @ self._place(link))
            if joint:
                self._add_joint(spec.body(link), joint, self._place(link))
            elif not model.get("static"):
                spec.body(link).add_freejoint()
        for name in self._attached:
            if name not in self._joints and (link := self._fixed_on(name)) in self._links:
                at = self._place(link).inverse @ self._place(name)
                spec.body(link).add_site(name=name, pos=at.origin, quat=_quaternion(at))
        if world is not None and gravity is None:
            gravity = np.array(self._numbers(world.find("gravity"), "0 0 -9.8", "world, gravity"))
        self.has_gravity, spec.option.gravity = gravity is not None, np.zeros(3) if gravity is None else gravity
        self.stop()
        return spec

    # -- names and frames ----------------------------------------------------------------------------------------------

    def _models(self, element: ET.Element, inside: Files) -> list[tuple[ET.Element, Files, ET.Element | None]]:
        """Models in an element, those of other files among them: the model, its file, the pose that counts."""
        folder, models = inside[-1].parent, [(model, inside, model.find("pose")) for model in element.findall("model")]
        for include in element.findall("include"):
            uri = _text(include, "uri")
            name = uri.removeprefix("model://").removeprefix("file://").strip("/")
            files = [file for place in (folder, folder.parent) for file in _files_of(place / name)]
            if not files and element.tag == "world":
                self.notes.append(f"include {show(uri)}: left out of the world, since it is not there")
                continue
            if not name or "://" in name or not files:
                self.problems.add(f"include {show(uri)}", f"expected {name}/model.sdf in {folder} or beside it")
                continue
            model = read_xml(files[0]).find("model")
            if model is None or files[0] in inside:
                self.problems.add(f"include {show(uri)}", f"there is no other model in {files[0]}")
                continue
            self.notes += left_out(model, _READ, _HARMLESS)
            model.attrib |= {"merge": include.get("merge", ""), "name": _text(include, "name") or model.get("name", "")}
            pose = include.find("pose")
            models.append((model, (*inside, files[0]), model.find("pose") if pose is None else pose))
        for model, *_ in models:
            model.set("static", "yes" if _text(model, "static") in _TRUE else "")
        return models

    def _add(self, model: ET.Element, scope: str, files: Files, pose: tuple[str, Place]) -> None:
        """Frames, links and joints of a model at a pose; `scope` stands before its names."""
        frame = (
            f"{scope}__model__" if f"{scope}__model__" not in self._frames else f"{scope}__model__{len(self._frames)}"
        )
        self._frames[frame] = pose
        first = next((scope + link.get("name", "") for link in model.findall("link")), "")
        for element in (*model.findall("link"), *model.findall("joint"), *model.findall("frame")):
            name, base = scope + element.get("name", ""), frame
            if name in self._frames:
                self.problems.add(f"{element.tag} {show(name)}", "there are two of this name")
            if element.tag == "link":
                self._links[name] = element
            elif element.tag == "joint":
                self._joints[name] = scope, element
                self._attached[name] = base = scope + _text(element, "child")
            elif on := element.get("attached_to"):
                self._attached[name] = base = scope + on
            else:
                self._attached[name] = first
            self._frames[name] = self._pose(element.find("pose"), base, scope)
        for inner, inside_files, at in self._models(model, files):
            inside = scope if inner.get("merge") in _TRUE else f"{scope}{inner.get('name', '')}::"
            self._add(inner, inside, inside_files, self._pose(at, frame, scope))

    def _pose(self, element: ET.Element | None, base: str, scope: str) -> tuple[str, Place]:
        """The frame that a pose is given in, by default `base`, and the pose."""
        if element is None:
            return base, Place()
        quaternion = element.get("rotation_format") == "quat_xyzw"
        x = np.array(self._numbers(element, "0 0 0 0 0 0 1" if quaternion else "0 0 0 0 0 0", "pose"))
        turned = np.radians(x[3:]) if element.get("degrees") in _TRUE else x[3:]
        rotation = Rotation.from_quat(turned) if quaternion else Rotation.from_euler("xyz", turned)
        relative = element.get("relative_to")
        return scope + relative if relative else base, Place(x[:3], np.asarray(rotation.as_matrix()))

    def _place(self, frame: str, path: tuple[str, ...] = ()) -> Place:
        """A frame in the world."""
        if frame == "world":
            return Place()
        if frame not in self._frames or frame in path:
            self.problems.add(f"frame {show(frame)}", "is in a circle of frames" if frame in path else "is not there")
            self.stop()
        base, place = self._frames[frame]
        return self._place(base, (*path, frame)) @ place

    def _body(self, scope: str, joint: ET.Element, end: str) -> str:
        """The link at an end of a joint, or the world."""
        name = _text(joint, end)
        return name if name == "world" else self._fixed_on(scope + name)

    def _fixed_on(self, frame: str) -> str:
        """The link that a frame is fixed on."""
        for _ in self._attached:
            frame = self._attached.get(frame, frame)
        return frame

    # -- bodies and joints ---------------------------------------------------------------------------------------------

    def _add_link(self, parent: Any, link: str, place: Place) -> None:
        """A body; of a mass or moment that the file does not have SDF says 1 kg or 1 kg m2."""
        where, inertial = f"link {show(link)}", self._links[link].find("inertial")
        tensor = None if inertial is None else inertial.find("inertia")
        if inertial is not None and inertial.get("auto") in _TRUE:
            self.problems.add(where, "inertial", "auto: inertia of shapes is not known here: write it")
        if _text(self._links[link], "gravity") in ("false", "0"):
            self.notes.append(f"{where}: has no gravity there, but here all bodies have")
        decay = self._links[link].find("velocity_decay")
        if any(self._number(decay, key, 0.0, where) for key in ("linear", "angular")):
            self.notes.append(f"{where}: velocity_decay, a damping in some engines, is left out: see damping")
        if inertial is not None and (fluid := inertial.find("fluid_added_mass")) is not None:
            A = np.zeros((6, 6))
            for i, j in zip(*np.triu_indices(6), strict=True):
                A[i, j] = A[j, i] = self._number(fluid, "xyzpqr"[i] + "xyzpqr"[j], 0.0, where)
            self.added_mass[link] = A
        missing = [] if inertial is not None and inertial.find("mass") is not None else ["mass"]
        missing += [key for key in ("ixx", "iyy", "izz") if tensor is None or tensor.find(key) is None]
        if missing:
            self.notes.append(f"{where}: {', '.join(missing)} not in the file: 1 kg, 1 kg m2, the defaults of SDF")
        mass = self._number(inertial, "mass", 1.0, where)
        xx, yy, zz = (self._number(tensor, key, 1.0, where) for key in ("ixx", "iyy", "izz"))
        xy, xz, yz = (self._number(tensor, key, 0.0, where) for key in ("ixy", "ixz", "iyz"))
        scope = link.rpartition("::")[0]
        pose = None if inertial is None else inertial.find("pose")
        base, at = self._pose(pose, link, f"{scope}::" if scope else "")
        at = (self._place(link).inverse @ self._place(base) @ at) if base != link else at
        rigid_mass = at.mass(RigidMass(mass, np.zeros(3), np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])))
        body = parent.add_body(name=link, pos=place.origin, quat=_quaternion(place))
        body.explicitinertial, body.mass, body.ipos = True, mass, rigid_mass.center
        body.fullinertia = rigid_mass.inertia[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]

    def _add_joint(self, body: Any, name: str, place: Place) -> None:
        """The joint of a body whose link is at a place in the world."""
        (scope, element), where = self._joints[name], f"joint {show(name)}"
        kind, axis = _KINDS.get(element.get("type", "")), element.find("axis")
        self.numbers[name] = list(self._joints).index(name)
        if kind is None:
            self.problems.add(where, f"{element.get('type')}: expected one of {', '.join(_KINDS)}")
        if element.find("axis/mimic") is not None:
            self.problems.add(where, MIMIC)
        if not kind:
            return
        joint_place = self._place(name)
        joint = body.add_joint(name=name, pos=place.inverse.point(joint_place.origin))
        joint.type = getattr(self.mujoco.mjtJoint, f"mjJNT_{kind}")
        if kind == "BALL" or axis is None:
            return
        xyz = axis.find("xyz")
        frame = joint_place
        if xyz is not None and xyz.get("expressed_in"):
            frame = self._place(scope + xyz.get("expressed_in", ""))
        elif self._axes_in_model or _text(axis, "use_parent_model_frame") in _TRUE:
            frame = self._place(f"{scope}__model__")
        joint.axis = place.axes.T @ frame.axes @ self._numbers(xyz, "0 0 1", where)
        dynamics, limit = axis.find("dynamics"), axis.find("limit")
        joint.damping = [self._number(dynamics, "damping", 0.0, where), 0.0, 0.0]
        joint.frictionloss = self._number(dynamics, "friction", 0.0, where)
        joint.stiffness = [self._number(dynamics, "spring_stiffness", 0.0, where), 0.0, 0.0]
        joint.springref = self._number(dynamics, "spring_reference", 0.0, where)
        if limit is not None:
            lower, upper, velocity, effort = (_text(limit, key) for key in ("lower", "upper", "velocity", "effort"))
            lower, upper = (sign + "1e16" if not x or "inf" in x else x for sign, x in (("-", lower), ("", upper)))
            largest = self._number(limit, "effort", -1.0, where)
            effort = effort if largest >= 0.0 else ""  # -1 is the default, none
            self.limit(name, kind, lower, upper, velocity, effort)
            if largest > 0.0:
                joint.actfrcrange, joint.actfrclimited = [-largest, largest], True

    def _number(self, element: ET.Element | None, tag: str, default: float, where: str) -> float:
        """A number of a child; without it, or where it is infinite, the default."""
        child = None if element is None else element.find(tag)
        if child is None or "inf" in (child.text or ""):
            return default
        return self._numbers(child, f"{default}", f"{where}, {tag}")[0]

    def _numbers(self, element: ET.Element | None, default: str, where: str) -> list[float]:
        """Numbers of an element, as many as in the default, which applies where it is not there or empty."""
        text = "" if element is None else (element.text or "").strip()
        try:
            return numbers(text or default, len(default.split()))
        except ValueError as error:
            self.problems.add(where, str(error))
            return numbers(default, len(default.split()))


def _quaternion(place: Place) -> Array:
    return np.asarray(Rotation.from_matrix(place.axes).as_quat(scalar_first=True))


def _files_of(place: Path) -> list[Path]:
    """The file at a path; in a model's folder those that its model.config names, newest first, model.sdf, its one."""
    if place.is_file():
        return [place]
    config, single = place / "model.config", list(place.glob("*.sdf"))
    named = parsed_xml(config).findall("sdf") if config.is_file() else []
    named.sort(key=lambda sdf: (len(version := sdf.get("version", "")), version), reverse=True)  # 1.9 before 1.10
    files = [place / name for name in (*((sdf.text or "").strip() for sdf in named), "model.sdf")]
    return [file for file in (*files, *(single if len(single) == 1 else ())) if file.is_file()]


def _text(element: ET.Element, tag: str) -> str:
    """Text of a child; "" where there is none."""
    return (element.findtext(tag) or "").strip()
