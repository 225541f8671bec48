"""What free motion keeps, over random stands that shrink: rates at one state, by differences alone; and in time."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from hypothesis import given, settings

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.proof.reference import evaluate
from physics.general import isolated, without_wrench
from physics.motions import motion, rate, vec
from physics.properties import PROPERTY, cases, near, of_a_motion, scale
from physics.test_free_motion import DRIFT, integrate

TURN = 0.03
"""rad by the fastest in a step of the differences: its ninth power is far below the rounding of a sum."""


def fastest(state: State):
    """rad/s: of anything that turns, accelerations by the time in which they turn as far."""
    accelerations = [*state.V_dot[3:], *state.phi_ddot]
    return max(1.0, *map(abs, (*state.V[3:], *state.phi_dot)), *np.sqrt(np.abs(accelerations)))


def free(case: tuple[Stand, State]):
    """The case without any external wrench, moved by (8)."""
    stand, state = case
    return isolated(stand), of_a_motion(isolated(stand), without_wrench(state))


def changes(stand: Stand, state: State):
    """What Z in E0 and the energy change by in the step of the differences, and that step."""
    at, h = motion(stand, state), TURN / fastest(state)
    momentum = rate(lambda t: evaluate(stand, at(t), ["momentum"])["Z0"], h)
    energy = rate(lambda t: evaluate(stand, at(t), ["momentum"])["energy"], h)
    return h * momentum, h * energy, h


@PROPERTY
@given(case=cases(stream=False))
def test_driven_flywheels_keep_momentum_and_energy_takes_their_work(case: tuple[Stand, State], shown) -> None:
    """Flywheels of given phi(t) on a free stand."""
    shown(*case)
    stand, state = free(case)
    size = scale(stand, state, "momentum")
    momentum, energy, h = changes(stand, state)
    near(momentum, np.zeros(6), size["Z0"])
    work = h * np.dot(state.tau, state.phi_dot)
    near(energy, work, size["energy"] + h * np.abs(state.tau) @ np.abs(state.phi_dot))


@PROPERTY
@given(case=cases(stream=False))
def test_free_flywheels_keep_momentum_and_energy_at_every_state(case: tuple[Stand, State], shown) -> None:
    """tau = 0: V* and phi'' of the coupled form."""
    shown(*case)
    stand, state = isolated(case[0]), without_wrench(case[1])
    state = replace(state, tau=(0.0,) * len(state.phi))
    found = evaluate(stand, state, ["coupled"])
    state = replace(state, V_dot=vec(found["V_dot"]), phi_ddot=vec(found["phi_ddot"]))
    size = scale(stand, state, "momentum")
    momentum, energy, _ = changes(stand, state)
    near(momentum, np.zeros(6), size["Z0"])
    near(energy, 0.0, size["energy"])


@settings(PROPERTY, max_examples=5)
@given(case=cases(high=4, stream=False))
def test_free_flywheels_keep_momentum_and_energy_in_time(case: tuple[Stand, State], shown) -> None:
    """Integrated for two radians of the fastest."""
    shown(*case)
    stand, state = isolated(case[0]), without_wrench(case[1])
    state = replace(state, tau=(0.0,) * len(state.phi))

    def coupled(t: float, now):
        values = evaluate(stand, now, ["coupled"])
        return values["V_dot"], values["phi_ddot"]

    at = [evaluate(stand, now, ["momentum"]) for now in integrate(stand, state, coupled, 2.0 / fastest(state))]
    size = scale(stand, state, "momentum")
    for later in at[1:]:
        assert np.all(np.abs(later["Z0"] - at[0]["Z0"]) <= DRIFT * size["Z0"])
        assert abs(later["energy"] - at[0]["energy"]) <= DRIFT * size["energy"]
