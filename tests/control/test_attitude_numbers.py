"""Numbers that `export attitude` writes into C, recomputed from the matrices of the literal reference."""

from __future__ import annotations

import re
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import minimize

from mahovik.core.stand import load, rest_state
from mahovik.core.stand.model import Stand
from mahovik.errors import UsageError
from mahovik.out.export.attitude import attitude_sources
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
def spins(given: Stand) -> Array:
    """Angular momenta of the flywheels at 1 rad/s (3, N), in E1."""
    return np.asarray(reference.pieces(given, rest_state(given)).I[3:])


def limits(given: Stand, name: str) -> Array:
    """Torque (N m) or no-load speed (rad/s) of the motors (N)."""
    return np.array([getattr(wheel.motor, name) for wheel in given.flywheels])


def largest_inertia(given: Stand) -> float:
    """Largest |J e| of unit vectors e, J about the centre of mass, by K about O1."""
    K = reference.pieces(given, rest_state(given)).K
    m, moment = K[0, 0], K[3:, :3]
    arm = np.array([moment[2, 1], moment[0, 2], moment[1, 0]]) / m
    return float(np.linalg.norm(K[3:, 3:] - m * (arm @ arm * np.eye(3) - np.outer(arm, arm)), 2))


def least_reach(vectors: Array) -> float:
    """Least over all unit vectors u of the largest sum along u of vectors (3, N), each times at most 1: by search."""
    found = np.random.default_rng(0).normal(size=(3000, 3))
    found /= np.linalg.norm(found, axis=1)[:, None]
    reached = np.abs(found @ vectors).sum(axis=1)
    ends = [
        minimize(
            lambda u: float(np.abs(u @ vectors).sum() / np.linalg.norm(u)),
            u,
            method="Nelder-Mead",
            options={"xatol": 1e-9, "fatol": 1e-12},
        ).fun
        for u in found[np.argsort(reached)[:12]]
    ]
    return float(min(ends))


@cache
def reach_without_one(given: Stand) -> tuple[float, float]:
    """Momentum (N m s) and torque (N m) in every direction, with the flywheel missing whose loss costs most."""
    momenta = spins(given) * limits(given, "speed")
    torques = spins(given) / np.linalg.norm(spins(given), axis=0) * limits(given, "torque")
    momentum, torque = (
        min(least_reach(np.delete(m, s, axis=1)) for s in range(m.shape[1])) for m in (momenta, torques)
    )
    return momentum, torque


def wrong_numbers(even: bool) -> list[str]:
    """Names of the numbers that are wrong in the design."""
    given, momentum = stand(even), 1.0
    design = design_attitude(given, LoopOptions(momentum=momentum))
    made, speeds, no_load = design.settings, np.array(design.speeds), limits(given, "speed")
    per_speed, inertia = spins(given), largest_inertia(given)
    left = 1.0 - np.abs(speeds).max() / no_load.min()
    rate, acceleration = (PART * left * reach / inertia for reach in reach_without_one(given))
    preferred = np.array(made["preferred"])
    begun = per_speed @ speeds
    expected = {
        "slew_rate": (made["slew_rate"], rate),
        "closing_rate": (made["closing_rate"], rate),
        "slew_acceleration": (made["slew_acceleration"], acceleration),
        "momentum of the preferred speeds": (np.linalg.norm(per_speed @ preferred) / np.abs(preferred).max(), 0.0),
        "largest preferred speed": (np.abs(preferred).max() / no_load.min(), 0.1),
        "avoid": (made["avoid"] / np.abs(preferred).max(), 0.1),
        "momentum at the beginning": (np.linalg.norm(begun), momentum),
        "its direction": (begun @ np.array(design.goal[1:]) / np.sin(np.radians(15)), momentum),
        "dump_torque": (made["dump_torque"], limits(given, "torque").min() / 2),
    }
    found = [
        name
        for name, (value, right) in expected.items()
        if abs(value - right) > 1e-3 * (abs(right) or np.abs(per_speed).max())
    ]
    if not 0.0 < made["avoid"] < np.abs(preferred).min():
        found.append("a preferred speed is among the avoided")
    share = largest_share_of_speed(given)
    return found if abs(share - 0.7) < 1e-3 else [*found, f"speeds up to {share:.3f} of no-load"]


def largest_share_of_speed(given: Stand) -> float:
    """Largest part of its no-load speed that a flywheel begins with, at the largest momentum that is taken."""
    low, high = 0.0, 100.0
    share = 0.0
    for _ in range(25):
        middle = (low + high) / 2
        try:
            design = design_attitude(given, LoopOptions(momentum=middle))
        except UsageError as error:
            assert "70 % of its no-load speed" in str(error)
            high = middle
            continue
        low, share = middle, float(np.max(np.abs(design.speeds) / limits(given, "speed")))
    return share


@pytest.mark.parametrize("even", [True, False])
def test_the_numbers_are_right(even: bool) -> None:
    assert wrong_numbers(even) == []


def test_the_emitted_settings_are_these_numbers() -> None:
    made = attitude_sources(stand(False), LoopOptions(), "double")
    table = made.files["eye4_attitude.c"].partition("eye4_attitude_default = {")[2].partition("};")[0]
    written = {
        name: [float(number) for number in re.findall(r"[-+.e\d]+", values)]
        for name, values in re.findall(r"\.(\w+) = (\{[^}]*\}|[^,]+),", table)
    }
    assert written == {name: np.ravel(value).tolist() for name, value in made.design.settings.items()}
