"""Tables against the programme that they were made of: their stated errors, and the same motion by every method."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest

from export.programmes import PERIOD, exported, motion, spin, stand, started, swaying
from mahovik.core.lower.programme.play import Player
from mahovik.core.motion.programme import Fourier
from mahovik.errors import CheckError, MahovikError, UsageError
from mahovik.out.export.programme import ProgrammeExport, export_programme

OUTPUTS = ("phi", "phi_dot", "phi_ddot")


def player(made: ProgrammeExport) -> Player:
    """The C's interpreter."""
    return Player(made.program, {t.form.part: t.value for t in made.tables})


def outputs_at(made: ProgrammeExport, phases: np.ndarray, number: int = 0) -> dict[str, np.ndarray]:
    """Outputs of one table at phases."""
    return player(made).many(made.program.courses[number], [float(np.float32(x)) for x in phases])


def mean() -> np.ndarray:
    """The constant speed of `spin`, as the mean phases of its course."""
    course = spin().course
    assert isinstance(course, Fourier)
    return course.mean


def angular_distance(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Distance of angles, modulo a turn."""
    d = a - b
    return np.asarray(np.abs(d - 2 * np.pi * np.round(d / (2 * np.pi))))


@pytest.mark.parametrize("kind", ["quintic", "fourier"])
@pytest.mark.parametrize("real", ["double", "float"])
@pytest.mark.parametrize("name", ["swaying", "sampled"])
def test_errors_are_what_is_told(name: str, kind: str, real: str) -> None:
    """At other phases than those of the report, with a little room."""
    made = exported(name, kind, real)
    told = made.errors[0]
    phases = np.random.default_rng(3).random(300)
    found = outputs_at(made, phases)
    truth = made.tables[0].at(np.float32(phases).astype(float) * PERIOD)
    assert np.max(angular_distance(found["phi"], truth.phi)) <= 2 * told.phi
    assert np.max(np.abs(found["phi_dot"] - truth.phi_dot)) <= 2 * told.phi_dot
    assert np.max(np.abs(found["phi_ddot"] - truth.phi_ddot)) <= 2 * told.phi_ddot
    assert np.max(np.abs(found["phi"])) <= np.pi * (1 + 1e-6)
    assert told.phi < {"double": 1e-9, "float": 1e-6}[real]


def test_speed_and_acceleration_are_the_derivatives() -> None:
    for kind in ("quintic", "fourier"):
        step = 2.0**-20
        middle = np.arange(1, 60) / 61.0
        made = exported("swaying", kind)
        a, b, c = (player(made).many(made.program.courses[0], list(middle + k * step)) for k in (-1, 0, 1))
        h = step * PERIOD
        rise = c["phi"] - a["phi"]
        rise -= 2 * np.pi * np.round(rise / (2 * np.pi))
        assert np.allclose(rise / (2 * h), b["phi_dot"], atol=1e-4)
        assert np.allclose((c["phi_dot"] - a["phi_dot"]) / (2 * h), b["phi_ddot"], atol=1e-1)


def test_quintic_and_fourier_agree_within_their_errors() -> None:
    for name in ("spin", "swaying"):
        one, two = exported(name, "quintic"), exported(name, "fourier")
        phases = np.random.default_rng(4).random(200)
        a, b = outputs_at(one, phases), outputs_at(two, phases)
        bounds = (sum(getattr(x.errors[0], each) for x in (one, two)) for each in OUTPUTS)
        for each, bound in zip(OUTPUTS, bounds, strict=True):
            assert np.max(angular_distance(a[each], b[each])) <= 2 * bound + 1e-12, each


@pytest.mark.parametrize("kind", ["quintic", "fourier"])
@pytest.mark.parametrize("real", ["double", "float"])
def test_many_turns_a_period_cost_no_digits(kind: str, real: str) -> None:
    """Whole turns are removed as integers: the angle of 15 turns per period is as good as that of one."""
    many = replace(swaying(2), winding=(12, -15))
    told = export_programme(stand(), many, kind=kind, real=real, limit=1e-2).errors[0]
    assert told.phi < {"double": 2e-11, "float": 2e-6}[real]


def test_more_nodes_are_better() -> None:
    """The angle by h^6, the acceleration by h^4."""
    coarse, fine = (export_programme(stand(), swaying(4), nodes=nodes, limit=1.0).errors[0] for nodes in (64, 128))
    assert 30 < coarse.phi / fine.phi < 90
    assert 10 < coarse.phi_ddot / fine.phi_ddot < 22


def test_torques_are_those_of_the_reference() -> None:
    for real, share in (("double", 1e-6), ("float", 1e-5)):
        for kind in ("quintic", "fourier"):
            told = exported("spin", kind, real).errors[0]
            assert told.tau is not None
            assert told.tau_peak is not None
            assert told.tau < share * told.tau_peak


def test_the_motion_is_given_to_the_last_digits() -> None:
    """The residual of the programme itself, and what the table adds, by the reference."""
    for real, added in (("double", 1e-9), ("float", 1e-6)):
        told = exported("spin", "quintic", real).errors[0]
        assert told.given is not None
        assert told.added is not None
        assert told.given < 1e-8  # of the digits in the stand and motion files
        assert told.added < added


def test_a_residual_that_is_added_is_measured() -> None:
    """The table of a programme that is a little beside another: what it adds is about that."""
    away = 1e-5
    beside = replace(spin(), course=Fourier(mean(), np.array([[away, away]]), np.zeros((1, 2))))
    told = export_programme(stand(), beside, motion(), limit=1.0).errors[0]
    assert told.given is not None
    assert 0.1 * away < told.given < 10 * away


def test_run_up_ends_on_the_programme_and_run_down_begins_there() -> None:
    made = exported("started")
    assert [t.form.part for t in made.tables] == ["", "runup", "rundown"]
    course, up, down = made.program.courses
    begin = player(made).at(course, 0.0)[1]
    for each, phase in ((up, 1.0), (down, 0.0)):
        status, joint = player(made).at(each, phase)
        assert status == 0
        assert np.max(angular_distance(np.array(joint["phi"]), np.array(begin["phi"]))) < 1e-12
        assert joint["phi_dot"] == pytest.approx(begin["phi_dot"], rel=1e-12)
        assert joint["phi_ddot"] == pytest.approx(begin["phi_ddot"], abs=1e-6)
    assert player(made).at(up, 0.0)[1]["phi_dot"] == [0.0, 0.0]
    truth = started().runup
    assert truth is not None
    phases = np.random.default_rng(5).random(100)
    found = outputs_at(made, phases, 1)
    exact = truth.at(np.float32(phases).astype(float) * truth.duration)
    assert np.max(angular_distance(found["phi"], exact.phi)) < 1e-9
    assert np.max(np.abs(found["phi_ddot"] - exact.phi_ddot)) < 1e-2


def test_torques_of_run_up_and_run_down_are_those_of_a_free_carrier() -> None:
    """From rest the weight of the unbalance; the run-down begins with the torques of the programme."""
    made = export_programme(stand(), started(), motion(), real="float")
    course, up, down = made.program.courses
    begin, leave, rest = (player(made).at(each, 0.0)[1] for each in (course, down, up))
    assert leave["tau"] == pytest.approx(begin["tau"], rel=1e-5)
    weight = [w.mass * 9.81 * w.center_of_mass[1] for w in stand().flywheels]
    assert rest["tau"] == pytest.approx(weight * np.cos(np.array(rest["phi"])), rel=1e-5)
    for told in made.errors[1:]:
        assert told.tau is not None
        assert told.tau_peak is not None
        assert told.tau < 1e-4 * told.tau_peak
        assert told.added is None


def test_too_coarse_is_refused_with_what_to_do() -> None:
    with pytest.raises(CheckError, match=r"above 1e-06: give more nodes \(--nodes 128\) or a larger --limit"):
        export_programme(stand(), swaying(), nodes=64)
    with pytest.raises(CheckError, match="--real double"):
        export_programme(stand(), swaying(), real="float", limit=1e-9)


def test_a_programme_of_another_stand_or_motion_is_refused() -> None:
    other = replace(spin(), physics="00000000")
    with pytest.raises(CheckError, match=r"of another stand.*plan again"):
        export_programme(stand(), other)
    with pytest.raises(CheckError, match="of another motion"):
        export_programme(stand(), replace(spin(), motion="shaker2_z"), motion())
    with pytest.raises(CheckError, match=r"period is 0\.04 s, of the motion 0\.05 s"):
        export_programme(stand(), replace(spin(), span=0.04), motion())
    with pytest.raises(CheckError, match="does not give the motion"):
        export_programme(stand(), swaying(), motion())
    beside = replace(spin(), course=Fourier(mean(), np.full((1, 2), 1e-5), np.zeros((1, 2))))
    with pytest.raises(CheckError, match="does not give the motion"):
        export_programme(stand(), beside, motion())


def test_what_means_nothing_is_refused() -> None:
    with pytest.raises(UsageError, match="Fourier table has none"):
        export_programme(stand(), spin(), kind="fourier", nodes=64)
    for limit in (0.0, -1.0, float("nan"), float("inf")):
        with pytest.raises(UsageError, match="expected a number above 0"):
            export_programme(stand(), spin(), limit=limit)
    with pytest.raises(UsageError, match="a finite programme"):
        export_programme(stand(), replace(spin(), periodic=False), kind="fourier")
    assert issubclass(CheckError, MahovikError)
    assert CheckError.exit_status == 1


def test_the_manifest_says_what_it_was_made_of() -> None:
    made = exported("spin", real="float")
    found = json.loads(made.files["shaker2_programme.json"])
    assert found["real"] == "float"
    assert found["programme"] == "shaker2_spin"
    assert found["limit"] == 1e-3
    (table,) = found["tables"]
    assert table["rows"] == 64
    assert table["errors"]["added"] == made.errors[0].added
    assert set(found["files"]) == set(made.files) - {"shaker2_programme.json"}
