"""Corrections without trial weights: data of the full equations, read by the literal reference at the sensor."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import mahovik
from balance.bench import PLANES, read, write
from cli.run import refused, run
from mahovik.core.stand import load
from mahovik.core.stand.inertia import inertia_about_origin
from mahovik.errors import BalanceError
from mahovik.use.balance.by_model import Planes, balance_wheels
from mahovik.use.measured import read_recordings


def test_static_and_dynamic_unbalance_are_undone(bench: Path) -> None:
    """First moments and products of inertia about Os, of flywheels that turn in both directions."""
    stand = load(bench / "two.toml")
    found = mahovik.balance_stand(stand, bench / "run.csv", planes=PLANES)
    assert [each.name for each in found.wheels] == ["w1", "w2"]
    for flywheel, wheel in zip(stand.flywheels, found.wheels, strict=True):
        static = flywheel.mass * complex(*flywheel.center_of_mass[1:])
        assert abs(wheel.static - static) < 2e-4 * abs(static)
        J = inertia_about_origin(flywheel)
        dynamic = -complex(J[0, 1], J[0, 2])
        assert abs(-wheel.w @ np.array(wheel.positions) - dynamic) < 0.03 * abs(dynamic)
        assert all(after < 1e-3 * before for _, before, after in wheel.vibration)


@pytest.mark.slow
def test_intervals_are_those_of_the_noise(bench: Path, tmp_path: Path) -> None:
    """Pooled over 40 noisy copies the 95 % intervals hold the truth about as often."""
    names, values = read(bench / "run.csv")
    exact = mahovik.balance_stand(str(bench / "two.toml"), bench / "run.csv", planes=PLANES)
    stand, planes = load(bench / "two.toml"), dict.fromkeys(("w1", "w2"), Planes((-0.01, 0.01)))
    rng = np.random.default_rng(5)
    inside = []
    for _ in range(40):
        noisy = values.copy()
        noisy[:, 1:4] += 0.5 * rng.normal(size=(len(values), 3))
        noisy[:, 4:7] += 0.02 * rng.normal(size=(len(values), 3))
        write(tmp_path / "noisy.csv", names, noisy)
        found = balance_wheels(stand, read_recordings([tmp_path / "noisy.csv"], stand), planes)
        for a, b in zip(found, exact.wheels, strict=True):
            off = (a.w - b.w) / (1.959963984540054 * a.error)
            inside += [*(np.abs(off.real) <= 1.0), *(np.abs(off.imag) <= 1.0)]
    assert 0.89 <= np.mean(inside) <= 0.99


def test_command_and_refused_data(bench: Path, tmp_path: Path) -> None:
    stand, data = str(bench / "two.toml"), str(bench / "run.csv")
    done = run("balance", stand, "--data", data, "--plane", "all=-10mm,10mm", "-o", str(tmp_path / "c.json"))
    assert done.exit_code == 0 and "w1" in done.stdout
    figures = json.loads((tmp_path / "c.json").read_text(encoding="utf-8"))["flywheels"][0]
    assert figures["static"]["before"] == pytest.approx(4842.5e-6, rel=1e-3)
    assert set(figures["planes"][0]) == {"position", "correction", "interval", "residual"}
    assert 'unknown flywheel "w9"' in refused("balance", stand, "--data", data, "--plane", "w9=0")
    assert "different positions" in refused("balance", stand, "--data", data, "--plane", "w1=0,0")
    assert "--data is missing" in refused("balance", stand)
    assert "either --influence" in refused("balance")


def test_alike_speeds_and_changing_speeds_are_refused(bench: Path, tmp_path: Path) -> None:
    names, values = read(bench / "run.csv")
    for phase, words in (
        (values[:, 7] + 0.5, "speeds differ by less than"),
        (2.0 * values[:, 7] + 0.3, "w2 turns at twice the speed of w1 within 6.3 rad/s, one beat"),
        (-0.501 * values[:, 7], "w1 turns at twice the speed of w2 within"),
        (values[:, 8] * (1.0 + 0.1 * values[:, 0]), "w2: speed changes by"),
    ):
        write(tmp_path / "other.csv", names, np.column_stack([values[:, :8], phase]))
        with pytest.raises(BalanceError, match=words):
            mahovik.balance_stand(str(bench / "two.toml"), tmp_path / "other.csv")
    with pytest.raises(BalanceError, match="w1: planes at 0 mm, 1 mm, 2 mm act alike on these channels"):
        mahovik.balance_stand(str(bench / "two.toml"), bench / "run.csv", planes={"w1": [0, 0.001, 0.002]})
