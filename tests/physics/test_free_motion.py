"""Free motion in time, integrated by SciPy's DOP853: what must stay, stays."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.laws.leg.data import Legs, legs_of
from mahovik.proof.reference import evaluate
from mahovik.proof.reference.array import Array
from physics.general import draw, isolated, without_wrench
from physics.motions import rotation, vec
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


def test_driven_flywheels_keep_momentum_in_E0_while_energy_takes_their_work() -> None:
    stand, state = draw(7, 3)
    stand, state = isolated(stand), without_wrench(state)
    amplitude, frequency, mean = np.array([3.0, 5.0, 2.0]), np.array([4.0, 7.0, 11.0]), np.array(state.phi)

    def programme(t: float) -> tuple[tuple[float, ...], tuple[float, ...], tuple[float, ...]]:
        angle = frequency * t
        return (
            vec(mean + amplitude * np.sin(angle)),
            vec(amplitude * frequency * np.cos(angle)),
            vec(-amplitude * frequency**2 * np.sin(angle)),
        )

    def on_programme(t: float, now: State) -> State:
        phi, phi_dot, phi_ddot = programme(t)
        return replace(now, phi=phi, phi_dot=phi_dot, phi_ddot=phi_ddot)

    def driven(t: float, now: State) -> tuple[Array, Array]:
        now = on_programme(t, now)
        values = evaluate(stand, now, ["forward"])
        return values["V_dot"], np.array(now.phi_ddot)

    start = on_programme(0.0, state)
    states = integrate(stand, start, driven)
    at = [evaluate(stand, now, ["momentum"]) for now in states]
    scale = np.abs(at[0]["Z0"]).max()
    for later in at[1:]:
        np.testing.assert_allclose(later["Z0"], at[0]["Z0"], rtol=0, atol=DRIFT * scale)
    energies = [later["energy"] for later in at]
    assert max(energies) - min(energies) > 0.1 * energies[0]  # the drives do work


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
