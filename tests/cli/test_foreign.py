"""verify and judge: the table of the C, right and wrong programs, every way in which one can fail, and adapters."""

from __future__ import annotations

import json
import re
import shlex
import subprocess
import sys
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

import pytest

from cli.run import DEMO3, run
from mahovik.contract.evaluation import MAY_BE_LEFT_OUT
from mahovik.contract.functions import WANTS
from mahovik.stands import path
from toolchain.tools import require

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


def rows(*arguments: str, status: int) -> list[dict[str, Any]]:
    """Rows of the table that the command prints as JSON."""
    result = run(*arguments, "--json")
    assert result.exit_code == status, result.output
    judged: list[dict[str, Any]] = json.loads(result.stdout)["rows"]
    return judged


def test_the_table_of_generated_c_as_junit_and_its_worst_states() -> None:
    result = run("verify", DEMO3, "--states", "3", "--junit", "report.xml", "--worst", "worst.jsonl")
    assert result.exit_code == 0 and "interpreter = C, bit for bit" in result.stdout
    assert ET.parse("report.xml").getroot().get("failures") == "0"
    assert sorted(p.name for p in Path().iterdir()) == ["report.xml", "worst.jsonl"]
    assert run("eval", DEMO3, "--backend", "numpy", stdin=Path("worst.jsonl").read_text()).exit_code == 0


@pytest.mark.parametrize(("stand", "left_out"), [(DEMO3, {"reaction"}), (PENDULUM, set())])
def test_the_reference_itself_passes_as_a_program(stand: str, left_out: set[str]) -> None:
    judged = rows("judge", stand, "--states", "3", "--with", EVAL, "--junit", "report.xml", status=0)
    assert ET.parse("report.xml").getroot().get("failures") == "0"
    assert {row["judged"] for row in judged} == set(WANTS) - left_out
    assert {row["value"] for row in judged} == {0.0}


@pytest.mark.parametrize(("name", "drop"), [("I0", "if number: "), ("D", "")])
def test_what_is_left_out_now_and_then_or_not_allowed_to_be_is_missing(name: str, drop: str) -> None:
    command = changed(result=f"{drop}result.pop({name!r}, None)")
    judged = rows("judge", DEMO3, "--states", "6", "--with", command, "--want", "generalized", status=1)
    words = {row["quantity"]: row["words"] for row in judged if row["verdict"] == "FAILED"}
    assert words == {name: "missing" if name == "I0" else f"{ODD}: missing"}  # the second derivation has no I0


@pytest.mark.parametrize(("attitude", "other"), [("quaternion", "angles"), ("angles", "quaternion")])
def test_attitudes_are_given_in_one_form(attitude: str, other: str) -> None:
    """Free and held carriers; the reference at the same attitude agrees to the last bit."""
    command = changed(f'assert "{attitude}" in state and "{other}" not in state')
    for stand in (DEMO3, PENDULUM):
        options = ("--with", command, "--attitude", attitude, "--want", "forward,points", "--states", "9")
        assert {row["value"] for row in rows("judge", stand, *options, status=0)} == {0.0}


