"""judge: a program that is right, one that is not and what it has, and every way in which one can fail."""

from __future__ import annotations

import json
import shlex
import sys
from pathlib import Path

import pytest

from cli.run import DEMO3, run
from mahovik.stands import path

PYTHON = shlex.quote(sys.executable)

WRONG = """
import json, subprocess, sys
command = [sys.executable, "-c", "from mahovik.out.cli import main; main()", "eval", sys.argv[1], "--backend", "numpy"]
given = [json.loads(line) for line in sys.stdin]
for state in given:
    CHANGE
lines = "".join(json.dumps(state) + chr(10) for state in given)
sys.stdout.write(subprocess.run(command, input=lines, capture_output=True, text=True).stdout)
"""


def wrong(change: str) -> str:
    """The reference, asked something else than was given."""
    return f"{PYTHON} -c {shlex.quote(WRONG.replace('CHANGE', change))} {{stand}}"


PENDULUM = str(Path(__file__).parents[2] / "docs" / "held" / "pendulum.toml")

SHAKER = str(path("shaker2"))
"""A stand with unbalanced flywheels: without wrenches balanced ones know no phase."""

PHASE = wrong('state["phi"] = [-phi for phi in state.get("phi", [])] or [0.0] * 2')


@pytest.fixture(autouse=True)
def _elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Worst states are written where the command runs."""
    monkeypatch.chdir(tmp_path)


@pytest.mark.slow
def test_a_program_that_differs_is_told_its_fault() -> None:
    result = run("judge", SHAKER, "--with", PHASE, "--explain", "--states", "6")
    assert result.exit_code == 1
    assert "fault found:" in result.stdout
    assert "The phase of the flywheels turns the wrong way" in result.stdout
    assert "confidence 9" in result.stdout


LEVER = """
import json, sys
import numpy as np
import mahovik
from mahovik.proof import reference
from mahovik.proof.verify.states import read_request
stand = mahovik.load(sys.argv[1])
for line in sys.stdin:
    given = json.loads(line)
    state = read_request(stand, given).state
    at = reference.pieces(stand, state)
    V_dot = reference.evaluate(stand, state, ("forward",), at)["V_dot"]
    V_dot = V_dot + np.linalg.solve(at.K, [0, 0, 0, 0, 0.25 * at.V_r[2] * at.V_r[5], 0])
    print(json.dumps({"id": given["id"], "V_dot": V_dot.tolist()}))
"""


@pytest.mark.slow
def test_a_wrong_term_as_json() -> None:
    command = f"{PYTHON} -c {shlex.quote(LEVER)} {{stand}}"
    result = run("judge", DEMO3, "--with", command, "--explain", "--states", "3", "--want", "forward", "--json")
    assert result.exit_code == 1
    diagnosis = json.loads(result.stdout)["diagnosis"]
    assert (diagnosis["verdict"], len(diagnosis["found"])) == ("named", 1)
    (term,) = diagnosis["found"]
    assert (term["want"], term["component"], term["term"], term["coefficient"]) == ("forward", "M", "w r", "")
    assert term["factor"] - term["expected"] == pytest.approx(0.25, rel=1e-9)
    assert diagnosis["unexplained"] < 1e-9


ARM = """
import json, sys
import mahovik
from mahovik.proof import reference
from mahovik.proof.verify.states import read_request
stand = mahovik.load(sys.argv[1])
for line in sys.stdin:
    given = json.loads(line)
    if given["want"] != ["forward"]:
        print(json.dumps({"id": given["id"], "error": "not offered"}))
        continue
    state = read_request(stand, given).state
    at = reference.pieces(stand, state)
    found = reference.evaluate(stand, state, ("forward",), at)
    moment = 0.2 * 0.048 * at.gravity[0]
    u_dot = float(found["u_dot"][0]) - moment / at.K[4, 4]
    reaction = found["reaction"] + at.K[:, 4] * (u_dot - found["u_dot"][0])
    reaction[4] = 0.0
    V_dot = [0, 0, 0, 0, u_dot, 0]
    print(json.dumps({"id": given["id"], "u_dot": [u_dot], "V_dot": V_dot, "reaction": reaction.tolist()}))
