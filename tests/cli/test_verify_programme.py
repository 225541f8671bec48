"""mahovik verify, of a programme: right, refused, bad input."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest

from cli.run import run
from mahovik import stands
from mahovik.core.motion.programme import save_programme
from verify.programme.programmes import shaker

SHAKER = str(stands.path("shaker2"))
SPIN = next(str(path) for path in stands.motions("shaker2") if "spin" in path.name)
OF_SPIN = ("--motion", SPIN)


@pytest.fixture
def programme(tmp_path: Path) -> str:
    save_programme(shaker()[2], tmp_path / "p.json")
    return str(tmp_path / "p.json")


def test_a_wrong_one_is_refused_by_name(programme: str, tmp_path: Path) -> None:
    save_programme(replace(shaker()[2], winding=(1, 1)), tmp_path / "q.json")
    result = run("verify", SHAKER, *OF_SPIN, str(tmp_path / "q.json"), "--json")
    assert result.exit_code == 1
    report = json.loads(result.stdout)
    assert not report["passed"]
    assert {finding["item"] for finding in report["findings"] if finding["verdict"] == "FAILED"} == {
        "winding",
        "residual",
        "simulation",
    }


def test_a_programme_of_another_stand(programme: str, tmp_path: Path) -> None:
    text = Path(programme).read_text(encoding="utf-8").replace(shaker()[2].physics, "00000000")
    (tmp_path / "q.json").write_text(text, encoding="utf-8")
    result = run("verify", SHAKER, *OF_SPIN, str(tmp_path / "q.json"))
    assert result.exit_code == 1
    assert "programme of another stand: physics is 00000000" in result.stdout
    assert "REFUSED: stand" in result.stdout
    other = json.loads(text) | {"flywheels": [f"flywheel_number_{k}" for k in range(2)]}
    (tmp_path / "q.json").write_text(json.dumps(other), encoding="utf-8")
    result = run("verify", SHAKER, *OF_SPIN, str(tmp_path / "q.json"))
    assert "flywheel_number_1" in result.stdout
    assert all(len(line) <= 100 for line in result.stdout.splitlines() if not line.startswith("stand: "))
