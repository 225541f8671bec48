"""Small planning problems for the tests: a stand, a motion of some harmonics, a flywheel motion near nothing."""

from __future__ import annotations

from typing import Any

import numpy as np

from mahovik.core.motion.required import Bounds, Objective, RequiredMotion
from mahovik.core.motion.required.course import Harmonics
from mahovik.core.stand.model import Stand
from mahovik.core.stand.random import Features, random_stand
from mahovik.use.plan.problem import Periodic, Problem

PERIOD = 0.2
NONE = Bounds()


def required(
    N: int,
    size: tuple[float, float] = (1e-3, 3e-3),
    *,
    seed: int = 1,
    harmonics: tuple[int, ...] = (1,),
    bounds: Bounds = NONE,
    free: tuple[bool, ...] = (True,) * 6,
    **weights: Any,
) -> RequiredMotion:
    """Harmonics drawn within `size` (m, rad); weights of the objective by kind, acceleration 1 where none is given."""
    rng = np.random.default_rng(seed)
    cos, sin = (rng.uniform(-1, 1, (len(harmonics), 6)) * np.repeat(size, 3) for _ in range(2))
    given = {"acceleration": 0.0, "torque": 0.0, "speed_variation": 0.0, "power": 0.0, **weights}
    if not weights:
        given["acceleration"] = 1.0
    objective = Objective(**{kind: tuple(np.broadcast_to(w, N).tolist()) for kind, w in given.items()})
    course = Harmonics(PERIOD, harmonics, cos, sin)
    return RequiredMotion("drawn", True, PERIOD, np.zeros(6), course, free, "any", bounds, objective, None)


def problem(seed: int, N: int, features: Features, **asked: Any) -> tuple[Problem, Stand]:
    """A random stand that shall move a little."""
    stand = random_stand(np.random.default_rng(seed), N, features)
    return Problem.of(stand, required(N, **asked)), stand


def wheels(N: int, H: int, seed: int = 2, size: float = 0.3) -> Periodic:
    """Flywheels that turn or rock with drawn harmonics, and a bias."""
    rng = np.random.default_rng(seed)
    waves = rng.normal(size=(N, 2 * H + 1)) * size
    winding = np.resize([1.0, -1.0, 0.0], N)
    return Periodic(PERIOD, winding, waves, rng.normal(size=6) * 1e-3)
