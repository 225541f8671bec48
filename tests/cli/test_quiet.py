"""mahovik quiet: what is printed and written, and one line for every wrong input."""

from __future__ import annotations

import json
from pathlib import Path

from cli.run import run
from mahovik.core.motion.regime import load as load_regime
from mahovik.core.stand import load
from mahovik.stands import path
from mahovik.use.simulate.case import load_start

SAT4 = str(path("sat4"))
ASKED = ("--point", "acc1", "--band", "20..200Hz")
NEAR = ("--speeds", "3040 3022 3040 3022 rpm", "--momentum", "0 0 14")


def test_what_is_written_is_what_is_said(tmp_path: Path) -> None:
    """A regime and a start, as `simulate` reads them."""
    regime, start = str(tmp_path / "r.toml"), str(tmp_path / "s.json")
    got = run("quiet", SAT4, *ASKED, *NEAR, "-o", regime, "--state", start, "--json")
    assert got.exit_code == 0, got.output
    said = json.loads(got.stdout)
    assert said["reduction"] > 10.0
    assert json.loads(Path(start).read_text())["phi"] == said["after"]["phases"]
    assert f"speed = {said['after']['speeds'][0]!r}" in Path(regime).read_text()
    stand = load(SAT4)
    assert load_regime(regime, stand, 1.0).flywheels[1].phase == said["after"]["phases"][1]
    assert load_start(Path(start), stand).phi_dot == tuple(said["after"]["speeds"])


def test_a_reduction_that_is_not_reached_is_said() -> None:
    """The best result is printed, with exit status 1."""
    got = run("quiet", SAT4, *ASKED, *NEAR, "--change", "3 rpm", "--reduction", "10")
    assert got.exit_code == 1
    assert "not 10 times lower within the limits" in got.stderr
    assert "times lower; momentum within" in got.stdout
