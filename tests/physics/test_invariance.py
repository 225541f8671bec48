"""Matters of choice change nothing: origin and axes of E1, order of flywheels."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mahovik.laws.damping.data import Damping
from mahovik.laws.suspension.data import Suspension
from mahovik.proof.reference import evaluate
from mahovik.proof.reference.array import Values
from physics.general import draw
from physics.redescribed import redescribed, redescribed_state, transfer

SEEDS = range(4)
ROUNDING = 1e-10  # two ways of some hundred operations, condition of the 6 + N matrix below 1e4


@pytest.mark.parametrize("stream", [False, True])
@pytest.mark.parametrize("seed", SEEDS)
def test_moving_O1_and_turning_E1_changes_nothing_observable(seed: int, stream: bool) -> None:
    stand, state = draw(seed, 5, stream=stream)
    damping = stand.carrier.law(Damping)
    assert damping is not None
    carrier = stand.carrier.with_laws(replace(damping, quadratic=None, terms=()))
    stand = replace(stand.without_laws(Suspension), carrier=carrier)
    rng = np.random.default_rng(seed)
    d, R = rng.uniform(-0.3, 0.3, 3), Rotation.from_rotvec(rng.uniform(-1, 1, 3)).as_matrix()
    other, other_state = redescribed(stand, d, R), redescribed_state(stand, state, d, R)
    L = transfer(d, R)

    def evaluate_both(want: str) -> tuple[Values, Values]:
        return evaluate(stand, state, [want]), evaluate(other, other_state, [want])

    here, there = evaluate_both("momentum")
    np.testing.assert_allclose(there["Z0"], here["Z0"], rtol=0, atol=ROUNDING * np.abs(here["Z0"]).max())
    assert there["energy"] == pytest.approx(here["energy"], rel=ROUNDING)
    np.testing.assert_allclose(R @ there["center_of_mass"] + d, here["center_of_mass"], rtol=0, atol=ROUNDING)

    here, there = evaluate_both("forward")
    V_dot = L.T @ here["V_dot"]
    np.testing.assert_allclose(there["V_dot"], V_dot, rtol=0, atol=ROUNDING * np.abs(V_dot).max())

    here, there = evaluate_both("coupled")
    scale = np.abs(here["phi_ddot"]).max()
    np.testing.assert_allclose(there["phi_ddot"], here["phi_ddot"], rtol=0, atol=ROUNDING * scale)
    np.testing.assert_allclose(there["V_dot"], L.T @ here["V_dot"], rtol=0, atol=ROUNDING * scale)

    here, there = evaluate_both("inverse")
    assert there["status"] == here["status"]
    assert there["rank"] == here["rank"]
    np.testing.assert_allclose(there["sigma"], here["sigma"], rtol=0, atol=ROUNDING)
    scale = np.abs(here["phi_ddot"]).max() / here["sigma"][-1]
    np.testing.assert_allclose(there["phi_ddot"], here["phi_ddot"], rtol=0, atol=ROUNDING * scale)
    scale = np.abs(here["residual"]).max()
    np.testing.assert_allclose(there["residual"], np.linalg.solve(L, here["residual"]), rtol=0, atol=ROUNDING * scale)

    for want, name in (("torque", "tau"), ("mounts", "mount_wrench")):
        here, there = evaluate_both(want)
        scale = np.abs(here[name]).max()
        np.testing.assert_allclose(there[name], here[name], rtol=0, atol=ROUNDING * scale)

    here, there = evaluate_both("points")
    for name, point in here["points"].items():
        for quantity, value in point.items():
            scale = max(1.0, np.abs(value).max())
            np.testing.assert_allclose(there["points"][name][quantity], value, rtol=0, atol=ROUNDING * scale)


@pytest.mark.parametrize("seed", SEEDS)
def test_order_of_flywheels_is_of_no_consequence(seed: int) -> None:
    stand, state = draw(seed, 7)
    order = [3, 1, 2, 0, 6, 5, 4]
    shuffled = replace(stand, flywheels=tuple(stand.flywheels[i] for i in order))
    per_flywheel = ("phi", "phi_dot", "phi_ddot", "tau")
    shuffle: dict[str, Any] = {name: tuple(getattr(state, name)[i] for i in order) for name in per_flywheel}
    moved = replace(state, **shuffle)
    for want in ("matrices", "momentum", "forward", "torque", "mounts", "coupled", "inverse", "generalized"):
        here, there = evaluate(stand, state, [want]), evaluate(shuffled, moved, [want])
        for name, value in here.items():
            if name in ("status", "rank"):
                assert there[name] == value
                continue
            expected = value[order] if name in ("tau", "mount_wrench", "phi_ddot") else value
            expected = value[:, order] if name in ("I", "J") else expected
            if name == "residual":  # seven flywheels reach everything: rounding only, of the size of the demand
                expected, scale = np.zeros(6), 1e3
            else:
                scale = max(1.0, np.abs(value).max())
            np.testing.assert_allclose(there[name], expected, rtol=0, atol=ROUNDING * scale)
