"""Numbers that `export attitude` writes into C, recomputed from the matrices of the literal reference."""

from __future__ import annotations

import re
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import brentq, minimize

from mahovik.core.stand import load, rest_state
from mahovik.core.stand.model import Stand
from mahovik.errors import UsageError
from mahovik.out.export.project import attitude_sources
from mahovik.proof import reference
from mahovik.stands import path
from mahovik.use.control.attitude import LoopOptions, design_attitude

Array = NDArray[np.float64]

PART = 0.25
"""Part of what the flywheels reach that a reference may take."""

SPEEDS = (9000.0, 6000.0, 7000.0, 8000.0)
TORQUES = (0.07, 0.1, 0.06, 0.09)


@cache
def stand(even: bool) -> Stand:
    """eye4; not `even`: with motors of different speeds (rpm) and torques (N m)."""
    made = load(path("eye4"))
    motors = [wheel.motor for wheel in made.flywheels]
    if not even:
        pairs = zip(motors, SPEEDS, TORQUES, strict=True)
        motors = [replace(m, speed=rpm * np.pi / 30, torque=torque) for m, rpm, torque in pairs if m is not None]
    wheels = zip(made.flywheels, motors, strict=True)
    return replace(made, flywheels=tuple(replace(wheel, motor=motor) for wheel, motor in wheels))


@cache
def spins(stand: Stand) -> Array:
    """Angular momenta of the flywheels at 1 rad/s (3, N), in E1."""
    return np.asarray(reference.pieces(stand, rest_state(stand)).I[3:])


def limits(stand: Stand, name: str) -> Array:
    """Torque (N m) or no-load speed (rad/s) of the motors (N)."""
    return np.array([getattr(wheel.motor, name) for wheel in stand.flywheels])


def largest_inertia(stand: Stand) -> float:
    """Largest |J e| of unit vectors e, J about the centre of mass, by K about O1."""
    K = reference.pieces(stand, rest_state(stand)).K
    m, moment = K[0, 0], K[3:, :3]
    arm = np.array([moment[2, 1], moment[0, 2], moment[1, 0]]) / m
    return float(np.linalg.norm(K[3:, 3:] - m * (arm @ arm * np.eye(3) - np.outer(arm, arm)), 2))


def least_reach(vectors: Array) -> float:
    """Least over all unit vectors u of the largest sum along u of vectors (3, N), each times at most 1: by search."""
    directions = np.random.default_rng(0).normal(size=(3000, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    reached = np.abs(directions @ vectors).sum(axis=1)
    ends = [
        minimize(
            lambda u: float(np.abs(u @ vectors).sum() / np.linalg.norm(u)),
            u,
            method="Nelder-Mead",
            options={"xatol": 1e-9, "fatol": 1e-12},
        ).fun
        for u in directions[np.argsort(reached)[:12]]
    ]
    return float(min(ends))


@cache
def reach_without_one(stand: Stand) -> tuple[float, float]:
    """Momentum (N m s) and torque (N m) in every direction, with the flywheel missing whose loss costs most."""
    momenta = spins(stand) * limits(stand, "speed")
    torques = spins(stand) / np.linalg.norm(spins(stand), axis=0) * limits(stand, "torque")
    momentum, torque = (
        min(least_reach(np.delete(m, s, axis=1)) for s in range(m.shape[1])) for m in (momenta, torques)
    )
    return momentum, torque


@pytest.mark.parametrize("even", [True, False])
def test_a_reference_takes_a_part_of_what_the_flywheels_reach_without_one(even: bool) -> None:
    satellite, momentum = stand(even), 1.0
    design = design_attitude(satellite, LoopOptions(momentum=momentum))
    made, speeds, no_load = design.settings, np.array(design.speeds), limits(satellite, "speed")
    left = 1.0 - np.abs(speeds).max() / no_load.min()
    rate, acceleration = (PART * left * reach / largest_inertia(satellite) for reach in reach_without_one(satellite))
    assert made["slew_rate"] == pytest.approx(rate, rel=1e-3) and made["closing_rate"] == made["slew_rate"]
    assert made["slew_acceleration"] == pytest.approx(acceleration, rel=1e-3)
    preferred, begun = np.array(made["preferred"]), spins(satellite) @ speeds
    assert (
        np.linalg.norm(spins(satellite) @ preferred) < 1e-3 * np.abs(spins(satellite)).max() * np.abs(preferred).max()
    )
    assert np.abs(preferred).max() == pytest.approx(0.1 * no_load.min(), rel=1e-3)
    assert made["avoid"] == pytest.approx(0.1 * np.abs(preferred).max(), rel=1e-3)
    assert np.all(np.array(made["avoid"]) < np.abs(preferred)) and np.all(np.array(made["avoid"]) > 0.0)
    assert np.linalg.norm(begun) == pytest.approx(momentum, rel=1e-3)
    assert begun @ np.array(design.goal[1:]) == pytest.approx(momentum * np.sin(np.radians(15)), rel=1e-3)
    most = brentq(lambda m: np.abs((preferred + m * (speeds - preferred)) / no_load).max() - 0.7, 0.1, 100.0)
    design_attitude(satellite, LoopOptions(momentum=0.999 * most))
    with pytest.raises(UsageError, match="70 % of its no-load speed"):
        design_attitude(satellite, LoopOptions(momentum=1.001 * most))


def test_the_emitted_settings_are_these_numbers() -> None:
    made = attitude_sources(stand(False), LoopOptions(), "double")
    table = made.files["eye4_attitude.c"].partition("eye4_attitude_default =\n{")[2].partition("};")[0]
    written = {
        name: [float(number) for number in re.findall(r"[-+.e\d]+", values)]
        for name, values in re.findall(r"\.(\w+) = (\{[^}]*\}|[^,]+),", table)
    }
    assert written == {name: np.ravel(value).tolist() for name, value in made.design.settings.items()}
