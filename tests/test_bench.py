"""The benchmark's contestants give what the reference gives, and a wrong one is not timed."""

import sys
from pathlib import Path

import pytest

from mahovik.errors import ToolchainError

sys.path.append(str(Path(__file__).resolve().parents[1] / "bench"))

from mahovik_bench import agree, run

pytestmark = pytest.mark.slow

IN_BOTH = {"coupled", "torque"}


def measured(*programs: str) -> list[run.Row]:
    return list(run.measure((2,), programs, 2, 1e9, print))


def test_every_work_agrees_and_has_figures() -> None:
    rows = measured("mahovik", "mujoco")
    by_program = {
        name: {row["work"] for row in rows if row["program"] == name} for name in (run.SCALAR, "mujoco its library")
    }
    assert by_program["mujoco its library"] == IN_BOTH < by_program[run.SCALAR]
    for row in rows:
        assert row["least"] > 0 and row["median"] >= row["least"]
        if row["program"] == run.SCALAR:
            assert row["instructions"] > 0 and row["ratio"] == 1.0
            assert (row["difference"] or 0.0) <= agree.ACCEPTED


def test_results_that_differ_stop_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(agree, "ACCEPTED", 1e-25)
    with pytest.raises(ToolchainError, match=r"N = 2: .* off"):
        measured("mahovik")
