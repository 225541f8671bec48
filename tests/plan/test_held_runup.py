"""Run-ups of held carriers: equations along the freedoms, and a shaker through its resonance by its closed formula."""

from __future__ import annotations

import cmath
import json
import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from mahovik.core.motion.course import Course
from mahovik.core.motion.programme import Fourier, Programme, RunUpTable
from mahovik.core.motion.required import Bounds, RequiredMotion, read_motion
from mahovik.core.stand import Stand
from mahovik.errors import MahovikError
from mahovik.proof.reference.hold import held_forward
from mahovik.proof.verify.programme import held
from mahovik.proof.verify.programme.finding import RUNUP, SMOOTH, Tolerance
from mahovik.proof.verify.programme.mechanics import pieces_at, scale_of, twist
from mahovik.proof.verify.programme.runup import runup_findings
from mahovik.proof.verify.programme.simulation import rest_near
from mahovik.use.plan.array import Array
from mahovik.use.plan.certificate import make_programme
from mahovik.use.plan.forward import drive, equilibrium
from mahovik.use.plan.held_chart import HeldChart, chart_at
from mahovik.use.plan.residual import Mechanics
from mahovik.use.plan.runup import with_runup
from plan.held_stands import HOLDS, stand, wheel

MASS, MU, STIFFNESS, DAMPING = 3.0, 0.04, 20000.0, 20.0
PERIOD, LASTS = 0.05, 0.3
OMEGA = 2.0 * math.pi / PERIOD
"""rad/s; the natural frequency is 81.6 rad/s, so that the run-up passes through it."""


def shaker(freedom: str = "z") -> Stand:
    """Two exciters that turn against each other, on a rail with a spring and a damper."""
    return stand(
        f'freedoms = ["{freedom}"]',
        wheel(1, [1, 0, 0], 1e3 * MU, (0, -0.1, 0)) + wheel(2, [-1, 0, 0], 1e3 * MU, (0, 0.1, 0)),
        f"[suspension]\nstiffness = [0, 0, {STIFFNESS}, 0, 0, 0]\ndamping = [0, 0, {DAMPING}, 0, 0, 0]",
    )


def shaken(bounds: Bounds, apart: float = 0.0) -> tuple[Stand, RequiredMotion, Programme]:
    """(k - m w^2 + i c w) Z = mu w^2 (e^ia + e^ib): wheels `apart` from each other (rad) at constant speed."""
    own = shaker()
    response = STIFFNESS - MASS * OMEGA**2 + 1j * DAMPING * OMEGA
    size = 2.0 * MU * OMEGA**2 * math.cos(apart / 2) / abs(response)
    document = {"schema": 1, "type": "periodic", "period": PERIOD, "harmonics": [{"k": 1, "cos": [size]}]}
    required = replace(read_motion(json.dumps(document), own, "m.json"), runup=LASTS, bounds=bounds)
    mean = cmath.phase(response) + apart / 2 * np.array([1.0, -1.0])
    course = Fourier(mean, np.zeros((0, 2)), np.zeros((0, 2)))
    programme = make_programme(own, required, np.array([-MASS * 9.81 / STIFFNESS]), (1, 1), course, {})
    return own, required, programme


@cache
def made() -> Programme:
    return with_runup(*shaken(Bounds()))


def sway(table: RunUpTable, start: Array) -> Array:
    """z, z' at the end by m z'' + c z' + k z + m g = mu sum (phi'' sin phi + phi'^2 cos phi)."""

    def rates(t: float, y: Array) -> Array:
        phi, phi_dot, phi_ddot = (each[0] for each in table.at(np.array([t])))
        shaking = MU * float(np.sum(phi_ddot * np.sin(phi) + phi_dot**2 * np.cos(phi)))
        return np.array([y[1], (shaking - DAMPING * y[1] - STIFFNESS * y[0]) / MASS - 9.81])

    step = table.duration / 500
    return np.asarray(solve_ivp(rates, (0, table.duration), start, "DOP853", rtol=1e-10, atol=1e-12, max_step=step).y.T)


@pytest.mark.parametrize("up", [True, False])
def test_a_shaker_goes_through_its_resonance_by_the_closed_formula(up: bool) -> None:
    _, required, programme = shaken(Bounds())
    table = made().runup if up else made().rundown
    assert table is not None and table.duration == LASTS
    course = required.at(np.zeros(1), programme.bias)
    joint, rest = np.array([course.q[0, 0], course.q_dot[0, 0]]), np.array([programme.bias[0], 0.0])
    y = sway(table, rest if up else joint)
    size = required.at(np.zeros(1)).q[0, 0]
    assert np.abs((y[-1] - (joint if up else rest)) / [size, OMEGA * size]).max() < 2e-6
    report = made().report["runup" if up else "rundown"]
    assert report["terminal_error"] < 1e-6 and report["deviation"]["angular"]["largest"] == 0.0
    assert report["deviation"]["linear"]["largest"] == pytest.approx(np.abs(y[:, 0] - rest[0]).max(), rel=1e-3)


