"""Deflections of fins and speeds of propellers in a state, in place of those of the stand file."""

from __future__ import annotations

from dataclasses import replace
from types import MappingProxyType
from typing import Any

import numpy as np

from mahovik.contract.laws import of_bodies
from mahovik.core.stand.actuator import Actuator
from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State


def actuators_of(stand: Stand) -> dict[str, Actuator]:
    """Fins and propellers of a stand by name."""
    found: dict[str, Actuator] = {}
    for actuators in of_bodies("actuator", "actuators"):
        for body in stand.bodies:
            found |= actuators(body)
    return found


def stand_at(stand: Stand, state: State) -> Stand:
    """The stand with the deflections (rad) and speeds (rad/s) of a state; itself, where the state has none."""
    if not state.actuators:
        return stand
    changes = of_bodies("actuator", "actuate")

    def change(body: Any) -> Any:
        for actuate in changes:
            body = actuate(body, state.actuators)
        return body

    return replace(stand, carrier=change(stand.carrier), instruments=tuple(map(change, stand.instruments)))


def with_drawn_actuators(stand: Stand, state: State, rng: np.random.Generator) -> State:
    """The state with deflections and speeds of their usual size; itself where the stand has neither."""
    known = actuators_of(stand)
    if not known:
        return state
    sizes = rng.uniform(0.3, 1.0, len(known)) * rng.choice([-1.0, 1.0], len(known))
    given = {name: float(size * each.usual) for (name, each), size in zip(known.items(), sizes, strict=True)}
    return replace(state, actuators=MappingProxyType(given))
