"""Programmes known to be right, found by least squares on the literal reference, and stands that need no search."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
from scipy.optimize import least_squares

from mahovik import stands
from mahovik.core.motion.functions import Fourier, Samples
from mahovik.core.motion.motion_file import load_motion, read_motion
from mahovik.core.motion.programme import Programme, RunUpTable
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand import Stand, load, loads
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.programme.mechanics import residual_and_torque, scale_of
from mahovik.proof.verify.programme.verification import verify_programme

Case = tuple[Stand, RequiredMotion, Programme]


def programme_of(
    stand: Stand, motion: RequiredMotion, course: Fourier | Samples, winding: tuple[int, ...], bias: np.ndarray
) -> Programme:
    """A programme with the identities of the stand."""
    return Programme.of(stand, motion.name, motion.span, bias, winding if motion.periodic else None, course)


def solved(stand: Stand, motion: RequiredMotion, winding: tuple[int, ...], mean: list[float], H: int, M: int) -> Case:
    """Least residual of (12) at M times, from constant speeds: unknowns are means, harmonics up to H and bias."""
    N = len(stand.flywheels)
    t = motion.span * np.arange(M) / M

    def programme_at(x: np.ndarray) -> Programme:
        parts = np.split(x, [N, N + H * N, N + 2 * H * N])
        return programme_of(
            stand, motion, Fourier(parts[0], parts[1].reshape(H, N), parts[2].reshape(H, N)), winding, parts[3] * 1e-3
        )

    start = np.concatenate([mean, np.zeros(2 * H * N + 6)])
    scale = scale_of(stand, motion, programme_at(start))
    L = np.linalg.inv(np.linalg.cholesky(scale.K0)) / scale.wrench

    def residual(x: np.ndarray) -> np.ndarray:
        programme = programme_at(x)
        R, _ = residual_and_torque(stand, motion.at(t, programme.bias), programme.at(t))
        return (R @ L.T).ravel()

    solution = least_squares(residual, start, xtol=1e-15, ftol=1e-15, gtol=1e-15, max_nfev=12)
    return stand, motion, programme_at(solution.x)


@cache
def shaker() -> Case:
    """shaker2 at the one amplitude that two wheels of constant speed give: exact."""
    stand = load(stands.path("shaker2"))
    spin = next(path for path in stands.motions("shaker2") if "spin" in path.name)
    return solved(stand, load_motion(spin, stand), (1, -1), [-1.5, 4.7], H=0, M=6)


TWINS = """
schema = 1
name = "twins"
[carrier]
mass = 5.0
inertia = [0.05, 0.06, 0.07]
[suspension]
stiffness = [400, 400, 400, 20, 20, 20]
damping = [4, 4, 4, 0.2, 0.2, 0.2]
"""


@cache
def twins() -> Case:
    """A carrier held still by two balanced wheels that turn about one axis in opposite senses; with a run-up."""
    wheel = "mass = 0.5\nposition = [0, 0, {}]\naxis = [0, 0, 1]\nzero = [1, 0, 0]\ninertia = [1e-3, 6e-4, 6e-4]\n"
    wheels = (f'[[flywheel]]\nname = "{name}"\n{wheel.format(z)}' for name, z in (("upper", 0.1), ("lower", -0.1)))
    stand = loads(TWINS + "".join(wheels))
    motion = read_motion('{"schema": 1, "name": "still", "type": "periodic", "period": 0.1, "harmonics": []}', stand)
    programme = programme_of(
        stand, motion, Fourier(np.array([0.3, 1.0]), np.zeros((0, 2)), np.zeros((0, 2))), (1, -1), np.zeros(6)
    )
    return stand, motion, programme


def twins_run_up() -> RunUpTable:
    """Run-up in 0.1 s to the programme of `twins`: speed by a quintic, angle to end where the programme begins."""
    x = np.linspace(0.0, 1.0, 21)[:, None]
    Tr, omega = 0.1, 2 * np.pi / 0.1 * np.array([[1.0, -1.0]])
    speed, slope = x**3 * (10 - 15 * x + 6 * x**2), 30 * x**2 * (1 - x) ** 2
    way = x**4 * (2.5 - 3 * x + x**2) - 0.5
    phi = np.array([[0.3, 1.0]]) + omega * Tr * way
    return RunUpTable(Tr, Samples(Tr * x[:, 0], phi, omega * speed, omega * slope / Tr))


def failed(checks: Sequence[Check]) -> set[str]:
    """Names of the items that have not passed."""
    return {item.quantity for item in checks if item.failed}


def offended(programme: Programme, **motion: Any) -> set[str]:
    """Items that a changed programme or motion of the shaker fails."""
    stand, required, _ = shaker()
    return failed(verify_programme(stand, replace(required, **motion), programme))


def item(checks: Sequence[Check], name: str) -> Check:
    """The one of a name."""
    return next(item for item in checks if item.quantity == name)


def tabled(M: int = 12) -> Samples:
    """The shaker's programme as a table."""
    _, motion, programme = shaker()
    t = motion.span * np.arange(M) / M
    return Samples(t, *programme.at(t))


def fourier(mean: tuple[float, float] = (0.0, 0.0), cos: float = 0.0) -> Fourier:
    """The shaker's coefficients with something added."""
    course = shaker()[2].course
    assert isinstance(course, Fourier)
    return Fourier(course.mean + np.array(mean), np.array([[cos, 0.0]]), np.zeros((1, 2)))
