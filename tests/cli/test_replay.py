"""`mahovik replay`: what it says, writes and refuses, one line each."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path

import pytest

from cli.run import BENCH8, DEMO3, refused, run
from mahovik.core.emit.log_format import MAGIC
from mahovik.core.stand import load
from mahovik.core.toolchain.board import build
from mahovik.core.toolchain.board import run as run_program
from mahovik.core.toolchain.targets import TARGETS
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
    found = tmp_path / "binary.log"
    found.write_bytes(b"".join(bytes.fromhex(line[1:]) for line in flown.read_text().splitlines()))
    return found


def test_all_steps_bit_for_bit(flown: Path) -> None:
    said = run("replay", DEMO3, "--log", str(flown))
    assert said.exit_code == 0
    assert said.stderr == ""
    assert "all 721 steps bit for bit: demo3, double, steps 0 to 720, 1 of them refused" in said.output


def test_the_stand_is_found_by_the_log(flown: Path) -> None:
    """Among the examples; and a stand file beside the log that is of other physics is passed over."""
    (flown.parent / "demo3.toml").write_text(Path(DEMO3).read_text().replace("mass = ", "mass = 1", 1))
    assert run("replay", "--log", str(flown)).exit_code == 0


def test_columns_and_lines_of_states(flown: Path) -> None:
    """The columns read back to bits; the lines go through `eval`."""
    run("replay", "--log", str(flown), "-o", "states.csv")
    lines = Path("states.csv").read_text().splitlines()
    assert len(lines) == 722
    assert lines[0].startswith("step,status,position[0],position[1],position[2],attitude[0],")
    assert len(lines[-1].split(",")) == len(lines[0].split(","))
    assert lines[701].split(",")[1] == "RANGE"
    run("replay", "--log", str(flown), "-o", "states.jsonl")
    states = Path("states.jsonl").read_text().splitlines()
    assert len(states) == 721
    good = "\n".join(states[5:8])
    results = [json.loads(line) for line in run("eval", DEMO3, stdin=good).stdout.splitlines()]
    assert [r["id"] for r in results] == ["step 5", "step 6", "step 7"]
    assert all("V_dot" in r for r in results)


def test_one_step_in_full(flown: Path) -> None:
    said = run("replay", "--log", str(flown), "--step", "51").stdout.splitlines()
    assert json.loads(said[0])["id"] == "step 51"
    shown = {line.rsplit(" ", 3)[0]: line.split()[-3:] for line in said if "position" in line}
    before = run("replay", "--log", str(flown), "--step", "50").stdout.splitlines()
    after = next(line.split()[-3:] for line in before if line.startswith("after position"))
    assert shown["before position"] == after  # what one step leaves the next one finds
    assert all("0x" in number for number in after)


@pytest.mark.slow
@pytest.mark.parametrize("step", [3, 50, 700])
def test_a_step_becomes_a_unit_test(flown: Path, step: int) -> None:
    """A step with an encoder, one of step_driven, one that was refused. The test passes, and fails for other C."""
    run("replay", "--log", str(flown), "--emit-test", str(step))
    name = f"demo3_step_{step}"
    source = (flown.parent / "demo3.c").read_text()
    edited = source.replace("half = 0.5 * h", "half = 0.5001 * h").replace("_RANGE;", "_NOT_FINITE;")
    for text, status, said in ((source, 0, "PASS"), (edited, 1, "FAIL")):
        Path("tried.c").write_text(text)
        flags = ["-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wfloat-equal", "-Werror", "-O0"]
        command = ["gcc", *flags, "-ffp-contract=off", f"-I{flown.parent}", f"{name}.c", "tried.c", "-o", "tried"]
        subprocess.run(command, check=True)
        done = subprocess.run(["./tried"], capture_output=True, text=True, check=False)
        assert (done.returncode, done.stdout[:4]) == (status, said)


@pytest.mark.slow
def test_a_step_with_a_carry_becomes_a_unit_test(tmp_path: Path) -> None:
    """It compares the carry as well, and passes; it fails where the carry that is left is another."""
    flew = Recorder("demo3", "float", tmp_path)
    flew.fly(20)
    Path("flight.log").write_bytes(flew.log)
    said = run("replay", DEMO3, "--log", "flight.log", "--step", "16", "--emit-test", "16")
    assert said.exit_code == 0, said.output
    assert "step 16, step_carried: OK" in said.output
    assert "before carry 0x1.12e0be" in said.output  # 1e-9, which the flight wrote
    source = (tmp_path / "demo3.c").read_text()
    edited = source.replace("->rounding[i + 13] = ", "->rounding[i + 13] = 0.5f * ")
    for text, status, words in ((source, 0, "PASS"), (edited, 1, "FAIL: other bits in the carry")):
        Path("tried.c").write_text(text)
        flags = ["-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wfloat-equal", "-Werror", "-O0"]
        command = ["gcc", *flags, "-ffp-contract=off", f"-I{tmp_path}", "demo3_step_16.c", "tried.c", "-o", "tried"]
        subprocess.run(command, check=True)
        done = subprocess.run(["./tried"], capture_output=True, text=True, check=False)
        assert (done.returncode, done.stdout.strip()) == (status, words)


def test_against_the_folder_that_flew(flown: Path) -> None:
    assert run("replay", "--log", str(flown), "--against", str(flown.parent)).exit_code == 0


@pytest.mark.slow
def test_a_state_that_differs_is_status_1(tmp_path: Path) -> None:
    """Flown by C with one constant in another bit; the folder that flew gives its bits again."""
    flew = Recorder("bench8", "double", tmp_path, edit=("half = 0.5 * h", "half = 0.5000000000000001 * h"))
    flew.fly(6)
    Path("other.log").write_bytes(flew.log)
    said = run("replay", BENCH8, "--log", "other.log")
    assert said.exit_code == 1
    assert "0 steps bit for bit" in said.output
    assert "error: step 0 differs: the state after it has hash" in said.stderr
    assert run("replay", BENCH8, "--log", "other.log", "--against", str(tmp_path)).exit_code == 0


def test_damage_is_status_1_and_a_cut_end_is_not(binary: Path) -> None:
    whole = binary.read_bytes()
    binary.write_bytes(whole[:-5])
    said = run("replay", DEMO3, "--log", str(binary))
    assert said.exit_code == 0
    assert "all 720 steps" in said.output
    assert "note: the log ends inside the record of step 720" in said.stderr
    binary.write_bytes(whole[:30000] + bytes([whole[30000] ^ 1]) + whole[30001:])
    said = run("replay", DEMO3, "--log", str(binary))
    assert said.exit_code == 1
    assert "is damaged: its check does not fit; the log ends without another start" in said.stderr
    assert len(said.stderr.splitlines()) == 1


def test_refusals_are_one_line(flown: Path, binary: Path) -> None:
    log = str(flown)
    for arguments, words, status in (
        (("--log", "none.log"), "none.log: cannot be read", 2),
        ((BENCH8, "--log", log), 'stand "bench8", but the log is from "demo3"', 1),
        (("--log", log, "-o", "states.txt"), "expected a name that ends in .csv or .jsonl", 2),
        (("--log", log, "--backend", "interpreter", "--against", "x"), "the interpreter runs no C", 2),
        (("--log", log, "--against", "nowhere"), "no such file", 2),
    ):
        said = refused("replay", *arguments, status=status)
        assert words in said
        assert len(said.splitlines()) == 1
    run("generate", DEMO3, "--real", "float", "-o", "single")
    said = refused("replay", DEMO3, "--log", log, "--against", "single")
    assert said == "error: --against single: its C is float, the log double: give the folder that flew\n"
    done = run("replay", "--log", log, "--step", "5000")
    assert (done.exit_code, done.stdout) == (2, "")
    assert "no such step" in done.stderr
    data = bytearray(binary.read_bytes())
    data[len(MAGIC) + 4] ^= 1  # in the name
    binary.write_bytes(data)
    assert "is damaged" in refused("replay", "--log", str(binary))


def test_the_verdict_as_json(flown: Path, binary: Path) -> None:
    found = json.loads(run("replay", DEMO3, "--log", str(flown), "--json", "--step", "5").stdout)
    assert (found["stand"], found["steps_equal"], found["steps_refused"], found["differs_at"]) == (
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
