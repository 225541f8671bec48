"""The gate passes what was accepted and stops functions that have become more expensive."""

from __future__ import annotations

import json

import pytest
from mahovik_bench.counting import read
from mahovik_bench.gate import ACCEPTED, SIZES, compared, costs, text

from toolchain.tools import require


@pytest.fixture
def valgrind() -> None:
    """What counts instructions."""
    require("valgrind", "valgrind")


@pytest.mark.slow
@pytest.mark.usefixtures("valgrind")
def test_a_planted_rise_is_stopped() -> None:
    found = costs((2,))
    kept = text(found)
    assert compared(found, kept)[2].rises == ()
    cheaper = json.loads(kept)
    for each in cheaper["2"]["targets"]:
        for function in each["functions"]:
            if function["function"] == "forward":
                function["instructions"] = round(function["instructions"] * 0.9)
    (rise,) = compared(found, json.dumps(cheaper))[2].rises
    assert "forward, instructions" in rise


def test_accepted_figures_are_of_all_sizes() -> None:
    kept = json.loads(ACCEPTED.read_text(encoding="utf-8"))
    assert sorted(map(int, kept)) == sorted(SIZES)
    for each in kept.values():
        names = {f["function"] for target in each["targets"] for f in target["functions"]}
        assert {"forward", "coupled", "torque", "step"} <= names


def test_dumps_of_callgrind_are_read() -> None:
    assert read("desc: Trigger: Client Request: peer_forward\nevents: Ir\nsummary: 1381\n") == ("peer_forward", 1381)
    assert read("events: Ir\ntotals: 12\n") == ("", 12)
