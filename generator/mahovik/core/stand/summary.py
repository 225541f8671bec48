"""Figures that `mahovik check` prints, in SI: masses, inertia, unbalance, capacity, reach, warnings."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from mahovik.core.stand.capacity import Capacity, momentum_capacity, torque_capacity
from mahovik.core.stand.fields import Mat3
from mahovik.core.stand.hold import twists, words
from mahovik.core.stand.law import HoldNumber
from mahovik.core.stand.laws import body_laws, carrier_laws, held_laws
from mahovik.core.stand.masses import (
    eccentric_velocity,
    grade,
    inertia_about_center,
    inertia_about_origin,
    mass_properties,
    placed_bodies,
    vec3,
)
from mahovik.core.stand.model import WRENCH_LETTERS, Flywheel, Instrument, Stand, Vec3
from mahovik.core.stand.motor import UNLIMITED
from mahovik.core.stand.slips import slips
from mahovik.core.stand.task import row_name

USUAL_SPEED = 100 * math.pi  # 3000 rpm, rad/s
_NEAR = math.radians(5.0)
_THIRD_AXIS = {"ship": 0, "aircraft": 0, "euler": 2}  # axis of E1 that the last angle turns about
_FIRST_AXIS = {"ship": 2, "aircraft": 1, "euler": 2}  # axis of E0 that the first angle turns about


@dataclass(frozen=True)
class BodyRow:
    """One body: kind "carrier", "instrument" or "flywheel"; mass, kg; centre of mass in E1 at phi = 0, m."""

    name: str
    kind: str
    mount: str
    mass: float
    center_of_mass: Vec3


@dataclass(frozen=True)
class UnbalanceRow:
    """Unbalance and asymmetry of one flywheel, and what they do at a speed.

    static          mass times distance of the centre of mass from the axis, kg m
    static_at       its angle from axis 2, rad; None without it
    dynamic         sqrt(J12^2 + J13^2) about the origin, kg m2
    dynamic_at      its angle from axis 2, rad, as in the stand file; None without it
    dynamic_center  the same about the centre of mass, kg m2
    asymmetry       J22 - J33 about the origin, kg m2
    product         J23 about the origin, kg m2
    speed           rad/s: as asked, else the motor's no-load speed, else 3000 rpm
    eccentric_velocity  distance of the centre of mass from the axis times speed, m/s
    grade           the finest grade of ISO 21940-11 that admits it, "G 6.3"; "-" without static unbalance
    force           static unbalance times speed^2, N
    moment          dynamic unbalance about the origin times speed^2, N m
    couple          dynamic unbalance about the centre of mass times speed^2, N m: no grade bounds it
    """

    name: str
    static: float
    static_at: float | None
    dynamic: float
    dynamic_at: float | None
    dynamic_center: float
    asymmetry: float
    product: float
    spin_inertia: float
    speed: float
    eccentric_velocity: float
    grade: str
    force: float
    moment: float
    couple: float


@dataclass(frozen=True)
class TaskSummary:
    """A task and the names of its rows: `wx`, or `telescope.wy` of a point."""

    name: str
    rows: tuple[str, ...]


@dataclass(frozen=True)
class Summary:
    """Figures of a whole stand, in E1, flywheels at phi = 0.

    inertia            (3, 3) about the centre of mass, kg m2; without added mass
    principal_inertia  (3), rising, kg m2; principal_axes: a unit vector in E1 for each
    momentum, torque   capacity of the flywheels whose motors have a speed, N m s, or a torque, N m
    force              worst case, N: the unbalance forces of all flywheels in one line
    hold               how a held carrier can move, in words; empty where it is free
    hold_numbers       where it is held, and what acts along its freedoms, in SI
    """

    name: str
    bodies: tuple[BodyRow, ...]
    mass: float
    center_of_mass: Vec3
    inertia: Mat3
    principal_inertia: Vec3
    principal_axes: Mat3
    unbalance: tuple[UnbalanceRow, ...]
    force: float
    momentum: Capacity
    torque: Capacity
    warnings: tuple[str, ...]
    tasks: tuple[TaskSummary, ...] = ()
    hold: str = ""
    hold_numbers: tuple[HoldNumber, ...] = ()

    def as_dict(self) -> dict[str, Any]:
        """The figures as plain dicts and tuples, which `json` writes as objects and lists; a hold if there is one."""
        result = asdict(self)
        return result if self.hold else {key: value for key, value in result.items() if not key.startswith("hold")}


def summarize(stand: Stand, speed: float | None = None, written: Mapping[str, str] | None = None) -> Summary:
    """Figures of `stand`; `speed` (rad/s) of all flywheels, default each motor's no-load speed, else 3000 rpm.

    `written`: static unbalances as written in the file, for warnings.
    """
    bodies = []
    for placed_body in placed_bodies(stand):
        body = placed_body.body
        kind = "flywheel" if isinstance(body, Flywheel) else "instrument" if isinstance(body, Instrument) else "carrier"
        mount = body.mount if isinstance(body, Flywheel) else "carrier" if isinstance(body, Instrument) else ""
        bodies.append(BodyRow(body.name, kind, mount, body.mass, vec3(placed_body.center_of_mass)))
    whole = mass_properties(stand)
    unbalance = tuple(_unbalance(flywheel, speed) for flywheel in stand.flywheels)
    known = [speed is not None or (s.motor or UNLIMITED).no_load is not None for s in stand.flywheels]
    return Summary(
        name=stand.name,
        bodies=tuple(bodies),
        mass=whole.mass,
        center_of_mass=whole.center_of_mass,
        inertia=whole.inertia,
        principal_inertia=whole.principal_inertia,
        principal_axes=whole.principal_axes,
        unbalance=unbalance,
        force=math.fsum(row.force for row in unbalance),
        momentum=momentum_capacity(stand),
        torque=torque_capacity(stand),
        warnings=(*_warnings(stand), *slips(stand, [row.speed for row in unbalance], known, written)),
        tasks=tuple(TaskSummary(task.name, tuple(map(row_name, task.rows))) for task in stand.tasks),
        hold=_hold(stand),
        hold_numbers=(*_place(stand), *forces_along_freedoms(stand)),
    )


def _hold(stand: Stand) -> str:
    """How the carrier can move, and what acts along its freedoms; empty where it is free."""
    if stand.hold is None:
        return ""
    return "; ".join([words(stand.hold), *filter(None, (law.short(stand) for law in held_laws()))])


def _place(stand: Stand) -> list[HoldNumber]:
    """Where the hold is: pivot of what turns, and home pose."""
    hold = stand.hold
    if hold is None:
        return []
    turning = any(freedom.kind == "turn" for freedom in hold.freedoms)
    pivot = [HoldNumber("hold", "pivot in E1", hold.pivot, "m")] if turning else []
    home = HoldNumber("hold", "home position of O1 in E0", hold.position, "m")
    return [*pivot, home, HoldNumber("hold", f"home angles, {stand.angles}", hold.angles, "rad")]


def forces_along_freedoms(stand: Stand) -> list[HoldNumber]:
    """The numbers of the laws along the freedoms of a hold: friction and stops."""
    return [number for law in held_laws() for number in law.numbers(stand)]


def _unbalance(flywheel: Flywheel, asked: float | None) -> UnbalanceRow:
    speed = asked if asked is not None else (flywheel.motor or UNLIMITED).no_load or USUAL_SPEED
    static = flywheel.mass * math.hypot(*flywheel.center_of_mass[1:])
    J, central = inertia_about_origin(flywheel), inertia_about_center(flywheel)
    dynamic = math.hypot(J[0, 1], J[0, 2])
    velocity = eccentric_velocity(flywheel, speed)
    couple = math.hypot(central[0, 1], central[0, 2])
    return UnbalanceRow(
        name=flywheel.name,
        static=static,
        static_at=_angle(flywheel.center_of_mass[1], flywheel.center_of_mass[2]),
        dynamic=dynamic,
        dynamic_at=_angle(-float(J[0, 1]), -float(J[0, 2])),
        dynamic_center=couple,
        asymmetry=float(J[1, 1] - J[2, 2]),
        product=float(J[1, 2]),
        spin_inertia=float(J[0, 0]),
        speed=speed,
        eccentric_velocity=velocity,
        grade=grade(velocity),
        force=static * speed**2,
        moment=dynamic * speed**2,
        couple=couple * speed**2,
    )


def _angle(second: float, third: float) -> float | None:
    """Angle of a vector across the axis from axis 2, rad; None for the zero vector."""
    return math.atan2(third + 0.0, second + 0.0) if second or third else None  # no -0.0, which would turn by pi


def _warnings(stand: Stand) -> list[str]:
    warnings = []
    if stand.angles == "euler":
        warnings.append('angles = "euler" are singular at theta = 0, which is the attitude aligned with E0 itself')
    elif _heading_is_singular(stand.angles, stand.gravity):
        better = [name for name in ("ship", "aircraft") if not _heading_is_singular(name, stand.gravity)]
        warnings.append(
            f'angles = "{stand.angles}" are singular where the carrier\'s axis 1 lies along axis '
            f"{_FIRST_AXIS[stand.angles] + 1} of E0: a turn about the vertical passes there, it is a heading"
            + (f' ("{better[0]}" has no such heading with this gravity)' if better else "")
        )
    carrying = [law for law in (*carrier_laws(), *body_laws()) if law.carries_weight]
    if stand.hold is None and any(stand.gravity) and not any(law.short(stand) for law in carrying):
        *names, last = (law.name for law in carrying)
        warnings.append(f"nothing carries the weight (no {', '.join(names)} or {last}): the stand falls freely")
    of_laws = (line for law in (*body_laws(), *carrier_laws()) for line in law.warnings(stand))
    return [*warnings, *of_laws, *idle_laws(stand)]


def _heading_is_singular(angles: str, gravity: Vec3) -> bool:
    """Whether a carrier aligned with E0 and turned about the vertical comes within 5 degrees of the singularity.

    The angles are singular where the axis of the last, fixed in E1, lies along that of the first, fixed in E0.
    A turn about the vertical leaves its angle to the vertical as it was, so the two can meet only where both
    axes stand at the same angle to the vertical (either sense).
    """
    length = math.hypot(*gravity)
    if length == 0.0:
        return False
    first, third = (math.acos(min(1.0, abs(gravity[k]) / length)) for k in (_FIRST_AXIS[angles], _THIRD_AXIS[angles]))
    return abs(first - third) < _NEAR


def idle_laws(stand: Stand) -> list[str]:
    """Warnings, a line for each law whose wrench acts on what the hold blocks: there it adds to the reaction alone."""
    if stand.hold is None:
        return []
    S = twists(stand.hold)
    result = []
    for law in stand.laws:
        idle = [WRENCH_LETTERS[i] for i in law.rows or () if not np.any(S[i])]
        if idle:
            name = type(law).__name__.lower()
            result.append(
                f"{name}: [hold] blocks the motion along {', '.join(idle)} of its wrench, which there adds to the "
                "reaction and does nothing else"
            )
        elif not stand.hold.freedoms:
            result.append(
                f"{type(law).__name__.lower()}: [hold] clamps the carrier: wrenches on it add to the reaction and do "
                "nothing else"
            )
    return result
