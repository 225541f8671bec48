"""docs/results/rounding.md: written by tools/rigorous.py; the tolerances of `verify` stand well above its figures."""

from __future__ import annotations

import importlib.util
import sys
from functools import cache
from types import ModuleType

import pytest

from docs.pages import ROOT, cells
from mahovik.contract.functions import wants_of
from mahovik.proof.verify.bounds import BOUNDS
from mahovik.proof.verify.rounding.limits import MARGIN, ULPS
from mahovik.stands import names

REALS = ("double", "float")
Row = dict[str, str]


@cache
def tool() -> ModuleType:
    spec = importlib.util.spec_from_file_location("rigorous_tool", ROOT / "tools" / "rigorous.py")
    assert spec is not None
    assert spec.loader is not None
    found = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = found  # its data classes look for their module
    spec.loader.exec_module(found)
    return found


def tables(real: str) -> list[list[Row]]:
    """The tables under the heading of an element type, as rows by the names of the head."""
    page = (ROOT / "docs" / "results" / "rounding.md").read_text(encoding="utf-8")
    part = page.split(f"\n## {real.capitalize()}\n")[1].split("\n## ")[0]
    found: list[list[Row]] = []
    for paragraph in part.split("\n\n"):
        lines = [cells(line) for line in paragraph.splitlines() if line.startswith("|")]
        if lines:
            head, _, *rows = lines
            found.append([dict(zip(head, row, strict=True)) for row in rows])
    return found


def key(row: Row) -> tuple[str, str]:
    return row["want"].strip("`"), row["quantity"].strip("`")


@pytest.mark.parametrize("real", REALS)
def test_tolerances_follow_from_the_measured_errors(real: str) -> None:
    """Three times what C and judge may differ by, of the example stands and of the random ones."""
    examples, _, random = tables(real)
    for row in (*examples, *random):
        apart = float(row["of scale"]) + float(row["judges of scale"])
        assert BOUNDS[real].of(*key(row)) >= MARGIN * apart, row
        assert float(row["accepted"]) == BOUNDS[real].of(*key(row)), row


@pytest.mark.parametrize("real", REALS)
def test_errors_are_within_what_is_promised(real: str) -> None:
    """And of one size with one another: ulp, and error over scale."""
    limit, bits = ULPS[real] or 50.0, {"double": 52, "float": 23}[real]
    for row in (*tables(real)[0], *tables(real)[2]):
        assert float(row["ulp"]) <= limit
        assert float(row["of scale"]) <= float(row["ulp"]) * 2.0**-bits * 1.1
        assert float(row["function alone"]) <= limit


@pytest.mark.parametrize("real", REALS)
def test_forward_is_right_to_fifty_ulp_on_every_example_stand(real: str) -> None:
    forward = next(row for row in tables(real)[1] if key(row) == ("forward", "V_dot"))
    assert list(forward) == ["want", "quantity", *names(), tool().RANDOM]
    assert all(0.0 < float(forward[name]) <= 50.0 for name in (*names(), tool().RANDOM))


@pytest.mark.parametrize("real", REALS)
def test_nothing_is_left_out(real: str) -> None:
    """Every quantity that has an enclosure, in both tables."""
    examples, stands, random = tables(real)
    assert {want for want, _ in map(key, examples)} == set(wants_of("rigorous"))
    assert list(map(key, examples)) == list(map(key, random))
    assert {want for want, _ in map(key, stands)} == set(tool().SHORT)


def test_the_page_is_what_the_tool_writes() -> None:
    """Its words; the figures are the tool's alone."""
    written, page = tool(), (ROOT / "docs" / "results" / "rounding.md").read_text(encoding="utf-8")
    head = written.INTRODUCTION.format(limit=f", or in double above {ULPS['double']:g} ulp")
    assert page.startswith(head)
    assert page.endswith(
        "`generalized`, `points` and `inverse` have no enclosure" + written.FOLLOWS.split("enclosure")[1]
    )


def test_the_worst_of_stands_is_the_largest_of_each() -> None:
    written = tool()
    first, second = written.Worst(1.0, 5.0, judges=2.0, own=(1.0, 9.0)), written.Worst(2.0, 3.0, own=(3.0,))
    total = written.joined([{("torque", "tau"): first}, {("torque", "tau"): second, ("forward", "V_dot"): first}])
    assert list(total) == [("forward", "V_dot"), ("torque", "tau")]
    assert total["torque", "tau"] == written.Worst(2.0, 5.0, 2.0, 0.0, 0.0, (1.0, 9.0, 3.0))
    assert total["torque", "tau"].relative == 3.0
    assert total["forward", "V_dot"] == first
