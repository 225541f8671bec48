"""Corrections without trial weights, of any size and such as can be made: data of the full equations."""

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
from mahovik.errors import BalanceError, UsageError
from mahovik.out.functions.stand_balancing import StandBalance


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


HOLES = """
[all]
positions = ["-10 mm", "10 mm"]
pieces = { holes = 12, amounts = ["5 g", "20 g", "50 g", "100 g"], radii = ["30 mm"], most = 2, remove = true }
[w2]
positions = ["-10 mm", "10 mm"]
pieces = [{ positions = [0, 120, 240], amounts = ["200 g"], radii = ["4 cm"], split = true }, {}]
"""


@pytest.fixture(scope="module")
def made(bench: Path) -> StandBalance:
    (bench / "planes.toml").write_text(HOLES, encoding="utf-8")
    return mahovik.balance_stand(str(bench / "two.toml"), bench / "run.csv", planes=bench / "planes.toml")


def test_the_simulation_agrees_before_and_after(made: StandBalance) -> None:
    """The full equations with the pieces as masses leave what the linear model expects of noiseless data."""
    for wheel in made.wheels:
        assert len(wheel.simulated) == 2
        for (name, measured, expected), (same, before, after) in zip(wheel.vibration, wheel.simulated, strict=True):
            assert name == same
            assert before == pytest.approx(measured, rel=5e-3)
            assert abs(after - expected) < 3e-3 * measured
    holes = made.wheels[0].vibration
    assert all(1e-3 * before < after < 0.05 * before for _, before, after in holes)


def test_holes_and_screws_are_as_allowed(made: StandBalance) -> None:
    figures = made.to_dict()["flywheels"]
    for plane in figures[0]["planes"]:
        pieces = plane["pieces"]
        assert 1 <= len(pieces) <= 2
        assert all(each["remove"] and each["degrees"] % 30 == pytest.approx(0, abs=1e-9) for each in pieces)
        moment = -sum(
            each["count"] * each["amount"] * each["radius"] * np.exp(1j * np.radians(each["degrees"]))
            for each in pieces
        )
        made_there = plane["made"]["g mm"] * 1e-6 * np.exp(1j * np.radians(plane["made"]["degrees"]))
        assert abs(moment - made_there) < 1e-12
        off = made_there - plane["correction"]["g mm"] * 1e-6 * np.exp(1j * np.radians(plane["correction"]["degrees"]))
        assert plane["residual"] >= abs(off)
    screws, free = figures[1]["planes"]
    for plane in (screws, free):
        assert plane["made"] == pytest.approx(plane["correction"], rel=2e-2)
    assert all(0 < each["count"] <= 1 for each in screws["pieces"])
    assert free["pieces"] == []


REFUSED = (
    ({"w1": {"positions": [0], "piece": {}}}, UsageError, 'planes of w1: unknown key "piece"'),
    ({"w1": {"positions": 3}}, UsageError, "expected a list of positions, found 3"),
    ({"w1": {"pieces": {"holes": 3, "amounts": ["1 g"]}}}, BalanceError, "radii: missing"),
    ({"w1": {"pieces": {"holes": 3, "amounts": ["1 m"], "radii": [0.1]}}}, UsageError, "amounts"),
    ({"w1": {"pieces": {"holes": 0, "amounts": [1], "radii": [0.1]}}}, BalanceError, "whole number above 0"),
    ({"w1": {"pieces": [None, None]}}, BalanceError, "a list of 2, but the number of planes is 1"),
)


@pytest.mark.parametrize(("planes", "kind", "words"), REFUSED)
def test_refused_planes(bench: Path, planes: dict[str, object], kind: type[Exception], words: str) -> None:
    with pytest.raises(kind) as error:
        mahovik.balance_stand(str(bench / "two.toml"), bench / "run.csv", planes=planes)  # type: ignore[arg-type]
    assert words in str(error.value)


def test_refused_arguments(bench: Path, tmp_path: Path) -> None:
    stand, data = str(bench / "two.toml"), str(bench / "run.csv")
    (tmp_path / "bad.toml").write_text("[all", encoding="utf-8")
    assert "not TOML" in refused("balance", stand, "--data", data, "--plane", str(tmp_path / "bad.toml"))
    assert "no such file" in refused("balance", stand, "--data", data, "--plane", str(tmp_path / "none.toml"))
    assert "expected NAME=X,.." in refused("balance", stand, "--data", data, "--plane", "w1")
    assert "w1 is given twice" in refused("balance", stand, "--data", data, "--plane", "w1=0", "--plane", "w1=1mm")
    assert "expected" in refused("balance", stand, "--data", data, "--report", str(tmp_path / "page.pdf"))
    assert "--report: need a stand" in refused("balance", "--influence", data, "--report", "p.html")
