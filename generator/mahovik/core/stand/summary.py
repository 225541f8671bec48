"""What `mahovik check` tells of a stand: masses, unbalance and asymmetry in workshop units, reach, warnings."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.frames import mount_of, placement
from mahovik.core.stand.inertia import inertia_about_center, inertia_about_origin
from mahovik.core.stand.model import Flywheel, Instrument, Stand, Vec3
from mahovik.laws import parts

Array = NDArray[np.float64]

DEFAULT_SPEED = 100 * math.pi  # 3000 rpm, rad/s
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

    static          mass times distance of the centre of mass from the axis, g mm
    dynamic         sqrt(J12^2 + J13^2) about the origin, g mm2
    dynamic_center  the same about the centre of mass, g mm2
    asymmetry       J22 - J33 about the origin, g mm2
    product         J23 about the origin, g mm2
    speed           rad/s: as asked, else the motor's no-load speed, else 3000 rpm
    force           static unbalance times speed^2, N
    moment          dynamic unbalance about the origin times speed^2, N m
    """

    name: str
    static: float
    dynamic: float
    dynamic_center: float
    asymmetry: float
    product: float
    spin_inertia: float
    speed: float
    force: float
    moment: float


@dataclass(frozen=True)
class Summary:
    """Figures of a whole stand. `force` is the worst case, N: the unbalance forces of all flywheels in one line."""

    name: str
    bodies: tuple[BodyRow, ...]
    mass: float
    center_of_mass: Vec3
    unbalance: tuple[UnbalanceRow, ...]
    force: float
    warnings: tuple[str, ...]

    def as_dict(self) -> dict[str, Any]:
        """The same as plain dicts and tuples, which `json` writes as objects and lists."""
        return asdict(self)


def summarize(stand: Stand, speed: float | None = None) -> Summary:
    """Figures of `stand`; `speed` (rad/s) of all flywheels, default each motor's no-load speed, else 3000 rpm."""
    rows = [BodyRow("carrier", "carrier", "", stand.carrier.mass, stand.carrier.center_of_mass)]
    for instrument in stand.instruments:
        rows.append(BodyRow(instrument.name, "instrument", "carrier", instrument.mass, _center(stand, instrument)))
    for flywheel in stand.flywheels:
        rows.append(BodyRow(flywheel.name, "flywheel", flywheel.mount, flywheel.mass, _center(stand, flywheel)))
    mass = math.fsum(row.mass for row in rows)
    unbalance = tuple(_unbalance(flywheel, speed) for flywheel in stand.flywheels)
    return Summary(
        name=stand.name,
        bodies=tuple(rows),
        mass=mass,
        center_of_mass=_vec3(np.array([row.mass * np.array(row.center_of_mass) for row in rows]).sum(axis=0) / mass),
        unbalance=unbalance,
        force=math.fsum(row.force for row in unbalance),
        warnings=tuple(_warnings(stand)),
    )


def _center(stand: Stand, body: Instrument | Flywheel) -> Vec3:
    """Centre of mass of an instrument or flywheel in E1 at phi = 0."""
    position, C = placement(body)
    at = position + C @ np.array(body.center_of_mass)
    mount = mount_of(stand, body)
    if mount is not None:
        position, C = placement(mount)
        at = position + C @ at
    return _vec3(at)


def _vec3(a: Array) -> Vec3:
    return (float(a[0]), float(a[1]), float(a[2]))


def _unbalance(flywheel: Flywheel, asked: float | None) -> UnbalanceRow:
    motor = flywheel.motor
    speed = asked if asked is not None else motor.speed if motor and motor.speed else DEFAULT_SPEED
    static = flywheel.mass * math.hypot(*flywheel.center_of_mass[1:])
    J, central = inertia_about_origin(flywheel), inertia_about_center(flywheel)
    dynamic = math.hypot(J[0, 1], J[0, 2])
    return UnbalanceRow(
        name=flywheel.name,
        static=static * 1e6,
        dynamic=dynamic * 1e9,
        dynamic_center=math.hypot(central[0, 1], central[0, 2]) * 1e9,
        asymmetry=float(J[1, 1] - J[2, 2]) * 1e9,
        product=float(J[1, 2]) * 1e9,
        spin_inertia=float(J[0, 0]),
        speed=speed,
        force=static * speed**2,
        moment=dynamic * speed**2,
    )


def _warnings(stand: Stand) -> list[str]:
    found = []
    if stand.angles == "euler":
        found.append('angles = "euler" are singular at theta = 0, which is the attitude aligned with E0 itself')
    elif _heading_is_singular(stand.angles, stand.gravity):
        better = [name for name in ("ship", "aircraft") if not _heading_is_singular(name, stand.gravity)]
        found.append(
            f'angles = "{stand.angles}" are singular where the carrier\'s axis 1 lies along axis '
            f"{_FIRST_AXIS[stand.angles] + 1} of E0: a turn about the vertical passes there, it is a heading"
            + (f' ("{better[0]}" has no such heading with this gravity)' if better else "")
        )
    texts = [law for law in parts("text") if law.CARRIES_WEIGHT]
    carried = any(law.short(stand) for law in texts) or any(body.buoyancy for body in stand.bodies)
    if any(stand.gravity) and not carried:
        names = ", ".join(law.NAME for law in texts)
        found.append(f"nothing carries the weight (no {names} or buoyancy): the stand falls freely")
    return found


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
