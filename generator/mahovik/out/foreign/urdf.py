"""URDF -> ForeignModel: elements that affect the motion are read, others reported or refused."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np

from mahovik.core.stand.problems import Problems
from mahovik.core.stand.units import show
from mahovik.out.foreign.model import ForeignModel, Link, Place, RigidMass, Spin, rotation_from_rpy
from mahovik.out.foreign.xml import Attributes, read_xml

_REFUSED_JOINTS = {
    "prismatic": "prismatic: a flywheel turns, it does not slide",
    "revolute": "revolute, with an end to its turning: expected continuous, or fixed",
    "planar": "planar: a flywheel has one axis",
}
_SHORTEST = 1e-100
"""Largest component of an axis: below it squares vanish."""

_ORIGIN = [0.0, 0.0, 0.0]
_MOMENTS = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")


@dataclass(frozen=True, eq=False)
class _Joint:
    """A joint that was read, complete enough for the tree."""

    name: str
    type: str
    parent: str
    child: str
    place: Place
    spin: Spin | None


def read_urdf(path: Path) -> ForeignModel:
    """The model of a URDF file, with every problem found. Raises ForeignError if the file is not a URDF."""
    return _Reader(read_xml(path, "robot"), Problems(path.name)).model()


class _Reader:
    """One file."""

    def __init__(self, root: ET.Element, problems: Problems) -> None:
        self._root = root
        self.problems = problems
        self._attributes = Attributes(problems)
        self._notes: list[str] = []

    def model(self) -> ForeignModel:
        """The links in order, parents first; none unless the joints make a tree."""
        self._others()
        if not self._root.get("name"):
            self.problems.add("robot", "name", "required, but missing")
        masses = self._links()
        elements = enumerate(self._root.findall("joint"))
        joints = [joint for number, element in elements if (joint := self._joint(number, element)) is not None]
        free, links = self._tree(masses, joints)
        notes = tuple(dict.fromkeys(self._notes))
        name = self._root.get("name", "")
        return ForeignModel(name, "link", None, tuple(links), (), free, notes, tuple(self.problems.lines))

    def _others(self) -> None:
        """Report elements other than links and joints; refuse xacro macros."""
        tags = Counter(element.tag.rpartition("}")[2] for element in self._root)
        if any("xacro" in element.tag for element in self._root.iter()):
            self.problems.add("has xacro macros: run `xacro FILE > model.urdf` first")
        left = {tag: n for tag, n in tags.items() if tag not in ("link", "joint")}
        shapes = sum(len(link.findall(tag)) for link in self._root.findall("link") for tag in ("visual", "collision"))
        words = [f"{n} {tag}" for tag, n in sorted(left.items())]
        words += [f"{shapes} visual and collision shapes"] if shapes else []
        if words:
            self._notes.append(f"left out, without effect on the equations: {', '.join(words)}")

    # -- links ---------------------------------------------------------------------------------------------------------

    def _links(self) -> dict[str, RigidMass | None]:
        """Mass properties by link."""
        found: dict[str, RigidMass | None] = {}
        for number, element in enumerate(self._root.findall("link")):
            name = element.get("name")
            if not name:
                self.problems.add(f"link[{number}]", "name", "required, but missing")
            elif name in found:
                self.problems.add(f"link {show(name)}", "there are two of this name")
            else:
                found[name] = self._mass(element.find("inertial"), f"link {show(name)}, inertial")
        if not found:
            self.problems.add("has no link")
        return found

    def _mass(self, element: ET.Element | None, where: str) -> RigidMass | None:
        if element is None:
            return None
        mass = self._attributes.number(element.find("mass"), "value", None, where, "mass")
        tensor = element.find("inertia")
        if tensor is None:
            self.problems.add(where, "inertia", "required, but missing")
            return RigidMass(mass, np.zeros(3), np.eye(3))  # avoids further messages about the same problem
        xx, yy, zz, xy, xz, yz = (self._attributes.number(tensor, key, None, where, "inertia") for key in _MOMENTS)
        if mass < 0:
            self.problems.add(where, "mass", f"{mass:.17g} is negative")
        place = self._place(element.find("origin"), where)
        if not any((mass, xx, yy, zz, xy, xz, yz)):
            return None
        inertia = place.axes @ np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]) @ place.axes.T
        return RigidMass(mass, place.origin, (inertia + inertia.T) / 2)

    def _place(self, element: ET.Element | None, where: str) -> Place:
        """`<origin xyz rpy>`."""
        xyz = self._attributes.vector(element, "xyz", _ORIGIN, where, "origin")
        rpy = self._attributes.vector(element, "rpy", _ORIGIN, where, "origin")
        return Place(np.array(xyz), rotation_from_rpy(*rpy))

    # -- joints --------------------------------------------------------------------------------------------------------

    def _joint(self, number: int, element: ET.Element) -> _Joint | None:
        name, kind = element.get("name", ""), element.get("type", "")
        where = f"joint {show(name)}"
        ends = []
        for tag in ("parent", "child"):
            end = element.find(tag)
            ends.append("" if end is None else end.get("link", ""))
            if not ends[-1]:
                self.problems.add(where, tag, "required, but missing")
        if not name:
            self.problems.add("joint", "name", "required, but missing")
        if kind in _REFUSED_JOINTS:
            self.problems.add(where, _REFUSED_JOINTS[kind])
        elif kind not in ("fixed", "continuous", "floating"):
            self.problems.add(where, "type", f"expected fixed, continuous or floating, found {show(kind)}")
        if element.find("mimic") is not None:
            self.problems.add(where, "mimic: a flywheel cannot be coupled to another joint")
        if not all(ends):
            return None
        place = self._place(element.find("origin"), where)
        spin = self._spin(element, name, number, where) if kind == "continuous" else None
        return _Joint(name, kind, ends[0], ends[1], place, spin)

    def _spin(self, element: ET.Element, name: str, number: int, where: str) -> Spin:
        axis = self._attributes.vector(element.find("axis"), "xyz", [1.0, 0.0, 0.0], where, "axis")
        if max(map(abs, axis)) < _SHORTEST:
            self.problems.add(where, "axis", "xyz", f"{show(' '.join(map(str, axis)))} has no direction")
            axis = [1.0, 0.0, 0.0]
        dynamics, limit = element.find("dynamics"), element.find("limit")
        viscous = self._attributes.number(dynamics, "damping", 0.0, where, "dynamics")
        coulomb = self._attributes.number(dynamics, "friction", 0.0, where, "dynamics")
        endless = limit is not None and limit.get("effort", "").strip().lower() in ("inf", "+inf", "infinity")
        effort = 0.0 if endless else self._attributes.number(limit, "effort", 0.0, where, "limit")
        for key, value in (("damping", viscous), ("friction", coulomb), ("effort", effort)):
            if value < 0:
                self.problems.add(where, key, f"{value:.17g} is negative")
        if limit is not None and (limit.get("lower") is not None or limit.get("upper") is not None):
            self._notes.append(f"{where}: lower and upper limit say nothing of a continuous joint, and are left out")
        if limit is not None and limit.get("velocity") is not None:
            self._notes.append(f"{where}: its velocity limit {limit.get('velocity')} is left out: see motor.speed")
        left = [tag for tag in ("calibration", "safety_controller") if element.find(tag) is not None]
        if left:
            self._notes.append(f"{where}: {' and '.join(left)} left out")
        return Spin(name, number, np.array(axis), np.zeros(3), 0.0, viscous, coulomb, effort or None)

    # -- the tree ------------------------------------------------------------------------------------------------------

    def _tree(self, masses: dict[str, RigidMass | None], joints: list[_Joint]) -> tuple[bool | None, list[Link]]:
        """Links from the root on. A floating joint of the root means that its child is the free body."""
        if not masses:
            return None, []
        before = len(self.problems.lines)
        names: set[str] = set()
        above: dict[str, _Joint] = {}
        for joint in joints:
            where = f"joint {show(joint.name)}"
            if joint.name in names:
                self.problems.add(where, "there are two of this name")
            names.add(joint.name)
            for tag, end in (("parent", joint.parent), ("child", joint.child)):
                if end not in masses:
                    self.problems.add(where, tag, f"there is no link {show(end)}")
            if joint.child in above:
                self.problems.add(
                    f"link {show(joint.child)}", f"is child of two joints, {above[joint.child].name} and {joint.name}"
                )
            above[joint.child] = joint
        roots = [name for name in masses if name not in above]
        if len(self.problems.lines) == before and len(roots) != 1:
            found = (
                f"{len(roots)} links have no parent, {', '.join(map(show, roots))}" if roots else "no link is the root"
            )
            self.problems.add(f"{found}: expected one root")
        if len(self.problems.lines) > before:
            return None, []
        root = roots[0]
        floating = [joint for joint in joints if joint.type == "floating"]
        for joint in floating:
            if joint.parent != root or len([j for j in joints if j.parent == root]) > 1:
                self.problems.add(f"joint {show(joint.name)}", "floating: only the root may float, alone")
        if floating and len(self.problems.lines) == before:
            if masses[root] is not None:
                self._notes.append(
                    f"link {show(root)}: what floats is on it, so it is the world, and its mass has no effect"
                )
            root = floating[0].child
        free = (
            True if floating else False if root == "world" else None
        )  # links fixed on `world` stay fixed, by convention
        links = self._below(root, masses, joints)
        if len(self.problems.lines) == before and len(links) + bool(floating) != len(masses):
            self.problems.add("its joints close a loop")
        return free, links

    @staticmethod
    def _below(root: str, masses: dict[str, RigidMass | None], joints: list[_Joint]) -> list[Link]:
        children: dict[str, list[_Joint]] = {}
        for joint in joints:
            children.setdefault(joint.parent, []).append(joint)
        found = [Link(root, None, Place(np.zeros(3), np.eye(3)), masses[root])]
        for parent in found:  # grows as it goes
            found += [Link(j.child, j.parent, j.place, masses[j.child], j.spin) for j in children.get(parent.name, [])]
        return found
