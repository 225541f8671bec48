"""The closed loop of a small stand: it follows, mismatch disturbs it, the trim puts it right; what mismatch draws."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from control.following import design, run, servo, wanted
from mahovik import stands as examples
from mahovik.core.motion.functions import Samples
from mahovik.core.motion.programme import RunUpTable
from mahovik.core.stand import Stand, load
from mahovik.core.stand.masses import inertia_about_center, placement
from mahovik.core.stand.model import Encoder
from mahovik.core.stand.motor import drive
from mahovik.errors import UsageError
from mahovik.laws.suspension.law import Suspension
from mahovik.use.control.loop import Case, Encoders, Plant, close_loop, errors_of, starting_state
from mahovik.use.control.mismatch import with_mismatch
from mahovik.use.numeric.se3 import Array
from mahovik.use.plan.runup import TransientFamily
from mahovik.use.simulate import judge
from strategies import stands
from verify.programme.programmes import shaker

Z = 2


@pytest.mark.slow
def test_without_mismatch_only_sampling_is_left() -> None:
    record = run(0.0, trim=False)
    errors = errors_of(record)
    assert record.stopped is None
    assert errors.share < 1e-5
    assert errors.apart.max() < 1e-5
    assert errors.amplitude[Z] == pytest.approx(0.577162538232e-3, rel=1e-3)


@pytest.mark.slow
def test_mismatch_disturbs_and_the_trim_takes_its_harmonics_away() -> None:
    plain, trimmed = (errors_of(run(0.02, trim)) for trim in (False, True))
    assert plain.share > 1e-3
    assert plain.harmonics is not None and trimmed.harmonics is not None
    before, after = (f[:2, Z].max() / plain.amplitude[Z] for f in (plain.harmonics, trimmed.harmonics))
    assert before > 5e-3
    assert after < 1e-5  # two wheels have no more: what it costs is a third harmonic
    assert run(0.02, trim=True).rounds == 6


def test_the_plant_goes_the_way_of_the_judge() -> None:
    """The emitted C and SciPy on the literal reference move alike for 5 ms under the same torques."""
    stand = shaker()[0]
    state = starting_state(Case(wanted(), stand, servo(), 2))
    commands = [np.array([0.02, -0.01 * n]) for n in range(5)]
    course = Plant(stand, state)
    y = np.array([*state.position, *(state.quaternion or ()), *state.V, *state.phi, *state.phi_dot])

    def slope(command: Array, _: float, y: Array) -> Array:
        q = y[3:7] / np.linalg.norm(y[3:7])
        parts = {"position": y[:3], "quaternion": q, "V": y[7:13], "phi": y[13:15], "phi_dot": y[15:]}
        fields: Any = {name: tuple(x.tolist()) for name, x in parts.items()}
        now = replace(state, angles=None, **fields)
        tau = [drive(s.motor, u, w) for s, u, w in zip(stand.flywheels, command, y[15:], strict=True)]
        return judge.rate(now, *judge.accelerations(stand, now, np.array(tau), np.zeros(2), np.ones(2, dtype=bool)))

    for n, command in enumerate(commands):
        course.advance(command, n * 1e-3, (n + 1) * 1e-3)
        y, _ = judge.integrate(partial(slope, command), y, n * 1e-3, (n + 1) * 1e-3)
    end = np.concatenate([course.position, course.attitude, course.V, course.phi, course.phi_dot])
    assert np.abs(end - y).max() < 1e-8
    assert np.abs(end[-2:] - np.array(state.phi_dot)).max() > 1e-3  # something happened


def test_an_unstable_loop_is_told() -> None:
    """The servo is far too fast for its samples; its gains are not checked before."""
    wild = replace(servo(), bandwidth=20000.0)
    record = close_loop(Case(wanted(), shaker()[0], wild, 2))
    assert record.stopped is not None
    assert len(record.t) < 80
    assert "lost" in record.stopped or "leaves" in record.stopped or "refuses" in record.stopped


def test_a_run_up_is_followed_from_rest() -> None:
    """Torques of the run-up are fed forward, so the flywheels follow it wherever the carrier moves."""
    stand, motion, programme = shaker()
    t = np.linspace(0.0, 0.5, 201)
    family = TransientFamily.of(programme, 0.5, t, up=True)
    table = RunUpTable(0.5, Samples(t, *family.angles(np.zeros((2, family.P)))))
    with_table = type(wanted()).of(stand, motion, replace(programme, runup=table), 64)
    record = close_loop(Case(with_table, stand, servo(), 2, start="rest"))
    assert record.stopped is None
    assert record.t[0] == -0.5
    assert not np.any(record.phi_dot[0])
    assert np.abs(record.phi_dot[record.t > 0.0]).min() > 100.0
    assert np.abs(record.apart).max() < 1e-4


def test_encoders_count_and_keep_the_sign() -> None:
    stand = shaker()[0]
    wheel = replace(stand.flywheels[0], encoder=Encoder(-100, 7.0, 1e-4))
    read = Encoders(replace(stand, flywheels=(wheel, stand.flywheels[1])))
    assert read.latency.tolist() == [1e-4, 0.0]
    angles = np.linspace(-3.0, 3.0, 50)
    counts = np.array([read.read(np.array([phi, phi])) for phi in angles])
    assert np.abs(counts[:, 0] - angles).max() <= np.pi / 100 * (1 + 1e-9)
    assert np.abs(counts[:, 0] - angles).max() > 0.5 * np.pi / 100
    assert np.array_equal(counts[:, 1], angles)


def test_a_finite_programme_is_not_tabulated_again() -> None:
    stand, motion, programme = shaker()
    with pytest.raises(UsageError, match="finite"):
        type(wanted()).of(stand, motion, replace(programme, period=None, duration=1.0), 64)


SHARE = 0.01


BENCH8 = load(examples.path("bench8"))


@settings(max_examples=15)
@given(stands(max_flywheels=4), st.integers(0, 99))
def test_any_stand_stays_one_and_near(stand: Stand, seed: int) -> None:
    """The checks of the stand file hold inside `with_mismatch`; masses and positions are within the share."""
    changed = with_mismatch(stand, SHARE, seed)
    for body, other in zip(stand.bodies, changed.bodies, strict=True):
        assert abs(other.mass / body.mass - 1.0) <= SHARE
        c = np.array(body.center_of_mass)
        assert np.linalg.norm(np.array(other.center_of_mass) - c) <= SHARE * np.linalg.norm(c) * (1 + 1e-12)
        moment = np.trace(inertia_about_center(body))
        assert abs(np.trace(inertia_about_center(other)) / moment - 1.0) <= SHARE + 1e-12


def test_every_number_that_is_measured_is_wrong() -> None:
    """No flywheel keeps mass, centre, inertia, place or axis, nor the suspension its stiffness."""
    changed = with_mismatch(BENCH8, SHARE, 1)
    for wheel, other in zip(BENCH8.flywheels, changed.flywheels, strict=True):
        assert wheel.mass != other.mass
        assert wheel.center_of_mass != other.center_of_mass
        assert np.abs(inertia_about_center(wheel) - inertia_about_center(other)).diagonal().min() > 0.0
        assert wheel.position != other.position
        turned = placement(wheel)[1].T @ placement(other)[1]
        angle = np.arccos(np.clip((np.trace(turned) - 1.0) / 2.0, -1.0, 1.0))
        assert 0.0 < angle <= SHARE
        assert (wheel.motor, wheel.encoder, wheel.name) == (other.motor, other.encoder, other.name)
    hung, moved = BENCH8.law(Suspension), changed.law(Suspension)
    assert hung is not None
    assert moved is not None
    assert hung.stiffness != moved.stiffness
    assert (BENCH8.gravity, BENCH8.name) == (changed.gravity, changed.name)


@pytest.mark.parametrize("share", [-0.01, 0.5, float("nan")])
def test_a_share_out_of_range_is_refused(share: float) -> None:
    with pytest.raises(UsageError, match="mismatch"):
        with_mismatch(BENCH8, share, 1)


def test_the_design_tells_how_fast_and_how_sure() -> None:
    servo = design()
    assert 0.2 < servo.radius < 1.0
    assert 0.0 < servo.margin < 1.0
