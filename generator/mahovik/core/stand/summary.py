"""Figures that `mahovik check` prints, in SI: masses, inertia, unbalance, capacity, reach, warnings."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mahovik.contract.quantities import RPM
from mahovik.core.stand.capacity import Capacity, momentum_capacity, torque_capacity
from mahovik.core.stand.coordinates import row_name
from mahovik.core.stand.fields import Mat3
from mahovik.core.stand.hold import twists, words
from mahovik.core.stand.law import HoldNumber
from mahovik.core.stand.laws import body_laws, carrier_laws, held_laws
from mahovik.core.stand.masses import (
    PlacedBody,
    eccentric_velocity,
    grade,
    inertia_about_center,
    inertia_about_origin,
    mass_properties,
    placed_bodies,
    vec3,
)
from mahovik.core.stand.model import WRENCH_LETTERS, Body, Carrier, Flywheel, Instrument, Stand, Vec3
from mahovik.core.stand.motor import UNLIMITED

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


# -- plausible slips: numbers that a body may have, but that are far from those around them ----------------------------

Array = NDArray[np.float64]

USUAL_GRADE = 40.0
"""Grade G, mm/s, of coarsely balanced wheels: a data sheet's flywheel is not far above it."""

ORDER = 10.0
"""Ratio to what is usual above which a number is reported."""

OUTSIDE = 3.0
"""Distance of a centre of mass from the body's origin, in radii of gyration, above which it is reported.

At most a ninth of the mass is so far from the centre; the origin of a uniform rod at its end is at 1.73.
"""

DENSEST = 22.6e3
"""Density of osmium, kg/m3: a body of known mass and inertia is not denser than the densest metal."""

LIGHTEST = 0.01
"""kg/m3, a ninth of the density of hydrogen."""

FASTEST_RIM = 300.0
"""m/s: wheels of steel burst not far above; those of carbon fibre are faster."""


def slips(
    stand: Stand, speeds: Sequence[float], known: Sequence[bool], written: Mapping[str, str] | None = None
) -> list[str]:
    """Warnings, a line each. `speeds` (rad/s) of the flywheels, and whether each is known, by its motor or as asked.

    `written`: static unbalances with units as written in the file, by the names of the flywheels.
    """
    bodies = placed_bodies(stand)
    radii = np.array([_gyration(body.body) for body in bodies])
    return [
        *_unbalances(stand, speeds, written or {}),
        *_places(stand, bodies, radii),
        *_centers(bodies, radii),
        *_sizes(stand, bodies, radii),
        *_masses(stand),
        *_rims(stand, speeds, known),
    ]


def _unbalances(stand: Stand, speeds: Sequence[float], written: Mapping[str, str]) -> Iterator[str]:
    """Flywheels an order above G 40, unless all are: those of vibration motors and shakers are so on purpose."""
    velocities = [eccentric_velocity(s, speed) for s, speed in zip(stand.flywheels, speeds, strict=True)]
    unusual = [k for k, velocity in enumerate(velocities) if 1e3 * velocity > ORDER * USUAL_GRADE]
    if not unusual or len(unusual) == len(velocities):
        return
    worst = max(unusual, key=lambda k: velocities[k])
    flywheel = stand.flywheels[worst]
    static = 1e6 * flywheel.mass * math.hypot(*flywheel.center_of_mass[1:])
    words = written.get(flywheel.name) or (f"{static:.4g} g mm" if static < 1e4 else f"{static:.0f} g mm")
    more = f" (and {len(unusual) - 1} more)" if len(unusual) > 1 else ""
    yield (
        f"flywheel {flywheel.name}{more}: a static unbalance of {words} on {flywheel.mass:.4g} kg is "
        f"{grade(velocities[worst])} at {RPM * abs(speeds[worst]):.5g} rpm, "
        f"{1e3 * velocities[worst] / USUAL_GRADE:.3g} times G {USUAL_GRADE:g}: a slip in its unit, or a "
        "working moment, which is twice it?"
    )


def _places(stand: Stand, bodies: Sequence[PlacedBody], radii: Array) -> Iterator[str]:
    """Instruments, flywheels and points far away from all others, by the size of these."""
    mass = np.array([body.body.mass for body in bodies])
    centers = np.array([body.center_of_mass for body in bodies])
    for k, placed in enumerate(bodies):
        if not isinstance(placed.body, Carrier):
            kind = "instrument" if isinstance(placed.body, Instrument) else "flywheel"
            rest = np.arange(len(bodies)) != k
            yield from _outlier(f"{kind} {placed.body.name}", placed.position, mass[rest], centers[rest], radii[rest])
    mounts = {body.body.name: body for body in bodies}
    for point in stand.points:
        mount = mounts[point.mount]
        at = mount.position + mount.axes @ np.array(point.position)
        yield from _outlier(f"point {point.name}", at, mass, centers, radii)


