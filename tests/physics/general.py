"""Random general stands and states of moderate size, seeded: nothing balanced, symmetric or aligned."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mahovik.stand.model import (
    Buoyancy,
    Carrier,
    Damping,
    DampingTerm,
    Factor,
    Flywheel,
    Instrument,
    Leg,
    MountingAngles,
    MountingAxes,
    Point,
    Stand,
    Suspension,
)
from mahovik.stand.state import State


def rows(matrix):
    return tuple(tuple(float(x) for x in row) for row in matrix)


def vec(values):
    return tuple(float(x) for x in values)


class Builder:
    def __init__(self, seed):
        self.rng = np.random.default_rng(seed)

    def u(self, n, size=1.0):
        return vec(self.rng.uniform(-size, size, n))

    def inertia(self, mass, size):
        """About the centre of mass: of eight masses, so that the triangle inequality holds."""
        x = self.rng.normal(size=(8, 3)) * size
        x -= x.mean(axis=0)
        return mass / 8 * sum((r @ r) * np.eye(3) - np.outer(r, r) for r in x)

    def psd6(self, size):
        a = self.rng.normal(size=(6, 6))
        return rows(size * a @ a.T / 6)

    def damping(self, size):
        names = self.rng.integers(0, 6, (4, 3))
        flags = self.rng.integers(0, 2, (4, 2))
        terms = tuple(
            DampingTerm(int(w), (Factor(int(a), bool(i)), Factor(int(b), bool(j))), float(self.rng.normal() * size))
            for (w, a, b), (i, j) in zip(names, flags, strict=True)
        )
        return Damping(self.psd6(size), rows(self.rng.normal(size=(6, 6)) * size), terms)

    def body(self, name, mass, size):
        about = ("origin", "center_of_mass")[int(self.rng.integers(2))]
        rc = self.rng.uniform(-size, size, 3)
        J = self.inertia(mass, size)
        if about == "origin":
            J = J + mass * ((rc @ rc) * np.eye(3) - np.outer(rc, rc))
        return {
            "name": name,
            "mass": mass,
            "center_of_mass": vec(rc),
            "inertia": rows((J + J.T) / 2),
            "inertia_about": about,
            "buoyancy": Buoyancy(mass * 0.7, self.u(3, size)),
            "damping": self.damping(mass * 0.3),
            "wrench_input": True,
        }

    def flywheel(self, name, mounts):
        angles, axes = MountingAngles(*self.u(3, 2.0)), MountingAxes(self.u(3, 2.0), self.u(3, 2.0))
        return Flywheel(
            **self.body(name, float(self.rng.uniform(0.3, 1.0)), 0.1),
            mount=mounts[int(self.rng.integers(len(mounts)))],
            position=self.u(3, 0.4),
            mounting=(angles, axes)[int(self.rng.integers(2))],
            motor=None,
            encoder=None,
        )

    def instrument(self, name, added):
        return Instrument(
            **self.body(name, 1.0, 0.2),
            position=self.u(3, 0.3),
            angles=self.u(3, 2.0),
            added_mass=self.psd6(0.3) if added else None,
        )

    def stand(self, flywheels, *, instruments=2, added=True, stream=False):
        names = [f"p{i}" for i in range(instruments)]
        mounts = ["carrier", *names]
        return Stand(
            name="random",
            angles=("ship", "aircraft", "euler")[int(self.rng.integers(3))],
            gravity=self.u(3, 9.81),
            stream=self.u(3, 1.0) if stream else None,
            carrier=Carrier(**self.body("carrier", 5.0, 0.3), added_mass=self.psd6(1.0) if added else None),
            suspension=Suspension(self.psd6(50.0), self.psd6(5.0), self.u(3, 0.3), self.u(3, 1.0)),
            legs=tuple(Leg(self.u(3, 1.0), self.u(3, 0.3), 0.7, 40.0, 3.0) for _ in range(2)),
            instruments=tuple(self.instrument(name, added) for name in names),
            flywheels=tuple(self.flywheel(f"w{i}", mounts) for i in range(flywheels)),
            points=tuple(Point(f"a{i}", mounts[i % len(mounts)], self.u(3, 0.3), self.u(3, 2.0)) for i in range(2)),
        )

    def state(self, stand):
        N = len(stand.flywheels)
        return State(
            position=self.u(3, 1.0),
            angles=(*self.u(1, 3.0), float(self.rng.uniform(0.4, 1.2)), *self.u(1, 3.0)),  # nowhere singular
            quaternion=None,
            V=self.u(6, 2.0),
            phi=self.u(N, 3.0),
            phi_dot=self.u(N, 20.0),
            phi_ddot=self.u(N, 50.0),
            V_dot=self.u(6, 5.0),
            tau=self.u(N, 2.0),
            wrench={body.name: self.u(6, 3.0) for body in stand.bodies},
        )


def draw(seed, flywheels=4, **options):
    """A random general stand and a state of it."""
    builder = Builder(seed)
    stand = builder.stand(flywheels, **options)
    return stand, builder.state(stand)


def isolated(stand):
    """The stand without any external wrench: no gravity, fluid wrenches, suspension nor legs. Added mass stays."""

    def bare(body):
        return replace(body, buoyancy=None, damping=None)

    return replace(
        stand,
        gravity=(0.0, 0.0, 0.0),
        carrier=bare(stand.carrier),
        instruments=tuple(bare(p) for p in stand.instruments),
        flywheels=tuple(bare(s) for s in stand.flywheels),
        suspension=None,
        legs=(),
    )


def without_added_mass(stand):
    return replace(
        stand,
        carrier=replace(stand.carrier, added_mass=None),
        instruments=tuple(replace(p, added_mass=None) for p in stand.instruments),
    )


def without_wrench(state):
    """The state without run-time wrenches."""
    return replace(state, wrench={})
