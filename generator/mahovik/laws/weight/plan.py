"""Weight in planning."""

from __future__ import annotations

from mahovik.core.stand.model import Body
from mahovik.use.plan.array import Array
from mahovik.use.plan.residual.spatial import first_moment


def gravity_moments(body: Body) -> tuple[float, Array]:
    """Mass (kg) and first moment (3, kg m) that gravity acts on."""
    return body.mass, first_moment(body)