@pytest.mark.parametrize("file", ["adapter.py", "adapter.cpp"])
def test_a_skeleton_answers_at_once(file: str) -> None:
    """It is right for the stand in its head, line by line, and offers nothing else."""
    assert run("new", "adapter", "-o", file).output == f"files: {file}\n"
    lines = [line.removeprefix("//").strip() for line in Path(file).read_text(encoding="utf-8").splitlines()]
    first = lines.index("schema = 1")
    Path("body.toml").write_text("\n".join(lines[first : first + 6]), encoding="utf-8")
    command = f"{shlex.quote(sys.executable)} {file}"
    if file.endswith(".cpp"):
        require("g++", "g++")
        subprocess.run(["g++", "-std=c++17", "-Wall", "-Wextra", "-Werror", "-o", "adapter", file], check=True)
        command = "./adapter"
    judged = rows("judge", "body.toml", "--states", "12", "--with", command, status=0)
    assert [row["judged"] for row in judged if row["verdict"] == "ok"] == ["forward"]
    assert {row["words"] for row in judged if row["verdict"] == "not offered"} >= {"matrices: not offered"}
    with subprocess.Popen(shlex.split(command), stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdin is not None and process.stdout is not None
        process.stdin.write('{"id": [1, "a"], "want": ["forward"]}\n')
        process.stdin.flush()
        assert json.loads(process.stdout.readline()) == {"id": [1, "a"], "V_dot": [0.0] * 6}
        process.stdin.close()


ECHO = "import sys, json\nfor l in sys.stdin:\n    d = json.loads(l)\n    "
BY_QUATERNION = program(ECHO + 'print(json.dumps({"id": d["id"], "V_dot": d["quaternion"]}))')
REFUSING = program(ECHO + 'print(json.dumps({"id": d["id"], "error": "no"}))')
EMPTY = program(ECHO + 'print(json.dumps({"id": d["id"]}))')


def test_a_program_that_reads_one_form_of_attitudes_is_told_the_option() -> None:
    result = run("judge", DEMO3, "--states", "9", "--with", BY_QUATERNION, "--want", "forward")
    assert "KeyError: 'quaternion'; some states have angles, others a quaternion: --attitude" in result.stdout


def test_a_want_that_is_demanded_must_be_offered() -> None:
    result = run("judge", DEMO3, "--states", "2", "--with", REFUSING, "--want", "torque")
    assert result.exit_code == 1 and "MISSING" in result.stdout and "FAILED: torque\n" in result.stdout
    unasked = run("judge", DEMO3, "--states", "2", "--with", REFUSING)
    assert unasked.exit_code == 1 and "nothing was compared" in unasked.stdout


def test_results_without_their_quantities_fail() -> None:
    judged = rows("judge", DEMO3, "--states", "3", "--with", EMPTY, status=1)
    assert {row["words"].removeprefix(f"{ODD}: ") for row in judged if row["verdict"] == "FAILED"} == {"missing"}
    assert {row["quantity"] for row in judged if row["verdict"] != "FAILED"} == set(MAY_BE_LEFT_OUT)
    result = run("judge", DEMO3, "--states", "2", "--with", EMPTY, "--explain")
    assert result.exit_code == 1 and "no diagnosis: there is no answer in which" in result.stdout


def answering(result: str) -> str:
    """A program that answers every state with these members."""
    return ECHO + f'print(json.dumps({{"id": d["id"], {result}}}))'


BROKEN = {
    "drops all": ("import sys; sys.stdin.read()", "answered none of 3 states and ended with status 0"),
    "dies": ("1/0", "ZeroDivisionError"),
    "is killed": ("import os, signal; os.kill(os.getpid(), signal.SIGKILL)", "ended with signal 9"),
    "ends with a status of its own": (ECHO + 'print("{}")\nsys.exit(7)', "ended with status 7"),
    "prints garbage": (ECHO + 'print("hello")', "line 1 of its output: found 'hello', expected an object in JSON"),
    "prints numbers": (ECHO + "print(1)", "found '1', expected an object"),
    "loses the ids": (ECHO + 'print("{}")', "has the id null, expected"),
    "stops half way": (
        ECHO + 'print(json.dumps({"id": d["id"]})); sys.exit(0)',
        "answered 1 of 3 states and ended with status 0",
    ),
    "greets": ("print('ready')\n" + answering('"V_dot": [0] * 6'), "line 1 of its output: found 'ready'"),
    "never stops": ('while True: print("{}")', "line 1 of its output has the id null"),
    "answers more": (answering('"V_dot": [0] * 6') + '\nprint("{}")', "it gave more lines than the 3 states"),
    "dies half way": (ECHO + 'print(json.dumps({"id": d["id"], "V_dot": [0] * 6}), flush=True); 1/0', "1: ZeroDiv"),
    "misspells a key": (
        answering('"Vdot": [0] * 6'),
        'line 1 of its output: unknown key "Vdot", did you mean "V_dot"?',
    ),
    "lacks a number": (answering('"V_dot": [0] * 5'), "V_dot: found a list of 5, expected a list of 6"),
    "mixes lengths": (answering('"V_dot": [[0], 1]'), "V_dot: found lists of different lengths"),
    "hangs": ("import time; time.sleep(60)", "answered none of 3 states in 1 s, its timeout, and had not ended"),
}


@pytest.mark.parametrize("name", BROKEN)
def test_a_program_that_fails_is_one_line_and_status_1(name: str) -> None:
    text, words = BROKEN[name]
    timeout = "1" if name == "hangs" else "60"
    options = ("--states", "3", "--want", "forward", "--timeout", timeout)
    result = run("judge", DEMO3, "--with", program(text), *options)
    (line,) = (line for line in result.stdout.splitlines() if line.startswith("error: "))
    assert result.exit_code == 1 and "FAILED" in result.stdout
    assert words in line


def test_a_difference_within_what_is_accepted() -> None:
    rounding = changed('state["phi"] = [phi * (1 + 1e-9) for phi in state.get("phi", [0.0] * 2)]')
    judged = ("judge", SHAKER, "--with", rounding, "--states", "6", "--want", "forward")
    assert (run(*judged).exit_code, run(*judged, "--tolerance", "1e-5").exit_code) == (1, 0)


def test_digits_that_only_some_states_lack_are_said_with_how_far_they_fail() -> None:
    rounded = 'result["V_dot"] = [float("%.11e" % x) for x in result["V_dot"]]'
    command = changed(result=f'if "V_dot" in result and "phi_ddot" not in result: {rounded}')
    result = run("judge", DEMO3, "--with", command, "--states", "20", "--want", "forward", "--explain")
    assert "differ by no more than rounding (12 digits) at the states of the diagnosis" in result.stdout
    assert re.search(r"but FAILED above: forward V_dot \(.*, \d\.?\d* times its limit\)", result.stdout)


def test_nan_beside_a_wrong_term() -> None:
    """The diagnosis says that wrong terms are not looked for, and why."""
    spoil = 'result["V_dot"][2] = math.nan; result["V_dot"][0] += 0.3 * math.sin(result["V_dot"][1])'
    command = changed(result=f'if "V_dot" in result and "phi_ddot" not in result: {spoil}')
    result = run("judge", DEMO3, "--states", "3", "--with", command, "--explain", "--want", "forward")
    assert result.exit_code == 1
    assert "numbers are missing in forward: V_dot" in result.stdout
    assert "wrong terms are not looked for: forward: 0 of " in result.stdout


def test_no_cause_is_looked_for_in_torques_within_bounds() -> None:
    """They are judged by what they reach; a program that differs in nothing else has a fault nevertheless."""
    text = f"{Path(DEMO3).read_text(encoding='utf-8')}\n[task.spin]\nrows = ['wz']\n"
    for name, torque in (("right", 0.2), ("wrong", 0.15)):
        motor = f"[[flywheel]]\nmotor = {{ torque = {torque} }}"
        Path(f"{name}.toml").write_text(text.replace("[[flywheel]]", motor), encoding="utf-8")
    command = f"{shlex.quote(sys.executable)} -m mahovik eval wrong.toml"
    result = run("judge", "right.toml", "--states", "6", "--with", command, "--explain", "--want", "torque_for")
    assert "no diagnosis: there is no answer in which causes are looked for" in result.stdout
    assert "not compared there, but FAILED above: torque_for limited" in result.stdout
