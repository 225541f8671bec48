"""Design of the trim: its model against the carrier's periodic motion itself; what does not converge is refused."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from control.following import design, servo
from mahovik.core.motion.programme import Fourier, Programme
from mahovik.errors import UsageError
from mahovik.use.control.reference_motion import Orbit, nodes, required_orbit, settled_state
from mahovik.use.control.trim import TrimDesign, design_trim, trim_members
from mahovik.use.plan.forward import course, drive
from mahovik.use.plan.residual import Mechanics
from toolchain.quick import quick
from verify.programme.programmes import shaker

TERMS = 5
STEP = 1e-4


def corrected(programme: Programme, term: int, size: float) -> Programme:
    """With a correction of the second flywheel: mean, cos, sin, cos 2, sin 2."""
    assert isinstance(programme.course, Fourier)
    coefficients = np.zeros((TERMS, 2))
    coefficients[term, 1] = size
    cos, sin = np.zeros((2, 2)), np.zeros((2, 2))
    cos[: len(programme.course.cos)], sin[: len(programme.course.sin)] = programme.course.cos, programme.course.sin
    mean = programme.course.mean + coefficients[0]
    return replace(programme, course=Fourier(mean, cos + coefficients[1::2], sin + coefficients[2::2]))


def heave(orbit: Orbit, mechanics: Mechanics, programme: Programme, start: np.ndarray) -> np.ndarray:
    """Mean, cos, sin, cos 2, sin 2 of z in the motion that begins so, by the whole equations."""
    given = drive(mechanics, *programme.at(orbit.t))
    y = course(orbit.chart, given, orbit.t[1], start, orbit.y, None).y[:-1]
    z = orbit.chart.O1[2] + (y[:, :3] @ orbit.chart.C.T)[:, 2]
    a = 2 * np.pi * np.arange(len(z)) / len(z)
    waves = [np.ones(len(z)) / 2, np.cos(a), np.sin(a), np.cos(2 * a), np.sin(2 * a)]
    return np.array([2.0 / len(z) * (wave @ z) for wave in waves])


@pytest.mark.parametrize("term", quick(3, range(TERMS)))
def test_response_is_the_derivative_of_the_settled_motion(term: int) -> None:
    stand, motion, programme = shaker()
    mechanics = Mechanics.of(stand)
    count = nodes(motion, programme, 2)
    orbit = required_orbit(mechanics, motion, programme, count)
    ends = []
    for sign in (1, -1):
        other = corrected(programme, term, sign * STEP)
        ends.append(heave(orbit, mechanics, other, settled_state(mechanics, motion, other, count)))
    expected = (ends[0] - ends[1]) / (2.0 * STEP)
    found = design().response[:, TERMS + term]
    assert np.abs(found - expected).max() < 1e-5 * np.abs(design().response).max()


def trimmed(gain: float, settling: int, averaging: int) -> TrimDesign:
    """Design of a trim by the heave alone."""
    own = servo(trim=True).trim
    assert own is not None
    stand, motion, programme = shaker()
    return design_trim(stand, motion, programme, replace(own, gain=gain, settling=settling, averaging=averaging))


def test_a_settled_trim_leaves_what_its_gain_leaves() -> None:
    """The longer the carrier settles, the nearer is the radius to 1 - gain."""
    radii = [trimmed(0.6, settling, 10).radius for settling in (10, 50, 200)]
    assert radii[0] > radii[1] > radii[2]
    assert radii[2] == pytest.approx(0.4, abs=1e-3)


def test_a_trim_that_does_not_converge_is_refused() -> None:
    with pytest.raises(UsageError, match="does not converge"):
        trimmed(1.0, 0, 1)


def test_corrections_take_the_error_away_and_leave_the_mean() -> None:
    own = design()
    E = np.array([7.0, 1.0, -2.0, 0.5, 0.3]) * 1e-5
    left = own.unreachable_part(E)
    assert np.abs(left[1:]).max() < 1e-12
    assert not np.any(own.matrix[:, 0])


def test_members_have_what_is_required_as_their_target() -> None:
    _, motion, programme = shaker()
    members = trim_members(design(), motion, programme, 0.5e-3)
    assert (members["settling"], members["window"]) == (1000, 1000)
    assert members["target"][0] == pytest.approx([programme.bias[2], 0.577162538232e-3, 0.0, 0.0, 0.0], abs=1e-15)
