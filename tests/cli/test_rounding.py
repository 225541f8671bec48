"""verify --rigorous: table, JSON, files, exit status, and what it refuses."""

from __future__ import annotations

import json
import sys

import pytest

from cli.run import DEMO3, refused, run
from mahovik.contract.functions import wants_of, wants_of_carrier


def test_json_in_float() -> None:
    result = run("verify", DEMO3, "--rigorous", "--states", "3", "--real", "float", "--json")
    assert result.exit_code == 0
    report = json.loads(result.stdout)
    assert (report["passed"], report["states"], report["judged"]) == (True, 3, "float C")
    assert {row["judged"] for row in report["rows"]} == set(wants_of("rigorous")) & set(wants_of_carrier(held=False))
    forward = next(row for row in report["rows"] if row["judged"] == "forward")
    assert (forward["quantity"], forward["verdict"]) == ("V_dot", "ok")
    assert 0 < forward["value"] < forward["limit"] == 1e-5


def test_without_python_flint_one_line_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "flint", None)
    monkeypatch.delitem(sys.modules, "mahovik.proof.verify.rigorous", raising=False)
    said = refused("verify", DEMO3, "--rigorous")
    assert said == 'error: flint is not installed: pip install "mahovik[rigorous]"\n'
