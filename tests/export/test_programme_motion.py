"""The end of it all: C of the programme and C of the stand together, and the carrier does the required motion."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from export.programmes import PERIOD, exported, motion, written
from toolchain.quick import quick
from toolchain.tools import run

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
DRIVEN = "shaker2_step_driven(&shaker2_default, &x, phi_ddot, dt, 4, &x)"
FREE = "shaker2_step(&shaker2_default, &x, tau, locked, dt, 4, &x)"


def height(kind: str, real: str, step: str, folder: Path) -> tuple[np.ndarray, np.ndarray]:
    """Over a period: error of the height as a part of its amplitude; errors of angle and speed of a flywheel."""
    source = written(exported("spin", kind, real), folder, real)
    begin = motion().at(np.zeros(1)).q[0, 2]
    defines = (f"-DTICKS={TICKS}", f"-DSTEP={step}", f"-DBEGIN=(shaker2_real){float(begin)!r}")
    (folder / "main.c").write_text(LOOP)
    others = (source, folder / "shaker2.c", "-o", folder / "main")
    run("gcc", "-std=c99", "-O1", "-ffp-contract=off", *defines, folder / "main.c", *others)
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
    """Without any servo, by the coupled equations, over one period: the feedforward is the right torque."""
    error, (angle, speed) = height("quintic", "double", FREE, tmp_path)
    assert np.max(error) < 1e-4
    assert np.max(angle) < 1e-4
    assert np.max(speed) < 1e-2
