"""Whether the answers of a stand depend on a key of a state: a program or a log without it may still be judged."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from mahovik.core.stand.hold import has_coordinates, numbered_freedoms
from mahovik.core.stand.model import Stand
from mahovik.core.stand.random_state import random_state
from mahovik.core.stand.state import State
from mahovik.proof import reference
from mahovik.proof.reference.coordinates import coordinates_at
from mahovik.proof.verify.held import at_coordinates, onto_hold, with_quaternion

KEYS = {"V": ("V", "u"), "V_dot": ("V_dot", "u_dot")}
"""Keys of a state that differ together."""

MOVES = {"position": "slide", "quaternion": "turn"}
"""What moves a held carrier where a part of its pose differs."""

SAME = 1e-12
"""Relative difference that is rounding."""


def depends_on(stand: Stand, wants: Sequence[str], key: str) -> bool:
    """Whether an answer differs between two values of a key of a state, beyond rounding; of V also those of u.

    `position`, `quaternion` of a held carrier whose freedoms have coordinates: between poses that the hold allows. What
    turns changes the attitude, what slides the position.
    """
    for want in wants:
        first, second = (reference.evaluate(stand, state, (want,)) for state in _states(stand, key))
        for name, value in first.items():
            a, b = np.asarray(value), np.asarray(second[name])
            if not np.allclose(a, b, rtol=SAME, atol=SAME * float(np.abs(a).max(initial=0.0))):
                return True
    return False


def _states(stand: Stand, key: str) -> tuple[State, State]:
    """Two states that differ in this key."""
    first, second = (with_quaternion(stand, random_state(stand, np.random.default_rng(seed))) for seed in (1, 2))
    hold = stand.hold
    if key not in MOVES or hold is None or (hold.freedoms and not has_coordinates(hold)):
        return first, replace(first, **{name: getattr(second, name) for name in KEYS.get(key, (key,))})
    first, second = onto_hold(stand, first), onto_hold(stand, second)
    if not any(freedom.kind == MOVES[key] for freedom in hold.freedoms):
        return first, first
    at, then = coordinates_at(stand, first), coordinates_at(stand, second)
    moves = [hold.freedoms[k].kind == MOVES[key] for k in numbered_freedoms(hold)]
    turned = then.orientation if key == "quaternion" else at.orientation
    return first, at_coordinates(stand, first, np.where(moves, then.q, at.q), turned)
