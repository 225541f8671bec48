"""Seeded random stands and motions of the planning campaign, as planning is judged by: shakers on a soft suspension."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from mahovik.core.motion.functions import Harmonics, SampledCourse
from mahovik.core.motion.required import Bounds, Objective, RequiredMotion
from mahovik.core.stand.fields import Mat3
from mahovik.core.stand.model import Carrier, Flywheel, Mat6, MountingAngles, Stand, Vec3
from mahovik.laws.suspension.law import Suspension

Array = NDArray[np.float64]

PERIOD = 0.1  # s: 10 Hz
SUSPENDED = 1.5  # Hz
GRAVITY = 9.81
NO_BOUNDS = Bounds()


def campaign_stand(seed: int, N: int, unbalance: float = 1.0) -> Stand:
    """12 kg carrier, N wheels of 0.5-1.2 kg with 4-10 mm unbalance times `unbalance`, general inertia, 1.5 Hz."""
    rng = np.random.default_rng([seed, N])
    wheels = tuple(_wheel(rng, f"w{k + 1}", unbalance) for k in range(N))
    carrier_inertia = np.diag(rng.uniform(0.25, 0.45, 3)) + _symmetric(rng, 0.01)
    mass = 12.0 + sum(w.mass for w in wheels)
    stiffness = mass * (2 * math.pi * SUSPENDED) ** 2
    turning = 0.7 * (2 * math.pi * SUSPENDED) ** 2
    return Stand(
        name=f"campaign{N}",
        angles="ship",
        gravity=(0.0, 0.0, -GRAVITY),
        stream=None,
        carrier=Carrier(
            **_body("carrier", 12.0, rng.normal(size=3) * 0.005, carrier_inertia, "center_of_mass"), added_mass=None
        ),
        instruments=(),
        flywheels=wheels,
        points=(),
        laws=(
            Suspension(
                _diagonal(stiffness, turning),
                _diagonal(0.15 * stiffness / 10, 0.15 * turning / 10),
                (0.0, 0.0, mass * GRAVITY / stiffness),
                (0.0, 0.0, 0.0),
            ),
        ),
    )


def campaign_motion(
    seed: int,
    N: int,
    *,
    axes: int = 5,
    amplitude: float = 1.0,
    harmonics: tuple[int, ...] = (1,),
    period: float = PERIOD,
    winding: Any = "any",
    bounds: Bounds = NO_BOUNDS,
) -> RequiredMotion:
    """Harmonic motion of x, y, z to 0.2 mm and of psi, theta (six axes: phi) to 0.6 mrad, times `amplitude`."""
    rng = np.random.default_rng([seed, 77])
    size = amplitude * np.array([2e-4] * 3 + [6e-4] * 3)
    size[axes:] = 0.0
    cos, sin = (rng.uniform(-1, 1, (len(harmonics), 6)) * size for _ in range(2))
    falls = np.array(harmonics, dtype=np.float64)[:, None] ** -2
    return RequiredMotion(
        name=f"campaign{seed}",
        periodic=True,
        span=period,
        mean=np.zeros(6),
        course=Harmonics(period, harmonics, cos * falls, sin * falls),
        free_mean=(True,) * 6,
        winding=winding,
        bounds=bounds,
        objective=Objective((1.0,) * N, (0.0,) * N, (0.0,) * N, (0.0,) * N),
        runup=None,
    )


def _wheel(rng: np.random.Generator, name: str, unbalance: float) -> Flywheel:
    mass, offset, at = rng.uniform(0.5, 1.2), unbalance * rng.uniform(0.004, 0.010), rng.uniform(-math.pi, math.pi)
    center = np.array([rng.normal() * 0.002, offset * math.cos(at), offset * math.sin(at)])
    spin = mass * rng.uniform(0.035, 0.045) ** 2
    inertia = np.diag([spin, spin * rng.uniform(0.6, 0.7), spin * rng.uniform(0.55, 0.65)])
    inertia += _symmetric(rng, 0.02 * spin)
    axis = rng.normal(size=3)
    axis /= np.linalg.norm(axis)
    return Flywheel(
        **_body(name, mass, center, inertia, "center_of_mass"),
        mount="carrier",
        position=_vec3(rng.uniform(-0.25, 0.25, 3)),
        mounting=MountingAngles(math.atan2(axis[1], axis[0]), -math.asin(axis[2]), 0.0),
        motor=None,
        encoder=None,
    )


def _body(name: str, mass: float, center: Array, inertia: Array, about: str) -> dict[str, Any]:
    return {
        "name": name,
        "mass": float(mass),
        "center_of_mass": _vec3(center),
        "inertia": cast(Mat3, tuple(_vec3(row) for row in inertia)),
        "inertia_about": about,
        "wrench_input": False,
    }


def _symmetric(rng: np.random.Generator, size: float) -> Array:
    S = rng.normal(size=(3, 3)) * size / 2
    return np.asarray((S + S.T) / 2)


def _vec3(x: Array) -> Vec3:
    return (float(x[0]), float(x[1]), float(x[2]))


def _diagonal(linear: float, angular: float) -> Mat6:
    return cast(Mat6, tuple(tuple(float(x) for x in row) for row in np.diag([linear] * 3 + [angular] * 3)))


def campaign_move(seed: int, N: int, duration: float = 0.3) -> RequiredMotion:
    """A finite motion: to another place and attitude within 0.2 mm and 0.6 mrad, by a way round, in `duration` s."""
    rng = np.random.default_rng([seed, 55])
    t = np.linspace(0.0, duration, 13)
    x = t / duration
    size = np.array([2e-4] * 3 + [6e-4] * 3)
    there, round_way = (rng.uniform(-1, 1, 6) * size for _ in range(2))
    q = np.outer(x**3 * (10 - 15 * x + 6 * x * x), there) + np.outer(64 * x**3 * (1 - x) ** 3, round_way)
    return replace(campaign_motion(seed, N), periodic=False, span=duration, course=SampledCourse(duration, False, t, q))
