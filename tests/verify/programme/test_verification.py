"""A right programme passes: as a series, as a table, of a carrier held still, of three wheels of other speeds."""

from __future__ import annotations

import json
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from mahovik.core.motion.programme import Fourier
from mahovik.core.motion.required import Bounds, read_motion
from mahovik.core.stand import load
from mahovik.laws.suspension.data import Suspension
from mahovik.proof.verify.programme import Finding, table, verify_programme
from mahovik.proof.verify.programme.finding import tolerance_for
from mahovik.proof.verify.programme.mechanics import scale_of
from mahovik.stands import path
from verify.programme.programmes import Case, failed, fourier, item, shaker, solved, tabled, twins, twins_run_up


@cache
def right() -> tuple[Finding, ...]:
    return verify_programme(*shaker())


def test_a_right_programme_passes() -> None:
    found = right()
    assert failed(found) == set()
    assert item(found, "residual").value < 1e-11
    assert item(found, "simulation").value < 1e-8
    assert [each.name for each in found] == [
        "stand", "motion", "winding", "table", "periodicity", "bias", "residual", "simulation", "Floquet",
    ]  # fmt: skip


def test_all_twelve_multipliers_are_those_of_the_suspension() -> None:
    """Their product is exp(-T tr K^-1 D) (Liouville), D the suspension's damping; complex ones come in pairs."""
    stand, _, programme = shaker()
    found = np.array(item(right(), "Floquet").multipliers)
    assert len(found) == 12
    assert list(abs(found)) == sorted(abs(found), reverse=True)
    assert abs(found[0]) == item(right(), "Floquet").value
    assert np.sort_complex(found) == pytest.approx(np.sort_complex(found.conj()), abs=1e-9)
    held = stand.law(Suspension)
    assert held is not None
    decay = np.trace(np.linalg.solve(scale_of(*shaker()).K0, np.array(held.damping)))
    assert np.prod(found) == pytest.approx(np.exp(-decay * programme.span), rel=1e-3)
    translation = np.roots([7.0, 10.0, held.stiffness[1][1]])  # y: 7 kg, 10 N s/m
    assert min(abs(found - np.exp(translation[0] * programme.span))) < 1e-5


def test_the_same_as_a_table_passes() -> None:
    stand, motion, programme = shaker()
    assert failed(verify_programme(stand, motion, replace(programme, course=tabled()))) == set()


def test_a_wider_tolerance_takes_more() -> None:
    stand, motion, programme = shaker()
    rough = replace(programme, course=fourier(cos=1e-5))
    assert failed(verify_programme(stand, motion, rough, tolerance=1e-4)) == set()


def test_kinked_forces_are_accepted_to_less() -> None:
    """V|V| has a mean that nothing balances: the drift in a period is (2 pi)^2 / 2 times it."""
    smooth, kinked = (tolerance_for(load(path(name)), None) for name in ("bench8", "auv6"))
    assert (smooth.residual, smooth.error) == (1e-6, 1e-6)
    assert (kinked.residual, kinked.error) == pytest.approx((1e-5, 1e-5 * (2 * np.pi) ** 2 / 2), rel=0.02)


def test_a_carrier_that_is_held_still() -> None:
    stand, motion, programme = twins()
    assert failed(verify_programme(stand, motion, programme)) == set()
    one_way = replace(programme, course=Fourier(np.zeros(2), np.array([[0.01, 0.0]]), np.zeros((1, 2))))
    assert failed(verify_programme(stand, motion, one_way)) == {"residual", "simulation"}


def still_from_rest() -> Case:
    """The carrier of `twins` held still while its wheels run up: a finite motion."""
    stand, _, programme = twins()
    table = twins_run_up()
    samples = {"t": np.linspace(0.0, table.duration, 12).tolist(), "q": [[0.0] * 6] * 12}
    document = {"schema": 1, "name": "hold", "type": "finite", "duration": table.duration, "samples": samples}
    motion = read_motion(json.dumps(document), stand)
    finite = replace(
        programme, motion="hold", periodic=False, span=table.duration, winding=(0, 0), course=table.samples
    )
    return stand, motion, finite


@pytest.mark.slow
def test_a_finite_programme() -> None:
    stand, motion, programme = still_from_rest()
    phi = programme.at(np.zeros(1)).phi[0]
    wanted = replace(motion, bounds=Bounds(start_phi=tuple(phi), start_phi_dot=(0.0, 0.0)))
    found = verify_programme(stand, wanted, programme)
    assert failed(found) == set()
    assert {"start phi", "start phi_dot", "table", "simulation"} <= {each.name for each in found}
    elsewhere = replace(motion, bounds=Bounds(start_phi=(phi[0] + 0.1, phi[1]), start_phi_dot=(0.0, 0.5)))
    assert failed(table.start_findings(elsewhere, programme, 1e-6)) == {"start phi", "start phi_dot"}


def test_a_finite_programme_of_a_periodic_motion_is_not_tried() -> None:
    stand, _, programme = still_from_rest()
    (found,) = verify_programme(stand, twins()[1], replace(programme, motion="still"))
    assert "it is finite, the motion periodic" in found.words


@pytest.mark.slow
def test_demo3_turns_as_required() -> None:
    """Three balanced wheels of other speeds, with harmonics: momentum is exchanged, exactly."""
    from mahovik import stands
    from mahovik.core.motion.required import load_motion

    stand = load(path("demo3"))
    (file,) = stands.motions("demo3")
    case = solved(stand, load_motion(file, stand), (12, -15, 10), [0.0, 0.0, 0.0], H=6, M=18)
    found = verify_programme(*case)
    assert failed(found) == set()
    assert item(found, "Floquet").value == pytest.approx(1.0, abs=1e-3)
