"""Sections of runs and programmes: singular values and residuals by the literal reference; short and spoilt runs."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from html import unescape

import numpy as np
import pytest

from mahovik.core.stand import Stand
from mahovik.out.report.plot.inline import figure
from mahovik.out.report.stand import histories, programme, singular
from mahovik.out.report.stand.run import Run
from mahovik.proof import reference
from report.stand.runs import example, material, right_states, run_of, run_through, spun_up
from verify.programme.programmes import shaker

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


def test_without_a_run_one_turn_is_shown() -> None:
    stand = example("bench8")
    found = singular.section(material(stand))
    assert found is not None and "one turn" in found.html and found.summary.startswith("condition number")
    assert singular.section(material(replace(stand, flywheels=()))) is None


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


def test_a_stream_is_known_to_residual_and_energy() -> None:
    stand = replace(example("auv6"), stream=(0.7, -0.4, 0.2))
    states = right_states(stand, 5)
    run = run_through(stand, states)
    assert all(y.max() < ROUNDING for y in checked(stand, run).values())
    energy = histories.energy(stand, run, np.arange(5)).lines[0].y
    expected = [reference.evaluate(stand, state, ["momentum"])["energy"] for state in states]
    assert energy == pytest.approx(expected, rel=1e-9)


def test_a_run_under_torques() -> None:
    stand = example("demo3")
    run = spun_up(stand)
    found = histories.section(material(stand, run))
    assert found is not None and "21 rows" in found.html
    for words in ("O1, mm", "speed, rpm", "drive torque, N m", "kinetic energy", "residual of (8)", "carrier, m/s"):
        assert words in found.html
    assert all(y.max() < 1e-8 for y in checked(stand, run).values())


@pytest.mark.slow
def test_a_row_is_a_run_and_so_is_one_that_flies_off() -> None:
    stand = example("demo3")
    run = spun_up(stand)
    one = run_of(stand, {name: column[:1] for name, column in run.columns.items()})
    away = run_of(stand, {**run.columns, "x [m]": 1e6 * np.exp(np.arange(21.0))})
    still = run_of(stand, {**run.columns, **{n: 0.0 * c for n, c in run.columns.items() if n[0] in "vo" or "dot" in n}})
    for each in (one, away, still):
        for module in (histories, singular):
            found = module.section(material(stand, each))
            assert found is not None and "nan" not in found.html.replace("nance", "")


def test_a_run_that_follows_a_programme_has_no_accelerations() -> None:
    stand = example("bench8")
    run = run_through(stand, right_states(stand, 4))
    followed = run_of(stand, {n: c for n, c in run.columns.items() if "_dot_" not in n and "ddot" not in n})
    assert histories.residuals(stand, followed, np.arange(4)) is None
    found = histories.section(material(stand, followed))
    assert found is not None and "Residual" not in found.html
    assert histories.section(material(stand)) is None


def test_a_long_run_keeps_its_peak_in_the_page() -> None:
    stand = example("demo3")
    columns = dict(spun_up(stand).columns)
    long = {name: np.repeat(column, 2000) for name, column in columns.items()}
    long["t [s]"] = np.linspace(0.0, 1.0, 42_000)
    x = np.zeros(42_000)
    x[31_337] = 0.004
    found = histories.section(material(stand, run_of(stand, {**long, "x [m]": x})))
    assert found is not None and "O1, mm, from the start over t, s from 0 to 1: x 0 to 4;" in found.html
    assert len(found.html) < 200_000


def test_a_programme_with_its_motion() -> None:
    stand, motion, wanted = shaker()
    both = replace(material(stand), programme=wanted, motion=motion)
    found = programme.section(both)
    assert found is not None and not found.failures
    for words in ("O1, mm, about the mean", "residual", "drive torque", "speed, rpm", "left", "right"):
        assert words in found.html
    alone = programme.section(replace(both, motion=None))
    assert alone is not None and "--motion" in alone.html and "drive torque" not in alone.html
    assert programme.section(material(stand)) is None
    along = singular.section(both)
    assert along is not None and "Along the programme" in along.html


def test_shaded_stretches_and_marks_are_in_the_picture() -> None:
    x = np.linspace(0.0, 6.0, 7)
    sigma = np.array([[1.0, 0.5], [1.0, 1e-3], [1.0, 1e-4], [1.0, 0.5], [1.0, 0.5], [1.0, 0.5], [1.0, 0.5]])
    html = figure(singular.panels(x, "t, s", sigma)[0])
    left, _, across, _ = json.loads(unescape(re.findall(r'data-axes="([^"]*)"', html)[0]))["box"]
    (shade,) = re.findall(r'd="([^"]*)"[^>]*style="fill: var\(--warn\)', html)
    edges = np.array(re.findall(r"[\d.]+", shade), float)[::2]
    assert (edges.min() - left) / across == pytest.approx(0.5 / 6.0, abs=1e-3)
    assert (edges.max() - left) / across == pytest.approx(2.5 / 6.0, abs=1e-3)
