"""mahovik quiet: what is printed and written, and one line for every wrong input."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from cli.run import DEMO3, refused, run
from mahovik.core.motion import load as load_regime
from mahovik.core.stand import load
from mahovik.stands import path
from mahovik.use.simulate.case import load_start

SAT4 = str(path("sat4"))
ASKED = ("--point", "acc1", "--band", "20..200Hz", "--backend", "none")
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


def test_a_table_for_people() -> None:
    """Speeds, phases, lines, figures; on another axis and measure."""
    got = run("quiet", SAT4, *ASKED, *NEAR, "--axis", "0,0,1", "--measure", "velocity")
    assert got.exit_code == 0, got.output
    assert "rw1 rw2 rw3 rw4" in got.stdout
    assert "times lower" in got.stdout
    assert "velocity of acc1, 20 to 200 Hz: RMS" in got.stdout


def test_a_compiler_that_is_missing_is_told_before_the_search(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CC", "no-such-compiler")

    def searched(*_: object) -> None:
        raise AssertionError("searched")

    monkeypatch.setattr("mahovik.use.study.quiet.result.Search.run", searched)
    assert "CC=no-such-compiler: no such command" in refused(
        "quiet", SAT4, "--point", "acc1", "--band", "20..200Hz", "--momentum", "0 0 1"
    )


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("--momentum", "0 0 14", "--point", "acc9"), 'no point or instrument of that name, did you mean "acc1"?'),
        (
            ("--momentum", "0 0 14", "--band", "200..20Hz"),
            "--band 200..20 Hz: expected two frequencies, the lower first",
        ),
        (("--momentum", "0 0 14", "--band", "200"), "--band 200: expected two frequencies"),
        (("--momentum", "0 0 14", "--band", "20..200m"), 'unit "m" does not fit, expected a frequency (Hz)'),
        (("--momentum", "0 14"), "--momentum 0 14: expected three numbers"),
        (("--momentum", "0 0 14 kg"), 'unit "kg" does not fit, expected an angular momentum (N m s)'),
        (("--momentum", "0 0 zero"), "--momentum 0 0 zero"),
        ((), "neither --momentum nor --speeds"),
        (("--speeds", "1 2 3"), "3 speeds, but the stand has 4 flywheels"),
        (("--momentum", "0 0 14", "--axis", "zz"), "--axis zz: expected some of the letters xyz"),
        (("--momentum", "0 0 14", "--axis", "0,0,0"), "--axis 0,0,0: expected"),
        (("--momentum", "0 0 14", "--reduction", "0.5"), "--reduction 0.5: expected a factor above 1"),
        (("--momentum", "0 0 14", "--reduction", "nan"), "--reduction nan: expected a factor above 1"),
        (("--momentum", "0 0 14", "--change", "-3 rpm"), "--change -3 rpm: expected a speed above 0"),
        (("--momentum", "0 0 14", "--least", "3 m"), 'unit "m" does not fit, expected an angular speed (rad/s)'),
        (("--momentum", "0 0 14", "--avoid", "40..30Hz"), "--avoid 40..30 Hz: expected two frequencies"),
        (("--momentum", "0 0 14", "--avoid", "mode"), "--avoid mode"),
        (("--momentum", "0 0 14", "--orders", "0"), "--orders: expected whole numbers from 1"),
        (("--momentum", "0 0 14", "--orders", "1;2"), "--orders 1;2: expected whole numbers"),
        (("--momentum", "0 0 14", "--margin", "ten"), "--margin ten: expected a fraction"),
        (("--momentum", "0 0 14", "--guard", "200%"), "--guard 2: expected a fraction of 1"),
        (
            ("--momentum", "0 0 14", "--band", "0..200Hz", "--measure", "angle"),
            "--band from 0 Hz: a drift has no angle",
        ),
        (("--momentum", "0 0 14", "-o", SAT4), "is read by this command"),
        (("--momentum", "0 0 14", "-o", "both", "--state", "./both"), "-o and --state ./both: one file for both"),
    ],
)
def test_bad_input_is_one_line(arguments: tuple[str, ...], said: str) -> None:
    """Exit status 2."""
    error = refused("quiet", SAT4, *ASKED, *arguments)
    assert said in error
    assert error.count("\n") == 1


def test_out_of_reach_says_what_binds(tmp_path: Path) -> None:
    """Exit status 1, nothing is written."""
    out = tmp_path / "r.toml"
    error = refused("quiet", SAT4, *ASKED, "--momentum", "0 0 40", "-o", str(out), status=1)
    assert "momentum out of reach: it needs 1.443 times the speed limits" in error
    assert not out.exists()


def test_stands_without_freedom_are_refused() -> None:
    """Three flywheels."""
    error = refused("quiet", DEMO3, "--point", "gyro", "--band", "20..200Hz", "--momentum", "0 0 0")
    assert error.count("\n") == 1


def test_a_reduction_that_is_not_reached_is_said() -> None:
    """The best result is printed, with exit status 1."""
    got = run("quiet", SAT4, *ASKED, *NEAR, "--change", "3 rpm", "--reduction", "10")
    assert got.exit_code == 1
    assert "not 10 times lower within the limits" in got.stderr
    assert "times lower; momentum within" in got.stdout


def test_what_is_louder_than_before_is_no_success() -> None:
    """The speeds before are not allowed, and all that are allowed are faster."""
    slow = ("--speeds", "1300 1310 1320 1340 rpm", "--least", "3000 rpm")
    got = run("quiet", SAT4, *ASKED, *slow)
    assert got.exit_code == 1
    assert "times higher" in got.stdout
    assert "no allowed speeds are lower than before" in got.stderr
