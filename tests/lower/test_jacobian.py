"""forward_jacobian and coupled_jacobian against automatic differentiation of the second derivation."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from types import MappingProxyType

import casadi as ca
import numpy as np
import pytest

from mahovik.contract.status import STATUS_VALUES
from mahovik.core.lower.program import lower
from mahovik.core.program.cost import cost
from mahovik.core.program.types import DOUBLE
from mahovik.core.stand import Stand, State, load
from mahovik.core.stand.random import BARE, EVERYTHING, random_stand, random_state
from mahovik.proof.second import Second
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.program_backend import with_all_inputs
from mahovik.stands import names, path
from toolchain.quick import quick

RANDOM = {
    "everything 1": (1, EVERYTHING, 1),
    "everything 4": (4, EVERYTHING, 2),
    "everything 7": (7, EVERYTHING, 3),
    "bare 0": (0, BARE, 4),
    "bare 5": (5, BARE, 6),
    "bare 6": (6, BARE, 5),
    "bare 12": (12, BARE, 7),
    "bare 64": (64, BARE, 8),
}


@cache
def stand_of(name: str) -> Stand:
    """An example stand, or a random one with a run-time wrench on every body."""
    if name in RANDOM:
        count, features, seed = RANDOM[name]
        return with_all_inputs(random_stand(np.random.default_rng(seed), count, features, name="sloped"))
    return load(path(name))


@cache
def backend_of(name: str) -> CBackend:
    return CBackend(stand_of(name))


def state_of(name: str, seed: int) -> State:
    """A random state; without run-time wrenches where the C takes none."""
    state = random_state(stand_of(name), np.random.default_rng(seed))
    return state if backend_of(name).inputs else replace(state, wrench=MappingProxyType({}))


def differentiated(stand: Stand, state: State, want: str, by: tuple[str, ...]) -> dict[str, np.ndarray]:
    """CasADi's exact derivatives of the second derivation, by result and input: `V_dot_phi`."""
    second = Second(stand)
    function = second.function(want)
    symbols = {n: ca.MX.sym(n, *function.size_in(n)) for n in function.name_in()}
    results = function(**symbols)
    found = {}
    for result in ("V_dot", "phi_ddot"):
        if f"{want}_{result}" not in results:
            continue
        for name in by:
            slope = ca.Function(
                "slope", list(symbols.values()), [ca.jacobian(results[f"{want}_{result}"], symbols[name])]
            )
            arguments = second.arguments(state)
            found[f"{result}_{name}"] = slope(*(arguments[n] for n in symbols)).full()
    return found


def locked_slopes(stand: Stand, state: State, free: list[int]) -> dict[str, np.ndarray]:
    """Derivatives of `coupled` with all flywheels locked but the free ones, by implicit differentiation.

    phi'' is zero of locked flywheels, and of the free ones what makes needed = tau, where `needed` is the torque for
    phi'' and the V_dot that `forward` gives with it. It is linear in phi'', so one step of Newton's method finds it.
    """
    second = Second(stand)
    forward, torque = second.function("forward"), second.function("torque")
    symbols = {n: ca.MX.sym(n, *forward.size_in(n)) for n in forward.name_in()}
    V_dot = forward(**symbols)["forward_V_dot"]
    needed = torque(**(symbols | {"V_dot": V_dot}))["torque_tau"]
    by = ("V", "phi", "phi_dot", "phi_ddot")
    wanted = [needed, *(ca.jacobian(each, symbols[n]) for each in (V_dot, needed) for n in by)]
    function = ca.Function("slopes", list(symbols.values()), wanted)

    def accelerations_at(phi_ddot: np.ndarray) -> list[np.ndarray]:
        arguments = second.arguments(replace(state, phi_ddot=tuple(phi_ddot.tolist())))
        return [each.full() for each in function(*(arguments[n] for n in symbols))]

    phi_ddot = np.zeros(len(state.phi))
    now = accelerations_at(phi_ddot)
    pull = np.linalg.inv(now[8][np.ix_(free, free)])
    phi_ddot[free] = pull @ (np.array(state.tau) - now[0].ravel())[free]
    _, *slopes = accelerations_at(phi_ddot)
    V_by, needed_by = dict(zip(by, slopes[:4], strict=True)), dict(zip(by, slopes[4:], strict=True))
    found = {}
    for name in ("V", "phi", "phi_dot", "tau"):
        columns = 6 if name == "V" else len(state.phi)
        pushed = np.eye(columns) if name == "tau" else -needed_by[name]
        turned = np.zeros((len(state.phi), columns))
        turned[free] = pull @ pushed[free]
        found[f"phi_ddot_{name}"] = turned
        found[f"V_dot_{name}"] = V_by["phi_ddot"] @ turned + (0.0 if name == "tau" else V_by[name])
    return found


