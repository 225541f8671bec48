"""What free motion keeps: rates at one state, by differences alone; and in time, integrated by SciPy's DOP853."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.laws.leg.data import Legs, legs_of
from mahovik.proof.reference import evaluate
from mahovik.proof.reference.array import Array
from physics.general import draw, isolated, without_wrench
from physics.motions import motion, rate, rotation, vec
from physics.properties import PROPERTY, assert_near, cases, of_a_motion, scale
from toolchain.quick import quick

# relative tolerance of the integrator is 1e-11 a step, a few hundred steps, errors add up at random
DRIFT = 2e-9
SECONDS = 0.5

Acceleration = Callable[[float, State], tuple[Array, Array]]
"""V* (6) and phi'' (N) at a time and a state."""


def pack(state: State, C: Array) -> Array:
    """The state as one vector, its attitude as a quaternion."""
    quaternion = Rotation.from_matrix(C).as_quat(scalar_first=True)
    return np.array([*state.position, *quaternion, *state.V, *state.phi, *state.phi_dot])


def unpack(state: State, y: Array) -> State:
    """The state of a vector; what the vector does not hold is that of `state`."""
    N = len(state.phi)
    position, quaternion, V, phi, phi_dot = np.split(y, [3, 7, 13, 13 + N])
    quaternion = quaternion / np.linalg.norm(quaternion)
    return replace(
        state,
        position=vec(position),
        angles=None,
        quaternion=vec(quaternion),
        V=vec(V),
        phi=vec(phi),
        phi_dot=vec(phi_dot),
    )


def integrate(stand: Stand, state: State, acceleration: Acceleration, seconds: float = SECONDS) -> list[State]:
    """States at five times; acceleration(t, state) gives V* and phi''."""

    def rates(t: float, y: Array) -> Array:
        now = unpack(state, y)
        V_dot, phi_ddot = acceleration(t, now)
        w, x = y[3], y[4:7]
        omega = np.array(now.V[3:])
        quaternion_rate = 0.5 * np.array([-x @ omega, *(w * omega + np.cross(x, omega))])
        return np.concatenate(
            [rotation(stand, now) @ np.array(now.V[:3]), quaternion_rate, V_dot, now.phi_dot, phi_ddot]
        )

    solution = solve_ivp(
        rates,
        (0, seconds),
        pack(state, rotation(stand, state)),
        method="DOP853",
        rtol=1e-11,
        atol=1e-12,
        t_eval=np.linspace(0, seconds, 5),
    )
    assert solution.success, solution.message
    return [unpack(state, y) for y in solution.y.T]


@pytest.mark.parametrize("seed", quick(1, range(2)))
def test_undamped_legs_and_weight_keep_total_energy(seed: int) -> None:
    stand, state = draw(seed, 2)
    legs = tuple(replace(leg, damping=0.0) for leg in legs_of(stand))
    stand = replace(isolated(stand), gravity=stand.gravity, laws=(Legs(legs),))
    state = replace(without_wrench(state), tau=(0.0, 0.0))

    def free(t: float, now: State) -> tuple[Array, Array]:
        values = evaluate(stand, now, ["coupled"])
        return values["V_dot"], values["phi_ddot"]

    def total_energy(now: State) -> tuple[float, float]:
        values = evaluate(stand, now, ["momentum"])
        C, O1 = rotation(stand, now), np.array(now.position)
        mass = sum(body.mass for body in stand.bodies)
        potential = -mass * np.dot(stand.gravity, O1 + C @ values["center_of_mass"])
        for leg in legs_of(stand):
            length = np.linalg.norm(O1 + C @ np.array(leg.carrier) - np.array(leg.ground))
            potential += leg.stiffness * (length - leg.length) ** 2 / 2
        return values["energy"] + potential, values["energy"]

    energies = [total_energy(now) for now in integrate(stand, state, free)]
    scale = max(kinetic for _, kinetic in energies)
    for total, _ in energies[1:]:
        assert total == pytest.approx(energies[0][0], abs=DRIFT * scale)


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
    """Flywheels of given phi(t) on a free stand."""
    stand, state = free(case)
    size = scale(stand, state, "momentum")
    momentum, energy, h = changes(stand, state)
    assert_near(momentum, np.zeros(6), size["Z0"])
    work = h * np.dot(state.tau, state.phi_dot)
    assert_near(energy, work, size["energy"] + h * np.abs(state.tau) @ np.abs(state.phi_dot))


@PROPERTY
@given(case=cases(stream=False))
def test_free_flywheels_keep_momentum_and_energy_at_every_state(case: tuple[Stand, State]) -> None:
    """tau = 0: V* and phi'' of the coupled form."""
    stand, state = isolated(case[0]), without_wrench(case[1])
    state = replace(state, tau=(0.0,) * len(state.phi))
    found = evaluate(stand, state, ["coupled"])
    state = replace(state, V_dot=vec(found["V_dot"]), phi_ddot=vec(found["phi_ddot"]))
    size = scale(stand, state, "momentum")
    momentum, energy, _ = changes(stand, state)
    assert_near(momentum, np.zeros(6), size["Z0"])
    assert_near(energy, 0.0, size["energy"])


@settings(PROPERTY, max_examples=5)
@given(case=cases(high=4, stream=False))
def test_free_flywheels_keep_momentum_and_energy_in_time(case: tuple[Stand, State]) -> None:
    """Integrated for two radians of the fastest."""
    stand, state = isolated(case[0]), without_wrench(case[1])
    state = replace(state, tau=(0.0,) * len(state.phi))

    def coupled(t: float, now: State) -> tuple[Array, Array]:
        values = evaluate(stand, now, ["coupled"])
        return values["V_dot"], values["phi_ddot"]

    at = [evaluate(stand, now, ["momentum"]) for now in integrate(stand, state, coupled, 2.0 / fastest(state))]
    size = scale(stand, state, "momentum")
    for later in at[1:]:
        assert np.all(np.abs(later["Z0"] - at[0]["Z0"]) <= DRIFT * size["Z0"])
        assert abs(later["energy"] - at[0]["energy"]) <= DRIFT * size["energy"]
