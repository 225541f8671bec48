"""The section on response: vibration of the points against the common speed of the flywheels."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mahovik.core.stand.summary import summarize
from mahovik.out.report.stand import response
from mahovik.use.study.response.periodic import periodic_response
from mahovik.use.study.response.scene import Scene
from report.stand.runs import example, material


def test_the_largest_vibration_is_that_of_the_periodic_state() -> None:
    stand = example("sat4")
    limit = max(row.speed for row in summarize(stand).unbalance)
    ((found,),) = response._sweeps(stand, limit, [(name, None) for name in response.measured_points(stand)])
    assert found.point == stand.points[0].name
    size, speed = response._largest(found)
    assert speed == pytest.approx(limit)  # nothing resonates
    spectrum = (
        periodic_response(Scene.of(stand), [limit] * 4, [found.point]).points[found.point].harmonics("acceleration")
    )
    assert size == pytest.approx(np.linalg.norm(spectrum[1:]) / np.sqrt(2.0), rel=1e-9)


def test_a_suspended_stand_has_a_diagram_about_its_natural_frequencies() -> None:
    shown = response.section(material(example("bench8")))
    assert shown is not None
    assert shown.html.count('<figure class="chart"') == 2
    assert "3000 rpm" in shown.summary


@pytest.mark.parametrize(("name", "said"), [("demo3", "Nothing shakes O1"), ("remus6", "no static equilibrium")])
def test_without_a_vibration_it_says_why(name: str, said: str) -> None:
    shown = response.section(material(example(name)))
    assert shown is not None
    assert said in shown.html
    assert "<figure" not in shown.html


def test_without_flywheels_there_is_none() -> None:
    assert response.section(material(replace(example("demo3"), flywheels=()))) is None


def test_the_report_measures_at_the_points_of_the_stand() -> None:
    """Points of the stand before its instruments, in response and jitter; amplitudes say what they are."""
    stand = example("sat4")
    assert response.measured_points(stand) == [each.name for each in stand.points] == ["acc1"]
    shown = response.section(material(stand))
    assert shown is not None
    assert "Amplitudes, 0 to peak, of the acceleration of acc1" in shown.html and "acc1" in shown.summary
    assert response.measured_points(replace(stand, points=())) == ["carrier"]
