"""Stands that a page of algebra solves: a free carrier with wheels in its middle, their axes along z of E1."""

from __future__ import annotations

from typing import Any

import mahovik
from mahovik import Stand

Table = dict[str, Any]

CARRIER, WHEEL = 16.0, 2.0
"""kg: two wheels and the carrier are 20 kg."""

ACROSS, ALONG, SPIN = 3.0, 2.0, 0.02
"""kg m2: transverse inertia of carrier and wheels, inertia of the carrier along z, of a wheel about its axis."""


def wheel(name: str, **changes: Any) -> Table:
    """A balanced wheel in the origin of E1, of 0.01 kg m2 across its axis."""
    balanced = {
        "name": name, "axis": [0, 0, 1], "zero": [1, 0, 0], "mass": WHEEL, "spin_inertia": SPIN,
        "transverse_inertia": 0.01,
    }  # fmt: skip
    return balanced | changes


def stand(*wheels: Table, carrier: Table | None = None, **more: Any) -> Stand:
    """A free carrier without gravity that bears these wheels."""
    across = ACROSS - 0.01 * len(wheels)
    body = {"mass": CARRIER, "inertia": [across, across, ALONG]} | (carrier or {})
    return mahovik.Stand.from_dict({"schema": 1, "name": "hand", "carrier": body, "flywheel": [*wheels], **more})