def _outlier(name: str, position: Array, mass: Array, centers: Array, radii: Array) -> Iterator[str]:
    """A position (3) far from bodies of these masses (n), centres of mass (n, 3) and radii of gyration (n)."""
    total = float(mass.sum())
    if total == 0.0:
        return
    middle = mass @ centers / total
    size = float((np.linalg.norm(centers - middle, axis=1) + radii).max())
    distance = float(np.linalg.norm(position - middle))
    if 0.0 < ORDER * size < distance:
        yield (
            f"{name}: its position is {distance:.4g} m from the middle of the bodies, {distance / size:.3g} times "
            f"their size of {size:.3g} m: a slip in the unit?"
        )


def _centers(bodies: Sequence[PlacedBody], radii: Array) -> Iterator[str]:
    """Bodies whose centre of mass is far from the origin of their frame, by their radius of gyration."""
    for body, radius in zip((placed.body for placed in bodies), radii, strict=True):
        distance = math.hypot(*body.center_of_mass)
        if 0.0 < OUTSIDE * radius < distance:
            yield (
                f"{body.name}: its centre of mass is {distance:.4g} m from the origin of its frame, "
                f"{distance / radius:.3g} times its radius of gyration of {radius:.3g} m, which is outside the body: "
                "a slip in the unit?"
            )


def _sizes(stand: Stand, bodies: Sequence[PlacedBody], radii: Array) -> Iterator[str]:
    """Bodies whose inertia is too large for the stand or too small for their mass.

    Too large: the radius of gyration of an instrument or a flywheel is far above those of all other bodies; that of the
    carrier is far beyond all that stands on it, and the ball with the same mass and radius of gyration k, whose radius
    is sqrt(5/3) k, is lighter than any gas. Too small: that ball is denser than any metal; every other shape is denser
    still. A body without inertia is a particle, which is written so on purpose.
    """
    for k, (placed, radius) in enumerate(zip(bodies, radii, strict=True)):
        body = placed.body
        largest = float(max(radii[:k].max(initial=0.0), radii[k + 1 :].max(initial=0.0)))
        ball = 4.0 / 3.0 * math.pi * (math.sqrt(5.0 / 3.0) * radius) ** 3
        if isinstance(body, Carrier):
            reach = _reach(stand, bodies, placed.center_of_mass)
            if radius > ORDER * reach and 0.0 < body.mass < LIGHTEST * ball:
                beside = f", {radius / reach:.3g} times the distance of what stands on it" if reach else ""
                yield (
                    f"carrier: its radius of gyration is {radius:.3g} m{beside}; it would be lighter than any gas: "
                    "a slip in the unit of its inertia or mass?"
                )
        elif 0.0 < ORDER * largest < radius:
            yield (
                f"{body.name}: its radius of gyration is {radius:.3g} m, {radius / largest:.3g} times the largest of "
                "the other bodies: a slip in the unit of its inertia or mass?"
            )
        if 0.0 < DENSEST * ball < body.mass:
            yield (
                f"{body.name}: {body.mass:.4g} kg with a radius of gyration of {radius:.3g} m is "
                f"{body.mass / ball / DENSEST:.3g} times denser than osmium, whatever its shape: a slip in the unit of "
                "its inertia or mass?"
            )


def _reach(stand: Stand, bodies: Sequence[PlacedBody], center: Array) -> float:
    """Largest distance (m) of an instrument, a flywheel or a point on the carrier from its centre of mass (3)."""
    places = [placed.position for placed in bodies if not isinstance(placed.body, Carrier)]
    places += [np.array(point.position) for point in stand.points if point.mount == stand.carrier.name]
    return max((float(np.linalg.norm(place - center)) for place in places), default=0.0)


def _masses(stand: Stand) -> Iterator[str]:
    """A free carrier without any mass but that of the flywheels."""
    fixed = (stand.carrier, *stand.instruments)
    if stand.flywheels and stand.hold is None and not any(body.mass for body in fixed):
        yield (
            "carrier: its mass is 0, so that the flywheels are all that moves with their own unbalance: a mass that "
            "was left out?"
        )


def _rims(stand: Stand, speeds: Sequence[float], known: Sequence[bool]) -> Iterator[str]:
    """Flywheels whose rim, that of the disc of their mass and spin inertia, is faster than wheels of metal bear."""
    rims = []
    for flywheel, speed, is_known in zip(stand.flywheels, speeds, known, strict=True):
        if is_known and flywheel.mass:
            radius = math.sqrt(2.0 * float(inertia_about_origin(flywheel)[0, 0]) / flywheel.mass)
            rims.append((radius * abs(speed), radius, abs(speed), flywheel.name))
    above = [entry for entry in rims if entry[0] > FASTEST_RIM]
    if above:
        rim, radius, speed, name = max(above)
        more = f" (and {len(above) - 1} more)" if len(above) > 1 else ""
        yield (
            f"flywheel {name}{more}: at {speed:.5g} rad/s, {RPM * speed:.5g} rpm, the rim of a disc of its mass and "
            f"inertia, of {radius:.3g} m, runs at {rim:.4g} m/s, above {FASTEST_RIM:g}: rpm written as rad/s?"
        )


def _gyration(body: Body) -> float:
    """Root mean square distance of the mass from its centre, m; 0 without mass."""
    if body.mass == 0.0:
        return 0.0
    return math.sqrt(max(float(np.trace(inertia_about_center(body))), 0.0) / (2.0 * body.mass))
