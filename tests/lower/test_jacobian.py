"""forward_jacobian and coupled_jacobian against automatic differentiation of the second derivation."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from types import MappingProxyType

import casadi as ca
import numpy as np
import pytest

from mahovik.program.cost import cost
from mahovik.program.function import STATUS_VALUES
from mahovik.second import Second
from mahovik.stand import Stand, State, load
from mahovik.stand.random import BARE, EVERYTHING, random_stand, random_state
from mahovik.stands import names, path
from mahovik.verify.c_backend import CBackend, with_all_inputs

RANDOM = {
    "everything 1": (1, EVERYTHING, 1),
    "everything 4": (4, EVERYTHING, 2),
    "everything 7": (7, EVERYTHING, 3),
    "bare 0": (0, BARE, 4),
    "bare 6": (6, BARE, 5),
}


@cache
def stand_of(name: str) -> Stand:
    """An example stand, or a random one with a run-time wrench on every body."""
    if name in RANDOM:
        count, features, seed = RANDOM[name]
        return with_all_inputs(random_stand(np.random.default_rng(seed), count, features, name="sloped"))
    return load(path(name))


@cache
def made(name: str) -> CBackend:
    return CBackend(stand_of(name))


def state_of(name: str, seed: int) -> State:
    """A random state; without run-time wrenches where the C takes none."""
    state = random_state(stand_of(name), np.random.default_rng(seed))
    return state if made(name).inputs else replace(state, wrench=MappingProxyType({}))


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


def scales(exact: np.ndarray) -> np.ndarray:
    """Rows of velocities and of rotations have sizes of their own."""
    rows = np.abs(exact).max(axis=1, keepdims=True)
    if len(exact) == 6:
        rows = np.repeat([rows[:3].max(), rows[3:].max()], 3)[:, None]
    return np.maximum(rows, np.abs(exact).max() * 1e-3)


CASES = [*RANDOM, *names()]


@pytest.mark.parametrize("seed", [1, 2])
@pytest.mark.parametrize("name", CASES)
def test_derivatives_of_forward(name: str, seed: int) -> None:
    """By V, phi, phi' and phi''. Two independent solves: 1e-10 of the largest in a row of like numbers."""
    c, state = made(name), state_of(name, seed)
    by = ("V", "phi", "phi_dot", "phi_ddot") if state.phi else ("V",)
    slopes = c.call("forward_jacobian", c.arguments(state))[1]["out"]
    exact = differentiated(stand_of(name), state, "forward", by)
    assert set(slopes) == set(exact)
    for key, value in exact.items():
        if np.abs(value).max() > 1e-12:  # balanced flywheels: nothing depends on their phases
            assert np.abs(np.array(slopes[key]) - value).max() <= (1e-10 * scales(value)).max(), key
        else:
            assert np.abs(slopes[key]).max() < 1e-9, key


@pytest.mark.parametrize("seed", [1, 2])
@pytest.mark.parametrize("name", [n for n in CASES if n != "bare 0"])
def test_derivatives_of_coupled(name: str, seed: int) -> None:
    """By V, phi, phi' and tau, of both results."""
    c, state = made(name), state_of(name, seed)
    slopes = c.call("coupled_jacobian", c.arguments(state))[1]["out"]
    motion = c.call("coupled", c.arguments(state))[1]
    exact = differentiated(stand_of(name), state, "coupled", ("V", "phi", "phi_dot", "tau"))
    assert set(slopes) == set(exact)
    for key, value in exact.items():
        if np.abs(value).max() > 1e-12:
            allowed = (1e-10 * scales(value)).max()
            if key == "phi_ddot_phi":
                # a turned phase moves a small unbalance: what is left of terms as large as phi'' itself
                allowed = max(allowed, 1e-12 * np.abs(motion["phi_ddot"]).max())
            assert np.abs(np.array(slopes[key]) - value).max() <= allowed, key
        else:
            assert np.abs(slopes[key]).max() < 1e-9, key


def test_locked_flywheels_take_no_part() -> None:
    """With all locked the derivatives by V and phi are those of forward at phi'' = 0, and those by tau vanish."""
    c, state = made("everything 4"), state_of("everything 4", 3)
    given = c.arguments(replace(state, phi_ddot=(0.0,) * 4)) | {"locked": [1] * 4}
    locked = c.call("coupled_jacobian", given)[1]["out"]
    driven = c.call("forward_jacobian", given)[1]["out"]
    for key in ("V_dot_V", "V_dot_phi", "V_dot_phi_dot"):
        largest = np.abs(driven[key]).max()
        assert np.array(locked[key]) == pytest.approx(np.array(driven[key]), abs=1e-11 * largest)
    assert not np.any(locked["V_dot_tau"])
    assert not np.any(locked["phi_ddot_V"])


@pytest.mark.parametrize("function", ["forward_jacobian", "coupled_jacobian"])
def test_not_a_number_is_refused(function: str) -> None:
    c, state = made("everything 1"), state_of("everything 1", 1)
    bad = c.arguments(replace(state, phi_dot=(float("nan"),)))
    wanted = {a.name for a in c.program.function(function).arguments}
    status, out = c.library.run(c.program.function(function), {k: v for k, v in bad.items() if k in wanted}, fill=3.5)
    assert status == STATUS_VALUES["NOT_FINITE"]
    assert np.all(np.array(out["out"]["V_dot_V"]) == 3.5)


def test_coupled_costs_at_most_twice_forward() -> None:
    """At eight flywheels, by the operations of the program."""
    program = made("bench8").program
    assert cost(program.function("coupled")).total <= 2 * cost(program.function("forward")).total