@pytest.mark.slow
def test_the_verification_takes_the_tables_and_refuses_wrong_ones() -> None:
    own, required, programme = shaken(Bounds(torque=(1e3, 1e3), deviation=(0.2, math.inf)))
    scale = scale_of(own, required, programme)
    limits = Tolerance(SMOOTH, SMOOTH, RUNUP)
    found = runup_findings(own, required, made(), scale, limits)
    assert all(each.passed for each in found)
    assert {"run-up end", "run-down end", "run-up bound deviation", "run-up bound torque"} <= {e.name for e in found}
    table = made().runup
    assert table is not None
    turned = replace(table.samples, phi=table.samples.phi + np.array([2e-3, 0.0]))
    wrong = runup_findings(own, required, replace(made(), runup=replace(table, samples=turned)), scale, limits)
    assert "run-up end" in {each.name for each in wrong if not each.passed}


def chart_of(own: Stand, q: Array) -> HeldChart:
    found = chart_at(Mechanics.of(own), q)
    assert isinstance(found, HeldChart)
    return found


@pytest.mark.parametrize("hold", HOLDS)
def test_equations_along_the_freedoms_are_those_of_the_reference(hold: str) -> None:
    """u* against multipliers of the hold; coordinates, displacements and their changes against differences."""
    own = stand(hold, wheel(1, [0, 1, 1], 3, (0.1, 0, 0)) + wheel(2, [1, 0, 0], 2))
    assert own.hold is not None
    rng, m = np.random.default_rng(8), len(own.hold.freedoms)
    q0, y = rng.normal(size=m) * 0.3, rng.normal(size=(3, 2 * m)) * 0.4
    phi, phi_dot, phi_ddot = rng.normal(size=(3, 3, 2)) * 3
    chart = chart_of(own, q0)
    given = drive(chart.mechanics, phi, phi_dot, phi_ddot)
    rate, S = chart.rate(given, y), chart.mechanics.freedoms
    for i in range(3):
        q, u = q0 + y[i, :m], y[i, m:]
        at = pieces_at(own, q, S @ u, phi[i], phi_dot[i])
        expected = held_forward(at, own.hold, phi_ddot[i]).u_dot
        assert np.abs(rate[i, m:] - expected).max() < 1e-10 * max(1.0, np.abs(expected).max())
        assert np.abs(twist(own, q, rate[i, :m]) - S @ u).max() < 1e-12
    still = Course(y[:, :m] + q0, rate[:, :m], np.zeros((3, m)))
    assert np.abs(chart.of(still) - y).max() < 1e-12
    away = chart.displacement(y)
    for i in range(3):
        told = held.displacement(own, q0 + y[i, :m], q0)
        assert [np.linalg.norm(away[i, :3]), np.linalg.norm(away[i, 3:])] == pytest.approx(told, abs=1e-12)
    moved = rng.normal(size=(3, 2 * m, 1))
    changes = chart.displacement_change(y, moved)[:, :, 0].reshape(3, 2, 3)
    e = 1e-6
    ends = [chart.displacement(y + side * moved[:, :, 0]).reshape(3, 2, 3) for side in (e, -e)]
    by_difference = (np.linalg.norm(ends[0], axis=2) - np.linalg.norm(ends[1], axis=2)) / (2 * e)
    directions = away.reshape(3, 2, 3)
    size = np.maximum(np.linalg.norm(directions, axis=2), 1e-300)
    assert np.abs(np.einsum("ijk,ijk->ij", directions, changes) / size - by_difference).max() < 1e-7


def test_a_pendulum_with_an_unbalanced_wheel_rests_where_moments_balance() -> None:
    """tan theta = mu / (m l) of a wheel whose unbalance points forward; both derivations of rest, and d/dphi."""
    own = stand('freedoms = ["pitch"]\npivot = [0, 0, "120 mm"]', wheel(1, [0, 1, 0], 20))
    chart = chart_of(own, np.zeros(1))
    for phi in (math.pi / 2, -math.pi / 2):
        found = equilibrium(chart, np.array([phi]))
        ahead = equilibrium(chart, np.array([phi + 1e-5])).y[0] - equilibrium(chart, np.array([phi - 1e-5])).y[0]
        assert abs(found.y[0]) == pytest.approx(math.atan2(0.02, 2.5 * 0.12), rel=1e-9)
        assert found.by_phi[0, 0] == pytest.approx(ahead / 2e-5, abs=1e-6)
        K0 = chart.mechanics.mean_inertia
        rest = rest_near(own, np.array([phi]), np.zeros(1), K0)
        assert rest.q == pytest.approx(found.y[:1], abs=1e-9) and rest.free.shape == (6, 0)


def test_what_nothing_holds_along_a_freedom_is_told() -> None:
    own = stand('freedoms = ["z"]', wheel(1, [0, 1, 0]))
    with pytest.raises(MahovikError, match=r"accelerates by 9\.81 m/s2; nothing holds it there"):
        equilibrium(chart_of(own, np.zeros(1)), np.zeros(1))
