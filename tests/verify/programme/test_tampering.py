"""Whatever is changed in a right programme, it is refused, and the item that it offends is named."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from mahovik.core.motion.programme import Angles, Fourier, Programme
from mahovik.core.motion.required import Bounds
from mahovik.core.motion.required.model import Winding
from mahovik.core.stand import load
from mahovik.proof.verify.programme import finding, mechanics, simulation, table, verify_programme
from mahovik.proof.verify.programme.finding import tolerance_for
from mahovik.proof.verify.programme.mechanics import Scale, scale_of
from mahovik.stands import path
from verify.programme.programmes import failed, fourier, offended, shaker, tabled


@cache
def scale() -> Scale:
    return scale_of(*shaker())


def residual_passes(programme: Programme) -> bool:
    """Scale of the shaker's motion."""
    stand, motion, _ = shaker()
    return mechanics.residual_finding(mechanics.residuals(stand, motion, programme, scale()), 1e-6).passed


@pytest.mark.parametrize(
    "course",
    [
        pytest.param(lambda: fourier(cos=1e-5), id="a coefficient"),
        pytest.param(lambda: fourier(mean=(1e-5, 0.0)), id="a mean angle"),
        pytest.param(lambda: fourier(mean=(1e-5, -1e-5)), id="a time shift"),
        pytest.param(lambda: Fourier(-fourier().mean, np.zeros((0, 2)), np.zeros((0, 2))), id="a wrong sign"),
    ],
)
def test_changed_angles_are_refused(course: Callable[[], Fourier]) -> None:
    assert residual_passes(shaker()[2])
    assert not residual_passes(replace(shaker()[2], course=course()))


def test_the_carrier_goes_elsewhere() -> None:
    assert offended(replace(shaker()[2], course=fourier(cos=1e-4))) == {"residual", "simulation"}


def test_changed_windings_are_refused() -> None:
    _, motion, programme = shaker()
    assert offended(replace(programme, winding=(-1, 1))) == {"winding", "residual", "simulation"}
    assert not residual_passes(replace(programme, winding=(2, -1)))
    expected: tuple[tuple[Winding, int], ...] = (("rock", 2), ("spin", 0), ((1, -1), 0), ((1, 1), 1))
    for wanted, other in expected:
        (found,) = table.winding_finding(replace(motion, winding=wanted), programme)
        assert (found.value, found.passed) == (other, other == 0)


def test_a_changed_bias_is_refused() -> None:
    _, motion, programme = shaker()
    shifted = replace(programme, bias=programme.bias + np.array([0, 0, 1e-6, 0, 0, 0]))
    assert not residual_passes(shifted)
    assert not residual_passes(replace(programme, bias=np.array([0, 0, 0, 0, 0, 1e-4])))
    assert failed(table.bias_findings(motion, shifted)) == set()
    held = replace(motion, free_mean=(True, True, False, True, True, True))
    assert failed(table.bias_findings(held, shifted)) == {"bias"}


@cache
def angles_and_torques() -> tuple[Angles, np.ndarray]:
    """Angles and torques of the shaker's programme."""
    stand, motion, programme = shaker()
    found = mechanics.residuals(stand, motion, programme, scale())
    return programme.at(found.t), found.tau


@pytest.mark.parametrize(
    ("bounds", "offends"),
    [
        (Bounds(speed=(130.0, 120.0)), {"bound speed"}),
        (Bounds(speed=(130.0, 130.0), speed_min=(120.0, 120.0)), set()),
        (Bounds(speed_min=(120.0, 130.0)), {"bound speed_min"}),
        (Bounds(acceleration=(1.0, 1.0), angle=(1e-9, 1e-9)), set()),
        (Bounds(torque=(0.01, 1.0)), {"bound torque"}),
        (Bounds(torque=(0.1, 0.1)), set()),
    ],
)
def test_bounds_are_kept_or_named(bounds: Bounds, offends: set[str]) -> None:
    _, motion, programme = shaker()
    angles, tau = angles_and_torques()
    t = motion.span * np.arange(len(tau)) / len(tau)
    rocking = table.rocking_of(programme, t, programme.at(t).phi)
    found = table.bound_findings(bounds, programme.flywheels, angles, tau, rocking)
    assert failed([*found, *table.slowest_finding(bounds, programme.flywheels, angles.phi_dot)]) == offends


