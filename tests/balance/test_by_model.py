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
from mahovik.out.result import Result
from mahovik.use.balance.by_model import Planes, balance_wheels
from mahovik.use.measured.read import read_recordings


def test_static_and_dynamic_unbalance_are_undone(bench: Path) -> None:
    """Corrections take first moments and products of inertia about Os away, for flywheels of both senses."""
    stand = load(bench / "two.toml")
    places = Planes((-0.01, 0.01))
    wheels = balance_wheels(stand, read_recordings([bench / "run.csv"], stand), {"w1": places, "w2": places})
    assert [w.name for w in wheels] == ["w1", "w2"]
    for flywheel, wheel in zip(stand.flywheels, wheels, strict=True):
        static = flywheel.mass * complex(*flywheel.center_of_mass[1:])
        assert abs(wheel.static - static) < 2e-4 * abs(static)
        J = inertia_about_origin(flywheel)
        dynamic = -complex(J[0, 1], J[0, 2])
        assert abs(-wheel.w @ np.array(wheel.positions) - dynamic) < 0.03 * abs(dynamic)
        assert all(after < 1e-3 * before for before, after in wheel.vibration.values())


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


HOLES = """
[all]
positions = ["-10 mm", "10 mm"]
pieces = { holes = 12, amounts = ["5 g", "20 g", "50 g", "100 g"], radii = ["30 mm"], most = 2, remove = true }
[w2]
positions = ["-10 mm", "10 mm"]
pieces = [{ positions = [0, 120, 240], amounts = ["200 g"], radii = ["4 cm"], split = true }, {}]
"""


def test_holes_and_screws_are_as_allowed(bench: Path) -> None:
    """In each plane the sum of the pieces is what is made, near the correction and within the residual of it."""
    (bench / "planes.toml").write_text(HOLES, encoding="utf-8")
    result = mahovik.balance(bench / "two.toml", data=bench / "run.csv", plane=str(bench / "planes.toml"))
    correction, made = (result[a] * np.exp(1j * result[b]) for a, b in (("correction", "at"), ("made", "made_at")))
    for k, (name, plane) in enumerate((("w1", 0), ("w1", 1), ("w2", 0), ("w2", 1))):
        pieces: Result = result[f"pieces of {name}"]
        rows = pieces["plane"] == plane
        sign = np.where(pieces["kind"] == "hole", -1.0, 1.0)
        moments = sign * pieces["count"] * pieces["amount"] * pieces["radius"]
        total = (moments * np.exp(1j * np.radians(pieces["degrees"])))[rows].sum()
        if k < 3:
            assert abs(total - made[k]) < 1e-12
            assert 1 <= rows.sum() <= (2 if name == "w1" else 3)
        else:
            assert not rows.any()  # a free plane
        assert result["residual"][k] >= abs(made[k] - correction[k])
    assert np.all(result["pieces of w1"]["degrees"] % 30 == pytest.approx(0, abs=1e-9))
    assert set(result["pieces of w1"]["kind"]) == {"hole"}
    assert np.all(result["pieces of w2"]["count"] <= 1.0)
    assert made[2:] == pytest.approx(correction[2:], rel=2e-2)
    sizes = result["vibration"]
    assert np.all(sizes["after"] < 0.05 * sizes["before"])


REFUSED: tuple[tuple[dict[str, Any], type[Exception], str], ...] = (
    ({"w1": {"positions": [0], "piece": {}}}, UsageError, "plane of w1: unknown key piece"),
    ({"w1": {"positions": []}}, UsageError, "expected different positions"),
    ({"w1": {"pieces": {"holes": 3, "amounts": ["1 g"]}}}, BalanceError, "radii: missing"),
    ({"w1": {"pieces": {"holes": 3, "amounts": ["1 m"], "radii": [0.1]}}}, BalanceError, "amounts"),
    ({"w1": {"pieces": {"holes": 0, "amounts": [1], "radii": [0.1]}}}, BalanceError, "holes: 0: expected 1 to 2000"),
    ({"w1": {"pieces": [None, None]}}, BalanceError, "a list of 2, but the number of planes is 1"),
)


@pytest.mark.parametrize(("planes", "kind", "words"), REFUSED)
def test_refused_planes(bench: Path, planes: dict[str, object], kind: type[Exception], words: str) -> None:
    with pytest.raises(kind) as error:
        mahovik.balance(bench / "two.toml", data=bench / "run.csv", plane=planes)  # type: ignore[arg-type]
    assert words in str(error.value)


def test_refused_arguments(bench: Path, tmp_path: Path) -> None:
    stand, data = str(bench / "two.toml"), str(bench / "run.csv")
    (tmp_path / "bad.toml").write_text("[all", encoding="utf-8")
    assert "not TOML" in refused("balance", stand, "--data", data, "--plane", str(tmp_path / "bad.toml"))
    assert "No such file" in refused("balance", stand, "--data", data, "--plane", str(tmp_path / "none.toml"))
    assert "--plane: a name is given twice" in refused(
        "balance", stand, "--data", data, "--plane", "w1=0", "--plane", "w1=1mm"
    )
    assert "need a stand" in refused("balance", "--influence", data, "--plane", "w1=0")
