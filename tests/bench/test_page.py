"""The page says what the data says: targets, who wins, how busy the machine was."""

from __future__ import annotations

import xml.etree.ElementTree as ET

import pytest
from mahovik_bench.page import Results, figures, plots
from mahovik_bench.page import page as rendered
from mahovik_bench.slopes import slope
from mahovik_bench.targets import FACTORS, INSTRUCTIONS, SLOPES, best_ratio, verdicts

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
    assert len(found) == sum(len(wanted) for *_, wanted in FACTORS) + len(INSTRUCTIONS) + len(SLOPES)
    by_figure = {(v.what, v.N): v for v in found}
    assert by_figure["`forward`, -O2", "8"].reached is True
    assert by_figure["`forward`, -O2", "64"].reached is None
    assert by_figure["`coupled`, -O2, ns a further flywheel", "slope"].found == "10.0"
    assert by_figure["`torque`, -O2, instructions", "8"].reached is False


def test_a_slow_build_misses_its_targets() -> None:
    found = {(v.what, v.N): v.reached for v in verdicts(results(peer=1.5))}
    assert found["`forward`, -O2", "2"] is False


def test_lanes_are_asked_less_without_avx512() -> None:
    data = results()
    narrow = [v.asked for v in verdicts(data) if "lanes" in v.what]
    data["machine"]["vectors"] = "AVX-512"
    wide = [v.asked for v in verdicts(data) if "lanes" in v.what]
    assert (narrow[0], wide[0]) == ("2.0 x", "3.0 x")


def test_the_best_peer_is_the_nearest() -> None:
    table = results()["cases"]["2"]["times"]["independent"]["forward"]
    assert best_ratio(table, "mahovik -O2") == (10.0, "casadi ldl -O2")
    nearer = {"casadi table -O2": {"ratios": {"mahovik -O2": 2.0}}, **table}
    assert best_ratio(nearer, "mahovik -O2") == (10.0, "casadi ldl -O2")


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
