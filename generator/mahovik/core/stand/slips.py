"""Plausible slips in a stand file: numbers that a body may have, but that are far from those around them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from mahovik.contract.quantities import RPM
from mahovik.core.stand.balance import eccentric_velocity, grade
from mahovik.core.stand.inertia import inertia_about_center
from mahovik.core.stand.model import Body, Carrier, Instrument, Stand
from mahovik.core.stand.whole import PlacedBody, placed_bodies

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


def slips(
    stand: Stand, speeds: Sequence[float], known: Sequence[bool], written: Mapping[str, str] | None = None
) -> list[str]:
    """Warnings, a line each. `speeds` (rad/s) of the flywheels, and whether each is known, by its motor or as asked.

    `written`: static unbalances with units as written in the file, by the names of the flywheels.
    """
    bodies = placed_bodies(stand)
    return [
        *_unbalances(stand, speeds, known, written or {}),
        *_places(stand, bodies),
        *_centers(bodies),
        *_sizes(bodies),
    ]


def _unbalances(
    stand: Stand, speeds: Sequence[float], known: Sequence[bool], written: Mapping[str, str]
) -> Iterator[str]:
    """Flywheels an order above G 40, unless all of several are and no speed is known: these are so on purpose."""
    velocities = [eccentric_velocity(s, speed) for s, speed in zip(stand.flywheels, speeds, strict=True)]
    above = [1e3 * velocity > ORDER * USUAL_GRADE for velocity in velocities]
    on_purpose = len(above) > 1 and all(above)
    found = [k for k, far in enumerate(above) if far and (known[k] or not on_purpose)]
    if not found:
        return
    worst = max(found, key=lambda k: velocities[k])
    flywheel = stand.flywheels[worst]
    static = 1e6 * flywheel.mass * math.hypot(*flywheel.center_of_mass[1:])
    words = written.get(flywheel.name) or (f"{static:.4g} g mm" if static < 1e4 else f"{static:.0f} g mm")
    more = f" (and {len(found) - 1} more)" if len(found) > 1 else ""
    yield (
        f"flywheel {flywheel.name}{more}: a static unbalance of {words} on {flywheel.mass:.4g} kg is "
        f"{grade(velocities[worst])} at {RPM * abs(speeds[worst]):.5g} rpm, "
        f"{1e3 * velocities[worst] / USUAL_GRADE:.3g} times G {USUAL_GRADE:g}: on purpose, or a slip in its unit?"
    )


def _places(stand: Stand, bodies: Sequence[PlacedBody]) -> Iterator[str]:
    """Instruments, flywheels and points far away from all others, by the size of these."""
    for k, placed in enumerate(bodies):
        if not isinstance(placed.body, Carrier):
            others = [each for j, each in enumerate(bodies) if j != k]
            kind = "instrument" if isinstance(placed.body, Instrument) else "flywheel"
            yield from _outlier(f"{kind} {placed.body.name}", placed.position, others)
    mounts = {each.body.name: each for each in bodies}
    for point in stand.points:
        mount = mounts[point.mount]
        at = mount.position + mount.axes @ np.array(point.position)
        yield from _outlier(f"point {point.name}", at, bodies)


def _outlier(name: str, position: Array, others: Sequence[PlacedBody]) -> Iterator[str]:
    mass = sum(each.body.mass for each in others)
    if mass == 0.0:
        return
    middle = np.sum([each.body.mass * each.center_of_mass for each in others], axis=0) / mass
    size = max(float(np.linalg.norm(each.center_of_mass - middle)) + _gyration(each.body) for each in others)
    distance = float(np.linalg.norm(position - middle))
    if 0.0 < ORDER * size < distance:
        yield (
            f"{name}: its position is {distance:.4g} m from the middle of the bodies, {distance / size:.3g} times "
            f"their size of {size:.3g} m: a slip in the unit?"
        )


def _centers(bodies: Sequence[PlacedBody]) -> Iterator[str]:
    """Bodies whose centre of mass is far from the origin of their frame, by their radius of gyration."""
    for placed in bodies:
        body, radius = placed.body, _gyration(placed.body)
        distance = math.hypot(*body.center_of_mass)
        if 0.0 < OUTSIDE * radius < distance:
            yield (
                f"{body.name}: its centre of mass is {distance:.4g} m from the origin of its frame, "
                f"{distance / radius:.3g} times its radius of gyration of {radius:.3g} m, which is outside the body: "
                "a slip in the unit?"
            )


def _sizes(bodies: Sequence[PlacedBody]) -> Iterator[str]:
    """Bodies whose inertia is too large for the stand or too small for their mass.

    Too large: the radius of gyration of an instrument or a flywheel is far above those of all other bodies. Too small:
    the ball with the same mass and radius of gyration k, whose radius is sqrt(5/3) k, is denser than any metal; every
    other shape is denser still. A body without inertia is a particle, which is written so on purpose.
    """
    radii = [_gyration(each.body) for each in bodies]
    for k, placed in enumerate(bodies):
        body, radius = placed.body, radii[k]
        others = max((radii[j] for j in range(len(bodies)) if j != k), default=0.0)
        if not isinstance(body, Carrier) and 0.0 < ORDER * others < radius:
            yield (
                f"{body.name}: its radius of gyration is {radius:.3g} m, {radius / others:.3g} times the largest of "
                "the other bodies: a slip in the unit of its inertia or mass?"
            )
        ball = 4.0 / 3.0 * math.pi * (math.sqrt(5.0 / 3.0) * radius) ** 3
        if 0.0 < DENSEST * ball < body.mass:
            yield (
                f"{body.name}: {body.mass:.4g} kg with a radius of gyration of {radius:.3g} m is "
                f"{body.mass / ball / DENSEST:.3g} times denser than osmium, whatever its shape: a slip in the unit of "
                "its inertia or mass?"
            )


def _gyration(body: Body) -> float:
    """Root mean square distance of the mass from its centre, m; 0 without mass."""
    if body.mass == 0.0:
        return 0.0
    return math.sqrt(max(float(np.trace(inertia_about_center(body))), 0.0) / (2.0 * body.mass))
