"""The closed loop of a small stand: it follows, mismatch disturbs it, the trim puts it right; both plants agree."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from control.following import design, run, servo, wanted
from mahovik.core.motion.programme import RunUpTable, Samples
from mahovik.core.stand.model import Encoder
from mahovik.errors import UsageError
from mahovik.use.control.controller import Encoders
from mahovik.use.control.loop import Case, close_loop, starting_state, step_error
from mahovik.use.control.plant import plant
from mahovik.use.control.record import following
from mahovik.use.plan.runup.boundary import transient_family
from verify.programme.programmes import shaker

Z = 2


@pytest.mark.slow
def test_without_mismatch_only_sampling_is_left() -> None:
    record = run(0.0, trim=False)
    found = following(record, 10)
    assert record.stopped is None
    assert found.share < 1e-5
    assert found.apart.max() < 1e-5
    assert found.amplitude[Z] == pytest.approx(0.577162538232e-3, rel=1e-3)


@pytest.mark.slow
def test_mismatch_disturbs_and_the_trim_takes_its_harmonics_away() -> None:
    plain, trimmed = (following(run(0.02, trim), 10) for trim in (False, True))
    assert plain.share > 1e-3
    before, after = (f.harmonics[:2, Z].max() / f.amplitude[Z] for f in (plain, trimmed))
    assert before > 5e-3
    assert after < 1e-5  # two wheels have no more: what it costs is a third harmonic
    assert run(0.02, trim=True).rounds == 6


def test_nothing_is_left_by_finer_steps() -> None:
    own = run(0.0, trim=False)
    assert 0.0 < step_error(Case(wanted(), shaker()[0], servo(), 12), own) < 1e-9


def test_both_plants_go_the_same_way() -> None:
    """Emitted C and SciPy on the literal reference, 5 ms under the same torques."""
    case = Case(wanted(), shaker()[0], servo(), 2)
    state = starting_state(case)
    ends = []
    for backend in ("c", "scipy"):
        own = plant(case.real, state, backend)
        for n in range(5):
            own.advance(np.array([0.02, -0.01 * n]), n * 1e-3, (n + 1) * 1e-3)
        ends.append(np.concatenate([own.position, own.attitude, own.V, own.phi, own.phi_dot]))
    assert np.abs(ends[0] - ends[1]).max() < 1e-8
    assert np.abs(ends[0][-2:] - np.array(state.phi_dot)).max() > 1e-3  # something happened


def test_an_unstable_loop_is_told() -> None:
    """The servo is far too fast for its samples; its gains are not checked before."""
    wild = replace(servo(), bandwidth=20000.0)
    record = close_loop(Case(wanted(), shaker()[0], wild, 2))
    assert record.stopped is not None
    assert len(record.t) < 80
    assert "lost" in record.stopped or "leaves" in record.stopped or "refuses" in record.stopped


def test_a_run_up_is_followed_from_rest() -> None:
    """Torques of the run-up are fed forward: flywheels stay on it, though the carrier is where it likes."""
    stand, motion, programme = shaker()
    t = np.linspace(0.0, 0.5, 201)
    family = transient_family(programme, 0.5, t, up=True)
    table = RunUpTable(0.5, Samples(t, *family.angles(np.zeros((2, family.P)))))
    with_table = type(wanted()).of(stand, motion, replace(programme, runup=table), 64)
    record = close_loop(Case(with_table, stand, servo(), 2, start="rest"))
    assert record.stopped is None
    assert record.t[0] == -0.5
    assert not np.any(record.phi_dot[0])
    assert np.abs(record.phi_dot[record.t > 0.0]).min() > 100.0
    assert np.abs(record.apart).max() < 1e-4


@pytest.mark.slow
def test_encoders_cost_what_a_count_is() -> None:
    """Finer counts, less noise; both follow."""
    stand, motion, programme = shaker()
    apart = []
    for counts in (1000, 30000):
        coded = replace(stand, flywheels=tuple(replace(s, encoder=Encoder(counts, 0.0, 5e-5)) for s in stand.flywheels))
        own = Case(type(wanted()).of(coded, motion, programme, 64), coded, replace(servo(), encoder="stand"), 12)
        apart.append(following(close_loop(own), 10).apart.max())
    assert 1e-5 < apart[0] < 2 * np.pi / 1000
    assert apart[1] < apart[0] / 10


def test_encoders_count_and_keep_the_sign() -> None:
    stand = shaker()[0]
    own = replace(stand.flywheels[0], encoder=Encoder(-100, 7.0, 1e-4))
    read = Encoders(replace(stand, flywheels=(own, stand.flywheels[1])))
    assert read.latency.tolist() == [1e-4, 0.0]
    angles = np.linspace(-3.0, 3.0, 50)
    found = np.array([read.read(np.array([phi, phi])) for phi in angles])
    assert np.abs(found[:, 0] - angles).max() <= np.pi / 100 * (1 + 1e-9)
    assert np.abs(found[:, 0] - angles).max() > 0.5 * np.pi / 100
    assert np.array_equal(found[:, 1], angles)


def test_the_design_tells_how_fast_and_how_sure() -> None:
    own = design()
    assert 0.2 < own.radius < 1.0
    assert 0.0 < own.margin < 1.0


def test_a_finite_programme_is_not_tabulated_again() -> None:
    stand, motion, programme = shaker()
    with pytest.raises(UsageError, match="finite"):
        type(wanted()).of(stand, motion, replace(programme, periodic=False), 64)
