"""`identify_step`: against the literal covariance form, and unbalances found in motion made by the reference."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mahovik import stands
from mahovik.core.lower.layout import Layout
from mahovik.core.lower.program import lower_layout
from mahovik.core.lower.values import Values
from mahovik.core.program.interpret import Interpreter
from mahovik.core.program.types import DOUBLE, FLOAT, Precision
from mahovik.core.stand import load
from mahovik.core.stand.model import Stand, State, rest_state
from mahovik.core.stand.random import EVERYTHING, random_stand
from mahovik.core.stand.structure import structure
from mahovik.proof.reference.evaluate import pieces
from mahovik.proof.reference.motion import forward
from mahovik.proof.verify.functions.table import checks_of
from mahovik.proof.verify.functions.value import covariance
from regressor.test_columns import case_of, failures


@pytest.mark.slow
@pytest.mark.parametrize(("name", "real"), [("everything", "double"), ("everything", "float"), ("bench8", "double")])
def test_a_step_is_that_of_the_covariance_form(tmp_path: Path, name: str, real: str) -> None:
    everything = random_stand(np.random.default_rng(6), 3, EVERYTHING)
    stand = everything if name == "everything" else load(stands.path(name))
    assert failures(checks_of(case_of(stand, tmp_path, real, named="identify_step"), "identify_step")) == {}


class Firmware:
    """The step of a stand's program, sample by sample."""

    def __init__(self, stand: Stand, precision: Precision) -> None:
        layout = Layout(structure(stand), precision)
        program = lower_layout(layout, ("identify_step",))
        values = Values(stand, layout, program)
        self._run = Interpreter(program).run
        self._tables = {"table": values.table, "mounting": values.mounting}
        n = 2 * len(stand.flywheels)
        self.estimate: dict[str, Any] = {
            "unbalance": [0.0] * n,
            "variance": [1e-6] * n,
            "factor": [0.0] * (n * (n - 1) // 2),
            "largest": 1e-6,
        }

    def take(self, state: State, noise: float) -> int:
        attitude = (1.0, 0.0, 0.0, 0.0)
        x = {"position": state.position, "attitude": attitude, "V": state.V, "phi": state.phi, "phi_dot": state.phi_dot}
        arguments: dict[str, Any] = {
            **self._tables,
            "x": x,
            "V_dot": state.V_dot,
            "phi_ddot": state.phi_ddot,
            "wrench": [],
        }
        status, outputs = self._run(
            "identify_step", {**arguments, "noise": [noise] * 6, "forget": 0.0, "estimate": self.estimate}
        )
        if status == 0:
            self.estimate = {name: outputs["estimate"][name] for name in self.estimate}
        return int(status)


def moved(stand: Stand, unbalance: np.ndarray) -> Stand:
    """The stand with m rc of each flywheel changed (kg m), its inertia about the origin as it was."""
    flywheels = []
    for s, (y, z) in zip(stand.flywheels, unbalance.reshape(-1, 2), strict=True):
        assert s.inertia_about == "origin"
        x0, y0, z0 = s.center_of_mass
        flywheels.append(replace(s, center_of_mass=(x0, y0 + float(y) / s.mass, z0 + float(z) / s.mass)))
    return replace(stand, flywheels=tuple(flywheels))


def samples(stand: Stand, true: Stand, count: int, seed: int) -> list[State]:
    """States of spinning flywheels with V* of the true stand, by the literal reference."""
    rng, N = np.random.default_rng(seed), len(stand.flywheels)
    samples = []
    for _ in range(count):
        state = replace(
            rest_state(stand),
            V=tuple(0.01 * rng.normal(size=6)),
            phi=tuple(rng.uniform(-3.0, 3.0, N)),
            phi_dot=tuple(rng.uniform(100.0, 200.0, N)),
            phi_ddot=tuple(rng.normal(size=N)),
        )
        V_dot = forward(pieces(true, state), np.array(state.phi_ddot))
        samples.append(replace(state, V_dot=tuple(V_dot.tolist())))
    return samples


@pytest.mark.parametrize(("precision", "error"), [(DOUBLE, 1e-9), (FLOAT, 1e-6)])
def test_planted_unbalances_are_found(precision: Precision, error: float) -> None:
    """40 samples without noise give 12 numbers of six flywheels, to the digits that the motion leaves."""
    stand = load(stands.path("bench8"))
    stand = replace(stand, flywheels=tuple(replace(s, inertia_about="origin") for s in stand.flywheels[:6]))
    planted = 2e-4 * np.random.default_rng(1).normal(size=12)
    firmware = Firmware(stand, precision)
    for state in samples(stand, moved(stand, planted), 40, 2):
        assert firmware.take(state, 1e-3) == 0
    estimate = np.array(firmware.estimate["unbalance"], dtype=np.float64)
    deviation = np.sqrt(np.diag(covariance(firmware.estimate)))
    assert np.abs(planted).max() > 1e-4
    assert np.all(np.abs(estimate - planted) <= error + 1e-3 * deviation)
    assert np.all(deviation < 1e-6)


def test_what_is_not_finite_is_refused_and_changes_nothing() -> None:
    stand = load(stands.path("bench8"))
    firmware = Firmware(stand, DOUBLE)
    before = {name: np.array(value) for name, value in firmware.estimate.items()}
    state = samples(stand, stand, 1, 5)[0]
    assert firmware.take(replace(state, V_dot=(float("nan"), *state.V_dot[1:])), 1e-2) < 0
    firmware.estimate["factor"][3] = float("inf")
    assert firmware.take(state, 1e-2) < 0
    firmware.estimate["factor"][3] = 0.0
    assert all(np.array_equal(before[name], firmware.estimate[name]) for name in before)
