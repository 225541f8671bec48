"""Models of other programs as one tree of bodies on joints, and the XML that they stand in."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from mahovik.core.stand.files import readable
from mahovik.core.stand.masses import cross
from mahovik.core.stand.tables import Problems
from mahovik.core.stand.units import show
from mahovik.errors import ForeignError

Array = NDArray[np.float64]

KINDS = {"robot": "URDF", "mujoco": "MJCF", "sdf": "SDF"}
"""Formats by the root element of their files."""


@dataclass(frozen=True, eq=False)
class RigidMass:
    """Mass (kg), its centre (3, m) and the inertia about that centre (3x3, kg m2), in the axes of a frame."""

    mass: float
    center: Array
    inertia: Array


@dataclass(frozen=True, eq=False)
class Place:
    """A frame in another: origin (3, m) and axes (3x3: columns are its axes there)."""

    origin: Array = field(default_factory=lambda: np.zeros(3))
    axes: Array = field(default_factory=lambda: np.eye(3))

    def __matmul__(self, inner: Place) -> Place:
        """A frame given in this one, in the frame that this one is given in."""
        return Place(self.point(inner.origin), self.axes @ inner.axes)

    @property
    def inverse(self) -> Place:
        """The outer frame in this one."""
        return Place(-(self.axes.T @ self.origin), self.axes.T)

    def point(self, inside: Array) -> Array:
        """A point (3, m) of this frame in the outer one."""
        return self.origin + self.axes @ inside

    @property
    def twist(self) -> Array:
        """6x6: the twist of a body about this origin in these axes, by that about the outer origin in its axes."""
        turned = self.axes.T
        return np.block([[turned, -turned @ cross(self.origin)], [np.zeros((3, 3)), turned]])

    def mass(self, inside: RigidMass) -> RigidMass:
        """A body of this frame in the outer one."""
        inertia = self.axes @ inside.inertia @ self.axes.T
        return RigidMass(inside.mass, self.point(inside.center), (inertia + inertia.T) / 2)


@dataclass(frozen=True, eq=False)
class Joint:
    """What a body can do on its parent, by a coordinate q (rad or m) that is `zero` where the body is at its place.

    kind            "hinge", "slide", "ball", "free"
    axis, anchor    unit vector and a point of the axis (m), in the body's frame
    number          of the joint in the file: the order of flywheels
    damping, friction, stiffness    force or torque by speed, at any speed, by coordinate from `spring_zero`
    armature        inertia that acts on the coordinate's acceleration alone, kg m2 or kg
    range           least and largest coordinate; None without an end
    effort          largest force or torque of its drive; None without a limit
    label           its name in the file, where MuJoCo makes several joints of it
    """

    name: str
    label: str
    kind: str
    axis: Array
    anchor: Array
    number: int
    zero: float = 0.0
    damping: float = 0.0
    friction: float = 0.0
    stiffness: float = 0.0
    spring_zero: float = 0.0
    armature: float = 0.0
    range: tuple[float, float] | None = None
    effort: float | None = None

    def moved(self, way: float) -> Place:
        """Where the body is, in its own frame of before, after `way` of a hinge or slide."""
        if self.kind == "slide":
            return Place(self.axis * way)
        turned = np.asarray(Rotation.from_rotvec(self.axis * way).as_matrix())
        return Place(self.anchor - turned @ self.anchor, turned)

    @property
    def endless(self) -> bool:
        """Whether it can be the axis of a flywheel."""
        return self.kind == "hinge" and self.range is None and not self.stiffness


@dataclass(frozen=True, eq=False)
class Body:
    """A rigid body at `place` in its parent's frame, on joints one after another; fixed where it has none.

    `parent`: its name; "" is the world. `mass`: None where it has none. `added_mass`: of the fluid around it, 6x6 in
    its frame about its origin.
    """

    name: str
    parent: str
    place: Place
    mass: RigidMass | None
    joints: tuple[Joint, ...] = ()
    added_mass: Array | None = None


@dataclass(frozen=True, eq=False)
class Model:
    """A model as read: bodies, parents first, and named places on them (name, body, place there).

    noun        the format's word for a body
    gravity     m/s2; None: neither the format nor the user gives it
    notes       what is left out, one line each
    """

    name: str
    noun: str
    gravity: Array | None
    bodies: tuple[Body, ...]
    points: tuple[tuple[str, str, Place], ...]
    notes: tuple[str, ...]


def parsed_xml(path: Path) -> ET.Element:
    """The root element of a file. Raises ForeignError."""
    try:
        return ET.fromstring(readable(path, "an XML file"))
    except (ET.ParseError, LookupError) as error:  # an unknown encoding is a LookupError
        raise ForeignError([f"{path.name}: not XML: {error}"]) from None
    except ValueError as error:
        raise ForeignError([str(error)]) from None


def read_xml(path: Path) -> ET.Element:
    """The root element of a file of one of KINDS. Raises ForeignError."""
    root = parsed_xml(path)
    if root.tag not in KINDS:
        raise ForeignError([f"{path.name}: its root element is <{root.tag}>: expected one of {', '.join(KINDS)}"])
    if any("xacro" in element.tag for element in root.iter()):
        raise ForeignError([f"{path.name}: has xacro macros: run `xacro FILE > model.urdf` first"])
    return root


def left_out(root: ET.Element, read: Mapping[str, str], harmless: str) -> list[str]:
    """Notes of the elements that are not read, counted by their names.

    read        children that are read, by the name of the element
    harmless    names of what has no effect on the equations
    """
    without, unknown, inside = Counter[str](), Counter[str](), [root]
    for element in inside:  # grows as it goes
        for child in element:
            if child.tag in read[element.tag].split():
                inside += [child] if child.tag in read else []
            elif child.tag in harmless.split():
                without[child.tag] += 1
            else:
                unknown[f"<{child.tag}> in <{element.tag}>"] += 1
    counts = {"left out, without effect on the equations": without, "not read, and not known here": unknown}
    return [f"{words}: {', '.join(f'{n} {tag}' for tag, n in sorted(c.items()))}" for words, c in counts.items() if c]


def tree_order(noun: str, names: list[str], edges: list[tuple[str, str, str]], problems: Problems) -> list[str]:
    """Names of bodies, parents first, of a tree of edges (joint, parent, child); what it is instead is noted."""
    before, above = len(problems.lines), dict[str, str]()
    for what, listed in ((noun, names), ("joint", [joint for joint, _, _ in edges])):
        for name in dict.fromkeys(name for name in listed if listed.count(name) > 1):
            problems.add(f"{what} {show(name)}", "there are two of this name")
    for joint, parent, child in edges:
        for tag, end in (("parent", parent), ("child", child)):
            if end not in names:
                problems.add(f"joint {show(joint)}", tag, f"there is no {noun} {show(end)}")
        if child in above:
            problems.add(f"{noun} {show(child)}", f"is child of two joints, on {show(above[child])} and {show(parent)}")
        above[child] = parent
    order = [name for name in names if name not in above]
    if len(problems.lines) == before and len(order) != 1:
        roots = (
            f"{len(order)} {noun}s have no parent, {', '.join(map(show, order))}" if order else f"no {noun} is the root"
        )
        problems.add(f"{roots}: expected one root")
    for name in order:  # grows as it goes
        order += [child for child in names if above.get(child) == name]
    if len(problems.lines) == before and len(order) < len(names):
        problems.add("its joints close a loop")
    return order


def numbers(text: str | None, count: int) -> list[float]:
    """Exactly `count` finite numbers, separated by blanks. Raises ValueError, whose text says what was expected."""
    expected = "a number" if count == 1 else f"{count} numbers separated by blanks"
    try:
        result = [float(word) for word in (text or "").split()]
    except ValueError:
        result = []
    if len(result) != count:
        raise ValueError(f"expected {expected}, found {show(text or '')}")
    if not all(map(math.isfinite, result)):
        raise ValueError(f"{show(text)} is not finite")
    return result


def combined(parts: list[RigidMass]) -> RigidMass:
    """One rigid body of several in one frame. A single one is unchanged, to the last bit."""
    if len(parts) == 1:
        return parts[0]
    mass = sum(part.mass for part in parts)
    center, inertia = np.zeros(3), np.zeros((3, 3))
    with np.errstate(all="ignore"):  # what overflows is refused with the numbers of the stand
        center = sum((part.mass * part.center for part in parts), center) / (mass or 1.0)
        for part in parts:
            d = cross(part.center - center)
            inertia = inertia + part.inertia - part.mass * (d @ d)
    return RigidMass(float(mass), center, inertia)


def rows(matrix: Array) -> Any:
    """Rows of a matrix as a stand has them; None where it is zero."""
    return tuple(map(tuple, matrix.tolist())) if matrix.any() else None


def angles_of(axes: Array) -> tuple[float, float, float]:
    """psi, theta, phi, rad, of axes = C3(psi) C2(theta) C1(phi); as exact at theta = +-pi/2 as elsewhere."""
    psi = math.atan2(axes[1, 0], axes[0, 0])
    theta = math.atan2(-axes[2, 0], math.hypot(axes[0, 0], axes[1, 0]))
    s, c = math.sin(psi), math.cos(psi)
    # the rest of the rotation is about the first axis for any psi, which compensates rounding of psi
    phi = math.atan2(s * axes[0, 2] - c * axes[1, 2], c * axes[1, 1] - s * axes[0, 1])
    return psi + 0.0, theta + 0.0, phi + 0.0  # no negative zero
