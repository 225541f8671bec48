"""What free motion keeps: rates at one state, by differences alone."""

from dataclasses import replace

import numpy as np
from hypothesis import given

from mahovik.core.stand.model import Stand, State
from mahovik.proof.reference import evaluate
from mahovik.proof.reference.algebra import Array
from physics.general import isolated, without_wrench
from physics.motions import motion, rate, vec
from physics.properties import PROPERTY, assert_near, cases, of_a_motion, scale

TURN = 0.03
"""rad by the fastest in a step of the differences: its ninth power is far below the rounding of a sum."""


def fastest(state: State) -> float:
    """Largest speed in rad/s of anything that turns; an acceleration counts by its square root."""
    accelerations = [*state.V_dot[3:], *state.phi_ddot]
    return float(max(1.0, *map(abs, (*state.V[3:], *state.phi_dot)), *np.sqrt(np.abs(accelerations))))


def free(case: tuple[Stand, State]) -> tuple[Stand, State]:
    """The case without any external wrench, moved by (8)."""
    stand, state = case
    return isolated(stand), of_a_motion(isolated(stand), without_wrench(state))


def changes(stand: Stand, state: State) -> tuple[Array, float, float]:
    """Changes of Z in E0 (6) and of the energy over one step of the differences, and that step in s."""
    at, h = motion(stand, state), TURN / fastest(state)
    momentum = rate(lambda t: evaluate(stand, at(t), ["momentum"])["Z0"], h)
    energy = rate(lambda t: evaluate(stand, at(t), ["momentum"])["energy"], h)
    return h * momentum, h * energy, h


@PROPERTY
@given(case=cases(stream=False))
def test_driven_flywheels_keep_momentum_and_energy_takes_their_work(case: tuple[Stand, State]) -> None:
    """Flywheels follow given phi(t) on a free stand."""
    stand, state = free(case)
    size = scale(stand, state, "momentum")
    momentum, energy, h = changes(stand, state)
    assert_near(momentum, np.zeros(6), size["Z0"])
    work = h * np.dot(state.tau, state.phi_dot)
    assert_near(energy, work, size["energy"] + h * np.abs(state.tau) @ np.abs(state.phi_dot))


@PROPERTY
@given(case=cases(stream=False))
def test_free_flywheels_keep_momentum_and_energy_at_every_state(case: tuple[Stand, State]) -> None:
    """With tau = 0 the rates of momentum and energy by V* and phi'' of the coupled form are zero."""
    stand, state = isolated(case[0]), without_wrench(case[1])
    state = replace(state, tau=(0.0,) * len(state.phi))
    answer = evaluate(stand, state, ["coupled"])
    state = replace(state, V_dot=vec(answer["V_dot"]), phi_ddot=vec(answer["phi_ddot"]))
    size = scale(stand, state, "momentum")
    momentum, energy, _ = changes(stand, state)
    assert_near(momentum, np.zeros(6), size["Z0"])
    assert_near(energy, 0.0, size["energy"])
