"""The force of a body, literally."""

from __future__ import annotations

import numpy as np

from mahovik.core.stand.model import Body
from mahovik.proof.reference.algebra import Array, force_at, vector
from mahovik.proof.reference.pieces import BodyReference

from .law import Tug  # noqa: TID252  # its package is that of the laws


def wrenches(body: Body, law: Tug, gravity: Array, V_r: Array) -> dict[str, Array]:
    """The force (6; N, N m) at the origin."""
    return {"tug": force_at(vector(law.force), np.zeros(3))}


LAW = BodyReference(wrenches, Tug)
