"""States at which faults look different from one another: everything at once, then one kind of motion at a time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType
from typing import Any

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.core.stand.random_state import in_layer, random_state, random_wrenches
from mahovik.core.stand.state import State
from mahovik.proof.verify.draw import with_drawn_actuators
from mahovik.proof.verify.foreign import Program
from mahovik.proof.verify.held import with_angles, with_quaternion

FIRST = 3
"""Number of leading states with all features active: every visible fault shows in them, so they suffice to search."""

ALONE = 4
"""Largest number of flywheels that have a state in which they alone turn."""

STILL: Mapping[str, str] = {
    "all 1": "",
    "all 2": "",
    "all 3": "",
    "at rest": "V phi_dot phi_ddot V_dot tau",
    "flywheels turn": "V phi_ddot V_dot tau",
    "flywheels accelerate": "V phi_dot V_dot",
    "carrier moves": "phi_dot phi_ddot V_dot tau",
    "carrier accelerates": "V phi_dot phi_ddot",
    "no acceleration": "phi_ddot V_dot tau",
}
"""States, and what is zero there."""

BY_QUATERNION = ("all 2", "no acceleration")


def separating_states(stand: Stand, seed: int = 1, program: Program | None = None) -> list[tuple[str, State]]:
    """States with their names, the same for the same seed; without the extremes of `verify`, which rounding disturbs.

    `program`: that takes them, in the form in which it is given them.
    """
    rng = np.random.default_rng(seed)
    alone = {f"{k.name} turns": k.name for k in stand.flywheels[:ALONE]}
    found = []
    for number, name in enumerate((*STILL, *alone)):
        state = random_state(stand, rng)
        if name in BY_QUATERNION:
            state = with_quaternion(stand, state)
        else:
            while not 0.3 < abs(with_angles(stand, state).angles[1]) < 1.2:  # type: ignore[index]
                state = random_state(stand, rng)  # well off the singularity of the angles
            state = with_angles(stand, state)
        takes = [body.name for body in stand.bodies if body.wrench_input] if number < FIRST - 1 else []
        given: dict[str, Any] = {"wrench": random_wrenches(rng, takes) if takes else MappingProxyType({})}
        for key in STILL.get(name, "").split():
            given |= {each: (0.0,) * len(getattr(state, each)) for each in (key, key.replace("V", "u"))}
        if name in alone:
            speeds = zip(stand.flywheels, state.phi_dot, strict=True)
            given["phi_dot"] = tuple(x if k.name == alone[name] else 0.0 for k, x in speeds)
        state = replace(state, **given)
        if stand.profile is not None:  # layer by layer from the lowest
            layers = len(stand.profile.depth) - 1
            state = in_layer(stand, state, layers - 1 - number % layers, (0.7, 0.4)[number % 2])
        if program is not None:
            state = with_drawn_actuators(stand, state, rng) if program.actuators else state
            state = program.state(stand, state)
        found.append((name, state))
    return found


def spread_rows(states: Sequence[tuple[str, State]], count: int) -> list[tuple[str, State]]:
    """At most `count` rows of a log, spread evenly."""
    return [states[k] for k in np.linspace(0, len(states) - 1, min(count, len(states))).astype(int)]
