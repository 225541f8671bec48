"""README and docs/judges.md hold the tables that tools/judges_table.py writes; their numbers are the judges'."""

from __future__ import annotations

import importlib.util
import re
from types import ModuleType

from docs.pages import ROOT, cells
from mahovik.stands import names
from mahovik.verify.judges.compare import JUDGES


def tool() -> ModuleType:
    spec = importlib.util.spec_from_file_location("judges_table", ROOT / "tools" / "judges_table.py")
    assert spec is not None
    assert spec.loader is not None
    found = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(found)
    return found


def lines_of(text: str) -> list[list[str]]:
    return [cells(line) for line in text.splitlines() if line.startswith("|")]


def check_numbers(rows: list[list[str]]) -> None:
    for row in rows:
        given = [number for number in row[1:] if number]  # none for a stand without points
        assert given, row
        assert all(re.fullmatch(r"\de[+-]\d\d", number) for number in given), row
        assert all(float(number) <= 1e-10 for number in given), row


def test_the_table_of_the_readme() -> None:
    written, readme = tool(), (ROOT / "README.md").read_text(encoding="utf-8")
    text = readme.partition(written.BEGIN)[2].partition(written.END)[0]
    head, _, *rows = lines_of(text)
    assert head[0] == "generated C against"
    assert [name.split()[0] for name in head[1:]] == list(JUDGES)
    assert [row[0] for row in rows] == list(written.WORDS)
    check_numbers(rows)
    assert text.strip() + "\n" == written.table(head, rows)
    assert written.with_table(readme, text.strip() + "\n") == readme


def test_the_page() -> None:
    written, page = tool(), (ROOT / "docs" / "judges.md").read_text(encoding="utf-8")
    for judge, part in zip(JUDGES, page.split("\n## ")[1:], strict=True):
        assert part.startswith(judge)
        head, _, *rows = lines_of(part)
        assert head == ["quantity", *names()]
        assert [row[0] for row in rows] == list(written.WORDS)
        check_numbers(rows)
