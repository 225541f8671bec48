"""Whether the answers of a stand depend on a key of a state: a program or a log without it may still be judged."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from mahovik.core.stand.hold import has_coordinates, numbered_freedoms
from mahovik.core.stand.model import Stand
from mahovik.core.stand.random_state import random_state
from mahovik.core.stand.state import State
from mahovik.proof import reference
from mahovik.proof.reference.coordinates import coordinates_at
from mahovik.proof.verify.held import at_coordinates, onto_hold

POSES: Mapping[str, tuple[Any, Any]] = {
    "position": ((0.0, 0.0, 0.0), (0.3, -0.2, 0.1)),
    "quaternion": ((1.0, 0.0, 0.0, 0.0), (0.1, 0.7, 0.5, 0.5)),
}
"""Two poses that differ in one key of a state."""

MOVED = 0.7
"""m, rad: by how much coordinates of a held carrier differ."""

SAME = 1e-12
"""Relative difference that is rounding."""


def depends_on(stand: Stand, wants: Sequence[str], key: str) -> bool:
    """Whether an answer differs between two values of a key of a state, beyond rounding; of V also those of u.

    `position`, `quaternion` of a held carrier whose freedoms have coordinates: between poses that the hold allows. What
    turns changes the attitude, what slides the position.
    """
    state = replace(random_state(stand, np.random.default_rng(1)), angles=None)
    for want in wants:
        first, second = (reference.evaluate(stand, each, (want,)) for each in _poses(stand, state, key))
        for name, value in first.items():
            a, b = np.asarray(value), np.asarray(second[name])
            if not np.allclose(a, b, rtol=SAME, atol=SAME * float(np.abs(a).max(initial=0.0))):
                return True
    return False


def _poses(stand: Stand, state: State, key: str) -> Iterator[State]:
    """The state, and another that differs in this key."""
    hold = stand.hold
    if key not in POSES:
        other = random_state(stand, np.random.default_rng(2))
        keys = {"V": ("V", "u"), "V_dot": ("V_dot", "u_dot")}.get(key, (key,))
        yield from (state, replace(state, **{name: getattr(other, name) for name in keys}))
        return
    if hold is None or (hold.freedoms and not has_coordinates(hold)):
        yield from (replace(state, **{key: pose}) for pose in POSES[key])
        return
    moving, here = {"position": "slide", "quaternion": "turn"}[key], onto_hold(stand, state)
    yield here
    if not any(each.kind == moving for each in hold.freedoms):
        yield here
        return
    own = [hold.freedoms[k].kind for k in numbered_freedoms(hold)]
    at = coordinates_at(stand, here)
    moved = at.q + MOVED * np.array([kind == moving for kind in own])
    turned = at.orientation if moving == "slide" or at.orientation is None else np.array(POSES[key][1])
    yield at_coordinates(stand, state, moved, turned)
