"""Seeded random satellites of the campaign of `mahovik quiet`: redundant wheels in general directions."""

from __future__ import annotations

import math
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.model import Carrier, Flywheel, Mat3, Mat6, Motor, MountingAxes, Point, Stand, Vec3
from mahovik.laws.suspension.data import Suspension

Array = NDArray[np.float64]

SPEED = 2 * math.pi * 100.0  # rad/s: no-load speed
SPIN = 0.0191  # kg m2
RANK = 3


def satellite(seed: int, N: int, suspended: float | None = None) -> Stand:
    """60 kg with N wheels of 12 N m s: axes, places, angles of unbalance drawn. `suspended`: on springs, Hz; weight.

    Unbalance as of sat4: 0.15 g cm static, 2.2 g cm^2 dynamic. The point is 0.2 to 0.4 m off the carrier's origin.
    """
    rng = np.random.default_rng([seed, N])
    wheels = tuple(_wheel(rng, f"w{k + 1}") for k in range(N))
    mass = 60.0 - 2.4 * N
    inertia = np.diag(rng.uniform(1.8, 2.6, 3)) + _symmetric(rng, 0.03)
    place = rng.normal(size=3)
    place *= rng.uniform(0.2, 0.4) / np.linalg.norm(place)
    return Stand(
        name=f"satellite{N}",
        angles="ship",
        gravity=(0.0, 0.0, 0.0 if suspended is None else -9.81),
        stream=None,
        carrier=Carrier("carrier", mass, _vec(rng.normal(size=3) * 0.01), _mat(inertia), "center_of_mass", False, None),
        laws=() if suspended is None else (_suspension(suspended),),
        instruments=(),
        flywheels=wheels,
        points=(Point("bench", "carrier", _vec(place), _vec(rng.uniform(-1.0, 1.0, 3))),),
    )


def speeds_before(seed: int, stand: Stand, axes: Array) -> Array:
    """Speeds before (N, rad/s): those of a drawn momentum of a third of what one wheel holds, and as much of none."""
    rng = np.random.default_rng([seed, len(stand.flywheels), 1])
    h = rng.normal(size=3)
    h *= SPIN * SPEED / 3.0 / np.linalg.norm(h)
    least = np.linalg.pinv(axes) @ h
    free = np.linalg.svd(axes)[2][RANK:].T
    bias = free @ rng.normal(size=free.shape[1])
    return np.asarray(least + bias * (0.5 * SPEED / np.abs(bias).max()))


def _wheel(rng: np.random.Generator, name: str) -> Flywheel:
    """Static unbalance by the place of the centre of mass, dynamic by products of inertia."""
    a, b = rng.uniform(0.0, 2 * math.pi, 2)
    U, D = 1.5e-6, 2.2e-7
    J12, J13 = -D * math.cos(b), -D * math.sin(b)
    inertia = [[SPIN, J12, J13], [J12, 0.0105, 0.0], [J13, 0.0, 0.0106]]
    return Flywheel(
        name=name,
        mass=2.4,
        center_of_mass=(0.0, U / 2.4 * math.cos(a), U / 2.4 * math.sin(a)),
        inertia=_mat(np.array(inertia)),
        inertia_about="origin",
        wrench_input=False,
        mount="carrier",
        position=_vec(rng.uniform(-0.15, 0.15, 3)),
        mounting=MountingAxes(_vec(rng.normal(size=3)), _vec(rng.normal(size=3))),
        motor=Motor(0.2, SPEED, None, None, None, 0.0, 5e-4, 0.1),
        encoder=None,
    )


def _suspension(f: float) -> Suspension:
    """Natural frequencies about f, 2 % damping."""
    omega = 2 * math.pi * f
    stiffness = np.diag([60.0 * omega**2] * 3 + [2.4 * omega**2] * 3)
    return Suspension(_six(stiffness), _six(0.04 * stiffness / omega), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))


def _symmetric(rng: np.random.Generator, size: float) -> Array:
    A = rng.uniform(-size, size, (3, 3))
    return np.asarray((A + A.T) / 2.0)


def _vec(x: Any) -> Vec3:
    return cast(Vec3, tuple(float(each) for each in x))


def _mat(x: Array) -> Mat3:
    return cast(Mat3, tuple(_vec(row) for row in x))


def _six(x: Array) -> Mat6:
    return cast(Mat6, tuple(tuple(float(each) for each in row) for row in x))
