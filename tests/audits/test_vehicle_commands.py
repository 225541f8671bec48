"""Vehicles of docs/vehicles by the commands of the page: verified, and judged by a program that answers for them."""

from __future__ import annotations

import shlex
import sys
from pathlib import Path

import pytest

from cli.run import run

VEHICLES = sorted((Path(__file__).parents[2] / "docs" / "vehicles").glob("*.toml"))
EVAL = f"{shlex.quote(sys.executable)} -c 'from mahovik.out.cli import main; main()' eval {{stand}}"


@pytest.fixture(autouse=True)
def _elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Worst states are written where the command runs."""
    monkeypatch.chdir(tmp_path)


def test_there_are_vehicles() -> None:
    assert [path.stem for path in VEHICLES] == ["dsrv", "nps_auv2", "remus100"]


@pytest.mark.slow
@pytest.mark.parametrize("path", VEHICLES, ids=lambda path: path.stem)
def test_the_c_of_a_vehicle_is_verified(path: Path) -> None:
    result = run("verify", str(path), "--states", "20")
    assert result.exit_code == 0, result.output
    assert "passed: worst" in result.stdout


@pytest.mark.slow
def test_a_vehicle_is_judged_by_the_answers_of_its_c() -> None:
    """The program of the contract is `eval` of the same file: nothing differs, and no fault is named."""
    (path,) = (each for each in VEHICLES if each.stem == "remus100")
    result = run("judge", str(path), "--with", EVAL, "--states", "20", "--explain")
    assert result.exit_code == 0, result.output
    assert result.stdout.splitlines()[-1].startswith("no fault: nothing differs beyond rounding")
