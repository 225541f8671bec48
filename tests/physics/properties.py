"""Common parts of all properties: settings, cases, differences over the natural scale.

Cases are drawn by `strategies`, so that they shrink; a failure shows the smallest stand file and its state.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from hypothesis import HealthCheck, note, settings
from hypothesis import strategies as st

from mahovik.core.stand import dumps
from mahovik.core.stand.model import Stand, State
from mahovik.proof.reference import evaluate
from mahovik.proof.reference.algebra import Array
from mahovik.proof.verify.scales import scales_of
from mahovik.proof.verify.states import Request, state_line
from physics.general import AnyBody, rows
from physics.motions import vec
from strategies import held_stands, stands, states

PROPERTY = settings(
    max_examples=12, deadline=None, derandomize=True, database=None, suppress_health_check=[HealthCheck.too_slow]
)
ROUNDING = 1e-11
"""Accepted difference over the natural scale: some hundred operations on either side of an identity."""


@st.composite
def cases(draw: st.DrawFn, /, low: int = 0, high: int = 5, held: bool = False, **has: Any) -> tuple[Stand, State]:
    """A stand and an ordinary state of it; `held`: its carrier is free or held in any way."""
    kinds = [stands(low, high, **has), held_stands(low, high)] if held else [stands(low, high, **has)]
    stand = draw(st.one_of(kinds))
    state = draw(states(stand))
    note(f"{dumps(stand)}\n{state_line(Request('smallest', state, ('matrices',)))}")
    return stand, state


def assert_near(actual: Any, expected: Any, scale: Any, times: float = 1.0) -> None:
    """Within rounding of the scale, element by element."""
    off = np.abs(np.asarray(actual, dtype=float) - np.asarray(expected, dtype=float))
    allowed = times * ROUNDING * np.maximum(np.asarray(scale, dtype=float), 1e-280)
    assert np.all(off <= allowed), (off / allowed).max()


def scale(stand: Stand, state: State, want: str) -> Any:
    """Natural scales of the quantities of a want, by name."""
    return scales_of(stand, state, want)


def value(stand: Stand, state: State, want: str, name: str) -> Any:
    """One quantity of a want by the reference."""
    return evaluate(stand, state, [want])[name]


def of_a_motion(stand: Stand, state: State) -> State:
    """The state with V* by (8) and tau of it."""
    moved = evaluate(stand, state, ["forward"])
    state = replace(state, V_dot=vec(moved["V_dot"]), u_dot=vec(moved.get("u_dot", ())))
    return replace(state, tau=vec(value(stand, state, "torque", "tau")))


def balance(stand: Stand, state: State) -> Array:
    """K V* + M V + sum (I phi'' + J phi') - F of (8) for given V*, phi''."""
    at = evaluate(stand, state, ["matrices"])
    V, V_dot, phi_dot, phi_ddot = map(np.array, (state.V, state.V_dot, state.phi_dot, state.phi_ddot))
    return np.asarray(at["K"] @ V_dot + at["M"] @ V + at["I"] @ phi_ddot + at["J"] @ phi_dot - at["F"])


def with_inertia(body: AnyBody, mass: float, mu: Array, J: Array) -> AnyBody:
    """The body with this mass, first moment and moments of inertia about its origin."""
    rc = np.zeros(3) if mass == 0 else np.array(mu) / mass
    return replace(body, mass=mass, center_of_mass=vec(rc), inertia=rows(J), inertia_about="origin")