def test_rocking_is_counted_from_the_mean() -> None:
    course = Fourier(np.array([5.0, 0.0]), np.array([[0.3, 0.0]]), np.array([[0.0, 0.2]]))
    programme = replace(shaker()[2], course=course)
    t = programme.span * np.arange(64) / 64
    angles = programme.at(t)
    rocking = table.rocking_of(programme, t, angles.phi)
    for bound, offends in ((0.299, {"bound angle"}), (0.301, set())):
        found = table.bound_findings(Bounds(angle=(bound, 0.21)), programme.flywheels, angles, rocking, rocking)
        assert failed(found) == offends


def test_a_speed_that_changes_sign_is_no_least_speed() -> None:
    (found,) = table.slowest_finding(Bounds(speed_min=(1.0,)), ("w",), np.array([[-5.0], [5.0]]))
    assert not found.passed


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"physics": "00000000"}, "physics is 00000000"),
        ({"structure": "00000000"}, "structure is 00000000"),
        ({"stand": "bench8"}, "name is bench8"),
    ],
)
def test_a_programme_of_another_stand_says_so(change: dict[str, Any], words: str) -> None:
    stand, _, programme = shaker()
    found = finding.stand_finding(stand, replace(programme, **change))
    assert not found.passed
    assert found.words.startswith(f"programme of another stand: {words}, of the stand ")


def test_other_flywheels_are_not_tried() -> None:
    _, motion, programme = shaker()
    (found,) = verify_programme(load(path("bench8")), motion, programme)
    assert not found.passed
    assert "flywheels is left, right, of the stand w1" in found.words


def test_another_period_is_not_tried() -> None:
    stand, motion, programme = shaker()
    (found,) = verify_programme(stand, motion, replace(programme, span=0.051))
    assert (found.name, found.passed) == ("motion", False)
    assert "period is 0.051 s, of the motion 0.05 s" in found.words


@pytest.mark.parametrize("column", ["phi", "phi_dot", "phi_ddot"])
@pytest.mark.parametrize(("row", "name"), [(5, "table"), (0, "periodicity")])
def test_a_row_that_its_neighbours_do_not_foretell(column: str, row: int, name: str) -> None:
    samples = tabled()
    changed = getattr(samples, column).copy()
    changed[row, 1] += {"phi": 0.1, "phi_dot": 10.0, "phi_ddot": 1.0}[column]
    programme = replace(shaker()[2], course=replace(samples, **{column: changed}))
    assert name in failed(table.table_findings(programme, tolerance_for(shaker()[0], None).table))


def test_a_residual_between_the_nodes_is_seen() -> None:
    """A harmonic that vanishes at every node of a collocation, and at every node of a grid without offset."""
    _, motion, programme = shaker()
    sin = np.zeros((3, 2))
    sin[2, 0] = 1e-4  # six half waves: zero at six nodes
    changed = replace(programme, course=Fourier(fourier().mean, np.zeros((3, 2)), sin))
    nodes = motion.span * np.arange(6) / 6
    assert changed.at(nodes).phi == pytest.approx(programme.at(nodes).phi, abs=1e-15)
    assert not residual_passes(changed)


def test_a_carrier_that_is_thrown_off_is_not_followed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(simulation, "FURTHEST", 2.5)
    stand, motion, programme = shaker()
    wild = replace(programme, course=fourier(mean=(1.0, 1.0)))
    found = simulation.simulation_finding(stand, motion, wild, scale(), 1e-6)
    assert not found.passed
    assert "2.5 amplitudes from the required motion at t = 0.0" in found.words
