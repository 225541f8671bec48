"""Folders and logs of `generate --only` and `generate --prefix`, as verify, evidence and replay take them."""

from __future__ import annotations

import json
import re
import subprocess
from dataclasses import replace
from pathlib import Path

import pytest

from cli.run import DEMO3, refused, run
from mahovik.core.stand import load
from mahovik.core.toolchain.targets import TARGETS, build
from mahovik.core.toolchain.targets import run as run_program
from mahovik.stands import path
from targets.flight import flight
from toolchain.tools import compile_c, require

SHAKER2 = str(path("shaker2"))


def generated(folder: Path, *options: str) -> Path:
    """The folder of `generate` with these options."""
    assert run("generate", SHAKER2, *options, "-o", str(folder)).exit_code == 0
    return folder


@pytest.fixture(scope="module")
def part(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two functions of shaker2 under another name."""
    return generated(
        tmp_path_factory.mktemp("part") / "c", "--only", "forward,torque", "--prefix", "shakerp", "--with", "selftest"
    )


@pytest.fixture(scope="module")
def log(part: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Output of its self-test."""
    return self_test(part, "shakerp", tmp_path_factory.mktemp("log"))


def self_test(folder: Path, name: str, scratch: Path) -> Path:
    """Builds and runs the self-test of a folder; returns its log."""
    sources = folder / f"{name}.c", folder / f"verification/{name}_selftest.c"
    compile_c(
        require("gcc", "gcc"),
        *sources,
        "-O1",
        "-ffp-contract=off",
        f"-D{name.upper()}_SELFTEST_MAIN",
        "-o",
        scratch / "program",
    )
    printed = subprocess.run([scratch / "program"], capture_output=True, text=True, check=True, timeout=60).stdout
    (scratch / "board.log").write_text(printed)
    return scratch / "board.log"


def test_verify_judges_the_functions_that_are_there_under_their_name(part: Path) -> None:
    result = run("verify", SHAKER2, str(part), "--states", "9", "--json")
    assert result.exit_code == 0, result.output
    report = json.loads(result.stdout)
    assert report["stand"] == "shakerp"
    assert report["judged"] == f"C in {part}, only forward, torque"
    verdicts = {(row["judged"], row["quantity"]): row["verdict"] for row in report["rows"]}
    assert verdicts["forward", "V_dot"] == verdicts["torque", "tau"] == "ok"
    assert verdicts["", "interpreter = C, bit for bit"] == verdicts["", "bad inputs refused"] == "ok"
    absent = {want for (want, quantity), verdict in verdicts.items() if verdict == "not compared"}
    assert {"inverse", "step", "quaternion", "prepare"} <= absent
    assert not absent & {"forward", "torque", ""}
    assert {want for want, _ in verdicts} == absent | {"forward", "torque", ""}


@pytest.mark.parametrize(
    ("only", "status", "words"),
    [
        ("", 1, "C of `generate --only`? give --only forward,torque\n"),
        ("forward", 1, "unknown functions: torque"),
        ("forward,torque,wrap", 1, "no line PASS or FAIL of: wrap"),
        ("forwart", 2, '--only forwart: the C of shakerp has no such function, did you mean "forward"?'),
    ],
)
def test_the_log_of_a_part_gives_no_false_alarm(only: str, status: int, words: str, log: Path) -> None:
    options = ("--only", only) if only else ()
    message = refused("verify", SHAKER2, str(log), *options, status=status)
    assert words in message and "other bits" not in message


def test_the_stand_under_another_name_is_known_by_its_physics(part: Path, tmp_path: Path) -> None:
    """C of another stand is refused, and C of this one under two names in one folder."""
    message = refused("verify", DEMO3, str(part), status=1)
    assert re.search(r': holds the C of stand "shakerp", physics [0-9a-f]{8}, expected that of "\w+", also', message)
    folder = generated(tmp_path / "two", "--only", "wrap", "--prefix", "shakerq")
    for name in ("shakerp.h", "shakerp.c"):
        (folder / name).write_bytes((part / name).read_bytes())
    message = refused("verify", SHAKER2, str(folder), status=1)
    assert 'holds C of this stand under the names "shakerp" and "shakerq": move all but one' in message


@pytest.mark.slow
def test_a_flight_under_another_name_is_replayed(tmp_path: Path) -> None:
    texts = flight(replace(load(DEMO3), name="other"), "double", 20)
    flown = tmp_path / "flight.log"
    flown.write_text(run_program(TARGETS["host"], build(TARGETS["host"], texts, tmp_path)))
    result = run("replay", DEMO3, "--log", str(flown))
    assert result.exit_code == 0, result.output
    assert "all 20 steps bit for bit: other, double" in result.output
