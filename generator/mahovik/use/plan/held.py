"""What planning asks of a held carrier: mean wrenches along its freedoms, and words about them."""

from __future__ import annotations

import numpy as np

from mahovik.core.motion.motion_file import NO_SLEW
from mahovik.core.motion.required import RequiredMotion, Slew
from mahovik.core.stand.coordinates import coordinates_of
from mahovik.core.stand.hold import twists as freedom_twists
from mahovik.core.stand.hold import wrenches
from mahovik.core.stand.masses import transfer
from mahovik.core.stand.model import Stand
from mahovik.errors import MotionError
from mahovik.use.numeric.frame import Frame, Twists
from mahovik.use.numeric.se3 import Array

UNITS = {"m": ("force", "N"), "rad": ("moment", "N m"), "": ("wrench", "")}
"""What acts along a coordinate of a unit, and its own unit."""


def refuse_unplannable(stand: Stand, required: RequiredMotion | Slew) -> None:
    """Refuse what is planned for free carriers alone. Raises StandError, MotionError."""
    if stand.hold is None:
        return
    coordinates = coordinates_of(stand)
    if isinstance(required, Slew):
        raise MotionError([f"{required.name}: type: {NO_SLEW}"])
    if len(required.mean) != coordinates.count:
        raise MotionError([f"{required.name}: is of another carrier; expected rows of {coordinates.words}"])


def mean_along_freedoms(stand: Stand, at: Twists, F: Array) -> Array:
    """Mean (m) of wrenches F (M, 6) in E1 about O1 along the freedoms, counted in the home pose.

    There the freedoms stay as they are, so that over a period the momentum along them has no change.
    """
    hold = stand.hold
    assert hold is not None
    S = freedom_twists(hold)
    C0, O0 = (each[0] for each in Frame.of(stand).pose(np.zeros((1, S.shape[1]))))
    found = np.zeros(6)
    for C, O1, wrench in zip(at.C, at.O1, F, strict=True):
        found += transfer(C0.T @ (O1 - O0), C0.T @ C) @ wrench
    return np.asarray(S.T @ found / len(F))


def wrench_of(stand: Stand, along: Array) -> Array:
    """A wrench (..., 6) of what acts along the freedoms (..., m) and nowhere else."""
    assert stand.hold is not None
    return np.asarray(along @ wrenches(stand.hold).T)


def slide_directions(stand: Stand) -> Array | None:
    """Directions (3, k) in E0 along which the momentum of a held carrier is free; None of a free one: all."""
    hold = stand.hold
    if hold is None:
        return None
    C0 = Frame.of(stand).pose(np.zeros((1, len(hold.freedoms))))[0][0]
    slides = [np.array(each.direction) for each in hold.freedoms if each.kind == "slide"]
    return np.asarray(C0 @ np.array([each / np.linalg.norm(each) for each in slides]).reshape(-1, 3).T)
