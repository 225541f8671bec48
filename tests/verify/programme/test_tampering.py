"""Whatever is changed in a right programme, it is refused, and the item that it offends is named."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mahovik.core.motion.functions import Fourier
from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import Bounds, Winding
from mahovik.proof.verify.programme import verification
from mahovik.proof.verify.programme.verification import ProgrammeCase
from verify.programme.programmes import failed, fourier, offended, shaker, tabled


def case(programme: Programme, **changed: Any) -> ProgrammeCase:
    """The shaker with a programme, and a motion that is changed."""
    stand, motion, _ = shaker()
    return ProgrammeCase.of(stand, replace(motion, **changed), programme)


def residual_passes(programme: Programme) -> bool:
    return not case(programme).residual().failed


def shifted(z: float = 0.0, phi: float = 0.0) -> np.ndarray:
    """The shaker's bias with something added."""
    return np.asarray(shaker()[2].bias + np.array([0.0, 0.0, z, 0.0, 0.0, phi]))


def between_nodes() -> Fourier:
    """A harmonic that vanishes at every node of a collocation, and at every node of a grid without offset."""
    sin = np.zeros((3, 2))
    sin[2, 0] = 1e-4  # six half waves: zero at six nodes
    return Fourier(fourier().mean, np.zeros((3, 2)), sin)


CHANGES: dict[str, Callable[[], dict[str, Any]]] = {
    "a coefficient": lambda: {"fourier": fourier(cos=1e-5)},
    "a mean angle": lambda: {"fourier": fourier(mean=(1e-5, 0.0))},
    "a time shift": lambda: {"fourier": fourier(mean=(1e-5, -1e-5))},
    "a wrong sign": lambda: {"fourier": Fourier(-fourier().mean, np.zeros((0, 2)), np.zeros((0, 2)))},
    "between the nodes": lambda: {"fourier": between_nodes()},
    "a winding": lambda: {"winding": (2, -1)},
    "a bias along": lambda: {"bias": shifted(z=1e-6)},
    "a bias about": lambda: {"bias": shifted(phi=1e-4)},
}


@pytest.mark.parametrize("change", CHANGES)
def test_a_changed_programme_leaves_a_residual(change: str) -> None:
    assert residual_passes(shaker()[2])
    assert not residual_passes(replace(shaker()[2], **CHANGES[change]()))


def test_all_items_that_a_change_offends_are_named() -> None:
    _, _, programme = shaker()
    assert offended(replace(programme, fourier=fourier(cos=1e-4))) == {"residual", "simulation"}
    assert offended(replace(programme, winding=(-1, 1))) == {"winding", "residual", "simulation"}
    moved = replace(programme, bias=shifted(z=1e-6))
    for free, offends in ((True, set()), (False, {"bias"})):
        assert failed(case(moved, free_mean=(True, True, free, True, True, True)).bias()) == offends


@pytest.mark.parametrize(("winding", "other"), [("rock", 2), ("spin", 0), ((1, -1), 0), ((1, 1), 1)])
def test_windings_that_are_not_as_wanted_are_counted(winding: Winding, other: int) -> None:
    (finding,) = case(shaker()[2], winding=winding).winding()
    assert (finding.value, finding.failed) == (other, other != 0)


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
    assert failed(case(shaker()[2], bounds=bounds).bounds()) == offends


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (
            {"stand": replace(shaker()[2].stand, physics="00000000")},
            "programme of another stand: physics is 00000000, of the stand ",
        ),
        (
            {"stand": replace(shaker()[2].stand, structure="00000000")},
            "programme of another stand: structure is 00000000, of the stand ",
        ),
        (
            {"stand": replace(shaker()[2].stand, name="bench8")},
            "programme of another stand: name is bench8, of the stand ",
        ),
        ({"flywheels": ("w1", "w2")}, "flywheels is w1, w2, of the stand left, right"),
        ({"motion": "shaker2_z"}, "shaker2_z"),
        ({"period": None, "duration": 0.05}, "kind is finite, of the motion periodic"),
        ({"period": 0.051}, "period is 0.051 s, of the motion 0.05 s"),
    ],
)
def test_a_programme_of_another_stand_or_motion_says_so(change: dict[str, Any], words: str) -> None:
    stand, motion, programme = shaker()
    changed = replace(programme, **change)
    findings = (verification.stand_check(stand, changed), verification.motion_check(motion, changed))
    assert words in "; ".join(item.words for item in findings if item.failed)


@pytest.mark.parametrize("column", ["phi", "phi_dot", "phi_ddot"])
@pytest.mark.parametrize(("row", "name"), [(5, "table"), (0, "periodicity")])
def test_a_row_that_its_neighbours_do_not_foretell(column: str, row: int, name: str) -> None:
    samples = tabled()
    changed = getattr(samples, column).copy()
    changed[row, 1] += {"phi": 0.1, "phi_dot": 10.0, "phi_ddot": 1.0}[column]
    programme = shaker()[2].with_course(replace(samples, **{column: changed}))
    assert name in failed(case(programme).table())


def test_a_carrier_that_is_thrown_off_is_not_followed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(verification, "FURTHEST", 2.5)
    findings = case(shaker()[2].with_course(fourier(mean=(1.0, 1.0)))).simulation()
    assert findings.failed
    assert "2.5 amplitudes from the required motion at t = 0.0" in findings.words


def test_a_bound_is_one_of_the_items() -> None:
    assert offended(shaker()[2], bounds=Bounds(speed=(130.0, 120.0), bias=(0.0,) * 6)) == {"bound speed", "bound bias"}
