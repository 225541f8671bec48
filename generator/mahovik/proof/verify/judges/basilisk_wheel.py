"""Reaction wheels that Basilisk can represent, and stands whose flywheels are such wheels.

Its tensor about the mass centre is [[Js, 0, U_d], [0, Jt, 0], [U_d, 0, Jg]] in axes of which the first is the spin axis
and the second points to the mass centre, U_s / mass away. The equations are exact for Jt = Jg only.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import cast

import numpy as np

from mahovik.core.stand.model import Flywheel, Mat3, Stand
from mahovik.proof.verify.judges.rigid import Array, RigidBody, about_first, missing, mount_flywheel, tree

ROUNDING = 1e-14
"""Part of the moment about the spin axis below which entries are rounding, from turning the tensor."""


@dataclass(frozen=True, eq=False)
class Wheel:
    """One wheel, in the carrier's axes about O1; SI units.

    center: mass centre, put on the spin axis; axes (3x3): columns gs, w2, w3 at phi_s = 0; at: angle from the
    flywheel's second axis to w2; static: U_s, kg m; tensor (3x3): about the mass centre in these axes, kg m2, of which
    Basilisk takes the diagonal and element 13.
    """

    name: str
    center: Array
    axes: Array
    at: float
    mass: float
    static: float
    tensor: Array


def wheels(stand: Stand) -> tuple[Wheel, ...]:
    """The flywheels as Basilisk has them; what it has no place for stays in `tensor`."""
    bodies = tree(stand)
    return tuple(_wheel(body, bodies) for body in bodies if body.turns)


def hub(stand: Stand, bearing_wheels: bool = False) -> tuple[float, Array, Array]:
    """Carrier and instruments as one body: mass, mass centre about O1, tensor about the mass centre.

    `bearing_wheels`: with every wheel's mass on its axis, and its moments of inertia without the products.
    """
    parts = []
    for body in tree(stand):
        if not body.turns:
            place, axes = (np.zeros(3), np.eye(3)) if body.parent is None else (body.position, body.axes)
            parts.append((body.mass, place + axes @ body.center, axes @ body.inertia @ axes.T))
    if bearing_wheels:
        for wheel in wheels(stand):
            moments = np.diag(np.diag(wheel.tensor))
            parts.append((wheel.mass, wheel.center, wheel.axes @ moments @ wheel.axes.T))
    mass = sum(m for m, _, _ in parts)
    center = sum((m * c for m, c, _ in parts), np.zeros(3)) / (mass or 1.0)
    tensor = np.zeros((3, 3))
    for m, c, J in parts:
        arm = c - center
        tensor += J + m * (float(arm @ arm) * np.eye(3) - np.outer(arm, arm))
    return mass, center, tensor


def unsupported_features(stand: Stand, asymmetric: bool = False) -> list[str]:
    """Features of the stand that Basilisk lacks. `asymmetric`: let Jt differ from Jg, which it takes but gets wrong."""
    found = unsupported_spacecraft_features(stand)
    whose: dict[str, list[str]] = {}
    for wheel in wheels(stand):
        J, little = wheel.tensor, ROUNDING * float(wheel.tensor[0, 0])
        reasons = {
            "a flywheel without mass": wheel.mass <= 0.0,
            "dynamic unbalance that is not across the static one": abs(J[0, 1]) > little,
            "a product of inertia J23": abs(J[1, 2]) > little,
            "transverse moments that differ": abs(J[1, 1] - J[2, 2]) > little and not asymmetric,
        }
        for words, so in reasons.items():
            if so:
                whose.setdefault(words, []).append(wheel.name)
    return found + [f"{words} ({', '.join(names)})" for words, names in whose.items()]


def unsupported_spacecraft_features(stand: Stand) -> list[str]:
    """Features of the stand, but of its flywheels, that Basilisk's free spacecraft lacks."""
    found = missing(stand)
    found += ["gravity that is the same everywhere"] * any(stand.gravity)
    return found + ["a carrier without mass"] * (hub(stand)[0] <= 0.0)


def spacecraft_stand(stand: Stand) -> Stand:
    """The stand without gravity and run-time wrenches; its flywheels stay as they are."""
    return replace(
        stand,
        gravity=(0.0, 0.0, 0.0),
        carrier=replace(stand.carrier, wrench_input=False),
        instruments=tuple(replace(each, wrench_input=False) for each in stand.instruments),
        flywheels=tuple(replace(each, wrench_input=False) for each in stand.flywheels),
    )


def basilisk_stand(stand: Stand, asymmetric: bool = False) -> Stand:
    """The stand without gravity and run-time wrenches, its flywheels cut to what Basilisk's wheel has.

    Of the dynamic unbalance the part across the static one is kept, of the transverse moments the mean; with
    `asymmetric` each of them.
    """
    flywheels = tuple(_basilisk_flywheel(s, w, asymmetric) for s, w in zip(stand.flywheels, wheels(stand), strict=True))
    return spacecraft_stand(replace(stand, flywheels=flywheels))


def _wheel(body: RigidBody, bodies: Sequence[RigidBody]) -> Wheel:
    body = mount_flywheel(body, bodies)
    place, axes = body.position, body.axes
    along, *across = body.center
    at = _direction(body)
    turn = about_first(at)
    tensor = turn.T @ body.inertia @ turn
    static = body.mass * float(np.hypot(*across))
    return Wheel(body.name, place + along * axes[:, 0], axes @ turn, at, body.mass, static, tensor)


def _direction(body: RigidBody) -> float:
    """Angle about the spin axis from the second axis to w2, rad."""
    if np.any(body.center[1:]):
        return float(np.arctan2(body.center[2], body.center[1]))
    # with no static unbalance w2 is free: across the dynamic one
    return float(np.arctan2(-body.inertia[0, 1], body.inertia[0, 2])) if np.any(body.inertia[0, 1:]) else 0.0


def _basilisk_flywheel(s: Flywheel, wheel: Wheel, asymmetric: bool) -> Flywheel:
    Js, Jt, Jg = np.diag(wheel.tensor)
    if not asymmetric:
        Jt = Jg = (Jt + Jg) / 2
    U_d = wheel.tensor[0, 2]
    own = np.array([[Js, 0.0, U_d], [0.0, Jt, 0.0], [U_d, 0.0, Jg]])
    turn = about_first(wheel.at)
    J = turn @ own @ turn.T
    J = (J + J.T) / 2
    inertia = cast(Mat3, tuple(tuple(map(float, row)) for row in J))
    return replace(s, inertia=inertia, inertia_about="center_of_mass")
