"""Corrections without trial weights, of any size and such as can be made: data of the full equations."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mahovik
from balance.bench import read, write
from cli.run import refused, run
from mahovik.core.stand import load
from mahovik.core.stand.masses import inertia_about_origin
from mahovik.errors import BalanceError, UsageError
from mahovik.use.balance.by_model import balance_wheels
from mahovik.use.balance.influence import read_polar
from mahovik.use.measured.read import read_recordings


def test_static_and_dynamic_unbalance_are_undone(bench: Path) -> None:
    """Corrections take first moments and products of inertia about Os away, for flywheels of both senses."""
    stand = load(bench / "two.toml")
    places = (-0.01, 0.01)
    wheels = balance_wheels(stand, read_recordings([bench / "run.csv"], stand), {"w1": places, "w2": places})
    assert [w.name for w in wheels] == ["w1", "w2"]
    for flywheel, wheel in zip(stand.flywheels, wheels, strict=True):
        static = flywheel.mass * complex(*flywheel.center_of_mass[1:])
        assert abs(wheel.static - static) < 2e-4 * abs(static)
        J = inertia_about_origin(flywheel)
        dynamic = -complex(J[0, 1], J[0, 2])
        assert abs(-wheel.w @ np.array(wheel.positions) - dynamic) < 0.03 * abs(dynamic)
        assert all(after < 1e-3 * before for before, after, _ in wheel.vibration.values())


def test_one_plane_for_a_dynamic_unbalance_has_no_interval_and_fails(bench: Path) -> None:
    result = mahovik.balance(bench / "two.toml", data=bench / "run.csv", plane={"w2": [-0.01, 0.01]})
    assert not result.ok and np.isfinite(result["interval"]).tolist() == [False, True, True]
    (words,) = (message for message in result.messages if message.startswith("w1: "))
    assert "times the noise of the data" in words and words.endswith("dynamic unbalance: give plane w1=a,b")
    assert mahovik.balance(bench / "two.toml", data=bench / "run.csv", plane={"all": [-0.01, 0.01]}).ok


def test_command_and_refused_data(bench: Path, tmp_path: Path) -> None:
    stand, data = str(bench / "two.toml"), str(bench / "run.csv")
    done = run("balance", stand, "--data", data, "--plane", "all=-10mm,10mm", "-o", str(tmp_path / "c.json"))
    assert done.exit_code == 0 and "w1" in done.stdout
    figures = json.loads((tmp_path / "c.json").read_text(encoding="utf-8"))
    assert figures["flywheels"][0]["static"] == pytest.approx(4842.5e-6, rel=1e-3)
    assert [(plane["flywheel"], plane["plane"]) for plane in figures["planes"][:2]] == [("w1", -0.01), ("w1", 0.01)]
    assert {"correction", "at", "interval", "residual"} <= set(figures["planes"][0])
    assert 'unknown flywheel "w9"' in refused("balance", stand, "--data", data, "--plane", "w9=0")
    assert "different positions" in refused("balance", stand, "--data", data, "--plane", "w1=0,0")
    assert "--data: missing" in refused("balance", stand)
    assert "expected one of them" in refused("balance")


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
            mahovik.balance(bench / "two.toml", data=tmp_path / "other.csv")
    with pytest.raises(BalanceError, match="w1: planes at 0 mm, 1 mm, 2 mm act alike on these channels"):
        mahovik.balance(bench / "two.toml", data=bench / "run.csv", plane={"w1": [0, 0.001, 0.002]})


def test_corrections_split_between_places(bench: Path) -> None:
    result = mahovik.balance(bench / "two.toml", data=bench / "run.csv", places=8)
    for size, at, split in zip(result["correction"], result["at"], result["split"], strict=True):
        parts = [read_polar(part) or 0j for part in split.split(" + ")]
        assert sum(parts) == pytest.approx(size * np.exp(1j * at), rel=1e-2)


REFUSED: tuple[tuple[dict[str, Any], str], ...] = (
    ({"w1": []}, "expected different positions"),
    ({"w1": [0, 0]}, "expected different positions"),
    ({"w1": "1 g"}, "plane of w1"),
)


@pytest.mark.parametrize(("planes", "words"), REFUSED)
def test_refused_planes(bench: Path, planes: dict[str, Any], words: str) -> None:
    with pytest.raises(UsageError) as error:
        mahovik.balance(bench / "two.toml", data=bench / "run.csv", plane=planes)
    assert words in str(error.value)


def test_refused_arguments(bench: Path) -> None:
    stand, data = str(bench / "two.toml"), str(bench / "run.csv")
    assert "--plane: a name is given twice" in refused(
        "balance", stand, "--data", data, "--plane", "w1=0", "--plane", "w1=1mm"
    )
    assert "--plane: needs STAND.toml" in refused("balance", "--influence", data, "--plane", "w1=0")
