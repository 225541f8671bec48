"""What all properties share: settings, cases, differences over the natural scale.

Cases are drawn by `strategies`, so that they shrink; each test gives its case to `shown`, which writes the stand file.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from hypothesis import HealthCheck, settings
from hypothesis import strategies as st

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.proof.reference import evaluate, pieces
from mahovik.proof.verify.scales import scales
from physics.motions import vec
from strategies import stands, states

PROPERTY = settings(
    max_examples=12,
    deadline=None,
    derandomize=True,
    database=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)
ROUNDING = 1e-11
"""Of the natural scale: some hundred operations on either side of an identity."""


@st.composite
def cases(draw, low=0, high=5, **has):
    """A stand and an ordinary state of it."""
    stand = draw(stands(low, high, **has))
    return stand, draw(states(stand))


def near(found, expected, scale, times=1.0) -> None:
    """Within rounding of the scale, element by element."""
    off = np.abs(np.asarray(found, dtype=float) - np.asarray(expected, dtype=float))
    allowed = times * ROUNDING * np.maximum(np.asarray(scale, dtype=float), 1e-280)
    assert np.all(off <= allowed), (off / allowed).max()


def scale(stand: Stand, state: State, want: str):
    return scales(stand, state, pieces(stand, state), want)


def value(stand: Stand, state: State, want: str, name: str):
    return evaluate(stand, state, [want])[name]


def of_a_motion(stand: Stand, state: State):
    """The state with V* by (8) and tau of it."""
    state = replace(state, V_dot=vec(value(stand, state, "forward", "V_dot")))
    return replace(state, tau=vec(value(stand, state, "torque", "tau")))
