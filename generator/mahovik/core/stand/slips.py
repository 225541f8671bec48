"""Plausible slips in a stand file: numbers that a body may have, but that are far from those around them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from mahovik.contract.quantities import RPM
from mahovik.core.stand.masses import (
    PlacedBody,
    eccentric_velocity,
    grade,
    inertia_about_center,
    inertia_about_origin,
    placed_bodies,
)
from mahovik.core.stand.model import Body, Carrier, Instrument, Stand

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
        f"{1e3 * velocities[worst] / USUAL_GRADE:.3g} times G {USUAL_GRADE:g}: a slip in its unit?"
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
