"""The state at which a report shows the matrices where no run gives one."""

from __future__ import annotations

import math

from mahovik.stand.model import Stand
from mahovik.stand.state import State
from mahovik.stand.summary import summarize

WORDS = (
    "a chosen state: the carrier moves and is turned; phases are 0.7 rad apart, every flywheel keeps its motor's "
    "no-load speed, else 3000 rpm"
)

_APART = 0.7


def chosen_state(stand: Stand) -> State:
    """The same for the same stand: attitude away from the singularity of every sequence, flywheels at speed."""
    rows = summarize(stand).unbalance
    return State(
        position=(0.0, 0.0, 0.0),
        angles=(0.3, 0.4, 0.2),
        quaternion=None,
        V=(0.1, -0.2, 0.15, 0.3, -0.2, 0.4),
        phi=tuple(math.remainder(_APART * i, 2 * math.pi) for i in range(len(rows))),
        phi_dot=tuple(row.speed for row in rows),
        phi_ddot=(0.0,) * len(rows),
        V_dot=(0.0,) * 6,
        tau=(0.0,) * len(rows),
    )
