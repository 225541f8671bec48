"""Derivatives of wrenches by the carrier's pose and twist: what the laws of `laws/` give to planning."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np

from mahovik.core.stand.model import Body, Stand
from mahovik.use.plan.array import Array
from mahovik.use.plan.residual.kinematics import Twists
from mahovik.use.plan.residual.spatial import skew

SMALL = 1e-2
"""rad: below it a series is more exact."""


class Slopes(NamedTuple):
    """Derivatives by a small pose (translation, rotation vector on E1) and by V: (M, 6, 6) each."""

    by_pose: Array
    by_twist: Array


@dataclass(frozen=True)
class CarrierPlan:
    """A law between E0 and the carrier: its wrench (M, 6) on the carrier about O1 in E1, and its slopes.

    StateError: the law is undefined there.
    """

    wrench: Callable[[Stand, Twists], Array]
    slopes: Callable[[Stand, Twists], Slopes]


class TwistLaw(Protocol):
    """A wrench that depends on the twist v (M, 6) of a body relative to the fluid, both in the body's frame."""

    def wrench(self, v: Array) -> Array:
        """P (M, 6; N, N m)."""

    def rate(self, v: Array) -> Array:
        """dP/dv (M, 6, 6); |v| has the slope 0 at v = 0."""


@dataclass(frozen=True)
class BodyPlan:
    """A law of bodies: what of it depends on the twist of a body; None of a body without the law."""

    twist_law: Callable[[Body], TwistLaw | None]


def rotation_vector_rate(r: Array) -> Array:
    """B (M, 3, 3): r' = B omega of a rotation vector r (M, 3), omega on the turned axes."""
    angle = np.linalg.norm(r, axis=1)[:, None, None]
    with np.errstate(divide="ignore", invalid="ignore"):
        k = (1.0 - angle / 2.0 / np.tan(angle / 2.0)) / angle**2
    k = np.where(angle < SMALL, 1.0 / 12.0 + angle**2 / 720.0 + angle**4 / 30240.0, k)
    turned = skew(r)
    return np.asarray(np.eye(3) + 0.5 * turned + k * (turned @ turned))
