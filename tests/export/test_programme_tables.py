"""Tables of a programme: their stated errors, torques, whole turns, and the motion of the carrier by their C."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from export.programmes import PERIOD, exported, motion, spin, stand, started, swaying, written
from mahovik import stands
from mahovik.core.lower.programme_play import Player
from mahovik.core.motion.functions import Fourier, Samples
from mahovik.core.motion.programme import Programme
from mahovik.core.stand import load
from mahovik.errors import CheckError, UsageError
from mahovik.out.export.programme import ProgrammeExport, export_programme
from toolchain.quick import quick
from toolchain.tools import run


def player(made: ProgrammeExport) -> Player:
    """The C's interpreter."""
    return Player(made.program, {t.form.part: t.value for t in made.tables})


def outputs_at(made: ProgrammeExport, phases: np.ndarray, number: int = 0) -> dict[str, np.ndarray]:
    """Outputs of one table at phases."""
    return player(made).many(made.program.courses[number], [float(np.float32(x)) for x in phases])


def mean() -> np.ndarray:
    """The constant speed of `spin`, as the mean phases of its course."""
    course = spin().course
    assert isinstance(course, Fourier)
    return course.mean


def angular_distance(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Distance of angles, modulo a turn."""
    d = a - b
    return np.asarray(np.abs(d - 2 * np.pi * np.round(d / (2 * np.pi))))


@pytest.mark.parametrize(
    ("name", "kind", "real"),
    [("swaying", "quintic", "double"), ("swaying", "fourier", "float"), ("sampled", "quintic", "float")],
)
def test_errors_are_what_is_told(name: str, kind: str, real: str) -> None:
    """Errors at other phases than those of the report are no larger than reported, with a little room."""
    made = exported(name, kind, real)
    told = made.errors[0]
    phases = np.random.default_rng(3).random(300)
    outputs = outputs_at(made, phases)
    truth = made.tables[0].at(np.float32(phases).astype(float) * PERIOD)
    assert np.max(angular_distance(outputs["phi"], truth.phi)) <= 2 * told.phi
    assert np.max(np.abs(outputs["phi_dot"] - truth.phi_dot)) <= 2 * told.phi_dot
    assert np.max(np.abs(outputs["phi_ddot"] - truth.phi_ddot)) <= 2 * told.phi_ddot
    assert np.max(np.abs(outputs["phi"])) <= np.pi * (1 + 1e-6)
    assert told.phi < {"double": 1e-9, "float": 1e-6}[real]


def test_speed_and_acceleration_are_the_derivatives() -> None:
    for kind in ("quintic", "fourier"):
        step = 2.0**-20
        middle = np.arange(1, 60) / 61.0
        made = exported("swaying", kind)
        a, b, c = (player(made).many(made.program.courses[0], list(middle + k * step)) for k in (-1, 0, 1))
        h = step * PERIOD
        rise = c["phi"] - a["phi"]
        rise -= 2 * np.pi * np.round(rise / (2 * np.pi))
        assert np.allclose(rise / (2 * h), b["phi_dot"], atol=1e-4)
        assert np.allclose((c["phi_dot"] - a["phi_dot"]) / (2 * h), b["phi_ddot"], atol=1e-1)


def test_torques_are_those_of_the_reference() -> None:
    for real, share in (("double", 1e-6), ("float", 1e-5)):
        for kind in ("quintic", "fourier"):
            told = exported("spin", kind, real).errors[0]
            assert told.tau is not None
            assert told.tau_peak is not None
            assert told.tau < share * told.tau_peak


def test_run_up_ends_on_the_programme_and_run_down_begins_there() -> None:
    made = exported("started")
    assert [t.form.part for t in made.tables] == ["", "runup", "rundown"]
    course, up, down = made.program.courses
    begin = player(made).at(course, 0.0)[1]
    for table, phase in ((up, 1.0), (down, 0.0)):
        status, joint = player(made).at(table, phase)
        assert status == 0
        assert np.max(angular_distance(np.array(joint["phi"]), np.array(begin["phi"]))) < 1e-12
        assert joint["phi_dot"] == pytest.approx(begin["phi_dot"], rel=1e-12)
        assert joint["phi_ddot"] == pytest.approx(begin["phi_ddot"], abs=1e-6)
    assert player(made).at(up, 0.0)[1]["phi_dot"] == [0.0, 0.0]
    truth = started().runup
    assert truth is not None
    phases = np.random.default_rng(5).random(100)
    outputs = outputs_at(made, phases, 1)
    exact = truth.at(np.float32(phases).astype(float) * truth.duration)
    assert np.max(angular_distance(outputs["phi"], exact.phi)) < 1e-9
    assert np.max(np.abs(outputs["phi_ddot"] - exact.phi_ddot)) < 1e-2


def test_torques_of_run_up_and_run_down_are_those_of_a_free_carrier() -> None:
    """From rest the weight of the unbalance; the run-down begins with the torques of the programme."""
    made = export_programme(stand(), started(), motion(), real="float")
    course, up, down = made.program.courses
    begin, leave, rest = (player(made).at(part, 0.0)[1] for part in (course, down, up))
    assert leave["tau"] == pytest.approx(begin["tau"], rel=1e-5)
    weight = [w.mass * 9.81 * w.center_of_mass[1] for w in stand().flywheels]
    assert rest["tau"] == pytest.approx(weight * np.cos(np.array(rest["phi"])), rel=1e-5)
    for told in made.errors[1:]:
        assert told.tau is not None
        assert told.tau_peak is not None
        assert told.tau < 1e-4 * told.tau_peak
        assert told.added is None


def test_a_programme_of_another_stand_or_motion_is_refused() -> None:
    other = replace(spin(), stand=replace(spin().stand, physics="00000000"))
    with pytest.raises(CheckError, match=r"of another stand.*plan again"):
        export_programme(stand(), other)
    with pytest.raises(CheckError, match="of another motion"):
        export_programme(stand(), replace(spin(), motion="shaker2_z"), motion())
    with pytest.raises(CheckError, match=r"period is 0\.04 s, of the motion 0\.05 s"):
        export_programme(stand(), replace(spin(), period=0.04), motion())
    with pytest.raises(CheckError, match="does not give the motion"):
        export_programme(stand(), swaying(), motion())
    beside = spin().with_course(Fourier(mean(), np.full((1, 2), 1e-5), np.zeros((1, 2))))
    with pytest.raises(CheckError, match="does not give the motion"):
        export_programme(stand(), beside, motion())


def test_what_means_nothing_is_refused() -> None:
    for limit in (0.0, -1.0, float("nan"), float("inf")):
        with pytest.raises(UsageError, match="expected a number above 0"):
            export_programme(stand(), spin(), limit=limit)
    with pytest.raises(UsageError, match="a finite programme"):
        export_programme(stand(), replace(spin(), period=None, duration=0.05), kind="fourier")


SPAN = 10.0


def even_programme(speed: float, gained: float) -> Programme:
    """Flywheels of sat4 at `speed` (rad/s) that gain up to `gained` by a fifth-order polynomial."""
    stand = load(stands.path("sat4"))
    x = np.linspace(0.0, 1.0, 41)
    law = np.polynomial.Polynomial([0.0, 0.0, 0.0, 10.0, -15.0, 6.0])
    share = np.array([1.0, -1.0, 0.5, 0.0])
    columns = [
        np.outer(SPAN * law.integ()(x), share) * gained + speed * np.outer(SPAN * x, np.sign(share)),
        np.outer(law(x), share) * gained + speed * np.sign(share),
        np.outer(law.deriv()(x) / SPAN, share) * gained,
    ]
    return Programme.of(stand, "even", SPAN, np.zeros(6), None, Samples(x * SPAN, *columns))


@pytest.mark.parametrize(("real", "angle"), [("double", 1e-9), ("float", 2e-4)])
def test_no_turn_is_lost(real: str, angle: float) -> None:
    """500 rad/s are fifteen turns in an interval of 0.2 s; whole turns of a period are removed as integers."""
    fast = even_programme(500.0, 30.0)
    made = export_programme(load(stands.path("sat4")), fast, nodes=64, real=real, limit=0.1)
    assert made.errors[0].phi < angle
    assert made.errors[0].phi_dot < angle * 530.0
    many = replace(swaying(2), winding=(12, -15))
    assert export_programme(stand(), many, real=real, limit=1e-2).errors[0].phi < {"double": 2e-11, "float": 2e-6}[real]


TICKS = 400

LOOP = """#include <stdio.h>
#include "shaker2_programme.h"

static shaker2_state x = { .attitude = { 1 } };

int main(void)
{
    const shaker2_real dt = SHAKER2_PROGRAMME_PERIOD / TICKS, half = (shaker2_real)0.5 / TICKS;
    const int locked[SHAKER2_N] = { 0 };
    shaker2_programme_clock clock;
    shaker2_real phase, phi[SHAKER2_N], phi_dot[SHAKER2_N], phi_ddot[SHAKER2_N], tau[SHAKER2_N];
    int refused = shaker2_programme_start(TICKS, 1, &clock) != SHAKER2_OK;
    (void)locked;
    x.position[2] = BEGIN;
    refused |= shaker2_programme_at(0, x.phi, x.phi_dot, phi_ddot, tau) != SHAKER2_OK;
    for (int i = 0; i < TICKS; ++i) {
        refused |= shaker2_programme_phase(&clock, &phase) != SHAKER2_OK;
        refused |= shaker2_programme_at(phase, phi, phi_dot, phi_ddot, tau) != SHAKER2_OK;
        printf("%.17g %.17g %.17g %.17g\\n", (double)x.position[2], (double)phase,
               (double)(x.phi[0] - phi[0]), (double)(x.phi_dot[0] - phi_dot[0]));
        refused |= shaker2_programme_at(phase + half, phi, phi_dot, phi_ddot, tau) != SHAKER2_OK;
        refused |= STEP != SHAKER2_OK;
        refused |= shaker2_programme_advance(&clock) != SHAKER2_OK;
    }
    return refused;
}
"""
DRIVEN = "shaker2_step_driven(&shaker2_default, &x, phi_ddot, dt, 4, NULL, &x)"
FREE = "shaker2_step(&shaker2_default, &x, tau, locked, dt, 4, NULL, &x)"


def height(kind: str, real: str, step: str, folder: Path) -> tuple[np.ndarray, np.ndarray]:
    """Over a period: error of the height as a part of its amplitude; errors of angle and speed of a flywheel."""
    source = written(exported("spin", kind, real), folder, real)
    begin = motion().at(np.zeros(1)).q[0, 2]
    defines = (f"-DTICKS={TICKS}", f"-DSTEP={step}", f"-DBEGIN=(shaker2_real){float(begin)!r}")
    (folder / "main.c").write_text(LOOP)
    rest = (source, folder / "shaker2.c", "-o", folder / "main")
    run("gcc", "-std=c99", "-O1", "-ffp-contract=off", *defines, folder / "main.c", *rest)
    z, phase, angle, speed = np.array([line.split() for line in run(folder / "main").splitlines()], dtype=float).T
    wanted = motion().at(phase * PERIOD).q[:, 2]
    angle -= 2 * np.pi * np.round(angle / (2 * np.pi))
    return np.abs(z - wanted) / np.ptp(wanted) * 2, np.array([np.abs(angle), np.abs(speed)])


@pytest.mark.parametrize(
    ("kind", "real"), quick(1, [("quintic", "double"), ("fourier", "double"), ("quintic", "float")])
)
def test_the_carrier_does_the_required_motion(kind: str, real: str, tmp_path: Path) -> None:
    """Driven with the accelerations of the table, from the required state; as planning wants it of tables."""
    error, _ = height(kind, real, DRIVEN, tmp_path)
    assert error[0] < 1e-6
    assert np.max(error) < {"double": 1e-6, "float": 1e-3}[real]


def test_torques_alone_keep_the_flywheels_on_the_programme(tmp_path: Path) -> None:
    """Over one period by the coupled equations without a servo: the feedforward is the right torque."""
    error, (angle, speed) = height("quintic", "double", FREE, tmp_path)
    assert np.max(error) < 1e-4
    assert np.max(angle) < 1e-4
    assert np.max(speed) < 1e-2
