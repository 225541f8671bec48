"""Random general stands with every kind of wrench, moderate states of them, and stands with parts taken away."""

from dataclasses import replace

import numpy as np

from mahovik.core.stand.model import Body, Stand
from mahovik.core.stand.random import EVERYTHING, random_stand, random_state
from mahovik.core.stand.state import State


def rows(matrix: np.ndarray):
    return tuple(tuple(float(x) for x in row) for row in matrix)


def draw(seed: int, flywheels: int = 4, *, instruments=2, added=True, stream: bool = False):
    """A random general stand and a state of it, with a run-time wrench on every body.

    Speeds near 20 rad/s, so that differences over a millisecond resolve them; angles well off their singularity.
    """
    rng = np.random.default_rng(seed)
    stand = random_stand(rng, flywheels, replace(EVERYTHING, instruments=instruments, stream=stream))
    if not added:
        stand = without_added_mass(stand)

    def numbers(n, size):
        return tuple(float(x) for x in rng.uniform(-size, size, n))

    state = replace(
        random_state(stand, rng),
        angles=(*numbers(1, 3.0), float(rng.uniform(0.4, 1.2)), *numbers(1, 3.0)),
        quaternion=None,
        phi_dot=numbers(flywheels, 20.0),
        phi_ddot=numbers(flywheels, 50.0),
        wrench={body.name: numbers(6, 3.0) for body in stand.bodies},
    )
    return stand, state


def isolated(stand: Stand):
    """The stand without any external wrench: no gravity, fluid wrenches, suspension nor legs. Added mass stays."""

    def bare(body: Body):
        return replace(body, buoyancy=None, damping=None)

    return replace(
        stand,
        gravity=(0.0, 0.0, 0.0),
        carrier=bare(stand.carrier),
        instruments=tuple(bare(p) for p in stand.instruments),
        flywheels=tuple(bare(s) for s in stand.flywheels),
        laws=(),
    )


def without_added_mass(stand: Stand):
    return replace(
        stand,
        carrier=replace(stand.carrier, added_mass=None),
        instruments=tuple(replace(p, added_mass=None) for p in stand.instruments),
    )


def without_wrench(state: State):
    """The state without run-time wrenches."""
    return replace(state, wrench={})
