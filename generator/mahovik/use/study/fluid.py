"""Passivity and course of a stand in a fluid: power of its laws, added mass, growth of small motions."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from mahovik.contract.quantities import BOUNDS
from mahovik.core.lower.law_arrays import TwistLaws, law_arrays
from mahovik.core.stand.masses import inertia_about_center
from mahovik.core.stand.model import Body, Carrier, Instrument, Stand
from mahovik.core.stand.state import rest_state
from mahovik.proof.reference.assembly import pieces
from mahovik.proof.reference.motion import forward

Array = NDArray[np.float64]
AnyBody = TypeVar("AnyBody", bound=Body)

DIRECTIONS = 4096
"""Random directions of a body's twist at which the power is asked, and as many with few components."""

ROUNDING = 1e-12
"""Part of the sum of all magnitudes below which power is rounding."""

NEUTRAL = 1e-6
"""Growth over the velocity, 1/m, that rounding may give to a double eigenvalue 0 of derivatives by differences."""

_SEED = 24
_STEP = 1e-6


@dataclass(frozen=True)
class Power:
    """Power of the fluid's laws on one body over the accepted velocities, as far as a search at many twists finds it.

    body      its name
    ahead     only twists with u > 0 of which u is the largest velocity; else any
    positive  whether work is done on the body somewhere
    speed     least |v| found, m/s, at which it is positive; infinite where nowhere
    twist     there (6; m/s, rad/s), in the body's frame; power there, W
    """

    body: str
    ahead: bool
    positive: bool
    speed: float
    twist: tuple[float, ...]
    power: float

    def __str__(self) -> str:
        drives = "drives nowhere that was tried"
        if self.positive:
            twist = ", ".join(f"{x + 0.0:.3g}" for x in self.twist)
            drives = f"drives from {self.speed:.3g} m/s: {self.power:.3g} W at ({twist})"
        return f"laws of the fluid on {self.body}, {'twists ahead' if self.ahead else 'any twist'}: {drives}"


@dataclass(frozen=True)
class AddedMass:
    """Lambda of the whole stand about O1 in E1, which is symmetric in every stand that is read.

    least    eigenvalue at unit diagonal, of the rows that are not zero; above 0: definite there
    rows     how many rows are not zero
    sway     N_uv, the moment of Munk about z over u v, kg: Lambda_11 - Lambda_22
    heave    M_uw, about y over u w, kg: Lambda_33 - Lambda_11
    without  bodies with added mass whose published derivatives contain its products: those of (8) are taken out there
    """

    least: float
    rows: int
    sway: float
    heave: float
    without: tuple[str, ...] = ()


@dataclass(frozen=True)
class Fluid:
    """What `mahovik check --fluid` prints.

    powers    of all laws of the fluid but engines
    engines   bodies with laws that drive by their purpose, such as propellers
    velocity  ahead, m/s, along axis 1 of the carrier
    growth    largest growth rate of small motions from there, 1/s, flywheels at rest, without weight and supports
    """

    powers: tuple[Power, ...]
    engines: tuple[str, ...]
    added_mass: AddedMass | None
    velocity: float
    growth: float

    def words(self) -> list[str]:
        """What is found, in sentences."""
        result = [str(one) for one in self.powers] or ["fluid: no body has a law of its twist relative to the fluid"]
        if self.engines:
            result.append(f"propellers on {', '.join(self.engines)} are there to drive, and left out")
        if (added := self.added_mass) is not None:
            kind = "definite" if added.least > 1e-9 else "semidefinite"
            result.append(
                f"added mass: symmetric, {kind} in its {added.rows} rows (least eigenvalue at unit diagonal "
                f"{added.least:.4g}); moment of Munk {added.sway:.5g} kg u v about z, {added.heave:.5g} kg u w about y"
            )
            if added.without:
                bodies = ", ".join(added.without)
                result.append(f"the published derivatives on {bodies} contain these products: they count once")
        neutral = abs(self.growth) <= NEUTRAL * self.velocity
        course = "neutral" if neutral else "the course is unstable" if self.growth > 0.0 else "small motions decay"
        growth = 0.0 if neutral else self.growth
        result.append(f"at {self.velocity:g} m/s ahead, without weight: growth rate {growth:.4g} 1/s, {course}")
        return result


def fluid(stand: Stand, velocity: float) -> Fluid:
    """The report for a velocity ahead (m/s)."""
    laws = law_arrays(_without_engines(stand)).bodies
    powers = tuple(
        power_of(body, laws_of_body, ahead)
        for body, laws_of_body in zip(stand.bodies, laws, strict=True)
        if laws_of_body is not None
        for ahead in (False, True)
    )
    engines = tuple(body.name for body in stand.bodies if any(law.drives for law in body.laws))
    return Fluid(powers, engines, added_mass(stand), velocity, growth(stand, velocity))


