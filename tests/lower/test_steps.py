"""Steps at their limits: too long for the turning in them, run-away, and too short for a float without a carry."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any
from unittest.mock import patch

import numpy as np
import pytest

from lower.in_place import end_of_steps
from mahovik.contract.status import STATUS_VALUES
from mahovik.core.stand import load
from mahovik.core.stand.model import rest_state
from mahovik.core.toolchain import library
from mahovik.core.toolchain.compiler import BITS
from mahovik.proof.verify.c_backend import CBackend

STANDS = Path(__file__).parents[2] / "generator" / "mahovik" / "stands"
COARSE, RANGE = STATUS_VALUES["COARSE"], STATUS_VALUES["RANGE"]


@cache
def compiled(name: str, real: str = "double") -> CBackend:
    with patch.object(library, "FLAGS", (*BITS, "-O2")):  # optimised: many steps are made
        return CBackend(load(STANDS / f"{name}.toml"), real)


def good(c: CBackend, **more: Any) -> dict[str, Any]:
    """Arguments of every step function, at rest."""
    N = len(c.layout.structure.flywheels)
    x = {"position": [0.0] * 3, "attitude": [1.0, 0, 0, 0], "V": [0.0] * 6, "phi": [0.3] * N, "phi_dot": [0.0] * N}
    arguments = {
        "table": c.library.default("default"),
        "x": x,
        "tau": [0.0] * N,
        "locked": [0] * N,
        "phi_ddot": [0.0] * N,
    }
    arguments |= {"wrench": [0.0] * 6 * len(c.inputs), "dt": 1e-3, "order": 4}
    return arguments | more


def carry(c: CBackend) -> dict[str, Any]:
    """No carry, and one."""
    return {"without": {}, "with": {"carry": {"rounding": [0.0] * (13 + 2 * len(c.layout.structure.flywheels))}}}


def moving(c: CBackend, **members: list[float]) -> dict[str, Any]:
    x: dict[str, Any] = good(c)["x"] | members
    return x


@pytest.mark.parametrize("function", ["step", "step_driven"])
@pytest.mark.parametrize("kept", ["without", "with"])
@pytest.mark.parametrize(("order", "turn"), [(4, 1.0), (2, 0.1)])
def test_a_step_in_which_something_turns_too_far_says_so_and_is_made(
    function: str, kept: str, order: int, turn: float
) -> None:
    c = compiled("sat4")
    N, speed = len(c.layout.structure.flywheels), 50.0
    last = [0.0] * (N - 1)
    for x in (moving(c, phi_dot=[*last, -speed]), moving(c, V=[0.0] * 3 + [0.6 * speed, 0.0, -0.8 * speed])):
        for part, expected in ((0.99, 0), (1.01, COARSE), (3.0, COARSE)):
            arguments = good(c, x=x, order=order, dt=part * turn / speed, **carry(c)[kept])
            status, out = c.call(function, arguments)
            assert status == expected
            assert out["next"] != x


def test_the_bound_stands_for_the_error_that_the_header_names() -> None:
    """The error of a vibration after a turn is 3e-4 at the bound, and 100 and 10 times less at a third of it."""
    c = compiled("bench8")
    N, speed = len(c.layout.structure.flywheels), 300.0
    start = good(c)["x"] | {"phi": np.linspace(-3, 3, N).tolist(), "phi_dot": [speed] * N}

    def end(order: int, steps: int) -> np.ndarray:
        x, way = start, []
        for _ in range(steps):
            dt = 2 * np.pi / speed / steps
            x = c.call("step_driven", good(c, x=x, order=order, dt=dt))[1]["next"]
            way.append(x["V"])
        return np.array(way)

    exact = end(4, 600)
    size = np.abs(exact).max(axis=0)
    for order, steps in ((4, 6), (2, 60)):
        error = np.max(np.abs(end(order, steps)[-1] - exact[-1]) / size)
        assert 3e-5 < error < 1e-3


def test_a_step_that_runs_away_is_out_of_range() -> None:
    """Not "no positive definite matrix": the stand is as it was, only the step is too long for its laws."""
    c = compiled("demo3", "float")
    x = moving(c, V=[-4432.0, 2132.0, -9000.0, -2025.0, -1541.0, 5237.0], phi_dot=[13735.0, 22739.0, -41836.0])
    arguments = good(c, x=x, dt=3.6136937, tau=[1.517310e8] * 3)
    for function, kept in (("step", "without"), ("step_driven", "without"), ("step", "with")):
        for order in (2, 4):
            for dt in (0.1, 1.0, 3.6136937, 10.0):
                assert c.call(function, arguments | {"dt": dt, "order": order, **carry(c)[kept]})[0] == RANGE


def speeds(real: str, dt: float, seconds: float, carried: bool = False) -> np.ndarray:
    """Speeds of sat4 after torques of 10 mN m, rad/s."""
    state = rest_state(load(STANDS / "sat4.toml"))
    state = replace(state, tau=(0.01,) * len(state.tau))
    steps = round(seconds / dt)
    end = end_of_steps(compiled("sat4", real), "step", state, seconds, steps, carried=carried)
    return np.asarray(end["phi_dot"])


@pytest.mark.slow
@pytest.mark.parametrize("dt", [1e-4, 2e-5])
def test_a_carry_keeps_the_increments_of_short_steps_in_float(dt: float) -> None:
    """Two seconds: without a carry the speeds are wrong by a tenth of a percent and more."""
    exact = speeds("double", 1e-3, 2.0)
    size = np.abs(exact).max()
    without = np.abs(speeds("float", dt, 2.0) - exact).max() / size
    carried = np.abs(speeds("float", dt, 2.0, carried=True) - exact).max() / size
    assert carried < 2e-6
    assert without > 100 * carried
