"""`mahovik simulate --programme`: what it says, what it writes, what it refuses."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from cli.run import BENCH8, refused, run
from control.following import SERVO, TRIM
from mahovik import stands
from mahovik.core.motion.programme import save_programme
from mahovik.out.report.plot.run import panels, read
from verify.programme.programmes import shaker

STAND = str(stands.path("shaker2"))
MOTION = str(stands.path("shaker2").parent / "shaker2_spin.motion.json")


@pytest.fixture
def given(tmp_path: Path) -> list[str]:
    """Arguments that are right, but for those that a test adds."""
    save_programme(shaker()[2], tmp_path / "P.json")
    (tmp_path / "S.toml").write_text(SERVO)
    files = ["--programme", str(tmp_path / "P.json"), "--motion", MOTION, "--servo", str(tmp_path / "S.toml")]
    return ["simulate", STAND, *files]


def test_table_columns_and_panels(given: list[str], tmp_path: Path) -> None:
    output = tmp_path / "run.csv"
    said = run(*given, "--periods", "11", "--no-causes", "-o", str(output))
    assert said.exit_code == 0, said.output
    assert "error of the carrier" in said.stdout
    assert "over the last 10 of 11 periods; mismatch 0%, seed 1" in said.stdout
    columns = read(output)
    assert len(columns["t [s]"]) == 1101
    assert abs(columns["z [m]"] - columns["required_z [m]"]).max() < 1e-7
    shown = [panel.quantity.split(",")[0] for panel in panels(columns)]
    assert shown[:4] == ["O1", "attitude", "error of O1", "error of attitude"]


def test_ctrl_c_while_causes_are_asked_keeps_the_figures(given: list[str], monkeypatch: pytest.MonkeyPatch) -> None:
    def pressed(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("mahovik.out.functions.following.contributions", pressed)
    said = run(*given, "--periods", "11")
    assert said.exit_code == 130
    assert "error of the carrier" in said.stdout
    assert said.stderr == "interrupted: the run is complete, but its limits were not determined\n"


@pytest.mark.slow
def test_what_limits_it_is_told(given: list[str]) -> None:
    said = run(*given, "--periods", "11", "--mismatch", "1%", "--json")
    found = json.loads(said.stdout)
    assert found["limited_by"] == "mismatch"
    assert found["causes"]["mismatch"]["alone"] > 100 * found["causes"]["mismatch"]["without"]
    assert found["error"] == pytest.approx(found["causes"]["mismatch"]["alone"], rel=0.1)


@pytest.mark.parametrize(
    ("more", "words"),
    [
        (["--mismatch", "1"], "--mismatch 1: expected per cent with their sign, such as 1%"),
        (["--mismatch", "-1%"], "--mismatch -1%: expected 0% or more"),
        (["--mismatch", "90%"], "--mismatch 90%: expected 0% to 20%"),
        (["--periods", "3"], "--periods 3: expected at least 11"),
        (["--table", "many"], "--table many: expected a number of nodes"),
        (["--table", "2"], "--table 2: expected at least 4 nodes"),
        (["--begin", "rest"], "--begin rest: P.json has no run-up"),
        (["--dt", "1e-4"], "--dt: not allowed with --programme"),
        (["-o", "run.txt"], "expected a name that ends in .csv or .parquet"),
    ],
)
def test_what_means_nothing_is_one_line(given: list[str], more: list[str], words: str) -> None:
    said = refused(*given, *more)
    assert words in said
    assert len(said.splitlines()) == 1


def test_options_of_following_need_a_programme(tmp_path: Path) -> None:
    said = refused("simulate", STAND, "--until", "1", "-o", str(tmp_path / "x.csv"), "--mismatch", "1%")
    assert said == "error: --mismatch: needs --programme\n"


def test_files_of_another_stand_or_motion(given: list[str], tmp_path: Path) -> None:
    assert "programme of another stand" in refused("simulate", BENCH8, *given[2:])
    other = str(stands.path("shaker2").parent / "shaker2.motion.json")
    assert "programme of another motion" in refused(*given[:5], other, *given[6:])
    (tmp_path / "S.toml").write_text(SERVO + "torque_limit = [1, 2, 3]\n")
    assert "S.toml: torque_limit" in refused(*given)


def test_what_is_missing_is_named(given: list[str]) -> None:
    assert "--motion M.json, which is missing" in refused(*given[:4], *given[6:])
    assert "--servo S.toml, which is missing" in refused(*given[:6])


def test_a_loop_too_slow_to_be_stable_is_told(given: list[str], tmp_path: Path) -> None:
    (tmp_path / "S.toml").write_text(SERVO.replace("0.5 ms", "12 ms"))
    assert "unstable" in refused(*given, status=1)
    (tmp_path / "S.toml").write_text(SERVO.replace("0.5 ms", "20 ms"))
    assert "fewer than 4 samples in a period" in refused(*given)


def test_a_trim_that_does_not_converge_is_told(given: list[str], tmp_path: Path) -> None:
    wild = TRIM.replace("settling = 10", "settling = 0").replace("averaging = 10", "averaging = 1")
    (tmp_path / "S.toml").write_text(SERVO + wild.replace("gain = 0.8", "gain = 1"))
    assert "does not converge" in refused(*given)


def test_a_finite_programme_is_refused(given: list[str], tmp_path: Path) -> None:
    text = json.loads((tmp_path / "P.json").read_text())
    text["duration"] = text.pop("period")
    (tmp_path / "P.json").write_text(json.dumps(text))
    assert "P.json" in refused(*given)
