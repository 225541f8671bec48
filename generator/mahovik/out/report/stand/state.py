"""The state at which a report shows the matrices."""

from __future__ import annotations

import math

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.core.stand.summary import summarize
from mahovik.out.report.stand.run import Run

WORDS = (
    "a chosen state: the carrier moves and is turned; phases are 0.7 rad apart, every flywheel keeps its motor's "
    "no-load speed, else 3000 rpm"
)

_APART = 0.7

STILL = 1e-9
"""m/s and rad/s: a carrier slower than this, with flywheels at rest, moves by rounding alone."""


def state_shown(stand: Stand, run: Run | None) -> tuple[State, str]:
    """The last row of the run, and words that say so; the chosen state without a run, or where all is at rest there.

    At rest `M`, `K*`, `J` and `D` are zero but for rounding, which would be shown as if it were their structure.
    """
    if run is None:
        return chosen_state(stand), WORDS
    last, row = run.state(-1), f"the last row of the run, t = {run.t[-1]:.6g} s"
    if not any(last.phi_dot) and max(map(abs, last.V)) < STILL:
        return chosen_state(stand), f"{row}, is at rest; shown instead: {WORDS}"
    return last, row


def chosen_state(stand: Stand) -> State:
    """A fixed state for a stand: attitude away from the singularity of every sequence, flywheels at speed."""
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
