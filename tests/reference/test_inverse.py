"""The inverse problem (12) and tasks: the answer is the least, its status is right; (13) completes it."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import null_space

from mahovik.core.stand import loads
from mahovik.core.stand.model import COMPONENTS, MountingAngles, Stand, State, Task, TaskRow, rest_state
from mahovik.core.stand.random import EVERYTHING, random_stand, random_state
from mahovik.errors import StateError
from mahovik.proof.reference import evaluate, pieces
from mahovik.proof.reference.inverse import (
    demand,
    dependent_acceleration,
    determinant,
    inverse_root,
    least_error,
    scaled_demand,
    scaled_task,
    task_rows,
)
from mahovik.proof.second import Second
from physics.general import draw, isolated, rows

SEEDS = range(6)
ROUNDING = 1e-10  # some hundred operations over singular values above 1e-2


@pytest.mark.parametrize("flywheels", [1, 3, 5])
@pytest.mark.parametrize("seed", SEEDS)
def test_residual_of_few_flywheels_is_least_in_the_inverse_of_K(seed: int, flywheels: int) -> None:
    """Least: I^T K^-1 residual = 0."""
    stand, state = draw(seed, flywheels)
    values = evaluate(stand, state, ["inverse", "matrices"])
    assert values["status"] == "UNREACHABLE"
    assert values["rank"] == flywheels
    wanted = demand(pieces(stand, state), np.array(state.V_dot))
    np.testing.assert_allclose(values["residual"], wanted - values["I"] @ values["phi_ddot"], rtol=0, atol=ROUNDING)
    gradient = values["I"].T @ np.linalg.solve(values["K"], values["residual"])
    scale = np.abs(values["I"]).max() * np.abs(np.linalg.solve(values["K"], wanted)).max()
    np.testing.assert_allclose(gradient, 0, rtol=0, atol=ROUNDING * scale)


@pytest.mark.parametrize("flywheels", [7, 9])
@pytest.mark.parametrize("seed", SEEDS)
def test_many_flywheels_reach_the_demand_with_the_least_acceleration_energy(seed: int, flywheels: int) -> None:
    """Least: Theta_ff phi'' has no part in the null space of I."""
    stand, state = draw(seed, flywheels)
    at, values = pieces(stand, state), evaluate(stand, state, ["inverse"])
    assert values["status"] == "OK"
    wanted = demand(at, np.array(state.V_dot))
    scale = np.abs(wanted).max()
    np.testing.assert_allclose(at.I @ values["phi_ddot"], wanted, rtol=0, atol=ROUNDING * scale)
    null, weighted = null_space(at.I), at.Theta_ff @ values["phi_ddot"]
    np.testing.assert_allclose(null.T @ weighted, 0, rtol=0, atol=ROUNDING * np.abs(weighted).max())


def copies(angle: float) -> Stand:
    """A stand of two equal balanced flywheels at one place, the second turned by `angle` (rad) about z."""
    stand, _ = draw(1, 2, instruments=0)
    stand = isolated(stand)
    flywheels = tuple(
        replace(
            s,
            mount="carrier",
            position=(0.0, 0.0, 0.0),
            center_of_mass=(0.0, 0.0, 0.0),
            inertia=rows(np.diag([0.002, 0.002, 0.002])),
            inertia_about="origin",
            mounting=MountingAngles(psi, 0.0, 0.0),
        )
        for s, psi in zip(stand.flywheels, (0.0, angle), strict=True)
    )
    return replace(stand, flywheels=flywheels)


@pytest.mark.parametrize(
    ("angle", "rank", "name"),
    [(0.0, 1, "RANK_DEFICIENT"), (1e-7, 2, "NEAR_SINGULAR"), (1e-3, 2, None), (1e-11, 1, "RANK_DEFICIENT")],
)
def test_status_tells_parallel_flywheels(angle: float, rank: int, name: str | None) -> None:
    stand = copies(angle)
    values = evaluate(stand, replace(rest_state(stand), V_dot=(0, 0, 0, 1.0, 0, 0)), ["inverse"])
    assert values["rank"] == rank
    assert set(values["status"].split("|")) == {"UNREACHABLE"} | ({name} if name else set())
    assert np.all(np.isfinite(values["phi_ddot"]))


@pytest.mark.parametrize("seed", SEEDS)
def test_equation_13_completes_independent_flywheels_to_the_demand(seed: int) -> None:
    stand, state = draw(seed, 8)
    at, V_dot, plus, u = pieces(stand, state), np.array(state.V_dot), [7, 0, 2, 3, 5, 6], np.array([12.0, -30.0])
    assert determinant(at, plus) != 0.0
    phi_ddot = np.zeros(8)
    phi_ddot[plus], phi_ddot[[1, 4]] = dependent_acceleration(at, V_dot, plus, u), u
    wanted = demand(at, V_dot)
    scale = np.abs(at.I).max() * np.abs(phi_ddot).max()
    np.testing.assert_allclose(at.I @ phi_ddot, wanted, rtol=0, atol=1e-13 * scale)
    assert np.linalg.norm(phi_ddot) > np.linalg.norm(least_error(scaled_demand(at, V_dot), np.ones(8)).phi_ddot) * 0.1


SIX = Task("six", tuple(TaskRow("", name) for name in COMPONENTS))


def case(seed: int, flywheels: int) -> tuple[Stand, State]:
    """A stand with everything and two tasks, and a state with the first of them."""
    rng = np.random.default_rng(seed)
    stand = random_stand(rng, flywheels, EVERYTHING)
    stand = replace(stand, tasks=(*stand.tasks, SIX))
    state = random_state(stand, rng)
    demand = tuple(rng.normal(size=len(stand.tasks[0].rows)))
    return stand, replace(state, task=stand.tasks[0].name, demand=demand)


@pytest.mark.parametrize("seed", range(6))
def test_the_motion_that_results_is_that_of_the_second_derivation(seed: int) -> None:
    stand, state = case(seed, 3 + seed)
    answer = evaluate(stand, state, ["inverse", "torque", "points"])
    moved = replace(state, task="", demand=(), phi_ddot=tuple(answer["phi_ddot"]))
    second = Second(stand)
    V_dot = second.evaluate(moved, ["forward"])["V_dot"]
    np.testing.assert_allclose(answer["V_dot"], V_dot, rtol=0, atol=1e-9 * np.abs(V_dot).max())
    moved = replace(moved, V_dot=tuple(V_dot))
    expected = second.evaluate(moved, ["torque", "points"])
    np.testing.assert_allclose(answer["tau"], expected["tau"], rtol=0, atol=1e-9 * np.abs(expected["tau"]).max())
    reached = []
    for row in stand.tasks[0].rows:
        k = COMPONENTS.index(row.component)
        if not row.of:
            reached.append(V_dot[k])
            continue
        reading = expected["points"][row.of]
        gravity = reading["C"].T @ np.array(stand.gravity)
        reached.append((reading["specific_force"] + gravity)[k] if k < 3 else reading["angular_acceleration"][k - 3])
    left = np.array(state.demand) - reached
    np.testing.assert_allclose(answer["residual"], left, rtol=0, atol=1e-9 * np.abs(V_dot).max())


@pytest.mark.parametrize("is_weighted", [False, True])
@pytest.mark.parametrize("seed", range(8))
def test_the_answer_is_the_least_in_both_norms(seed: int, is_weighted: bool) -> None:
    """The residual is normal to all that can be reached, and phi'', by its weights, to all that changes nothing."""
    stand, state = case(20 + seed, 1 + seed)
    at = pieces(stand, state)
    rows, demanded = task_rows(at, stand, stand.tasks[0]), np.array(state.demand)
    weight = np.arange(1.0, 2.0 + seed) if is_weighted else np.ones(1 + seed)
    asked, answer = scaled_task(at, rows, demanded), least_error(scaled_task(at, rows, demanded), weight)
    G = rows.S @ np.linalg.solve(at.K, rows.S.T)
    root = inverse_root((G + G.T) / 2)
    left, matrix = root @ answer.residual, root @ asked.A / np.sqrt(np.diag(at.Theta_ff))
    size = np.linalg.norm(matrix, 2) * np.linalg.norm(root @ asked.c)
    assert np.linalg.norm(matrix.T @ left) < 1e-9 * size
    y = np.sqrt(np.diag(at.Theta_ff)) * answer.phi_ddot
    _, sigma, Vt = np.linalg.svd(matrix)
    free = Vt[int(np.sum(sigma > 1e-9 * sigma[0])) :]
    assert np.linalg.norm(free @ (weight * y)) < 1e-8 * np.linalg.norm(weight * y)


PENDULUM = """
schema = 1
name = "wheel"
inverse_most = 2.0
[carrier]
mass = 1
inertia = [1, 1, 1]
[[flywheel]]
name = "w"
mass = 1
spin_inertia = 0.5
transverse_inertia = 0.25
MOTOR
[task.turn]
rows = ["wx"]
[task.across]
rows = ["wy"]
"""


@pytest.mark.parametrize(
    ("motor", "demand", "speed", "status"),
    [
        ("", 0.9, 0.0, "OK"),  # phi'' = -(1 + 0.5)/0.5 demand, above 2 rad/s2 from 2/3 on
        ("", 0.5, 0.0, "OK"),
        ("", 0.7, 0.0, "EXCESSIVE"),
        ("motor = { torque = 0.6 }", 0.59, 50.0, "OK"),  # the torque is that which turns the carrier
        ("motor = { torque = 0.6 }", -0.61, 50.0, "EXCESSIVE"),
        ("motor = { torque = 0.6, speed = 100 }", 0.31, -50.0, "EXCESSIVE"),  # driving: half of it is left
        ("motor = { torque = 0.6, speed = 100 }", 0.29, -50.0, "OK"),
        ("motor = { torque = 0.6, speed = 100 }", 0.59, 50.0, "OK"),  # braking
        ("motor = { torque = 0.6, speed = 100 }", 0.001, -100.0, "EXCESSIVE"),
        ("motor = { speed = 100 }", 1000.0, -99.0, "OK"),
        ("motor = { speed = 100 }", 1e-6, -101.0, "EXCESSIVE"),
        ("motor = { viscous = 1e-3 }", 0.7, 0.0, "EXCESSIVE"),
    ],
)
def test_excessive_by_hand(motor: str, demand: float, speed: float, status: str) -> None:
    stand = loads(PENDULUM.replace("MOTOR", motor))
    if not motor and demand == 0.9:
        stand = replace(stand, inverse_most=3.0)
    state = replace(random_state(stand, np.random.default_rng(1)), V=(0.0,) * 6, phi_dot=(speed,))
    state = replace(state, task="turn", demand=(demand,))
    answer = evaluate(stand, state, ["inverse", "torque"])
    assert answer["status"] == status
    np.testing.assert_allclose(answer["tau"], [-demand], rtol=1e-12)
    plain = evaluate(stand, replace(state, task="", demand=(), V_dot=(0, 0, 0, demand, 0, 0)), ["inverse"])
    assert ("EXCESSIVE" in plain["status"]) == (status == "EXCESSIVE")


def test_a_wheel_cannot_turn_the_carrier_across_its_axis() -> None:
    stand = loads(PENDULUM.replace("MOTOR", ""))
    state = replace(random_state(stand, np.random.default_rng(1)), V=(0.0,) * 6, phi_dot=(0.0,))
    answer = evaluate(stand, replace(state, task="across", demand=(1.0,)), ["inverse"])
    assert answer["status"] == "UNREACHABLE|RANK_DEFICIENT"
    np.testing.assert_allclose(answer["residual"], [1.0])
    assert (answer["rank"], answer["sigma"].shape) == (0, (1,))


def test_wants_beside_a_task() -> None:
    stand, state = case(3, 4)
    for want in ("forward", "coupled"):
        with pytest.raises(StateError, match=f"want: '{want}' and the task both give 'V_dot'"):
            evaluate(stand, state, ["torque", want])
    with pytest.raises(StateError, match='task: unknown "t3", the stand has t1, t2, six'):
        evaluate(stand, replace(state, task="t3"), ["inverse"])
    with pytest.raises(StateError, match=r"demand: expected \d numbers, found 0"):
        evaluate(stand, replace(state, demand=()), ["inverse"])
    with pytest.raises(StateError, match="the second derivation has no tasks"):
        Second(stand).evaluate(state, ["torque"])
