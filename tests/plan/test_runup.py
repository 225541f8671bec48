"""Run-up and run-down of planned programmes, judged by the literal reference under SciPy's integration."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import DOP853

from mahovik.core.motion.programme import Fourier, Programme, RunUpTable, load_programme, save_programme
from mahovik.core.motion.required import Bounds, RequiredMotion
from mahovik.core.stand.model import Stand
from mahovik.proof.verify.programme.mechanics import scale_of
from mahovik.proof.verify.programme.simulation import rate, rest_near
from mahovik.use.plan.certificate import make_programme
from mahovik.use.plan.runup import shortcomings, solve, with_runup
from plan.examples import example
from toolchain.quick import quick

Array = np.ndarray
LASTS = 0.12
NONE = Bounds()


def spinning(bounds: Bounds = NONE) -> tuple[Stand, RequiredMotion, Programme]:
    """Two wheels at constant speed against each other: the one amplitude that needs no search."""
    stand, motion = example("shaker2", "shaker2_spin")
    motion = replace(motion, runup=LASTS, bounds=bounds)
    none = np.zeros((0, 2))
    course = Fourier(np.array([-1.5822788629852351, 4.723871516575028]), none, none)
    return stand, motion, make_programme(stand, motion, np.array([0, 0, -6.463e-11, 0, 0, 0]), (1, -1), course, {})


@cache
def planned() -> Programme:
    """The spinning programme with its run-up and run-down."""
    return with_runup(*spinning())


def simulated(table: RunUpTable, start: Array, stand: Stand) -> Array:
    """(q, V) (M, 12) at the rows: DOP853 on the reference, never over a row, where phi''' jumps."""

    def rates(t: float, y: Array) -> Array:
        angles = table.at(np.array([t]))
        return rate(stand, y, angles.phi[0], angles.phi_dot[0], angles.phi_ddot[0])

    states, rows = [start], table.samples.t
    for begin, end in pairwise(rows):
        solver = DOP853(rates, begin, states[-1], end, rtol=1e-11, atol=1e-14, first_step=end - begin)
        while solver.status == "running":
            solver.step()
        assert solver.status == "finished"
        states.append(solver.y)
    return np.array(states)


@pytest.mark.parametrize("up", quick(1, [True, False]))
def test_the_carrier_ends_where_it_shall_and_strays_as_is_told(up: bool) -> None:
    """From equilibrium into the required state, or back, to 1e-6 of the amplitude; deviation as in the report."""
    stand, motion, programme = spinning()
    made = planned()
    table = made.runup if up else made.rundown
    assert table is not None and table.duration == LASTS
    scale, mean = scale_of(stand, motion, programme), motion.mean + programme.bias
    course = motion.at(np.zeros(1), programme.bias)
    joint = np.concatenate([course.q[0], course.q_dot[0]])  # without attitude V is q'
    rest = np.concatenate([rest_near(stand, table.samples.phi[0 if up else -1], mean, scale.K0).q, np.zeros(6)])
    y = simulated(table, rest if up else joint, stand)
    apart = y[-1] - (joint if up else rest)
    assert scale.displacement_share(apart[:6]) <= 1e-6
    assert scale.twist_share(apart[6:]) <= 1e-6
    told = made.report["runup" if up else "rundown"]
    away = np.linalg.norm(y[:, :3] - mean[:3], axis=1)
    assert told["deviation"]["linear"]["largest"] == pytest.approx(away.max(), rel=1e-3)
    assert told["deviation"]["linear"]["t"] == pytest.approx(table.samples.t[away.argmax()], abs=motion.span / 16)
    assert told["terminal_error"] <= 1e-6
    assert told["deviation"]["angular"]["largest"] <= 1e-9


def test_peaks_are_those_of_the_table() -> None:
    """Speed and acceleration a flywheel."""
    made = planned()
    assert made.runup is not None
    peak = made.report["runup"]["peak"]
    for key, column in (("speed", made.runup.samples.phi_dot), ("acceleration", made.runup.samples.phi_ddot)):
        assert peak[key] == pytest.approx(np.abs(column).max(axis=0), rel=1e-2)
    assert all(value > 0.0 for value in peak["torque"])
    assert shortcomings(made) == ()


def test_the_same_twice_and_from_its_file(tmp_path: object) -> None:
    """Same arguments, same bits; the file keeps them."""
    again, made = with_runup(*spinning()), planned()
    assert made.runup is not None and again.runup is not None
    assert np.array_equal(again.runup.samples.phi_ddot, made.runup.samples.phi_ddot)
    path = f"{tmp_path}/programme.json"
    save_programme(made, path)
    read = load_programme(path)
    assert read.rundown is not None and made.rundown is not None
    assert np.array_equal(read.rundown.samples.phi, made.rundown.samples.phi)
    assert read.report["runup"]["deviation"] == made.report["runup"]["deviation"]


def test_nothing_is_done_unless_asked_for() -> None:
    """Without `runup` in the motion the programme stays as it is."""
    stand, motion, programme = spinning()
    assert with_runup(stand, replace(motion, runup=None), programme) is programme


@pytest.mark.slow
def test_a_bound_that_cannot_be_kept_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """The programme's own speed is above it: of which flywheel, by what; the tables are given."""
    monkeypatch.setattr(solve, "RICHER", ())
    made = with_runup(*spinning(Bounds(deviation=(1.0, np.inf), speed=(100.0, 1000.0))))
    assert made.runup is not None and made.rundown is not None
    words = shortcomings(made)
    assert [line.split(" ")[0] for line in words] == ["run-up:", "run-down:"]
    assert all("speed of left" in line and "100 rad/s" in line for line in words)


@pytest.mark.slow
def test_momentum_that_nothing_takes_up_is_told() -> None:
    """A free stand at rest has none, its programme has: no run-up exists, the programme stays."""
    stand, motion = example("demo3")
    motion = replace(motion, runup=0.1)
    course = Fourier(np.zeros(3), np.zeros((0, 3)), np.zeros((0, 3)))
    programme = make_programme(stand, motion, np.zeros(6), (2, -3, 1), course, {"kind": "spin"})
    made = with_runup(stand, motion, programme)
    assert made.runup is None and made.rundown is None
    assert all("cannot absorb the momentum" in line for line in shortcomings(made))
    assert made.report["kind"] == "spin" and len(shortcomings(made)) == 2