def scales(exact: np.ndarray) -> np.ndarray:
    """Rows of velocities and of rotations have sizes of their own."""
    rows = np.abs(exact).max(axis=1, keepdims=True)
    if len(exact) == 6:
        rows = np.repeat([rows[:3].max(), rows[3:].max()], 3)[:, None]
    return np.asarray(np.maximum(rows, np.abs(exact).max() * 1e-3))


def displaced_moments(name: str, state: State) -> np.ndarray:
    """m r^2 omega / J11 of every flywheel, 1/s: J11 about its axis, r of its origin from that of its mount."""
    omega = np.linalg.norm(state.V[3:])
    wheels = stand_of(name).flywheels
    return np.array([s.mass * np.dot(s.position, s.position) * omega / s.inertia[0][0] for s in wheels])


def rows_within(found: object, exact: np.ndarray, allowed: np.ndarray) -> bool:
    """Is every row as near as is allowed to it (rows x 1)?"""
    return bool(np.all(np.abs(np.array(found) - exact) <= allowed))


CASES = [*RANDOM, *names()]


@pytest.mark.slow
@pytest.mark.parametrize("seed", quick(1, [1, 2]))
@pytest.mark.parametrize("name", quick(3, CASES))
def test_derivatives_of_forward(name: str, seed: int) -> None:
    """Derivatives by V, phi, phi' and phi''. Two independent solves: 1e-10 of the largest in a row of like numbers."""
    c, state = backend_of(name), state_of(name, seed)
    by = ("V", "phi", "phi_dot", "phi_ddot") if state.phi else ("V",)
    slopes = c.call("forward_jacobian", c.arguments(state))[1]["out"]
    exact = differentiated(stand_of(name), state, "forward", by)
    assert set(slopes) == set(exact)
    for key, value in exact.items():
        if np.abs(value).max() > 1e-12:  # balanced flywheels: nothing depends on their phases
            assert rows_within(slopes[key], value, 1e-10 * scales(value)), key
        else:
            assert np.abs(slopes[key]).max() < 1e-9, key


@pytest.mark.slow
@pytest.mark.parametrize("seed", quick(1, [1, 2]))
@pytest.mark.parametrize("name", [n for n in CASES if n != "bare 0"])
def test_derivatives_of_coupled(name: str, seed: int) -> None:
    """Derivatives of both results by V, phi, phi' and tau."""
    c, state = backend_of(name), state_of(name, seed)
    slopes = c.call("coupled_jacobian", c.arguments(state))[1]["out"]
    motion = c.call("coupled", c.arguments(state))[1]
    exact = differentiated(stand_of(name), state, "coupled", ("V", "phi", "phi_dot", "tau"))
    assert set(slopes) == set(exact)
    for key, value in exact.items():
        if np.abs(value).max() > 1e-12:
            allowed = 1e-10 * scales(value)
            if key == "phi_ddot_phi":
                # a turned phase moves a small unbalance: what is left of terms as large as phi'' itself
                allowed = np.maximum(allowed, 1e-12 * np.abs(motion["phi_ddot"])[:, None])
            if key == "phi_ddot_phi_dot":
                # a small flywheel far from O1: what is left of terms as large as m r^2 omega over its inertia
                allowed = np.maximum(allowed, 1e-14 * displaced_moments(name, state)[:, None])
            assert rows_within(slopes[key], value, allowed), key
        else:
            assert np.abs(slopes[key]).max() < 1e-9, key


