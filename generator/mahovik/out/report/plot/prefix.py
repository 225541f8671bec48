"""SI prefixes, so that what is drawn or tabled has few zeros."""

from __future__ import annotations

import math

_PREFIXES = {-4: "p", -3: "n", -2: "µ", -1: "m", 0: "", 1: "k", 2: "M", 3: "G"}


def prefixed(largest: float, unit: str) -> tuple[float, str]:
    """What numbers in `unit` up to `largest` are multiplied by, and the unit then: 2300, "N" give 1e-3, "kN"."""
    if not (math.isfinite(largest) and largest > 0.0):
        return 1.0, unit
    n = min(max(math.floor(math.log10(largest) / 3 + 1e-12), min(_PREFIXES)), max(_PREFIXES))
    return 10.0 ** (-3 * n), _PREFIXES[n] + unit
