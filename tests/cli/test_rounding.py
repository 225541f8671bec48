"""verify --rigorous: table, JSON, files, exit status, and what it refuses."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import pytest

from cli.run import DEMO3, refused, run
from mahovik.contract.functions import wants_of, wants_of_carrier
from mahovik.core.emit.generate import generate
from mahovik.core.stand import load


def test_json_in_float() -> None:
    result = run("verify", DEMO3, "--rigorous", "--states", "3", "--real", "float", "--json")
    assert result.exit_code == 0
    found = json.loads(result.stdout)
    assert (found["passed"], found["real"], found["states"], found["judged"]) == (True, "float", 3, "float C")
    assert {row["want"] for row in found["rows"]} == set(wants_of("rigorous")) & set(wants_of_carrier(held=False))
    forward = next(row for row in found["rows"] if row["want"] == "forward")
    assert (forward["quantity"], forward["verdict"]) == ("V_dot", "ok")
    assert 0 < forward["ulps"] < 8
    assert forward["ulps_accepted"] is None
    assert 0 < forward["worst"] < forward["tolerance"] == 1e-6
    assert 0 < forward["worst_judges"] < 1e-12


@pytest.mark.slow
def test_wrong_c_ends_with_status_1_and_a_state_that_replays() -> None:
    for name, text in generate(load(DEMO3)).items():
        Path(name).write_text(text.replace("    .mass = 16.0,\n", "    .mass = 16.000000000016,\n"))
    result = run("verify", DEMO3, "--rigorous", "--states", "3", "--against", ".")
    assert result.exit_code == 1
    assert "rounding of double C in . of demo3" in result.stdout
    assert "FAILED: " in result.stdout
    assert "K" in result.stdout.rpartition("FAILED: ")[2]
    assert run("eval", DEMO3, stdin=Path("demo3-worst.jsonl").read_text()).exit_code == 0


def test_without_python_flint_one_line_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "flint", None)
    for name in [
        name for name in sys.modules if name.startswith(("mahovik.proof.rigorous", "mahovik.proof.verify.rounding"))
    ]:
        monkeypatch.delitem(sys.modules, name)
    said = refused("verify", DEMO3, "--rigorous")
    assert said == "error: --rigorous: python-flint is not installed: pip install 'mahovik[rigorous]'\n"