"""
"""A pendulum whose weight has a fifth less of its arm, 0.048 kg m over the pivot O1."""


@pytest.mark.slow
def test_a_wrong_term_of_a_held_carrier() -> None:
    command = f"{PYTHON} -c {shlex.quote(ARM)} {{stand}}"
    result = run("judge", PENDULUM, "--with", command, "--explain", "--json", "--states", "8")
    found = json.loads(result.stdout)["diagnosis"]
    assert (result.exit_code, found["verdict"], found["outcome"]) == (1, "named", "terms")
    (term,) = found["found"]
    assert (term["want"], term["component"], term["term"]) == ("forward", "M", "g_x")
    assert (round(term["factor"], 9), term["expected"], term["coefficient"]) == (0.8, 1.0, "W z_G")


def test_what_is_accepted_can_be_said() -> None:
    """The reference in float differs, and says so; within what float can do it agrees."""
    rounding = PHASE.replace("-phi for phi", "phi * (1 + 1e-9) for phi")
    assert run("judge", SHAKER, "--with", rounding, "--states", "6", "--want", "forward").exit_code == 1
    assert (
        run("judge", SHAKER, "--with", rounding, "--states", "3", "--want", "forward", "--tolerance", "1e-5").exit_code
        == 0
    )


TELL = """
import json, sys
for line in sys.stdin:
    state = json.loads(line)
    if "wrench" in state:
        sys.exit("a wrench on " + ", ".join(state["wrench"]))
    print(json.dumps({"id": state["id"], "V_dot": [1.0] * 6}))
"""


@pytest.mark.slow
def test_no_wrench_is_sent_that_the_stand_does_not_take() -> None:
    """No body of demo3 has `wrench_input`."""
    command = f"{PYTHON} -c {shlex.quote(TELL)}"
    result = run("judge", DEMO3, "--with", command, "--explain", "--states", "12", "--want", "forward")
    assert "error:" not in result.output
    assert "in the dictionary explains it" in result.stdout


ECHO = "import sys, json\nfor l in sys.stdin:\n    d = json.loads(l)\n    "


SECOND_TIME = """
import json, os, sys
if os.path.exists("been"):
    sys.exit("no more")
open("been", "w").close()
for line in sys.stdin:
    print(json.dumps({"id": json.loads(line)["id"], "V_dot": [0.0] * 6}))
"""


def test_a_program_that_dies_while_it_is_examined() -> None:
    command = f"{PYTHON} -c {shlex.quote(SECOND_TIME)}"
    result = run("judge", DEMO3, "--states", "3", "--with", command, "--explain", "--want", "forward")
    assert result.exit_code == 1
    assert "no more" in result.stderr


def test_a_program_that_gives_the_states_back_has_no_fault() -> None:
    result = run("judge", DEMO3, "--states", "2", "--with", "cat", "--explain")
    assert result.exit_code == 1
    assert result.stderr == (
        "error: it answered nothing: each line of its output is the state that it was given, without results\n"
    )
    assert "fault" not in result.stdout
    text = ECHO + 'print(json.dumps({"id": d["id"]}))'
    result = run("judge", DEMO3, "--states", "2", "--with", f"{PYTHON} -c {shlex.quote(text)}", "--explain")
    assert result.exit_code == 1
    assert "no diagnosis: the program answered nothing" in result.stdout
    assert "nearest" not in result.stdout


NAN = """
import json, math, subprocess, sys
command = [sys.executable, "-c", "from mahovik.out.cli import main; main()", "eval", sys.argv[1], "--backend", "numpy"]
for line in subprocess.run(command, input=sys.stdin.read(), capture_output=True, text=True).stdout.splitlines():
    found = json.loads(line)
    if "V_dot" in found and "phi_ddot" not in found:
        found["V_dot"][2] = math.nan
    print(json.dumps(found))
"""


def test_nan_beside_a_wrong_term() -> None:
    """That wrong terms are not looked for, and why, is said."""
    wrong = NAN.replace("math.nan", "math.nan\n        found['V_dot'][0] += 0.3 * math.sin(found['V_dot'][1])")
    command = f"{PYTHON} -c {shlex.quote(wrong)} {{stand}}"
    result = run("judge", DEMO3, "--states", "3", "--with", command, "--explain", "--want", "forward")
    assert result.exit_code == 1
    assert "states of the diagnosis (component Z)" in result.stdout
    assert "wrong terms are not looked for: forward has all components at no state" in result.stdout
