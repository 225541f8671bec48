"""mahovik excite: its output, its programme as a table in C, and bad input."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from cli.run import run
from identify.data import bench8
from mahovik.core.motion.programme import load_programme
from mahovik.out.identify.excite import face
from mahovik.out.identify.excite.search import search

QUICK = ("--speed", "1000 rpm", "--duration", "0.5", "--rate", "500", "-o", "p.json")


@pytest.fixture(autouse=True)
def folder(own_folder: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Two flywheels of bench8 with an IMU; a search of few programmes."""
    monkeypatch.setattr(face, "EVALUATIONS", 10)
    bench8(2).save("a.toml")
    return own_folder


@pytest.mark.slow
def test_half_the_noise_is_half_the_error() -> None:
    def errors(*noise: str) -> list[float]:
        options = [word for each in noise for word in ("--noise", each)]
        found = json.loads(run("excite", "a.toml", *QUICK, *options, "--json").stdout)
        return [row["standard_error_constant"] for row in found["parameters"]]

    once, half = errors("acceleration=0.02", "rate=0.002"), errors("imu.acceleration=0.01", "rate=0.001")
    assert half == pytest.approx([x / 2 for x in once], rel=1e-3)


def test_ctrl_c_writes_the_best_so_far(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def pressed(value: Any, courses: Any, budget: Any, seed: int) -> Any:
        budget.interrupt()
        return search(value, courses, budget, seed)

    monkeypatch.setattr(face, "search", pressed)
    result = run("excite", "a.toml", *QUICK)
    assert result.exit_code == 130 and "interrupted: this is the best so far" in result.stderr
    assert load_programme(folder / "p.json").motion == "excite"


def test_numbers_that_noise_hides_are_named() -> None:
    loud = ("--noise", "acceleration=1e9", "--noise", "rate=1e9")
    result = run("excite", "a.toml", *QUICK, *loud, "--free", "w1.mass,carrier.mass")
    assert result.exit_code == 0
    assert "warning: the programme hardly shows w1.mass, carrier.mass\n" in result.stderr
