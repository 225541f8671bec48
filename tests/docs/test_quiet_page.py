"""docs/results/quiet.md: the first table is that of tools/quiet_campaign.py; what is required is reached."""

from __future__ import annotations

import quiet_campaign as tool

from docs.pages import cells


def test_the_tables_are_those_of_the_campaign() -> None:
    """In order; sat4 with small differences along its axis is ten times quieter, and speeds change by little."""
    text = tool.BLOCK.text()
    rows = [cells(line) for line in text.splitlines() if line.startswith("|") and "---" not in line]
    sat4 = rows[1 : 1 + len(tool.SAT4)]
    for (momentum, name, axes, change, before, after, lower), row in zip(sat4, tool.SAT4, strict=True):
        assert (momentum, name, axes) == (" ".join(f"{x:g}" for x in row.momentum), row.name, row.axes)
        assert float(after) <= float(before)
        if row.required:
            assert row.change is not None
            assert float(lower) >= tool.REQUIRED
            assert float(change) <= row.change
    others = rows[2 + len(tool.SAT4) :]
    assert [(int(row[0]), row[1]) for row in others] == [(row.N, row.name) for row in tool.ROWS]
    assert all(float(row[6]) < 0.01 for row in others)