def _without_engines(stand: Stand) -> Stand:
    """The stand without propellers and other engines."""

    return replace(
        stand,
        carrier=_idle_body(stand.carrier),
        instruments=tuple(map(_idle_body, stand.instruments)),
        flywheels=tuple(map(_idle_body, stand.flywheels)),
    )


def _idle_body(body: AnyBody) -> AnyBody:
    return replace(body, laws=tuple(law for law in body.laws if not law.drives))


def power_of(body: Body, laws: TwistLaws, ahead: bool) -> Power:
    """Search the twists of a body for positive power, from small to large."""
    directions, largest = _directions(body, ahead), BOUNDS["MAX_VELOCITY"].value
    for speed in np.geomspace(1e-3, largest, 29):
        V = speed * directions
        V[:, 3:] = np.clip(V[:, 3:], -BOUNDS["MAX_SPEED"].value, BOUNDS["MAX_SPEED"].value)
        parts = laws.wrench(V) * V
        power, size = parts.sum(axis=1), np.abs(parts).sum(axis=1)
        share = np.where(size > 0.0, power / np.where(size > 0.0, size, 1.0), 0.0)
        k = int(np.argmax(share))
        if share[k] > ROUNDING:
            return Power(body.name, ahead, True, float(speed), tuple(V[k].tolist()), float(power[k]))
    return Power(body.name, ahead, False, float("inf"), (), 0.0)


def _directions(body: Body, ahead: bool) -> Array:
    """Twists (n, 6) with |v| <= 1 m/s, and turning that is as fast at the body's radius of gyration."""
    rng = np.random.default_rng(_SEED)
    D = rng.uniform(-1.0, 1.0, size=(2 * DIRECTIONS, 6))
    D[:DIRECTIONS] *= rng.random((DIRECTIONS, 6)) < 0.4  # few components
    D = np.vstack([D, np.eye(6), -np.eye(6)])
    if ahead:
        D[:, 0] = np.abs(D[:, 1:3]).max(axis=1) + np.abs(D[:, 0])
        D = D[D[:, 0] > 0.0]
    length = np.linalg.norm(D[:, :3], axis=1, keepdims=True)
    D /= np.where(length > 0.0, length, 1.0)
    radius = _radius(body)
    D[:, 3:] /= radius
    return D


def _radius(body: Body) -> float:
    """Radius of gyration (m), 1 m for a body without mass or inertia."""
    J = float(np.trace(inertia_about_center(body)))
    return float(np.sqrt(J / (2.0 * body.mass))) if body.mass > 0.0 and J > 0.0 else 1.0


def added_mass(stand: Stand) -> AddedMass | None:
    """The whole added mass; None without."""
    parts = [np.array(body.added_mass) for body in _fixed_bodies(stand) if body.added_mass is not None]
    if not parts:
        return None
    Lambda = np.asarray(sum(parts))
    kept = np.flatnonzero(np.diag(Lambda))
    root = np.sqrt(np.diag(Lambda)[kept])
    least = float(np.linalg.eigvalsh(Lambda[np.ix_(kept, kept)] / np.outer(root, root))[0])
    without = tuple(
        body.name
        for body in _fixed_bodies(stand)
        if body.added_mass is not None and any(law.takes_out_products for law in body.laws)
    )
    sway, heave = float(Lambda[0, 0] - Lambda[1, 1]), float(Lambda[2, 2] - Lambda[0, 0])
    return AddedMass(least, len(kept), sway, heave, without)


def _fixed_bodies(stand: Stand) -> Iterator[Carrier | Instrument]:
    yield stand.carrier
    yield from stand.instruments


def growth(stand: Stand, velocity: float) -> float:
    """Largest real part (1/s) of the eigenvalues of dV*/dV at V = (velocity, 0, 0, 0, 0, 0)."""
    bare = replace(stand, gravity=(0.0, 0.0, 0.0), stream=None, profile=None, hold=None, laws=(), tasks=())
    ahead = velocity * np.eye(6)[0]
    columns = []
    for unit in np.eye(6):
        step = _STEP * max(1e-3, abs(velocity)) * unit
        columns.append((_rate(bare, ahead + step) - _rate(bare, ahead - step)) / (2.0 * float(step.sum())))
    return float(np.linalg.eigvals(np.array(columns).T).real.max())


def _rate(stand: Stand, V: Array) -> Array:
    """V* (6) at a twist, flywheels locked."""
    state = replace(rest_state(stand), V=tuple(V.tolist()))
    return np.asarray(forward(pieces(stand, state), np.zeros(len(stand.flywheels))))
