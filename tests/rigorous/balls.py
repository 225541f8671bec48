"""What several tests of enclosures do: balls as arrays, and the widest of them."""

from __future__ import annotations

from typing import Any

import numpy as np
from flint import arb
from numpy.typing import NDArray


def flat(balls: Any) -> list[arb]:
    return [balls] if isinstance(balls, arb) else [x for each in balls for x in flat(each)]


def middles(balls: Any) -> NDArray[np.float64]:
    """Midpoints, rounded to double, in the shape of the quantity."""

    def nested(value: Any) -> Any:
        return float(value.mid()) if isinstance(value, arb) else [nested(each) for each in value]

    return np.array(nested(balls), dtype=np.float64)
