"""Sections of runs and programmes: singular values and residuals by the literal reference; short and spoilt runs."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mahovik.core.stand import Stand
from mahovik.out.report.stand import histories, singular
from mahovik.out.report.stand.run import Run
from mahovik.proof import reference
from report.stand.runs import example, material, right_states, run_through

ROUNDING = 1e-11


def checked(stand: Stand, run: Run) -> dict[str, np.ndarray]:
    panel = histories.residuals(stand, run, np.arange(len(run.t)))
    assert panel is not None and panel.log
    return {line.name: line.y for line in panel.lines}


@pytest.mark.parametrize("name", ["bench8", "auv6", "sat4", "demo3"])
def test_singular_values_are_those_of_the_reference(name: str) -> None:
    stand = example(name)
    states = right_states(stand, 5)
    x, _, phi, words = singular.course(material(stand, run_through(stand, states)))
    sigma = {line.name: line.y for line in singular.panels(x, "t, s", singular_values_of(stand, phi))[0].lines}
    assert words == "Along the run."
    for row, state in enumerate(states):
        expected = reference.evaluate(stand, state, ["inverse"])["sigma"]
        found = [sigma[f"σ{k + 1}"][row] for k in range(len(expected))]
        assert found == pytest.approx(np.maximum(expected, singular.LEAST), rel=1e-6, abs=1e-11)


def singular_values_of(stand: Stand, phi: np.ndarray) -> np.ndarray:
    from mahovik.use.plan.certificate import singular_values
    from mahovik.use.plan.residual import Mechanics

    return singular_values(Mechanics.of(stand), phi)[0]


def test_nearly_singular_stretches_are_shaded() -> None:
    x = np.arange(6.0)
    sigma = np.array([[1.0, 0.5], [1.0, 1e-3], [1.0, 1e-4], [1.0, 0.5], [1.0, 0.0], [1.0, 0.5]])
    shown = singular.panels(x, "t, s", sigma)
    assert shown[0].shaded == shown[1].shaded == ((0.5, 2.5), (3.5, 4.5))
    assert singular.condition(sigma).tolist() == pytest.approx([2.0, 1e3, 1e4, 2.0, np.inf, 2.0])
    assert np.isnan(shown[1].lines[0].y[4])


@pytest.mark.parametrize("name", ["bench8", "auv6", "sat4"])
def test_a_right_run_has_no_residual_and_a_wrong_one_shows_it(name: str) -> None:
    stand = example(name)
    states = right_states(stand, 6)
    assert all(y.max() < ROUNDING for y in checked(stand, run_through(stand, states)).values())
    V_dot = np.array(states[3].V_dot)
    V_dot[4] += 1e-3 * np.abs(V_dot).max()
    states[3] = replace(states[3], V_dot=tuple(V_dot.tolist()))
    wrong = checked(stand, run_through(stand, states))["of (8)"]
    assert wrong[3] > 1e-8 and np.delete(wrong, 3).max() < ROUNDING
