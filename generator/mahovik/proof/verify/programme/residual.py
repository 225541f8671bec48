"""Item 1: the residual of (12) between the programme's own nodes; and on the same grid the drive torques."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.core.motion.programme import Fourier, Programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand.model import Stand
from mahovik.proof.reference.array import Array
from mahovik.proof.verify.programme.along import instants
from mahovik.proof.verify.programme.finding import Finding, judged
from mahovik.proof.verify.programme.scale import Scale

FINER = 20
"""Times a node of the programme."""

OFFSET = 0.382
"""Offset of the grid, in steps, so that no node repeats."""


@dataclass(frozen=True, eq=False)
class Along:
    """What the reference says along a programme.

    t (M, s), residual (M) and its mean as shares, tau (M, N; N m).
    """

    t: Array
    residual: Array
    mean: float
    tau: Array


def nodes(programme: Programme, motion: RequiredMotion) -> int:
    """Points of the grid in a span; no fewer than the fastest of flywheels and motion needs."""
    own = 2 * len(programme.course.cos) + 1 if isinstance(programme.course, Fourier) else len(programme.course.t)
    fastest = max([*motion.harmonics, *(abs(n) for n in programme.winding), 1])
    return max(own, 2 * fastest + 1)


def fine_grid(programme: Programme, motion: RequiredMotion) -> Array:
    """Times (M) over the span, 20 to a node, beside every node."""
    M = FINER * nodes(programme, motion)
    return programme.span * (np.arange(M) + OFFSET) / M


def along(stand: Stand, motion: RequiredMotion, programme: Programme, scale: Scale, times: int | None = None) -> Along:
    """The whole span on the fine grid, or at so many times."""
    t = fine_grid(programme, motion) if times is None else programme.span * (np.arange(times) + OFFSET) / times
    R, tau = [], []
    for instant in instants(stand, motion.at(t, programme.bias), programme.at(t)):
        R.append(instant.residual())
        tau.append(instant.torque())
    shares = np.array([scale.of_wrench(each) for each in R])
    return Along(t, shares, scale.of_wrench(np.mean(R, axis=0)), np.array(tau))


def finding(found: Along, limit: float) -> Finding:
    """The largest residual of (12), relative."""
    i = int(np.argmax(found.residual))
    value = float(found.residual[i])
    words = f"of (12), at {len(found.t)} times; largest at t = {found.t[i]:.6g} s"
    if found.mean > 0.5 * value and value > 0.1 * limit:
        words += f"; mean {found.mean:.2g}, which nothing balances: the carrier drifts"
    return judged("residual", value, limit, words)
