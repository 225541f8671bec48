"""Demands on a held carrier that cannot be planned: of a clamped one, and of motions along what its hold blocks."""

from __future__ import annotations

import numpy as np

from mahovik.core.motion.required import RequiredMotion, Slew
from mahovik.core.stand.hold import INSTEAD, TWIST_NAMES, freedom_names, refuse_hold, twists
from mahovik.core.stand.model import Stand
from mahovik.errors import MotionError, StandError
from mahovik.proof.reference.rotation import kinematic_matrix

MOMENTS = 64
"""Times at which a required motion is looked at."""

BLOCKED = 1e-6
"""Part of the largest speed of a required motion that may be along what the hold blocks: figures of six digits."""


def refuse_held(stand: Stand, required: RequiredMotion | Slew) -> None:
    """Refuse a held carrier: what it cannot do by name, and else that planning takes free carriers only.

    Raises StandError of a clamped carrier and of others that could do what is required; MotionError, with the blocked
    direction, of those that could not.
    """
    if stand.hold is None:
        return
    if not stand.hold.freedoms:
        found = "no freedoms: clamped, the carrier does nothing that a programme could be planned for"
        raise StandError([f"{stand.name}: hold: {found}; expected a stand without [hold]; {INSTEAD}"])
    if isinstance(required, RequiredMotion):
        _refuse_blocked(stand, required)
    refuse_hold(stand, stand.name)


def _refuse_blocked(stand: Stand, required: RequiredMotion) -> None:
    """Raises MotionError where the twist of the motion has a part that no freedom gives: B^T V = 0 fails."""
    hold = stand.hold
    assert hold is not None
    course = required.at(np.linspace(0.0, required.span, MOMENTS))
    V = np.array([kinematic_matrix(stand.angles, q[3:]) @ rate for q, rate in zip(course.q, course.q_dot, strict=True)])
    S = twists(hold)
    off = np.abs(V - V @ (S @ np.linalg.pinv(S)).T).max(axis=0)
    if off.max() > BLOCKED * np.abs(V).max():
        name, freedoms = TWIST_NAMES[int(np.argmax(off))], ", ".join(freedom_names(hold))
        raise MotionError(
            [f"{required.name}: asks for motion along {name}, which [hold] blocks; expected its freedoms, {freedoms}"]
        )
