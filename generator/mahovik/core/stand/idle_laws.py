"""Laws of a held carrier whose wrench acts on what its hold blocks, as warnings."""

from __future__ import annotations

import numpy as np

from mahovik.core.stand.hold import twists
from mahovik.core.stand.model import WRENCH_LETTERS, Stand


def idle_laws(stand: Stand) -> list[str]:
    """Warnings, a line for each law whose wrench acts on what the hold blocks: there it adds to the reaction alone."""
    if stand.hold is None:
        return []
    S = twists(stand.hold)
    found = []
    for law in stand.laws:
        idle = [WRENCH_LETTERS[i] for i in law.rows or () if not np.any(S[i])]
        if idle:
            name = type(law).__name__.lower()
            found.append(
                f"{name}: [hold] blocks the motion along {', '.join(idle)} of its wrench, which there adds to the "
                "reaction and does nothing else"
            )
        elif not stand.hold.freedoms:
            found.append(
                f"{type(law).__name__.lower()}: [hold] clamps the carrier: wrenches on it add to the reaction and do "
                "nothing else"
            )
    return found