def test_locked_flywheels_take_no_part() -> None:
    """With all locked the derivatives by V and phi are those of forward at phi'' = 0, and those by tau vanish."""
    c, state = backend_of("everything 4"), state_of("everything 4", 3)
    given = c.arguments(replace(state, phi_ddot=(0.0,) * 4)) | {"locked": [1] * 4}
    locked = c.call("coupled_jacobian", given)[1]["out"]
    driven = c.call("forward_jacobian", given)[1]["out"]
    for key in ("V_dot_V", "V_dot_phi", "V_dot_phi_dot"):
        largest = np.abs(driven[key]).max()
        assert np.array(locked[key]) == pytest.approx(np.array(driven[key]), abs=1e-11 * largest)
    assert not np.any(locked["V_dot_tau"])
    assert not np.any(locked["phi_ddot_V"])


def test_a_small_row_is_held_to_its_own_size() -> None:
    exact = np.array([[1e3, 2e3], [1.0, 3.0]])
    off = exact + np.array([[1e-8, 0.0], [0.0, 1e-8]])
    assert rows_within(off[:1], exact[:1], 1e-10 * scales(exact[:1]))
    assert not rows_within(off, exact, 1e-10 * scales(exact))


@pytest.mark.parametrize("locks", [(1, 0, 0, 0), (0, 1, 0, 1), (1, 1, 0, 1)])
@pytest.mark.parametrize("seed", [1, 2])
def test_some_flywheels_locked(locks: tuple[int, ...], seed: int) -> None:
    """Derivatives by V, phi, phi' and tau are the second derivation's without the rows of locked flywheels."""
    c, state = backend_of("everything 4"), state_of("everything 4", seed)
    given = c.arguments(state) | {"locked": list(locks)}
    found = c.call("coupled_jacobian", given)[1]["out"]
    free = [s for s, lock in enumerate(locks) if not lock]
    exact = locked_slopes(stand_of("everything 4"), state, free)
    assert set(exact) == set(found)
    for key, value in exact.items():
        allowed = np.maximum(1e-10 * scales(value), 1e-300)
        assert rows_within(found[key], value, allowed), key
    for s, lock in enumerate(locks):
        if lock:
            assert not any(np.any(np.array(found[key])[s]) for key in found if key.startswith("phi_ddot"))
            assert not np.any(np.array(found["V_dot_tau"])[:, s])


@pytest.mark.parametrize("function", ["forward_jacobian", "coupled_jacobian"])
def test_not_a_number_is_refused(function: str) -> None:
    c, state = backend_of("everything 1"), state_of("everything 1", 1)
    bad = c.arguments(replace(state, phi_dot=(float("nan"),)))
    wanted = {a.name for a in c.program.function(function).arguments}
    status, out = c.library.run(c.program.function(function), {k: v for k, v in bad.items() if k in wanted}, fill=3.5)
    assert status == STATUS_VALUES["NOT_FINITE"]
    assert np.all(np.array(out["out"]["V_dot_V"]) == 3.5)


def test_coupled_costs_at_most_twice_forward() -> None:
    """At eight flywheels, by the operations of the program."""
    program = backend_of("bench8").program
    coupled, forward = (cost(program.function(name), program.functions) for name in ("coupled", "forward"))
    assert coupled.total <= 2 * forward.total


def test_coupled_jacobian_costs_no_work_on_zeros() -> None:
    """A pair of flywheels adds little: two columns by phase and speed and one by torque, of 13 operations a flywheel.

    The right-hand sides of the other flywheels are zero in these columns, and cost at most a comparison.
    """

    def total(count: int) -> int:
        program = lower(random_stand(np.random.default_rng(1), count, BARE, name="pairs"), DOUBLE)
        return cost(program.function("coupled_jacobian"), program.functions).total

    pair = (total(8) - 2 * total(6) + total(4)) / 8  # second difference of a polynomial in N, by steps of 2
    assert pair <= 3 * (13 + 1)
