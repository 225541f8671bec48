"""Laws that the second derivation must keep by itself, without the reference: balances, stream, derivatives."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mahovik.core.stand.model import LawData, Stand
from mahovik.core.stand.state import State
from mahovik.laws.damping.data import Damping
from mahovik.laws.leg.data import Legs, legs_of
from mahovik.laws.suspension.data import Suspension
from mahovik.laws.torquer.data import Torquers
from mahovik.proof.second import Second
from physics.general import draw, isolated, without_wrench
from physics.motions import motion, rate, rotation, vec, with_rotation
from second.agreement import evaluate

SEEDS = range(6)
STEP = 1e-3  # times 20 rad/s: the eighth power is far below rounding over STEP, 1e-13
FROM_DIFFERENCES = 1e-10  # 1e-16 of the largest term over STEP, some hundred operations
ROUNDING = 1e-12


def without_damping(stand: Stand) -> Stand:
    """The stand without damping of its bodies in the fluid."""
    return replace(
        stand,
        carrier=stand.carrier.without_laws(Damping),
        instruments=tuple(p.without_laws(Damping) for p in stand.instruments),
        flywheels=tuple(s.without_laws(Damping) for s in stand.flywheels),
    )


def consistent(stand: Stand, state: State) -> State:
    """The state with V* of its own equations and the drive torques of it: a moment of a real motion."""
    state = replace(state, V_dot=vec(evaluate(stand, state, ["forward"])["V_dot"]))
    return replace(state, tau=vec(evaluate(stand, state, ["torque"])["tau"]))


@pytest.mark.parametrize("seed", SEEDS)
def test_momentum_in_E0_changes_by_the_wrench_alone_and_energy_by_its_power(seed: int) -> None:
    """Kinetic energy and momentum are differenced along the motion: nothing but these two is used of the model."""
    stand, state = draw(seed, 4)
    stand, state = (
        isolated(stand),
        consistent(isolated(stand), replace(state, wrench={"carrier": (1.0, 2, 3, 4, 5, 6)})),
    )
    along, wrench, C = motion(stand, state), np.arange(1.0, 7.0), rotation(stand, state)
    force, moment = C @ wrench[:3], C @ wrench[3:]
    here = evaluate(stand, state, ["momentum"])
    Z0_rate = rate(lambda t: evaluate(stand, along(t), ["momentum"])["Z0"], STEP)
    expected = [*force, *(moment + np.cross(state.position, force))]
    np.testing.assert_allclose(Z0_rate, expected, rtol=0, atol=FROM_DIFFERENCES * np.abs(here["Z0"]).max())
    power = wrench @ np.array(state.V) + np.array(state.tau) @ np.array(state.phi_dot)
    energy_rate = rate(lambda t: evaluate(stand, along(t), ["momentum"])["energy"], STEP)
    assert energy_rate == pytest.approx(power, abs=FROM_DIFFERENCES * max(abs(power), here["energy"]))


@pytest.mark.parametrize("seed", SEEDS)
def test_weight_and_springs_keep_total_energy(seed: int) -> None:
    """Potential energy by the mass centre and the legs' lengths."""
    stand, state = draw(seed, 3)
    legs = tuple(replace(leg, damping=0.0) for leg in legs_of(stand))
    stand = replace(isolated(stand), gravity=stand.gravity, laws=(Legs(legs),))
    state = consistent(stand, without_wrench(state))
    along = motion(stand, state)

    def energies(t: float) -> np.ndarray:
        now = along(t)
        at, C, O1 = evaluate(stand, now, ["momentum"]), rotation(stand, now), np.array(now.position)
        mass = sum(body.mass for body in stand.bodies)
        potential = -mass * np.dot(stand.gravity, O1 + C @ at["center_of_mass"])
        for leg in legs_of(stand):
            length = np.linalg.norm(O1 + C @ np.array(leg.carrier) - np.array(leg.ground))
            potential += leg.stiffness * (length - leg.length) ** 2 / 2
        return np.array([at["energy"], potential])

    power = np.array(state.tau) @ np.array(state.phi_dot)
    scale = max(abs(power), *np.abs(energies(0.0)))
    assert sum(rate(energies, STEP)) == pytest.approx(power, abs=FROM_DIFFERENCES * scale)


