"""`mahovik simulate --programme`: what it says, what it writes, what it refuses."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from cli.run import refused, run
from control.following import SERVO, TRIM
from mahovik import stands
from mahovik.core.motion.programme import save_programme
from verify.programme.programmes import shaker

STAND = str(stands.path("shaker2"))
MOTION = str(stands.path("shaker2").parent / "shaker2_spin.motion.json")


@pytest.fixture
def options(tmp_path: Path) -> list[str]:
    """Arguments that are right, but for those that a test adds."""
    save_programme(shaker()[2], tmp_path / "P.json")
    (tmp_path / "S.toml").write_text(SERVO)
    files = ["--programme", str(tmp_path / "P.json"), "--motion", MOTION, "--servo", str(tmp_path / "S.toml")]
    return ["simulate", STAND, *files]


def test_table_and_columns(options: list[str], tmp_path: Path) -> None:
    """The columns follow the required heave."""
    output = tmp_path / "run.csv"
    said = run(*options, "--periods", "11", "-o", str(output))
    assert said.exit_code == 0, said.output
    assert "over the last 10 of 11 periods; mismatch 0%, seed 1" in said.stdout
    rows = np.genfromtxt(output, delimiter=",", names=True, deletechars="")
    assert len(rows) == 1101
    assert abs(rows["z_[m]"] - rows["required_z_[m]"]).max() < 1e-7


def test_a_mismatch_is_a_larger_error(options: list[str]) -> None:
    plain, wrong = (json.loads(run(*options, "--periods", "11", "--mismatch", x, "--json").stdout) for x in ("0", "1%"))
    assert wrong["error"] > 100 * plain["error"]
    assert wrong["coordinates"]["z"]["peak"] > 0.0


def test_a_loop_too_slow_to_be_stable_is_told(options: list[str], tmp_path: Path) -> None:
    (tmp_path / "S.toml").write_text(SERVO.replace("0.5 ms", "12 ms"))
    assert "unstable" in refused(*options, status=1)
    (tmp_path / "S.toml").write_text(SERVO.replace("0.5 ms", "20 ms"))
    assert "fewer than 4 samples in a period" in refused(*options)


def test_a_trim_that_does_not_converge_is_told(options: list[str], tmp_path: Path) -> None:
    wild = TRIM.replace("settling = 10", "settling = 0").replace("averaging = 10", "averaging = 1")
    (tmp_path / "S.toml").write_text(SERVO + wild.replace("gain = 0.8", "gain = 1"))
    assert "does not converge" in refused(*options)
