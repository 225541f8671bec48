"""The family of motions between rest and a programme: ends, derivatives, reversal."""

from __future__ import annotations

import numpy as np
import pytest

from mahovik.core.motion.programme import Fourier, Programme
from mahovik.use.plan.runup.boundary import transient_family

T, LASTS = 0.2, 0.73


def programme(seed: int = 1, N: int = 3, H: int = 4) -> Programme:
    """Flywheels that spin and rock, with harmonics."""
    rng = np.random.default_rng(seed)
    course = Fourier(*(rng.normal(size=shape) for shape in ((N,), (H, N), (H, N))))
    names = tuple(f"w{k}" for k in range(N))
    return Programme("s", "0", "0", "m", names, True, T, np.zeros(6), (2, -1, 0)[:N], course)


def unknowns(splines: int = 6) -> np.ndarray:
    """Any c."""
    return np.random.default_rng(2).normal(size=(3, splines + 1))


@pytest.mark.parametrize("up", [True, False])
def test_whatever_is_added_it_joins_the_programme_with_two_derivatives(up: bool) -> None:
    """At t = 0 of the programme, without whole turns between; at rest at the other end."""
    family = transient_family(programme(), LASTS, np.array([0.0, LASTS]), up=up)
    found, joint = family.angles(unknowns()), programme().at(np.zeros(1))
    ends = (-1, 0) if up else (0, -1)
    for values, expected in zip(found, joint, strict=True):
        assert values[ends[0]] == pytest.approx(expected[0], rel=1e-12)
    assert abs(found.phi_dot[ends[1]]).max() <= 1e-11
    assert abs(found.phi_ddot[ends[1]]).max() <= 1e-9


@pytest.mark.parametrize("up", [True, False])
def test_derivatives_are_those_of_differences(up: bool) -> None:
    """phi' of phi, phi'' of phi', of the fixed part and of all that may be added."""
    t, step = np.linspace(0.01, LASTS - 0.01, 9), 1e-6
    at, ahead, behind = (
        transient_family(programme(), LASTS, t + d, up=up).angles(unknowns()) for d in (0.0, step, -step)
    )
    for lower, exact in ((0, at.phi_dot), (1, at.phi_ddot)):
        difference = (ahead[lower] - behind[lower]) / (2 * step)
        assert exact == pytest.approx(difference, rel=1e-5, abs=1e-5 * abs(difference).max())


def test_down_is_up_of_the_programme_reversed_in_time() -> None:
    """phi(-t) as programme, run up to, then reversed, is the run-down of phi(t)."""
    forth = programme()
    assert isinstance(forth.course, Fourier)
    back = Programme(
        *("s", "0", "0", "m"), forth.flywheels, True, T, np.zeros(6), tuple(-n for n in forth.winding),
        Fourier(forth.course.mean, forth.course.cos, -forth.course.sin),
    )  # fmt: skip
    t = np.linspace(0.0, LASTS, 11)
    down, up = (transient_family(p, LASTS, t, up=u).angles(unknowns()) for p, u in ((forth, False), (back, True)))
    for sign, one, other in zip((1.0, -1.0, 1.0), down, up, strict=True):
        assert one == pytest.approx(sign * other[::-1], rel=1e-9, abs=1e-9 * abs(one).max())


def test_every_unknown_does_something_of_its_own() -> None:
    """The basis has full rank, also with more splines; only the first moves the angle of rest."""
    for splines in (6, 10):
        basis = transient_family(programme(), LASTS, np.linspace(0.0, LASTS, 60), up=True, splines=splines).basis
        assert np.linalg.matrix_rank(basis[0]) == splines + 1
        assert basis[0, 0] == pytest.approx(np.eye(splines + 1)[0], abs=1e-14)
