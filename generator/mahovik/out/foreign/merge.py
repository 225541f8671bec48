"""ForeignModel -> Stand: fixed links are merged, links that turn on the carrier are flywheels."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, cast

import numpy as np

from mahovik.core.stand.fields import Mat3
from mahovik.core.stand.model import Body, Carrier, Flywheel, Instrument, Motor, MountingAxes, Point, Stand, Vec3
from mahovik.core.stand.physical import LARGEST, check_body
from mahovik.core.stand.problems import Problems
from mahovik.core.stand.units import show
from mahovik.errors import ForeignError
from mahovik.nearest import suggestion
from mahovik.out.foreign.model import (
    Array,
    ForeignModel,
    Link,
    Place,
    RigidMass,
    Spin,
    angles_of,
    direction_across,
    rotation_about,
    spin_axes,
)
from mahovik.out.foreign.naming import Names

_HERE = Place(np.zeros(3), np.eye(3))


@dataclass(frozen=True)
class ImportedStand:
    """A stand and its origin.

    `comments`: lines above the table of a body or point, by name; `notes`: messages to the user, one line each;
    `carrier`: the link whose frame is E1, at `place` in the frame of the first link; `joints`, `numbers`:
    name and place in the file of the joint of each flywheel.
    """

    stand: Stand
    carrier: str
    place: Place
    joints: tuple[str, ...]
    numbers: tuple[int, ...]
    comments: dict[str, list[str]] = field(default_factory=dict)
    notes: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class _Group:
    """Links that are one rigid body, each with its place in the frame of the first."""

    members: dict[str, tuple[Link, Place]]

    def merge(self, base: Place = _HERE, without: Sequence[str] = ()) -> RigidMass:
        """Mass, centre, central inertia of all in a frame, in which the first link is at `base`."""
        return combine_masses(
            [
                move_mass(link.mass, base @ place)
                for link, place in self.members.values()
                if link.mass is not None and link.name not in without
            ]
        )


def combine_masses(parts: Sequence[RigidMass]) -> RigidMass:
    """One rigid body from several, all given in one frame. A single one is unchanged, to the last bit."""
    if len(parts) == 1:
        return parts[0]
    mass = sum(part.mass for part in parts)
    with np.errstate(all="ignore"):  # overflow is refused with the body's other numbers
        center = sum((part.mass * part.center for part in parts), np.zeros(3))
        center = center / mass if mass else center
        inertia = np.zeros((3, 3))
        for part in parts:
            d = part.center - center
            inertia = inertia + part.inertia + part.mass * ((d @ d) * np.eye(3) - np.outer(d, d))
    return RigidMass(float(mass), center, inertia)


def move_mass(part: RigidMass, place: Place) -> RigidMass:
    """The same body in the frame that `place` is given in."""
    inertia = place.axes @ part.inertia @ place.axes.T
    return RigidMass(part.mass, place.origin + place.axes @ part.center, (inertia + inertia.T) / 2)


def make_stand(
    model: ForeignModel,
    name: str,
    source: str,
    *,
    carrier: str | None = None,
    gravity: Array | None = None,
    instruments: bool = False,
) -> ImportedStand:
    """The stand of a model. Raises ForeignError with every reason against it.

    `carrier`: the link whose frame is E1, one that is fixed to the first; default the first. `gravity`, m/s2 in E0:
    for a format without it. `instruments`: keep bodies fixed on the carrier as separate bodies.
    """
    return _Merger(model, name, source, gravity, instruments).stand(carrier)


class _Merger:
    """One model."""

    def __init__(self, model: ForeignModel, name: str, source: str, gravity: Array | None, instruments: bool) -> None:
        self._model = model
        self._name = name
        self._problems = Problems(source, list(model.problems))
        self._gravity = gravity
        self._instruments = instruments
        self._names = Names()
        self._comments: dict[str, list[str]] = {}
        self._notes: list[str] = list(model.notes)

    def stand(self, chosen: str | None) -> ImportedStand:
        """See stand_of."""
        if not self._model.links:
            raise ForeignError(self._problems.lines)
        self._check_masses()
        first = self._model.links[0]
        groups = self._groups()
        on_carrier = groups[first.name]
        base = self._base(chosen, on_carrier)
        if self._model.free is False:
            self._fixed_on_the_world(chosen, on_carrier)
        massless = on_carrier.merge()
        if not massless.mass and not massless.inertia.any():
            self._problems.add(self._link_words(first.name), "has no mass and no inertia, nor has what is fixed on it")
        turning = [link for link in self._model.links if link.spin is not None]
        turning.sort(key=lambda link: cast(Spin, link.spin).number)
        for link in turning:
            self._check_flywheel(link, groups, on_carrier)
        if self._problems.lines:
            raise ForeignError(self._problems.lines)
        carrier_name = chosen or first.name
        carrier = self._carrier(on_carrier, base, carrier_name)
        own = [self._instrument(*each, base) for each in self._separate_bodies(on_carrier, carrier_name)]
        wheels = [self._flywheel(link, groups, on_carrier, base) for link in turning]
        motors = [show(s.name) for s in wheels if s.motor is not None]
        if motors:
            self._notes.append(
                f"friction and limits of {', '.join(motors)} act in `mahovik simulate`, not in the equations"
            )
        points = self._points(on_carrier, base, carrier_name)
        if not wheels:
            self._notes.append("nothing turns without end: the stand has no flywheels")
        gravity = self._gravity if self._model.gravity is None else self._model.gravity
        if gravity is None:
            self._notes.append("the format has no gravity: it is 0; --gravity 0 0 -9.81 gives one")
        stand = Stand(
            name=self._name,
            angles="ship",
            gravity=_vec3(np.zeros(3) if gravity is None else gravity),
            stream=None,
            carrier=carrier,
            instruments=tuple(own),
            flywheels=tuple(wheels),
            points=tuple(points),
        )
        spins = [cast(Spin, link.spin) for link in turning]
        joints, numbers = tuple(s.joint for s in spins), tuple(s.number for s in spins)
        return ImportedStand(stand, carrier_name, base.inverse, joints, numbers, self._comments, tuple(self._notes))

    # -- what is refused -----------------------------------------------------------------------------------------------

    def _link_words(self, link: str) -> str:
        return f"{self._model.noun} {show(link)}"

    def _check_masses(self) -> None:
        """Check each body separately, since a sum would hide an impossible one."""
        for link in self._model.links:
            far = float(
                max(np.abs(link.place.origin).max(), 0.0 if link.spin is None else np.abs(link.spin.anchor).max())
            )
            if not far <= LARGEST:
                self._problems.add(self._link_words(link.name), f"is {far:g} m away, expected at most {LARGEST:g}")
            if link.mass is not None and link.mass.mass >= 0:
                body = Body(
                    link.name,
                    link.mass.mass,
                    _vec3(link.mass.center),
                    _mat3(link.mass.inertia),
                    "center_of_mass",
                    False,
                )
                check_body(body, self._link_words(link.name), self._problems)

    def _fixed_on_the_world(self, chosen: str | None, on_carrier: _Group) -> None:
        """Refuse a carrier that is fixed on the world, unless the user chose it."""
        if chosen is not None:
            self._notes.append(
                f"{self._link_words(chosen)}: is fixed on the world there, and free here: see [suspension]"
            )
            return
        with_mass = [name for name, (link, _) in on_carrier.members.items() if link.mass is not None]
        base = [*with_mass, self._model.links[0].name][0]
        self._problems.add(
            self._link_words(base), f"is fixed on the world, but a carrier moves: give --carrier {base} to make it free"
        )

    def _groups(self) -> dict[str, _Group]:
        """Groups of links fixed together, by the first link of each."""
        groups: dict[str, _Group] = {}
        heads: dict[str, str] = {}
        for link in self._model.links:
            if link.parent is None or link.spin is not None:
                heads[link.name] = link.name
                groups[link.name] = _Group({link.name: (link, _HERE)})
            else:
                heads[link.name] = head = heads[link.parent]
                members = groups[head].members
                members[link.name] = (link, members[link.parent][1] @ link.place)
        return groups

    def _base(self, chosen: str | None, on_carrier: _Group) -> Place:
        """The frame of the first link in E1."""
        if chosen is None:
            return _HERE
        if chosen not in on_carrier.members:
            known = [link.name for link in self._model.links]
            if chosen in known:
                first = self._model.links[0].name
                reason = f"turns, expected {show(first)} or a {self._model.noun} that is fixed to it"
            else:
                reason = f"is not in the file{suggestion(chosen, known)}"
            self._problems.add(f"--carrier {chosen}: {reason}")
            return _HERE
        return on_carrier.members[chosen][1].inverse

    def _check_flywheel(self, link: Link, groups: dict[str, _Group], on_carrier: _Group) -> None:
        where = f"joint {show(cast(Spin, link.spin).joint)}"
        if link.parent not in on_carrier.members:
            self._problems.add(
                where,
                f"turns on {self._link_words(link.parent or '')}, which turns itself: "
                "a flywheel must be on the carrier",
            )
            return
        mass = groups[link.name].merge()
        if not mass.mass and not mass.inertia.any():
            self._problems.add(where, f"{self._link_words(link.name)} turns, but has no mass and no inertia")

    # -- the bodies of the stand ---------------------------------------------------------------------------------------

    def _separate_bodies(self, on_carrier: _Group, carrier: str) -> list[tuple[Link, Place]]:
        """Bodies on the carrier that are kept as separate bodies."""
        if not self._instruments:
            return []
        return [each for each in on_carrier.members.values() if each[0].name != carrier and each[0].mass is not None]

    def _carrier(self, on_carrier: _Group, base: Place, carrier: str) -> Carrier:
        apart = [link.name for link, _ in self._separate_bodies(on_carrier, carrier)]
        merged = [name for name, (link, _) in on_carrier.members.items() if link.mass is not None and name not in apart]
        self._comments["carrier"] = [f"Frame: that of {self._link_words(carrier)}.", self._sources(merged)]
        return Carrier(name="carrier", **_properties(on_carrier.merge(base, apart)), added_mass=None)

    def _sources(self, merged: Sequence[str]) -> str:
        """Comment that names the links of these mass properties."""
        if not merged:
            return "Without mass."
        listed = ", ".join(merged)
        return f"Mass, centre of mass, inertia: {listed}{', merged' if len(merged) > 1 else ''}."

    def _instrument(self, link: Link, place: Place, base: Place) -> Instrument:
        assert link.mass is not None
        name = self._own_name(link.name, "instrument")
        self._comments[name] = [f"{self._link_words(link.name).capitalize()}, fixed on the carrier."]
        at = base @ place
        return Instrument(
            name=name,
            **_properties(link.mass),
            position=_vec3(at.origin),
            angles=angles_of(at.axes),
            added_mass=None,
        )

    def _flywheel(self, link: Link, groups: dict[str, _Group], on_carrier: _Group, base: Place) -> Flywheel:
        spin = cast(Spin, link.spin)
        name = self._own_name(link.name, "flywheel")
        zero = direction_across(spin.axis)
        own = Place(spin.anchor, spin_axes(spin.axis, zero))  # Es in the frame of the link
        at = base @ on_carrier.members[link.parent or ""][1] @ link.place
        group = groups[link.name]
        back = rotation_about(spin.axis, -spin.zero) if spin.zero else np.eye(3)
        motor = None
        if spin.viscous or spin.coulomb or spin.torque is not None:
            motor = Motor(spin.torque, None, None, None, None, spin.viscous, spin.coulomb, 0.1)
        lines = [
            f"{self._link_words(link.name).capitalize()} on joint {show(spin.joint)}, whose coordinate is the phase."
        ]
        lines.append(self._sources([n for n, (member, _) in group.members.items() if member.mass is not None]))
        lines += _motor_sources(spin)
        self._comments[name] = lines
        return Flywheel(
            name=name,
            **_properties(group.merge(own.inverse)),
            mount="carrier",
            position=_vec3(at.origin + at.axes @ spin.anchor),
            mounting=MountingAxes(_vec3(at.axes @ spin.axis), _vec3(at.axes @ (back @ zero))),
            motor=motor,
            encoder=None,
        )

    def _points(self, on_carrier: _Group, base: Place, carrier: str) -> list[Point]:
        """Frames and links without mass on the carrier."""
        given = [
            (name, place)
            for name, (link, place) in on_carrier.members.items()
            if link.mass is None and name != carrier and link.parent is not None
        ]
        given += [
            (frame.name, on_carrier.members[frame.link][1] @ frame.place)
            for frame in self._model.frames
            if frame.link in on_carrier.members
        ]
        turning = sum(frame.link not in on_carrier.members for frame in self._model.frames)
        if turning:
            self._notes.append(f"left out: {turning} frames that turn with flywheels")
        found = []
        for theirs, place in given:
            name, at = self._own_name(theirs, "point"), base @ place
            self._comments[name] = [f"{theirs}, fixed on the carrier, without mass."]
            found.append(Point(name, "carrier", _vec3(at.origin), angles_of(at.axes)))
        return found

    def _own_name(self, theirs: str, kind: str) -> str:
        name = self._names.name(theirs, kind)
        if name != theirs:
            self._notes.append(f"{show(theirs)} is called {show(name)}: names become C identifiers")
        return name


def _motor_sources(spin: Spin) -> list[str]:
    """Comment that names the joint's number for each key of the motor."""
    given = [("damping", "viscous", spin.viscous), ("friction", "coulomb", spin.coulomb)]
    given.append(("largest torque", "torque", spin.torque or 0.0))
    words = [f"{ours} is its {theirs}" for theirs, ours, value in given if value]
    return [f"Motor, from the joint: {', '.join(words)}."] if words else []


def _properties(mass: RigidMass) -> dict[str, Any]:
    """Fields of a Body of the stand."""
    return {
        "mass": float(mass.mass),
        "center_of_mass": _vec3(mass.center),
        "inertia": _mat3(mass.inertia),
        "inertia_about": "center_of_mass",
        "wrench_input": False,
    }


def _vec3(given: Array) -> Vec3:
    x, y, z = (float(value) + 0.0 for value in given)  # no negative zero
    return x, y, z


def _mat3(given: Array) -> Mat3:
    a, b, c = (_vec3(row) for row in given)
    return a, b, c
