"""Random general stands and states from a seeded generator: what verification, campaigns and tests draw from.

Every body is a cloud of point masses, so every inertia is physical and nothing is symmetric by accident.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

from mahovik.contract.laws import LAWS
from mahovik.core.stand.declare import Size
from mahovik.core.stand.draw import Draw, rows
from mahovik.core.stand.fields import Mat3
from mahovik.core.stand.laws import body_laws, carrier_laws
from mahovik.core.stand.model import (
    COMPONENTS,
    Carrier,
    Encoder,
    Flywheel,
    Instrument,
    Mat6,
    Motor,
    MountingAngles,
    MountingAxes,
    Point,
    Sequence,
    Stand,
    Task,
    TaskRow,
)
from mahovik.core.stand.random_state import EXTREMES, extreme_state, random_state
from mahovik.core.stand.task import dependent_rows, places_of

__all__ = ["BARE", "EVERYTHING", "EXTREMES", "SEQUENCES", "Features", "extreme_state", "random_stand", "random_state"]

Array = NDArray[np.float64]
AnyBody = TypeVar("AnyBody", Carrier, Instrument, Flywheel)

SEQUENCES: tuple[Sequence, ...] = ("ship", "aircraft", "euler")


@dataclass(frozen=True)
class Features:
    """Features of a random stand. None: drawn.

    fluid           added mass, and the laws of bodies (on flywheels as well)
    wrench_inputs   some bodies take a run-time wrench
    laws            how many of each law of `laws/`, by its folder; where there can be one only, 1 or more gives it
    tasks           how many, each of one to six rows
    flow            the other laws of fluid as well: strips, fins, propellers, damping that fades
    """

    angles: Sequence | None = None
    instruments: int | None = None
    gravity: bool | None = None
    stream: bool | None = None
    fluid: bool | None = None
    points: int | None = None
    wrench_inputs: bool | None = None
    motors: bool | None = None
    laws: Mapping[str, int] = field(default_factory=dict)
    tasks: int | None = None
    flow: bool = False


EVERYTHING = Features(None, 2, True, True, True, 2, True, True, dict.fromkeys(LAWS, 2), 2)
"""Every kind of wrench and body at once; the attitude sequence is drawn."""
BARE = Features(None, 0, False, False, False, 0, False, False, dict.fromkeys(LAWS, 0), 0)
"""Carrier and flywheels in free space."""


def random_stand(
    rng: np.random.Generator, flywheels: int, features: Features = Features(), name: str = "random"
) -> Stand:
    """A general stand with `flywheels` flywheels. The same generator state gives the same stand."""
    draw = _Bodies(rng)
    angles = features.angles or SEQUENCES[int(rng.integers(3))]
    fluid = draw.flag(features.fluid)
    inputs = draw.flag(features.wrench_inputs)
    motors = draw.flag(features.motors)
    names = [f"i{k + 1}" for k in range(draw.count(features.instruments, 2))]
    mounts = ["carrier", *names]
    carrier = Carrier(
        **draw.body("carrier", 12.0, 0.25, fluid, inputs), added_mass=draw.added_mass(6.0) if fluid else None
    )
    instruments = tuple(
        Instrument(
            **draw.body(each, 2.0, 0.08, fluid, inputs),
            added_mass=draw.added_mass(0.8) if fluid and rng.random() < 0.5 else None,
            position=draw.vec3(0.25),
            angles=draw.vec3(1.0),
        )
        for each in names
    )
    wheels = tuple(
        Flywheel(
            **draw.body(f"w{k + 1}", 0.9, 0.05, fluid and rng.random() < 0.4, inputs),
            mount=mounts[int(rng.integers(len(mounts)))],
            position=draw.vec3(0.25),
            mounting=draw.mounting(),
            motor=draw.motor() if motors else None,
            encoder=Encoder(int(rng.choice([-4096, 1024])), 7.0, 5e-5) if motors else None,
        )
        for k in range(flywheels)
    )
    gravity = draw.vec3(6.0) if draw.flag(features.gravity) else (0.0, 0.0, 0.0)
    stream = draw.vec3(0.8) if draw.flag(features.stream) else None
    laws = [law.random_of(draw, features.laws.get(law.key), mounts) for law in carrier_laws()]
    points = tuple(
        Point(f"p{k + 1}", mounts[int(rng.integers(len(mounts)))], draw.vec3(0.2), draw.vec3(1.0))
        for k in range(draw.count(features.points, 2))
    )
    found = Stand(
        name=name,
        angles=angles,
        gravity=gravity,
        stream=stream,
        carrier=carrier,
        instruments=instruments,
        flywheels=wheels,
        points=points,
        tasks=_tasks(_tasks_generator(rng), features.tasks, instruments, points) if flywheels else (),
        laws=tuple(law for law in laws if law is not None),
    )
    return _with_flow(found, Draw(rng.spawn(1)[0])) if features.flow else found


def _with_flow(stand: Stand, draw: Draw) -> Stand:
    """The stand with laws of the fluid that came later, by a generator of its own: other draws stay as they are.

    What steers comes after the fins and propellers that it names.
    """
    return _with_drawn(_with_drawn(stand, draw, steers=False), draw, steers=True)


def _with_drawn(stand: Stand, draw: Draw, steers: bool) -> Stand:
    """The stand with the laws of bodies that are drawn after all bodies, or with those that steer."""

    def add_laws(body: AnyBody) -> AnyBody:
        laws = [law.random_on(draw, body) for law in body_laws() if law.steers is steers]
        return body.with_laws(*(law for law in laws if law is not None))

    return replace(
        stand,
        carrier=add_laws(stand.carrier),
        instruments=tuple(map(add_laws, stand.instruments)),
        flywheels=tuple(map(add_laws, stand.flywheels)),
    )


def _tasks_generator(rng: np.random.Generator) -> np.random.Generator:
    """A generator of its own for tasks: what else is drawn of `rng` stays as it is without tasks."""
    return rng.spawn(1)[0]


def _tasks(
    rng: np.random.Generator, given: int | None, instruments: tuple[Instrument, ...], points: tuple[Point, ...]
) -> tuple[Task, ...]:
    """Tasks of random independent rows, of O1 and of instruments and points."""
    places = places_of(instruments, points)
    frames = ["", *places]
    found = []
    for k in range(Draw(rng).count(given, 1)):
        task = Task(f"t{k + 1}", ())
        most = int(rng.integers(1, 7))
        while len(task.rows) < most:
            row = TaskRow(frames[int(rng.integers(len(frames)))], COMPONENTS[int(rng.integers(6))])
            longer = Task(task.name, (*task.rows, row))
            if dependent_rows(longer, places) is None:
                task = longer
        found.append(task)
    return tuple(found)


class _Bodies(Draw):
    """Bodies and what belongs to one."""

    def body(self, name: str, mass: float, size: float, fluid: bool, inputs: bool) -> dict[str, Any]:
        """Fields of any body: eight point masses, `mass` kg in all, off the origin by a third of their `size`, m."""
        rng = self.rng
        parts = rng.uniform(0.5, 1.5, 8) * mass / 8
        at = rng.normal(size=(8, 3)) * size + rng.normal(size=3) * size / 3
        total = float(parts.sum())
        center = parts @ at / total
        about_center = bool(rng.random() < 0.5)
        arms = at - center if about_center else at
        J = np.einsum("k,kij->ij", parts, np.einsum("ki,ki->k", arms, arms)[:, None, None] * np.eye(3))
        J = J - np.einsum("k,ki,kj->ij", parts, arms, arms)
        J = (J + J.T) / 2
        own = Size(total, size, mass)
        return {
            "name": name,
            "mass": total,
            "center_of_mass": (float(center[0]), float(center[1]), float(center[2])),
            "inertia": cast(Mat3, rows(J)),
            "inertia_about": "center_of_mass" if about_center else "origin",
            "laws": tuple(law for kind in body_laws() if fluid and (law := kind.random_with(self, own)) is not None),
            "wrench_input": inputs and bool(rng.random() < 0.6),
        }

    def added_mass(self, size: float) -> Mat6:
        return self.definite6(size)

    def mounting(self) -> MountingAngles | MountingAxes:
        if self.rng.random() < 0.6:
            psi, theta, zero = self.rng.uniform(-math.pi, math.pi, 3)
            return MountingAngles(float(psi), float(theta), float(zero))
        return MountingAxes(self.vec3(1.0), self.vec3(3.0))

    def motor(self) -> Motor:
        rng = self.rng
        return Motor(float(rng.uniform(0.05, 0.5)), float(rng.uniform(300, 900)), 0.03, 0.5, 24.0, 1e-5, 5e-4, 0.1)
