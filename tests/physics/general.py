"""Random general stands with every kind of wrench, moderate states of them, and stands with parts taken away."""

from dataclasses import replace
from typing import Any, TypeVar

import numpy as np

from mahovik.core.stand.model import Body, Stand, State
from mahovik.core.stand.random import EVERYTHING, random_stand, random_state
from mahovik.laws.suspension.law import Suspension
from mahovik.proof.reference.pieces import Pieces, PlacedBody

AnyBody = TypeVar("AnyBody", bound=Body)


def suspension_of(stand: Stand) -> Suspension:
    """The suspension of a stand that has one."""
    suspension = stand.law(Suspension)
    assert suspension is not None
    return suspension


def placed(at: Pieces) -> tuple[PlacedBody, ...]:
    """Every body with its transfer to E1: carrier, instruments, flywheels."""
    return (*at.fixed, *at.flywheels)


def rows(matrix: np.ndarray) -> tuple[Any, ...]:
    """A matrix as the plain data of a stand."""
    return tuple(tuple(float(x) for x in row) for row in matrix)


def draw(
    seed: int, flywheels: int = 4, *, instruments: int = 2, added: bool = True, stream: bool = False
) -> tuple[Stand, State]:
    """A random general stand and a state of it, with a run-time wrench on every body.

    Speeds near 20 rad/s, so that differences over a millisecond resolve them; angles well off their singularity.
    """
    rng = np.random.default_rng(seed)
    stand = random_stand(rng, flywheels, replace(EVERYTHING, instruments=instruments, stream=stream))
    stand = replace(  # what its flywheels can do is no matter here: nothing is EXCESSIVE
        stand, inverse_most=1e300, flywheels=tuple(replace(s, motor=None) for s in stand.flywheels)
    )
    if not added:
        stand = without_added_mass(stand)

    def numbers(n: int, size: float) -> tuple[Any, ...]:
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


def isolated(stand: Stand) -> Stand:
    """The stand without any external wrench: no gravity, fluid wrenches, suspension nor legs. Added mass stays."""

    def bare(body: AnyBody) -> AnyBody:
        return replace(body, laws=())

    return replace(
        stand,
        gravity=(0.0, 0.0, 0.0),
        carrier=bare(stand.carrier),
        instruments=tuple(bare(p) for p in stand.instruments),
        flywheels=tuple(bare(s) for s in stand.flywheels),
        laws=(),
    )


def without_added_mass(stand: Stand) -> Stand:
    """The stand without the added mass of any body."""
    return replace(
        stand,
        carrier=replace(stand.carrier, added_mass=None),
        instruments=tuple(replace(p, added_mass=None) for p in stand.instruments),
    )


def without_wrench(state: State) -> State:
    """The state without run-time wrenches."""
    return replace(state, wrench={})
