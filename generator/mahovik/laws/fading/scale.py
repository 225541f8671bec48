"""Scale of a body's fading damping."""

from __future__ import annotations

import numpy as np

from mahovik.core.stand.model import Body
from mahovik.laws.fading.data import FadingDamping
from mahovik.proof.reference.array import Array


def scale(body: Body, gravity: float, twist: Array) -> Array:
    """Magnitudes of all its terms (6; N, N m), unfaded, at the scale of the body's twist (6), in its own frame.

    An error of U by e changes the wrench by at most rate U exp(-rate U) < 0.37 of these times e.
    """
    law = body.law(FadingDamping)
    return np.zeros(6) if law is None else np.asarray(np.abs(np.array(law.linear)) @ twist)