@pytest.mark.parametrize("seed", SEEDS)
def test_coupled_returns_what_forward_and_torque_started_from(seed: int) -> None:
    stand, state = draw(seed, 5, stream=True)
    state = consistent(stand, state)
    found = evaluate(stand, state, ["coupled"])
    size = np.abs(state.V_dot).max() + np.abs(state.phi_ddot).max()
    for name in ("V_dot", "phi_ddot"):
        np.testing.assert_allclose(found[name], getattr(state, name), rtol=0, atol=ROUNDING * 100 * size)  # of a solve


@pytest.mark.parametrize("seed", SEEDS)
def test_a_stream_is_a_change_of_frame(seed: int) -> None:
    """An observer who drifts with the fluid sees V less the stream, and the same forces on the same accelerations."""
    stand, state = draw(seed, 4, stream=True)
    stand = stand.without_laws()  # they are fixed in E0
    w = rotation(stand, state).T @ np.array(stand.stream)
    turning = np.array([*np.cross(state.V[3:], w), 0.0, 0.0, 0.0])
    drifting = replace(
        state, V=vec(np.array(state.V) - [*w, 0, 0, 0]), V_dot=vec(np.array(state.V_dot) + turning), angles=state.angles
    )
    still = replace(stand, stream=None)
    forward = evaluate(stand, state, ["forward"])["V_dot"]
    seen = evaluate(still, drifting, ["forward"])["V_dot"]
    np.testing.assert_allclose(forward, seen - turning, rtol=0, atol=ROUNDING * np.abs(seen).max())
    tau = evaluate(stand, state, ["torque"])["tau"]
    np.testing.assert_allclose(
        tau, evaluate(still, drifting, ["torque"])["tau"], rtol=0, atol=ROUNDING * np.abs(tau).max()
    )


@pytest.mark.parametrize("seed", SEEDS)
def test_turning_E0_and_all_that_is_fixed_in_it_changes_nothing(seed: int) -> None:
    stand, state = draw(seed, 3, stream=True)
    stand = stand.without_laws(Suspension)  # its equilibrium is fixed in E0 by angles
    C, turn = rotation(stand, state), Rotation.random(rng=seed)

    def turned_law(law: LawData) -> LawData:
        if isinstance(law, Legs):
            return Legs(tuple(replace(leg, ground=vec(turn.apply(leg.ground))) for leg in law.legs))
        assert isinstance(law, Torquers)
        return replace(law, magnetic_field=vec(turn.apply(law.magnetic_field)))

    turned = replace(
        stand,
        gravity=vec(turn.apply(stand.gravity)),
        stream=vec(turn.apply(stand.stream)),
        laws=tuple(turned_law(law) for law in stand.laws),
    )
    moved = with_rotation(replace(state, position=vec(turn.apply(state.position))), turn.as_matrix() @ C)
    expected, found = (evaluate(a, b, ["forward", "torque"]) for a, b in ((stand, state), (turned, moved)))
    for name, value in expected.items():
        np.testing.assert_allclose(found[name], value, rtol=0, atol=ROUNDING * 100 * np.abs(value).max())


@pytest.mark.parametrize(
    ("want", "inputs"), [("forward", ("V", "phi", "phi_dot", "phi_ddot")), ("coupled", ("V", "phi", "tau"))]
)
def test_functions_can_be_differentiated(want: str, inputs: tuple[str, ...]) -> None:
    """CasADi's derivatives of the whole chain, the solve as well, against differences."""
    stand, state = draw(2, 2, stream=True)
    stand = without_damping(stand)  # |V_r| has a corner where a component passes zero, differences do not see it
    second = Second(stand)
    function = second.function(want)
    given = second.arguments(state)
    jacobian = function.factory("J", function.name_in(), [f"jac:{want}_V_dot:{name}" for name in inputs])
    exact = jacobian(**{name: given[name] for name in function.name_in()})
    for name in inputs:
        found = exact[f"jac_{want}_V_dot_{name}"].full()
        for k in range(len(given[name])):

            def moved(h: float, name: str = name, k: int = k) -> np.ndarray:
                values = {**given, name: given[name] + h * np.eye(len(given[name]))[k]}
                return np.asarray(function(**values)[f"{want}_V_dot"].full()[:, 0])

            column = rate(moved, 1e-2)
            scale = np.abs(moved(0.0)).max() + np.abs(found).max()
            np.testing.assert_allclose(found[:, k], column, rtol=0, atol=1e-9 * scale)
