"""Envelopes in the report: every facet drawn, the figures those of `check`, nothing without motors."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mahovik.core.stand.capacity import torque_capacity
from mahovik.core.stand.envelope import envelope
from mahovik.out.report.stand import envelopes
from report.stand.runs import example, material


def test_sat4_has_both_polyhedra_with_all_facets() -> None:
    stand = example("sat4")
    found = envelopes.section(material(stand))
    assert found is not None
    assert found.html.count('class="drawing"') == 2
    assert found.html.count("<title>") == 2 * 2 * len(torque_capacity(stand).envelope.facets)
    assert "326.6" in found.html and "19.596" in found.html  # mN m and N m s in every direction
    assert "326.6 mN m in every direction" in found.summary


def test_wheels_that_span_no_space_are_drawn_flat() -> None:
    for columns in (np.eye(3)[:2], np.eye(3)[:1]):
        drawing = envelopes.draw(envelope(columns), "flat")
        assert drawing.startswith("<svg") and "nan" not in drawing


def test_there_is_none_without_limits_of_motors() -> None:
    stand = example("sat4")
    bare = replace(stand, flywheels=tuple(replace(s, motor=None) for s in stand.flywheels))
    assert envelopes.section(material(bare)) is None
