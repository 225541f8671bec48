"""The page says what the data says: targets, who wins, how busy the machine was."""

from __future__ import annotations

import xml.etree.ElementTree as ET

import pytest
from mahovik_bench.page import Results, figures, plots
from mahovik_bench.page import page as rendered
from mahovik_bench.slopes import slope
from mahovik_bench.targets import BATCHES, INSTRUCTIONS, NATIVE, SCALAR, verdicts
from mahovik_bench.works import WORKS

from bench.results import results
from docs.pages import cells


def page(found: Results) -> str:
    """The figures of a run as Markdown."""
    return rendered(figures(found))


def test_slope_is_that_of_the_line() -> None:
    found = slope({2: 7.0, 6: 19.0, 8: 25.0})
    assert found == pytest.approx((3.0, 1.0))
    assert slope({2: 7.0, 6: 19.0}) is None


def test_every_target_has_a_verdict() -> None:
    found = list(verdicts(results()))
    assert len(found) == len(INSTRUCTIONS) + 3 * len(WORKS) + len(BATCHES)
    by_figure = {(v.what, v.N): v for v in found}
    assert by_figure["`forward`, -O2, instructions", "2"].reached is True
    assert by_figure["`torque`, -O2, instructions", "8"].reached is False
    assert by_figure["`step`, -O3 native over -O2", "6"].reached is True
    assert by_figure["`torque` over `forward`, batch native", "8"].reached is None


def test_a_native_build_that_is_slower_misses_its_targets() -> None:
    data = results()
    data["cases"]["6"]["times"]["independent"]["coupled"][NATIVE]["ratios"][SCALAR] = 1.06
    missed = {(v.what, v.N) for v in verdicts(data) if v.reached is False and "over" in v.what}
    assert missed >= {("`coupled`, -O3 native over -O2", "6")}


def test_batches_are_compared_with_forward() -> None:
    data = results()
    for work, ns in (("forward", 10.0), ("coupled", 14.0), ("torque", 6.0)):
        table = data["cases"]["8"]["times"]["independent"]
        table[work] = {**table[work], "mahovik batch native": {"least": ns}}
    found = {v.what: v.reached for v in verdicts(data) if "batch" in v.what}
    assert found == {"`coupled` over `forward`, batch native": True, "`torque` over `forward`, batch native": False}


def test_the_page_says_where_a_peer_wins() -> None:
    assert "Nowhere in this run" in page(results())
    text = page(results(peer=0.9))
    assert "`torque`, N = 8: casadi ldl -O2 is faster than mahovik -O2 (0.90)" in text
    assert "Nowhere" not in text


def test_the_page_says_when_the_machine_was_busy() -> None:
    assert "The machine was busy" not in page(results())
    assert "The machine was busy" in page(results(load=5.0))


def test_the_page_is_whole() -> None:
    text = page(results())
    for heading in ("Machine, versions, flags", "Targets", "Where a peer is faster", "Agreement"):
        assert f"## {heading}\n" in text
    assert "sympy: not installed" in text
    lines = [line for line in text.splitlines() if line.startswith("|")]
    tables: list[list[str]] = [[]]
    for line in text.splitlines():
        if line.startswith("|"):
            tables[-1].append(line)
        elif tables[-1]:
            tables.append([])
    assert len(lines) == sum(map(len, tables))
    for table in tables:
        assert len({len(cells(line)) for line in table}) <= 1


def test_plots_are_svg() -> None:
    found = plots(results())
    assert sorted(found) == [f"docs/results/benchmarks-{work}.svg" for work in ("coupled", "forward", "torque")]
    for text in found.values():
        assert ET.fromstring(text).tag.endswith("svg")
    assert "numpy reference" in found["docs/results/benchmarks-forward.svg"]
