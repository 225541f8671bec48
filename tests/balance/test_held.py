"""Balancing by a force table, and on a carrier that its hold lets move: corrections and influences of the reaction."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mahovik
from identify.test_held import START, TRUE, readings, table, with_noise, write
from mahovik.errors import BalanceError
from mahovik.use.balance.by_model import balance_wheels
from mahovik.use.measured.read import read_recordings


@pytest.fixture(scope="module")
def exact() -> Any:
    return readings(TRUE)


def test_a_force_table_tells_corrections_in_two_planes(tmp_path: Path, exact: Any) -> None:
    """Static and dynamic unbalance are within the intervals of the noise."""
    file = write(tmp_path / "run.csv", with_noise(exact, 1))
    stand, planes = table([], **START), (-0.02, 0.02)
    recordings = read_recordings([file], stand)
    wheels = balance_wheels(stand, recordings, {"first": planes, "second": planes})
    unbalances = {"first": (72e-6, 40.0, 3e-6, 110.0), "second": (50e-6, -70.0, 2e-6, -20.0)}
    for wheel in wheels:
        amount, at, couple, couple_at = unbalances[wheel.name]
        static, dynamic = (x * np.exp(1j * np.radians(a)) for x, a in ((amount, at), (couple, couple_at)))
        assert abs(wheel.static - static) < 4.0 * wheel.static_error
        arms = np.array(wheel.positions)
        spread = float(np.sqrt((arms @ wheel.covariance @ arms).real))
        assert abs(-wheel.w @ arms - dynamic) < 4.0 * spread
        assert list(wheel.vibration) == ["force", "moment"]
        assert wheel.vibration["force"][0] == pytest.approx(amount * wheel.speed**2, rel=0.02), "what turns: U omega^2"
        assert all(after < 0.01 * before for before, after, _ in wheel.vibration.values())
    assert not recordings[0].notes


def test_data_without_a_channel_of_the_hold_are_refused(tmp_path: Path, exact: Any) -> None:
    np.savetxt(tmp_path / "run.csv", exact[:, [0, 7, 8]], delimiter=",", comments="",
               header="time [s],first.phase [rad],second.phase [rad]")  # fmt: skip
    with pytest.raises(BalanceError, match="no acceleration or rate of a point, and no reaction of the hold, of held"):
        mahovik.balance(TRUE, data=tmp_path / "run.csv")
