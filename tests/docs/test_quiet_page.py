"""docs/results/quiet.md: the figures are those of tools/quiet_campaign.py; what is required is reached."""

from __future__ import annotations

import quiet_campaign as tool


def test_what_is_required_is_reached() -> None:
    """In order; sat4 with small differences along its axis is ten times quieter, and speeds change by little."""
    found = tool.CAMPAIGN.figures()
    for line, row in zip(found["sat4"], tool.SAT4, strict=True):
        assert (line["momentum, N m s"], line[""], line["axes"]) == (list(row.momentum), row.name, row.axes)
        assert line["simulated after"] <= line["RMS before, m/s2"] * (1 + 1e-6), "beyond what simulation resolves"
        if row.required:
            assert row.change is not None
            assert line["times lower"] >= tool.REQUIRED
            assert line["change of speeds, rpm"] <= row.change
    assert [(line["wheels"], line[""]) for line in found["random"]] == [(row.N, row.name) for row in tool.ROWS]
    assert all(line["simulated less expected, of RMS before"] < 0.01 for line in found["random"])
