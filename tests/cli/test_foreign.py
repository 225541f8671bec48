"""verify and judge: the table of the C, right and wrong foreign programs, and every way in which one can fail."""

from __future__ import annotations

import json
import shlex
import sys
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

import pytest

from cli.run import DEMO3, run
from mahovik.contract.functions import WANTS
from mahovik.stands import path

PENDULUM = str(Path(__file__).parents[2] / "docs" / "held" / "pendulum.toml")
SHAKER = str(path("shaker2"))
"""A stand with unbalanced flywheels: without wrenches balanced ones know no phase."""

EVAL = f"{shlex.quote(sys.executable)} -m mahovik eval {{stand}} --backend numpy"


ODD = "reference and second agree, program differs"


def program(text: str) -> str:
    """A command that runs this program with the stand file."""
    return f"{shlex.quote(sys.executable)} -c {shlex.quote(text)} {{stand}}"


CHANGED = """
import json, math, subprocess, sys
states = [json.loads(line) for line in sys.stdin]
for state in states:
    STATE
lines = "".join(json.dumps(state) + chr(10) for state in states)
command = [sys.executable, "-m", "mahovik", "eval", sys.argv[1], "--backend", "numpy"]
for number, line in enumerate(subprocess.run(command, input=lines, capture_output=True, text=True).stdout.splitlines()):
    result = json.loads(line)
    RESULT
    print(json.dumps(result))
"""


def changed(state: str = "pass", result: str = "pass") -> str:
    """The reference, which is asked for another state, or whose results are changed."""
    return program(CHANGED.replace("STATE", state).replace("RESULT", result))


PHASE = changed('state["phi"] = [-phi for phi in state.get("phi", [])] or [0.0] * 2')


def rows(*arguments: str, status: int) -> list[dict[str, Any]]:
    """Rows of the table that the command prints as JSON."""
    result = run(*arguments, "--json")
    assert result.exit_code == status, result.output
    judged: list[dict[str, Any]] = json.loads(result.stdout)["rows"]
    return judged


def test_the_table_of_generated_c_as_junit_and_its_worst_states() -> None:
    result = run("verify", DEMO3, "--states", "3", "--junit", "report.xml", "-o", "worst.jsonl")
    assert result.exit_code == 0 and "interpreter = C, bit for bit" in result.stdout
    assert ET.parse("report.xml").getroot().get("failures") == "0"
    assert sorted(p.name for p in Path().iterdir()) == ["report.xml", "worst.jsonl"]
    assert run("eval", DEMO3, "--backend", "numpy", stdin=Path("worst.jsonl").read_text()).exit_code == 0


@pytest.mark.parametrize(("stand", "left_out"), [(DEMO3, {"reaction"}), (PENDULUM, set())])
def test_the_reference_itself_passes_as_a_program(stand: str, left_out: set[str]) -> None:
    judged = rows("verify", stand, "--states", "3", "--with", EVAL, status=0)
    assert {row["judged"] for row in judged} == set(WANTS) - left_out
    assert {row["value"] for row in judged} == {0.0}


@pytest.mark.parametrize(("name", "drop"), [("I0", "if number: "), ("D", "")])
def test_what_is_left_out_now_and_then_or_not_allowed_to_be_is_missing(name: str, drop: str) -> None:
    command = changed(result=f"{drop}result.pop({name!r}, None)")
    judged = rows("verify", DEMO3, "--states", "6", "--with", command, "--want", "generalized", status=1)
    assert {row["quantity"]: row["words"] for row in judged if row["verdict"] == "FAILED"} == {name: f"{ODD}: missing"}


ECHO = "import sys, json\nfor l in sys.stdin:\n    d = json.loads(l)\n    "
REFUSING = program(ECHO + 'print(json.dumps({"id": d["id"], "error": "no"}))')
EMPTY = program(ECHO + 'print(json.dumps({"id": d["id"]}))')


def test_a_want_that_is_demanded_must_be_offered() -> None:
    result = run("verify", DEMO3, "--states", "2", "--with", REFUSING, "--want", "torque")
    assert result.exit_code == 1 and "MISSING" in result.stdout
    unasked = run("verify", DEMO3, "--states", "2", "--with", REFUSING)
    assert unasked.exit_code == 1 and "nothing was compared" in unasked.stdout


def test_results_without_their_quantities_fail() -> None:
    judged = rows("verify", DEMO3, "--states", "3", "--with", EMPTY, status=1)
    assert {row["words"] for row in judged if row["verdict"] == "FAILED"} == {f"{ODD}: missing"}
    assert {row["quantity"] for row in judged if row["verdict"] != "FAILED"} == {"I0", "J0"}
    result = run("judge", DEMO3, "--states", "2", "--with", EMPTY, "--explain")
    assert result.exit_code == 1 and "no diagnosis: the program answered nothing" in result.stdout


BROKEN = {
    "drops all": ("import sys; sys.stdin.read()", "gave nothing"),
    "dies": ("1/0", "ZeroDivisionError"),
    "is killed": ("import os, signal; os.kill(os.getpid(), signal.SIGKILL)", "ended with signal 9"),
    "ends with a status of its own": (ECHO + 'print("{}")\nsys.exit(7)', "ended with status 7"),
    "prints garbage": (ECHO + 'print("hello")', "is no JSON: 'hello"),
    "prints numbers": (ECHO + "print(1)", "is no object"),
    "loses the ids": (ECHO + 'print("{}")', "has the id null, expected"),
    "stops half way": (ECHO + 'print(json.dumps({"id": d["id"]})); sys.exit(0)', "1 lines of output for"),
    "never stops": ('while True: print("{}")', "gave more lines than"),
    "hangs": ("import time; time.sleep(60)", "gave no complete answer in 1 s"),
}


@pytest.mark.parametrize("name", BROKEN)
def test_a_program_that_fails_is_one_line_and_status_1(name: str) -> None:
    text, words = BROKEN[name]
    timeout = "1" if name == "hangs" else "60"
    result = run("verify", DEMO3, "--states", "3", "--with", program(text), "--timeout", timeout)
    (line,) = result.stderr.splitlines()
    assert result.exit_code == 1 and "FAILED" in result.stdout
    assert line.startswith("error: ") and words in line


@pytest.mark.slow
def test_a_program_that_differs_is_told_its_fault() -> None:
    result = run("judge", SHAKER, "--with", PHASE, "--explain", "--states", "6", "--json")
    assert result.exit_code == 1
    diagnosis = json.loads(result.stdout)["diagnosis"]
    assert diagnosis["outcome"] == "named" and diagnosis["causes"][0]["faults"][0]["name"] == "phase, sign"


def test_a_difference_within_what_is_accepted() -> None:
    rounding = changed('state["phi"] = [phi * (1 + 1e-9) for phi in state.get("phi", [0.0] * 2)]')
    judged = ("judge", SHAKER, "--with", rounding, "--states", "6", "--want", "forward")
    assert (run(*judged).exit_code, run(*judged, "--tolerance", "1e-5").exit_code) == (1, 0)


def test_nan_beside_a_wrong_term() -> None:
    """That wrong terms are not looked for, and why, is said."""
    spoil = 'result["V_dot"][2] = math.nan; result["V_dot"][0] += 0.3 * math.sin(result["V_dot"][1])'
    command = changed(result=f'if "V_dot" in result and "phi_ddot" not in result: {spoil}')
    result = run("judge", DEMO3, "--states", "3", "--with", command, "--explain", "--want", "forward")
    assert result.exit_code == 1
    assert "states of the diagnosis (component Z)" in result.stdout
    assert "wrong terms are not looked for: forward has all components at no state" in result.stdout
