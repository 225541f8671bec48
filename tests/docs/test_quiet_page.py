"""docs/quiet.md: its first table is that of tools/quiet_campaign.py, row by row, and what is required is reached."""

from __future__ import annotations

import importlib.util
import sys
from types import ModuleType

import pytest

from docs.pages import ROOT, cells

TOOLS = ROOT / "tools"


@pytest.fixture
def tool(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """The tool, with the module of stands beside it."""
    monkeypatch.syspath_prepend(str(TOOLS))
    spec = importlib.util.spec_from_file_location("quiet_campaign_tool", TOOLS / "quiet_campaign.py")
    assert spec is not None
    assert spec.loader is not None
    found = importlib.util.module_from_spec(spec)
    monkeypatch.setitem(sys.modules, spec.name, found)  # its data classes look for their module
    spec.loader.exec_module(found)
    return found


def test_the_tables_are_those_of_the_campaign(tool: ModuleType) -> None:
    """In order; sat4 with small differences along its axis is ten times quieter, and speeds change by little."""
    text = tool.PAGE.read_text(encoding="utf-8").split(tool.BEGIN)[1].split(tool.END)[0]
    rows = [cells(line) for line in text.splitlines() if line.startswith("|") and "---" not in line]
    sat4 = rows[1 : 1 + len(tool.SAT4)]
    for (momentum, name, axes, change, before, after, lower), row in zip(sat4, tool.SAT4, strict=True):
        assert (momentum, name, axes) == (" ".join(f"{x:g}" for x in row.momentum), row.name, row.axes)
        assert float(after) <= float(before)
        if row.required:
            assert float(lower) >= tool.REQUIRED
            assert float(change) <= row.change
    others = rows[2 + len(tool.SAT4) :]
    assert [(int(row[0]), row[1]) for row in others] == [(row.N, row.name) for row in tool.ROWS]
    assert all(float(row[6]) < 0.01 for row in others)
