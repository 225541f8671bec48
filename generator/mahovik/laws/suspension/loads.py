"""Wrench that the suspension transmits, for many samples whose numbers differ."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from mahovik.core.stand.structure_facts import Structure
from mahovik.out.campaign.pose import Array, Loads, Pose, compose, conjugate, product, rotation_vector, turn_back

NAME = "suspension"


def names(structure: Structure) -> tuple[str, ...]:
    """Name of the suspension; empty where the stand has none."""
    return (NAME,) if structure.law(NAME) else ()


def wrench(name: str, numbers: Mapping[str, Any], at: Pose, attitude: Array) -> Array:
    """-(stiffness x + damping V) (..., 6, n; N, N m) on the carrier about O1 in E1.

    x = (C^T (O1 - position), rotation vector of C_eq^T C); `attitude` (..., 4, n) is the quaternion of C.
    """
    own = numbers[NAME]
    turned = rotation_vector(compose(conjugate(own["attitude"]), attitude))
    x = np.concatenate([turn_back(at.C, at.O1 - own["position"]), turned], axis=-2)
    return np.asarray(-product(own["stiffness"], x) - product(own["damping"], at.V))


LAW = Loads(names, wrench)
