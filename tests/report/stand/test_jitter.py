"""The section on jitter: angle of the first point against the common speed of the flywheels."""

from __future__ import annotations

from dataclasses import replace

from mahovik.out.report.plot.jitter import report_panels
from mahovik.out.report.plot.numbers import chart_numbers
from mahovik.out.report.stand import jitter
from report.stand.runs import example, material


def test_a_satellite_has_all_diagrams_and_its_worst_speed() -> None:
    shown = jitter.section(material(example("sat4")))
    assert shown is not None
    assert shown.html.count('<figure class="chart"') == 4
    assert "waterfall" in shown.html and "budget" in shown.html and "cumulative RMS" in shown.html
    assert "arcsec RMS over all phases at acc1" in shown.summary
    assert "Angle of acc1, amplitudes 0 to peak" in shown.html


def test_cumulative_and_budget_charts_have_legends() -> None:
    """Lines whose abscissa rises have a name in the page, which is its legend; others only a label that may be cut."""
    found = jitter.swept(example("sat4"), 600.0)
    cumulative, budget = report_panels(found)[2:]
    for panel, names in ((cumulative, ["x", "y", "z"]), (budget, [f"{k + 1}: " for k in range(4)])):
        lines = chart_numbers(panel, None)["lines"]
        assert [line["name"][: len(name)] for line, name in zip(lines, names, strict=True)] == names


def test_without_a_steady_motion_or_unbalance_there_is_none() -> None:
    for name in ("remus6", "demo3"):
        assert jitter.section(material(example(name))) is None
    assert jitter.section(material(replace(example("demo3"), flywheels=()))) is None
