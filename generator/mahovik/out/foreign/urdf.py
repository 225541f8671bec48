"""URDF by MuJoCo's parser; what that does not know the XML tells: limits, order, mimic, what is not read."""

from __future__ import annotations

from typing import Any
from xml.etree import ElementTree as ET

import numpy as np

from mahovik.core.stand.units import show
from mahovik.out.foreign.model import Array, left_out, tree_order
from mahovik.out.foreign.reader import MIMIC, Reader

_URDF = {
    "robot": "link joint mujoco",
    "link": "inertial origin",
    "inertial": "origin mass inertia",
    "joint": "origin parent child axis limit dynamics mimic",
}
"""Children that are read, by the name of the element."""
_URDF_HARMLESS = "visual collision material transmission gazebo sensor calibration safety_controller ros2_control"

_KINDS = ("revolute", "continuous", "prismatic", "planar", "floating", "fixed")


class Urdf(Reader):
    """One URDF."""

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
            if kind not in _KINDS:
                self.problems.add(f"joint {show(name)}", f"type {show(kind)}: expected one of {', '.join(_KINDS)}")
            bounds = {} if limit is None else limit.attrib
            ended = kind in ("revolute", "prismatic")
            ends = (bounds.get("lower", "") if ended else None, bounds.get("upper", "") if ended else None)
            self.numbers[name] = number
            self.limit(name, kind, *ends, bounds.get("velocity", ""), bounds.get("effort", ""))
            if joint.find("mimic") is not None:
                self.problems.add(f"joint {show(name)}", MIMIC)
        self.stop()
        floats = any(joint.get("type") == "floating" and _end(joint, "parent") == order[0] for joint in joints)
        for element in root.iter() if floats else ():  # what a body floats on is the world
            for key in ("name", "link"):
                if element.tag in ("link", "parent") and element.get(key) == order[0]:
                    element.set(key, "world")
        spec = self.mujoco.MjSpec.from_string(ET.tostring(root, encoding="unicode"))
        self.has_gravity, spec.option.gravity = gravity is not None, np.zeros(3) if gravity is None else gravity
        if not floats and order[0] != "world":
            spec.body(order[0]).add_freejoint()
        return spec


def _end(joint: ET.Element, tag: str) -> str:
    """Name of the link at an end of a joint; "" where there is none."""
    end = joint.find(tag)
    return "" if end is None else end.get("link", "")
