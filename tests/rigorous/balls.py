"""What several tests of enclosures do: balls as arrays, and the comparison of their middles with the reference."""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import arb
from numpy.typing import NDArray

from mahovik.core.stand import Stand, State
from mahovik.proof import reference
from mahovik.proof.verify import rigorous


def flat(balls: Any) -> list[arb]:
    return [balls] if isinstance(balls, arb) else [x for part in balls for x in flat(part)]


def middles(balls: Any) -> NDArray[np.float64]:
    """Midpoints, rounded to double, in the shape of the quantity."""

    def nested(value: Any) -> Any:
        return float(value.mid()) if isinstance(value, arb) else [nested(part) for part in value]

    return np.array(nested(balls), dtype=np.float64)


def forward_is_enclosed(stand: Stand, state: State) -> None:
    """V_dot of (8) in balls is that of the literal reference."""
    balls = rigorous.evaluate(rigorous.exact_at(stand, state), "forward")
    expected = reference.evaluate(stand, state, ["forward"])["V_dot"]
    np.testing.assert_allclose(middles(balls["V_dot"]).ravel(), expected, rtol=1e-9)
