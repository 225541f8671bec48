"""verify: the table, its files, and every way in which a foreign program can fail."""

from __future__ import annotations

import json
import shlex
import sys
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

from cli.run import BENCH8, DEMO3, run
from mahovik.contract.functions import WANTS
from mahovik.core.emit.generate import generate
from mahovik.core.stand import load
from toolchain.quick import quick

PYTHON = shlex.quote(sys.executable)
EVAL = f"{PYTHON} -c 'from mahovik.out.cli import main; main()' eval {{stand}}"


def program(text: str) -> str:
    return f"{PYTHON} -c {shlex.quote(text)}"


def test_the_table_of_generated_c(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    result = run("verify", DEMO3, "--states", "12", "--junit", "report.xml", "-o", "worst.jsonl")
    assert result.exit_code == 0
    for words in ("V_dot", "interpreter = C, bit for bit", "outputs untouched", "passed: worst"):
        assert words in result.stdout
    assert ET.parse(tmp_path / "report.xml").getroot().get("failures") == "0"
    assert sorted(p.name for p in tmp_path.iterdir()) == ["report.xml", "worst.jsonl"]
    replayed = run("eval", DEMO3, stdin=(tmp_path / "worst.jsonl").read_text())
    assert replayed.exit_code == 0


@pytest.mark.slow
def test_broken_c_fails_and_leaves_a_state_that_replays(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    for name, text in generate(load(BENCH8)).items():
        Path(name).write_text(text.replace("sum->J[0] += ", "sum->J[0] -= ") if name.endswith(".c") else text)
    result = run("verify", BENCH8, "--states", "12", "--against", ".", "--junit", "report.xml")
    assert result.exit_code == 1
    assert "FAILED: " in result.stdout
    assert int(ET.parse("report.xml").getroot().get("failures") or 0) >= 1
    lines = Path("bench8-worst.jsonl").read_text()
    assert lines
    assert run("eval", BENCH8, "--backend", "numpy", stdin=lines).exit_code == 0


def test_the_reference_itself_passes_as_a_program() -> None:
    result = run("verify", DEMO3, "--states", "7", "--with", f"{EVAL} --backend numpy", "--json")
    assert result.exit_code == 0
    found = json.loads(result.stdout)
    assert found["passed"]
    wants = {row["want"] for row in found["rows"]}
    assert wants == set(WANTS) - {"reaction"}  # of held carriers
    assert {row["worst"] for row in found["rows"]} == {0.0}


DROPPING = """
import json, subprocess, sys
command = [sys.executable, "-c", "from mahovik.out.cli import main; main()", "eval", sys.argv[1], "--backend", "numpy"]
for number, line in enumerate(subprocess.run(command, stdin=sys.stdin, capture_output=True).stdout.splitlines()):
    result = json.loads(line)
    if DROP:
        result.pop(NAME, None)
    print(json.dumps(result))
"""


@pytest.mark.parametrize(("name", "drop"), quick(2, [("I0", "number > 0"), ("D", "True"), ("q_ddot", "True")]))
def test_what_is_left_out_now_and_then_or_not_allowed_to_be_is_missing(name: str, drop: str) -> None:
    text = DROPPING.replace("DROP", drop).replace("NAME", repr(name))
    command = f"{program(text)} {{stand}}"
    result = run("verify", DEMO3, "--states", "6", "--with", command, "--want", "generalized", "--json")
    assert result.exit_code == 1
    failed = {row["quantity"]: row["reason"] for row in json.loads(result.stdout)["rows"] if row["verdict"] == "FAILED"}
    assert failed == {name: "missing"}


def test_a_want_that_is_demanded_must_be_offered() -> None:
    answer = (
        'import sys\nfor l in sys.stdin: import json; print(json.dumps({"id": json.loads(l)["id"], "error": "no"}))'
    )
    result = run("verify", DEMO3, "--states", "2", "--with", program(answer), "--want", "torque")
    assert result.exit_code == 1
    assert "MISSING" in result.stdout
    unasked = run("verify", DEMO3, "--states", "2", "--with", program(answer))
    assert unasked.exit_code == 1
    assert "nothing was compared" in unasked.stdout


ECHO = "import sys, json\nfor l in sys.stdin:\n    d = json.loads(l)\n    "

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
    result = run(
        "verify", DEMO3, "--states", "3", "--with", program(text), "--timeout", "1" if name == "hangs" else "60"
    )
    assert result.exit_code == 1
    (line,) = result.stderr.splitlines()
    assert line.startswith("error: ")
    assert words in line
    assert "FAILED" in result.stdout


def test_results_without_their_quantities_fail() -> None:
    result = run(
        "verify", DEMO3, "--states", "3", "--with", program(ECHO + 'print(json.dumps({"id": d["id"]}))'), "--json"
    )
    assert result.exit_code == 1
    rows = json.loads(result.stdout)["rows"]
    assert {row["reason"] for row in rows if row["verdict"] == "FAILED"} == {"missing"}
    assert {row["quantity"] for row in rows if row["verdict"] != "FAILED"} == {"I0", "J0"}
