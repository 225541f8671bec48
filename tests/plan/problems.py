"""Planning problems for the tests: drawn motions and what the reference says of them, examples, small ones."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest
from numpy.typing import NDArray

import mahovik.stands
from mahovik.core.motion.functions import Course, Harmonics
from mahovik.core.motion.motion_file import load_motion
from mahovik.core.motion.required import Bounds, Objective, RequiredMotion
from mahovik.core.stand import load
from mahovik.core.stand.model import Stand, State
from mahovik.core.stand.random import Features, random_stand
from mahovik.proof.reference import pieces
from mahovik.proof.reference.coordinates import answer_generalized, kinematic_matrix, kinematic_matrix_rate
from mahovik.proof.reference.inverse import demand
from mahovik.proof.reference.motion import torque
from mahovik.use.numeric.mechanics import Mechanics
from mahovik.use.plan.problem import FlywheelMotion, Problem

Array = NDArray[np.float64]


class RandomCourse(NamedTuple):
    """Motion of the carrier (M, 6 each) and of the flywheels (M, N each) at unrelated times."""

    q: Array
    q_dot: Array
    q_ddot: Array
    phi: Array
    phi_dot: Array
    phi_ddot: Array

    @property
    def course(self) -> Course:
        """The motion of the carrier alone."""
        return Course(self.q, self.q_dot, self.q_ddot)


def random_course(seed: int, N: int, features: Features, M: int = 4) -> tuple[Stand, Mechanics, RandomCourse]:
    """A random stand and motions of its bodies."""
    rng = np.random.default_rng(seed)
    stand = random_stand(rng, N, features)
    carrier = [rng.normal(size=(M, 6)) * size for size in (0.6, 2.0, 20.0)]
    wheels = [rng.normal(size=(M, N)) * size for size in (3.0, 60.0, 900.0)]
    return stand, Mechanics.of(stand), RandomCourse(*carrier, *wheels)


def literal(stand: Stand, motion: RandomCourse, m: int) -> tuple[Array, Array, float, float]:
    """R (6) of (12) and tau (N) by the literal reference at time m, and the sizes of what they are sums of."""
    q, q_dot, q_ddot = (x[m] for x in motion[:3])
    A = kinematic_matrix(stand.angles, q[3:])
    V = A @ q_dot
    V_dot = A @ q_ddot + kinematic_matrix_rate(stand.angles, q[3:], q_dot[3:]) @ q_dot
    zeros = (0.0,) * len(motion.phi[m])
    state = State(
        tuple(q[:3]), tuple(q[3:]), None, tuple(V), tuple(motion.phi[m]), tuple(motion.phi_dot[m]),
        tuple(motion.phi_ddot[m]), tuple(V_dot), zeros,
    )  # fmt: skip
    at = pieces(stand, state)
    wanted = demand(at, V_dot)
    R = wanted - at.I @ motion.phi_ddot[m]
    assert answer_generalized(at, stand, state)["q_dot"] == pytest.approx(q_dot, rel=1e-9, abs=1e-9)
    tau = torque(at, V_dot, motion.phi_ddot[m])
    size = max(abs(at.F).max(), abs(at.K @ V_dot).max(), abs(wanted).max(), abs(at.I * motion.phi_ddot[m]).max())
    return R, tau, float(size), float(abs(tau).max())


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
    all_weights = {"acceleration": 0.0, "torque": 0.0, "speed_variation": 0.0, "power": 0.0, **weights}
    if not weights:
        all_weights["acceleration"] = 1.0
    objective = Objective(**{kind: tuple(np.broadcast_to(w, N).tolist()) for kind, w in all_weights.items()})
    course = Harmonics(PERIOD, harmonics, cos, sin)
    return RequiredMotion("drawn", True, PERIOD, np.zeros(6), course, free, "any", bounds, objective, None)


def drawn_problem(seed: int, N: int, features: Features, **asked: Any) -> tuple[Problem, Stand]:
    """A random stand that shall move a little."""
    stand = random_stand(np.random.default_rng(seed), N, features)
    return Problem.of(stand, required(N, **asked)), stand


def wheels(N: int, H: int, seed: int = 2, size: float = 0.3) -> FlywheelMotion:
    """Flywheels that turn or rock with drawn harmonics, and a bias."""
    rng = np.random.default_rng(seed)
    waves = rng.normal(size=(N, 2 * H + 1)) * size
    winding = np.resize([1.0, -1.0, 0.0], N)
    return FlywheelMotion(PERIOD, winding, waves, rng.normal(size=6) * 1e-3)


STANDS = Path(mahovik.stands.__file__).parent


@cache
def example(stand: str, motion: str | None = None) -> tuple[Stand, RequiredMotion]:
    """A stand and a motion that stands beside it."""
    loaded = load(STANDS / f"{stand}.toml")
    return loaded, load_motion(STANDS / f"{motion or stand}.motion.json", loaded)


def problem(stand: str, motion: str | None = None, **changed: Any) -> Problem:
    """The planning problem of an example, with fields of the motion changed."""
    loaded, required = example(stand, motion)
    return Problem.of(loaded, replace(required, **changed))
