"""Twists along a motion: V* is the derivative of V, and V turns E1 as the motion does, in every sequence."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mahovik import stands
from mahovik.core.motion.required.course import Harmonics
from mahovik.core.stand import load
from mahovik.core.stand.model import Sequence
from mahovik.core.stand.random import SEQUENCES
from mahovik.proof.reference.rotation import attitude
from mahovik.proof.reference.screw import cross
from mahovik.proof.verify.programme.mechanics import twist, twist_rate

STAND = load(stands.path("demo3"))


@pytest.mark.parametrize("sequence", SEQUENCES)
def test_twist_and_its_rate_along_a_motion(sequence: Sequence) -> None:
    stand = replace(STAND, angles=sequence)
    rng = np.random.default_rng(5)
    course = Harmonics(1.0, (1, 2), 0.2 * rng.normal(size=(2, 6)), 0.2 * rng.normal(size=(2, 6)))
    h = 1e-5
    for t in (0.1, 0.45, 0.8):
        q, q_dot, q_ddot = course.at(np.array([t - h, t, t + h]))
        q = q + np.array([0.0, 0.0, 0.0, 0.3, 0.9, -0.5])  # far from the singular attitudes
        before, now, after = (twist(stand, *row) for row in zip(q, q_dot, strict=True))
        assert twist_rate(stand, q[1], q_dot[1], q_ddot[1]) == pytest.approx((after - before) / (2 * h), abs=1e-5)
        C0, C, C1 = (attitude(sequence, *row[3:]) for row in q)
        assert C @ now[:3] == pytest.approx(q_dot[1, :3], abs=1e-12)
        assert C.T @ (C1 - C0) / (2 * h) == pytest.approx(cross(now[3:]), abs=1e-6)
