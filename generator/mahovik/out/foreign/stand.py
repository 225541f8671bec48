"""A tree of bodies on joints as the text of a stand file, which says where each number came from.

Bodies fixed together are merged. One of the bodies that move on the world is the carrier, with what is fixed on it; its
joint there becomes `[hold]`, with springs, friction and stops of the joint. What turns on it without end is a flywheel.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from mahovik.core.stand import loads
from mahovik.core.stand.fields import name_problem, stand_name_problem
from mahovik.core.stand.files import toml_text
from mahovik.core.stand.hold import (
    FREEDOMS,
    Freedom,
    FreedomKind,
    Hold,
    coordinate_problem,
    freedom_names,
    is_closed,
    twists,
    wrenches,
)  # fmt: skip
from mahovik.core.stand.masses import cross, matrix3, vec3
from mahovik.core.stand.model import Carrier, Flywheel, Instrument, MountingAxes, Point, Stand, Vec3
from mahovik.core.stand.motor import Motor
from mahovik.core.stand.stand_file import document_of
from mahovik.core.stand.tables import Problems
from mahovik.core.stand.units import show
from mahovik.errors import ForeignError, StandError
from mahovik.nearest import suggestion
from mahovik.out.foreign.model import Array, Body, Joint, Model, Place, RigidMass, angles_of, combined, rows

LONGEST = 1000 * 2 * math.pi
"""rad: a range beyond it is none."""

FASTEST, FURTHEST = 0.02, math.radians(170.0)
"""s: in which a stop made of a range pushes back, since a range has no stiffness; rad: beyond it no stop is made."""

NEAR = 1e-12
"""Largest difference of directions, and of places (m), that is rounding."""


@dataclass(frozen=True)
class ImportedStand:
    """A stand and its origin.

    text        of the stand file
    carrier     body of the file whose frame is E1
    wheels      joint of each flywheel; an armature was added to its inertia about the axis, and taken from the carrier
    held        joints of the carrier on the world
    passive     names of those whose damping and springs are in the suspension
    fixed       names of joints that equal limits fix, and their coordinates
    armature    6x6 added mass of the carrier that the joints' armature is; the rest is that of the fluid
    notes       messages to the user, one line each
    """

    stand: Stand
    text: str
    carrier: str
    wheels: tuple[Joint, ...]
    held: tuple[Joint, ...]
    passive: tuple[str, ...]
    fixed: tuple[tuple[str, float], ...]
    armature: Array
    notes: tuple[str, ...]


def make_stand(
    model: Model,
    name: str,
    source: str,
    *,
    carrier: str | None = None,
    instruments: bool = False,
    armature: str | None = None,
    fix: Sequence[str] = (),
) -> ImportedStand:
    """The stand of a model, from the file `source`. Raises ForeignError with every reason against it.

    carrier      the body whose frame is E1, fixed to the one that moves; default that one
    instruments  keep bodies fixed on the carrier as bodies
    armature     "wheel": that of a flywheel's joint is inertia of the flywheel; None: it is refused
    fix          joints that are fixed where the file has them
    """
    return _Maker(model, name, source, instruments, armature).make(carrier, fix)


class _Maker:
    """One model."""

    def __init__(self, model: Model, name: str, source: str, instruments: bool, armature: str | None) -> None:
        self._model, self._name, self._source = model, name, source
        self._instruments, self._armature = instruments, armature
        self._problems = Problems(source)
        self._notes = list(model.notes)
        self._names, self._fixed = {"carrier"}, list[tuple[str, float]]()
        self._comments: dict[str, list[str]] = {}

    def make(self, chosen: str | None, fix: Sequence[str]) -> ImportedStand:
        """See make_stand."""
        known = [joint.label for body in self._model.bodies for joint in body.joints]
        for missing in sorted(set(fix) - set(known)):
            self._problems.add(f"fix={missing}: is no joint of the file{suggestion(missing, known)}")
        self._bodies = {body.name: self._settled(body, fix) for body in self._model.bodies}
        self._merge_massless()
        self._group()
        root = self._root(chosen)
        self._stop()
        frame = chosen or root
        self._members = [name for name, head in self._heads.items() if head == root]
        self._place(root, frame)
        turning = [body for body in self._bodies.values() if body.joints and body.name != root]
        turning.sort(key=lambda body: body.joints[0].number)
        for body in turning:
            self._check_flywheel(body, root)
        if not self._has_mass(root):
            self._problems.add(self._words(root), "has no mass and no inertia, nor has what is fixed on it")
        self._stop()
        hold, tables, inertia, passive = self._hold(self._bodies[root])
        self._stop()

        names = [name for name in self._members if self._bodies[name].mass is not None and name != frame]
        kept = names if self._instruments else []
        merged = [name for name in self._members if name not in kept]
        self._comments["carrier"] = [f"Frame: that of {self._words(frame)}.", self._sources(merged)]
        mass = self._mass(merged, Place(), self._places)
        for body in turning:
            joint, axes = body.joints[0], self._places[body.name].axes
            mass = replace(mass, inertia=mass.inertia - _disc(joint.armature, axes @ joint.axis))
            moments = np.linalg.eigvalsh(mass.inertia)
            if joint.armature and moments[0] + moments[1] < (1.0 - 1e-9) * moments[2]:  # as no body has
                words = f"armature {joint.armature:g}: a thin disc of it has more inertia in its plane than the carrier"
                self._problems.add(f"joint {show(joint.label)}", f"{words}; write it into that of the wheel's body")
        self._stop()
        instruments, flywheels = tuple(map(self._instrument, kept)), tuple(map(self._flywheel, turning))
        if driven := ", ".join(show(wheel.name) for wheel in flywheels if wheel.motor):
            self._notes.append(f"friction and limits of {driven} act in `mahovik simulate`, not in the equations")
        if not flywheels:
            self._notes.append("nothing turns without end on the carrier: the stand has no flywheels")
        if self._model.gravity is None:
            self._notes.append("the format has no gravity: it is 0; gravity=0,0,-9.81 gives one")
        pull = np.zeros(3) if self._model.gravity is None else self._model.gravity
        carrier = Carrier(name="carrier", **_properties(mass), added_mass=rows(inertia + self._fluid()))
        points = self._points(frame)
        stand = Stand(self._name, "ship", _vec3(pull), None, carrier, instruments, flywheels, points, hold=hold)
        self._notes = list(dict.fromkeys(self._notes))  # of the three joints that MuJoCo makes of a planar one
        head = [f"Made from {self._source} by `mahovik new`. SI units.", *self._notes]
        head = [line.replace("; gravity=", "; --gravity ") for line in head]  # as on the command line
        text = _text(stand, tables, self._comments, head)
        try:
            stand = loads(text, self._source)
        except StandError as error:
            raise ForeignError(error.problems) from None
        wheels, held = tuple(body.joints[0] for body in turning), self._bodies[root].joints
        return ImportedStand(stand, text, frame, wheels, held, passive, tuple(self._fixed), inertia, tuple(self._notes))

    @property
    def _noun(self) -> str:
        return self._model.noun

    def _words(self, body: str) -> str:
        return f"{self._noun} {show(body)}"

    def _stop(self) -> None:
        """Raises ForeignError if there are problems."""
        if self._problems.lines:
            raise ForeignError(self._problems.lines)

    # -- joints and bodies ---------------------------------------------------------------------------------------------

    def _settled(self, body: Body, fix: Sequence[str]) -> Body:
        """The body with joints that move: without those that are fixed, by equal limits or by the user."""
        place, joints = body.place, []
        for joint in body.joints:
            least, most = joint.range or (-math.inf, math.inf)
            if joint.label in fix:
                self._notes.append(f"joint {show(joint.label)}: fixed where the file has it")
            elif least == most:
                self._notes.append(f"joint {show(joint.label)}: its limits are equal: it is fixed at {least:g}")
                self._fixed.append((joint.name, least))
                place = place @ joint.moved(least - joint.zero)
            else:
                without_end = joint.kind == "hinge" and most - least > LONGEST
                joints.append(replace(joint, range=None) if without_end else joint)
        return replace(body, place=place, joints=tuple(joints))

    def _merge_massless(self) -> None:
        """Joints of a body without mass, which bears one other on joints, become those of the other."""
        for body in (self._bodies[name] for name in list(self._bodies)):
            above = [other for other in self._bodies.values() if other.parent == body.name]
            turning = body.joints and all(joint.kind != "free" for joint in body.joints)
            if turning and body.mass is None and len(above) == 1 and above[0].joints:
                (other,) = above
                back = other.place.inverse
                moved = [replace(j, axis=back.axes @ j.axis, anchor=back.point(j.anchor)) for j in body.joints]
                del self._bodies[body.name]
                place = body.place @ other.place
                self._bodies[other.name] = replace(
                    other, parent=body.parent, place=place, joints=(*moved, *other.joints)
                )

    def _group(self) -> None:
        """Head of the bodies fixed together, on joints or on the world, by name, and the place of each in its frame."""
        self._heads: dict[str, str] = {}
        self._at: dict[str, Place] = {}
        for body in self._bodies.values():  # parents first
            first = bool(body.joints) or not body.parent
            self._heads[body.name] = body.name if first else self._heads[body.parent]
            self._at[body.name] = Place() if first else self._at[body.parent] @ body.place

    def _root(self, chosen: str | None) -> str:
        """Head of the bodies that are the carrier; "" where none are, which is noted.

        It is what moves on the world, and bears what moves or is not a flywheel itself. What is fixed on the world is
        the carrier, clamped, where flywheels alone turn on it.
        """
        bodies, heads = self._bodies, self._heads
        below = {name: heads.get(bodies[name].parent, "") for name in dict.fromkeys(heads.values())}
        still = [name for name in below if not bodies[name].joints]
        moving = [name for name in below if bodies[name].joints and below[name] in ("", *still)]
        plain = [name for name in moving if len(bodies[name].joints) == 1 and bodies[name].joints[0].endless]
        bearing = [name for name in moving if name not in plain or name in below.values()]
        if chosen is not None and chosen not in bodies:
            self._problems.add(f"carrier={chosen}: is not in the file{suggestion(chosen, list(bodies))}")
            return ""
        roots = bearing or [name for name in moving if not below[name]] or [below[name] for name in moving]
        if chosen is not None and heads[chosen] in (*still, *moving):
            roots = [heads[chosen]]
        if len(set(roots)) != 1:
            listed = "".join(f", {show(name)}" for name in dict.fromkeys(roots))
            self._problems.add(f"{len(set(roots)) or 'no'} bodies move on the world{listed}: expected one, the carrier")
            return ""
        root = roots[0]
        for name in moving:
            if root not in (name, below[name]):
                self._problems.add(self._words(name), f"moves on the world, as the carrier {show(root)}: expected one")
        if chosen is not None and heads[chosen] != root:
            words = f"turns, expected {show(root)} or a {self._noun} that is fixed to it"
            self._problems.add(f"carrier={chosen}: {words}")
        if left := [name for name, head in heads.items() if head in still and head != root]:
            self._notes.append(f"left out, since it does not move of the world: {', '.join(left)}")
        parent, place = bodies[root].parent, bodies[root].place
        self._on_world = bodies[below[root]].place @ self._at[parent] @ place if parent else place
        return root

    def _place(self, root: str, frame: str) -> None:
        """Places in E1 of the bodies on the carrier, where the file has them; that of the frame is E1."""
        self._places = {name: self._at[frame].inverse @ self._at[name] for name in self._members}
        for body in self._bodies.values():
            if body.name not in self._places and body.parent in self._places:
                self._places[body.name] = self._places[body.parent] @ body.place

    def _check_flywheel(self, body: Body, root: str) -> None:
        """Note the first reason against a flywheel, and what becomes of its armature."""
        joint, head = body.joints[0], self._heads[body.parent]
        least, most = joint.range or (0.0, 0.0)
        held = "; a root that is held, and not free, is called world" if self._noun == "link" else ""
        fix = f"; fix={joint.label} imports it where it is"
        reasons = (
            (head != root, f"turns on {self._words(head)}, which turns itself: expected the carrier{held}"),
            (len(body.joints) > 1, f"{self._words(body.name)} has {len(body.joints)} freedoms: a flywheel has one"),
            (joint.kind != "hinge", f"{joint.kind}: a flywheel turns about one axis, as a hinge does{fix}"),
            (joint.range, f"turns from {least:g} to {most:g}: a flywheel turns without end{fix}"),
            (joint.stiffness, f"stiffness {joint.stiffness:g}: a flywheel has no spring{fix}"),
            (not self._has_mass(body.name), f"{self._words(body.name)} turns, but has no mass and no inertia"),
            (
                joint.armature and self._armature is None,
                f"armature {joint.armature:g} is inertia without a body: armature=wheel makes it the flywheel's",
            ),
        )
        where = f"joint {show(joint.label)}"
        if reason := next((words for against, words in reasons if against), None):
            self._problems.add(where, reason)
        elif joint.armature:
            self._notes.append(
                f"{where}: its armature {joint.armature:g} kg m2 is a thin disc on the flywheel, taken from the "
                "carrier: its spin turns the carrier, which that of the file does not"
            )

    def _has_mass(self, head: str) -> bool:
        return any(self._bodies[name].mass for name, other in self._heads.items() if other == head)

    # -- what holds the carrier ----------------------------------------------------------------------------------------

    def _hold(self, root: Body) -> tuple[Hold | None, dict[str, Any], Array, tuple[str, ...]]:
        """The hold; tables of its springs, friction and stops; armature; joints whose damping and springs these are.

        What a joint does on its coordinate is a law of the stand where that coordinate is one of the hold too, or where
        it does the same in every direction.
        """
        home = spring = self._on_world
        for joint in root.joints:
            home, spring = home @ joint.moved(-joint.zero), spring @ joint.moved(joint.spring_zero - joint.zero)
        home, spring = home @ self._places[root.name].inverse, spring @ self._places[root.name].inverse
        ways = [
            (joint, kind, *self._in_carrier(root.name, axis, joint))
            for joint in root.joints
            for kind, axis in _freedoms_of(joint)
        ]
        hold, signs = _hold_of([way[1:] for way in ways], home)
        names = ", ".join(dict.fromkeys(show(joint.label) for joint in root.joints))
        if not is_closed(hold):
            words = "together no directions fixed in the carrier"
            expected = "expected one, slides, a plane, three hinges through a point"
            self._problems.add(f"joints {names}", f"{words}: {expected}")
            return None, {}, np.zeros((6, 6)), ()
        is_free = len(ways) == 6
        sayable = [
            joint.kind == "ball"
            or (joint.kind == "free" and not joint.stiffness)
            or (coordinate_problem(hold, k) is None and not is_free)
            for k, (joint, *_) in enumerate(ways)
        ]
        W = wrenches(hold)
        tensors = {
            key: W @ np.diag([getattr(joint, key) * ok for (joint, *_), ok in zip(ways, sayable, strict=True)]) @ W.T
            for key in ("stiffness", "damping", "armature")
        }
        friction, stops = [], []
        for k, ((joint, kind, *_), expressible) in enumerate(zip(ways, sayable, strict=True)):
            where, name = f"joint {show(joint.label)}", freedom_names(hold)[k]
            ends = sorted(signs[k] * np.array(joint.range or ()))
            stopped = (
                ends and expressible and (kind == "slide" or max(map(abs, ends)) < FURTHEST) and joint.kind != "ball"
            )
            if joint.armature and not expressible:
                self._problems.add(where, "armature: inertia without a body")
            if joint.friction and expressible and not is_free:
                friction.append({"freedom": name, "coulomb": joint.friction})
            for at, side in zip(ends, ("below", "above"), strict=True) if stopped else ():
                stiffness = self._inertia(twists(hold)[:, k]) / FASTEST**2
                stops.append({"freedom": name, "at": float(at), "side": side, "stiffness": stiffness})
            if stopped:
                words = f"its range is two stops, whose stiffness is chosen here: {FASTEST:g} s to stop"
                self._notes.append(f"{where}: {words}")
            left_out = {
                "damping": joint.damping and not expressible,
                "stiffness": joint.stiffness and not expressible,
                "friction": joint.friction and (is_free or not expressible),
                "range": joint.range and not stopped,
                "effort": joint.effort,
            }
            unsaid = ", ".join(key for key, is_left in left_out.items() if is_left)
            note = f"{where}: {unsaid} left out: no law of a hold says it"
            if unsaid:
                self._notes.append(note)
        tables: dict[str, Any] = {}
        if tensors["stiffness"].any() or tensors["damping"].any():
            matrices = {key: _diagonal_or_rows(tensors[key]) for key in ("stiffness", "damping") if tensors[key].any()}
            tables["suspension"] = matrices | {"position": _vec3(spring.origin), "angles": angles_of(spring.axes)}
            self._comments["suspension"] = [f"Springs and damping of {names}."]
        tables["hold"] = {"friction": friction, "stop": stops}
        if not is_free:
            self._comments["hold"] = [
                f"{names} on the world." if ways else "Fixed on the world; without [hold] it is free."
            ]
        passive = tuple(joint.name for (joint, *_), ok in zip(ways, sayable, strict=True) if ok)
        return None if is_free else hold, tables, tensors["armature"], passive

    def _in_carrier(self, root: str, axis: Array, joint: Joint) -> tuple[Array, Array]:
        """Direction and anchor of a way in E1; those of three at once are along its axes."""
        single = joint.kind in ("hinge", "slide")
        return _snapped(self._places[root].axes @ axis) if single else axis, self._places[root].point(joint.anchor)

    def _inertia(self, twist: Array) -> float:
        """Mass or moment of inertia of the whole stand, flywheels at rest, that moves along a twist in E1."""
        whole = self._mass(list(self._places), Place(), self._places)
        v = twist[:3] + np.cross(twist[3:], whole.center)
        return float(whole.mass * (v @ v) + twist[3:] @ whole.inertia @ twist[3:])

    # -- the bodies of the stand ---------------------------------------------------------------------------------------

    def _mass(self, names: Sequence[str], back: Place, at: Mapping[str, Place]) -> RigidMass:
        """Mass properties of bodies together; `at`: their places in a frame, which `back` turns into another."""
        masses = [(back @ at[name], self._bodies[name].mass) for name in names]
        return combined([place.mass(mass) for place, mass in masses if mass is not None])

    def _fluid(self) -> Array:
        """Added mass (6x6) of the fluid around the carrier, in E1 about O1; that around flywheels is noted."""
        result = np.zeros((6, 6))
        for body in self._bodies.values():
            if body.added_mass is not None and body.name in self._members:
                X = self._places[body.name].twist
                result += X.T @ body.added_mass @ X
            elif body.added_mass is not None:
                self._notes.append(f"{self._words(body.name)}: fluid_added_mass left out: a flywheel has none")
        if result.any():
            self._notes.append("fluid_added_mass is added_mass of the carrier, and not in MuJoCo's model of the file")
        return result

    def _instrument(self, body: str) -> Instrument:
        mass, at = self._bodies[body].mass, self._places[body]
        assert mass is not None
        name = self._unique_name(body, "instrument")
        self._comments[name] = [f"{self._words(body).capitalize()}, fixed on the carrier."]
        place: dict[str, Any] = {"position": _vec3(at.origin), "angles": angles_of(at.axes)}
        return Instrument(name=name, **_properties(mass), **place, added_mass=None)

    def _flywheel(self, body: Body) -> Flywheel:
        """A flywheel, whose phase is the coordinate of its joint."""
        (joint,), at = body.joints, self._places[body.name]
        name = self._unique_name(body.name, "flywheel")
        axis, across = joint.axis, np.eye(3)[(int(np.argmax(np.abs(joint.axis))) + 1) % 3]
        second = across - (across @ axis) * axis
        second = second / np.linalg.norm(second)
        place = Place(joint.anchor, np.column_stack([axis, second, np.cross(axis, second)]))
        members = [name for name, head in self._heads.items() if head == body.name]
        mass = self._mass(members, place.inverse, self._at)
        mass = replace(mass, inertia=mass.inertia + _disc(joint.armature, np.eye(3)[0]))
        zero = (at @ joint.moved(-joint.zero)).axes @ second
        motor, sources = None, {"viscous": joint.damping, "coulomb": joint.friction, "torque": joint.effort}
        if any(sources.values()):
            motor = Motor(joint.effort, None, None, None, None, joint.damping, joint.friction, 0.1)
        self._comments[name] = [
            f"{self._words(body.name).capitalize()} on joint {show(joint.label)}, whose coordinate is the phase.",
            self._sources(members),
            *([f"Motor: {', '.join(key for key, x in sources.items() if x)} of the joint."] if motor else []),
        ]
        return Flywheel(
            name=name,
            **_properties(mass),
            mount="carrier",
            position=_vec3(at.point(joint.anchor)),
            mounting=MountingAxes(_vec3(at.axes @ axis), _vec3(zero)),
            motor=motor,
            encoder=None,
        )

    def _points(self, carrier: str) -> tuple[Point, ...]:
        """Named places, and bodies without mass, on the carrier."""
        empty = [name for name in self._members if not self._bodies[name].mass and name != carrier]
        placed = [(name, self._places[name]) for name in empty if self._bodies[name].parent]
        placed += [(name, self._places[on] @ at) for name, on, at in self._model.points if on in self._members]
        if turning := [name for name, on, _ in self._model.points if on not in self._members]:
            self._notes.append(f"left out, since they are not on the carrier: {', '.join(turning)}")
        points = []
        for theirs, at in placed:
            name = self._unique_name(theirs, "point")
            self._comments[name] = [f"{theirs}, fixed on the carrier, without mass."]
            points.append(Point(name, "carrier", _vec3(at.origin), angles_of(at.axes)))
        return tuple(points)

    def _sources(self, bodies: Sequence[str]) -> str:
        """Comment that names the bodies that mass properties are of."""
        listed = [name for name in bodies if self._bodies[name].mass is not None]
        merged = ", merged" if len(listed) > 1 else ""
        return f"Mass, centre of mass, inertia: {', '.join(listed)}{merged}." if listed else "Without mass."

    def _unique_name(self, theirs: str, kind: str) -> str:
        """A name that no other body or point has; a change is noted."""
        plain = identifier(theirs, kind)
        if name_problem(plain) is not None:
            plain += "_"
        name, number = plain, 2
        while name in self._names:
            name, number = f"{plain}_{number}", number + 1
        self._names.add(name)
        if name != theirs:
            self._notes.append(f"{show(theirs)} is called {show(name)}: names become C identifiers")
        return name


def _text(stand: Stand, tables: dict[str, Any], comments: Any, head: Sequence[str]) -> str:
    """The stand file, with tables that are in no class of the stand."""
    document = document_of(stand)
    bodies = {key: document.pop(key) for key in ("instrument", "flywheel", "point") if key in document}
    if "suspension" in tables:
        document["suspension"] = tables["suspension"]
    if "hold" in document:
        document["hold"] = document.pop("hold") | {key: x for key, x in tables["hold"].items() if x}
    lines = {name: list(map(_one_line, lines)) for name, lines in comments.items()}
    return "\n".join(f"# {_one_line(line)}" for line in head) + "\n" + toml_text(document | bodies, lines)


def _diagonal_or_rows(matrix: Array) -> Any:
    """A 6x6 as its diagonal, where it is one."""
    diagonal = np.diag(matrix)
    return (diagonal if np.array_equal(matrix, np.diag(diagonal)) else matrix).tolist()


def _one_line(text: str) -> str:
    """A comment cannot hold line ends or control characters, which names of other programs may have."""
    return "".join(c if c.isprintable() else " " for c in text)


def stand_name(name: str) -> str:
    """The name of a model as the name of a stand."""
    plain = identifier(name, "stand")
    if plain.startswith("_"):
        return f"stand{plain}"
    return f"{plain}_" if stand_name_problem(plain) is not None else plain


def identifier(name: str, fallback: str) -> str:
    """Letters, digits and _ of a name, which does not begin with a digit."""
    plain = re.sub(r"[^A-Za-z0-9_]+", "_", name).strip("_")[:60]
    return f"_{plain}" if plain[:1].isdigit() else plain or fallback


def _freedoms_of(joint: Joint) -> list[tuple[FreedomKind, Array]]:
    """What a joint leaves free: kind and direction of each freedom."""
    slides: list[tuple[FreedomKind, Array]] = [("slide", axis) for axis in np.eye(3)]
    turns: list[tuple[FreedomKind, Array]] = [("turn", axis) for axis in np.eye(3)]
    literal: FreedomKind = "slide" if joint.kind == "slide" else "turn"
    return {"free": [*slides, *turns], "ball": turns}.get(joint.kind, [(literal, joint.axis)])


def _hold_of(ways: Sequence[tuple[FreedomKind, Array, Array]], home: Place) -> tuple[Hold, Array]:
    """The hold of freedoms (kind, direction, anchor) in E1, and the sign of each coordinate in it.

    Several are called by the axes of E1, where they are along these and what turns turns about one point; else they are
    a basis.
    """
    turns = [(axis, anchor) for kind, axis, anchor in ways if kind == "turn"]
    pivot, apart = turns[0][1] if turns else np.zeros(3), 0.0
    if len(turns) > 1:
        A = np.concatenate([cross(axis) for axis, _ in turns])
        b = np.concatenate([cross(axis) @ (anchor - pivot) for axis, anchor in turns])
        pivot = pivot + np.linalg.lstsq(A, b, rcond=None)[0]
        apart = float(max(np.linalg.norm(cross(axis) @ (anchor - pivot)) for axis, anchor in turns))
    signs = np.array([1.0 if len(ways) == 1 else np.sign(axis.sum()) for _, axis, _ in ways])
    freedoms = [Freedom(kind, _vec3(s * axis)) for s, (kind, axis, _) in zip(signs, ways, strict=True)]
    if len(ways) > 1 and (apart > NEAR or not set(freedoms) <= set(FREEDOMS.values())):
        columns = [np.r_[axis, 0, 0, 0] if k == "slide" else np.r_[np.cross(at, axis), axis] for k, axis, at in ways]
        freedoms = [Freedom("twist", twist=(a, b, c, d, e, f)) for a, b, c, d, e, f in map(np.ndarray.tolist, columns)]
        signs, pivot = np.ones(len(ways)), np.zeros(3)
    return Hold(tuple(freedoms), _vec3(pivot), _vec3(home.origin), angles_of(home.axes)), signs


def _disc(moment: float, axis: Array) -> Array:
    """Inertia (3x3) of a thin disc by its moment about its axis, the least body that has this moment."""
    return moment * (np.eye(3) + np.outer(axis, axis)) / 2


def _snapped(axis: Array) -> Array:
    """An axis of E1 where it is one but for rounding."""
    nearest = np.round(axis)
    return nearest if np.abs(axis - nearest).max() < NEAR else axis


def _properties(mass: RigidMass) -> dict[str, Any]:
    """Fields of a body of the stand."""
    return {
        "mass": float(mass.mass),
        "center_of_mass": _vec3(mass.center),
        "inertia": matrix3(mass.inertia + 0.0),
        "inertia_about": "center_of_mass",
        "wrench_input": False,
    }


def _vec3(array: Array) -> Vec3:
    return vec3(np.asarray(array) + 0.0)  # no negative zero
