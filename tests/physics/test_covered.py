"""docs/verification.md says which property covers which invariant: all of them, and no test that is not there."""

from __future__ import annotations

import re
from pathlib import Path

HERE = Path(__file__).parent
PAGE = HERE.parents[1] / "docs" / "verification.md"


def test_every_property_is_in_the_table_of_invariants_and_nothing_else() -> None:
    section = PAGE.read_text(encoding="utf-8").partition("## Random stands")[2].partition("\n## ")[0]
    told = set(re.findall(r"`(test_\w+)`", section))
    sources = [path.read_text(encoding="utf-8") for path in HERE.glob("test_hypothesis*.py")]
    properties = {name for text in sources for name in re.findall(r"^@given\(.*?\)\ndef (test_\w+)", text, re.M | re.S)}
    assert len(properties) > 12
    assert told == properties
