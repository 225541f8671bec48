"""Drawn motions of a carrier and of flywheels, and what the literal reference says of them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mahovik.core.motion.required import Course
from mahovik.core.stand.model import Stand
from mahovik.core.stand.random import Features, random_stand
from mahovik.core.stand.state import State
from mahovik.proof.reference import pieces
from mahovik.proof.reference.generalized import generalized
from mahovik.proof.reference.inverse import demand
from mahovik.proof.reference.rotation import kinematic_matrix, kinematic_matrix_rate
from mahovik.proof.reference.torque import torque
from mahovik.use.plan.residual import Mechanics

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
    assert generalized(at, stand.angles, state).q_dot == _approximately(q_dot)
    tau = torque(at, V_dot, motion.phi_ddot[m])
    size = max(abs(at.F).max(), abs(at.K @ V_dot).max(), abs(wanted).max(), abs(at.I * motion.phi_ddot[m]).max())
    return R, tau, float(size), float(abs(tau).max())


def _approximately(x: Array) -> object:
    import pytest

    return pytest.approx(x, rel=1e-9, abs=1e-9)
