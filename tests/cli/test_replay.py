"""`mahovik replay`: what it says, writes and refuses, one line each."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from cli.run import BENCH8, DEMO3, refused, run
from mahovik.core.stand import load
from mahovik.core.toolchain.targets import TARGETS, build
from mahovik.core.toolchain.targets import run as run_program
from mahovik.stands import path
from simulate.flights import Recorder
from targets.flight import flight
from toolchain.tools import require

STEPS = 720
"""Beyond the first sensor that fails, in step 700."""


@pytest.fixture(scope="module")
def flown(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The console of a flight of demo3, and the folder of its C."""
    require("gcc", "gcc")
    folder = tmp_path_factory.mktemp("flight")
    texts = flight(load(path("demo3")), "double", STEPS)
    (folder / "flight.log").write_text(run_program(TARGETS["host"], build(TARGETS["host"], texts, folder)))
    return folder / "flight.log"


@pytest.fixture
def binary(flown: Path, tmp_path: Path) -> Path:
    """The same log as bytes, to be damaged."""
    target = tmp_path / "binary.log"
    target.write_bytes(b"".join(bytes.fromhex(line[1:]) for line in flown.read_text().splitlines()))
    return target


def test_columns_of_states_and_a_line_of_a_step(flown: Path) -> None:
    """The columns read back to bits; the line of a step goes through `eval`."""
    run("replay", DEMO3, "--log", str(flown), "-o", "states.csv")
    lines = Path("states.csv").read_text().splitlines()
    assert len(lines) == 722
    assert lines[0].startswith("step,status,position x,position y,position z,attitude w,")
    assert len(lines[-1].split(",")) == len(lines[0].split(","))
    assert lines[701].split(",")[1] == "RANGE"
    said = run("replay", DEMO3, "--log", str(flown), "--step", "5").stdout.splitlines()
    good = next(line for line in said if line.startswith("{"))
    answer = json.loads(run("eval", DEMO3, stdin=good).stdout)
    assert answer["id"] == "step 5" and "V_dot" in answer


@pytest.mark.slow
def test_a_state_that_differs_is_status_1(tmp_path: Path) -> None:
    """Flown by C with one constant in another bit; the folder that flew gives its bits again."""
    flew = Recorder("bench8", "double", tmp_path, edit=("half = 0.5 * h", "half = 0.5000000000000001 * h"))
    flew.fly(6)
    Path("other.log").write_bytes(flew.log)
    said = run("replay", BENCH8, "--log", "other.log")
    assert said.exit_code == 1
    assert "0 steps bit for bit" in said.output
    assert "error: step 0 differs: the state after it has hash" in said.stdout
    assert run("replay", BENCH8, "--log", "other.log", "--against", str(tmp_path)).exit_code == 0


def test_damage_is_status_1_and_a_cut_end_is_not(binary: Path) -> None:
    whole = binary.read_bytes()
    binary.write_bytes(whole[:-5])
    said = run("replay", DEMO3, "--log", str(binary))
    assert said.exit_code == 0
    assert "all 720 steps" in said.output
    assert "note: the log ends inside the record of step 720" in said.stdout
    binary.write_bytes(whole[:30000] + bytes([whole[30000] ^ 1]) + whole[30001:])
    said = run("replay", DEMO3, "--log", str(binary))
    assert said.exit_code == 1
    assert "is damaged: its check does not fit; the log ends without another start" in said.stdout
    assert said.stderr == ""


@pytest.mark.parametrize(
    ("arguments", "words", "status"),
    [
        ((BENCH8,), 'stand "bench8", but the log is from "demo3"', 1),
        ((DEMO3, "--backend", "interpreter", "--against", "x"), "the interpreter runs no C", 2),
        ((DEMO3, "--against", "nowhere"), "no such file", 2),
    ],
)
def test_refusals_are_one_line(arguments: tuple[str, ...], words: str, status: int, flown: Path) -> None:
    said = refused("replay", *arguments, "--log", str(flown), status=status)
    assert words in said and len(said.splitlines()) == 1


def test_the_verdict_as_json(flown: Path, binary: Path) -> None:
    verdict = json.loads(run("replay", DEMO3, "--log", str(flown), "--json", "--step", "5").stdout)
    assert (verdict["stand"], verdict["steps_equal"], verdict["steps_refused"], verdict["differs_at"]) == (
        "demo3",
        721,
        1,
        None,
    )
    data = bytearray(binary.read_bytes())
    data[len(data) // 2] ^= 1
    binary.write_bytes(data)
    result = run("replay", DEMO3, "--log", str(binary), "--json")
    assert result.exit_code == 1
    assert json.loads(result.stdout)["damage"]
