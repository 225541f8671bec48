"""docs/results/diagnosis.md holds what tools/explain_campaign.py --write says, fault by fault."""

from __future__ import annotations

import explain_campaign as written

from docs.pages import ROOT, cells
from mahovik.proof.diagnose.faults import DICTIONARY

PAGE = ROOT / "docs" / "results" / "diagnosis.md"


def parts() -> tuple[str, list[list[list[str]]]]:
    """The sentence, and the three tables as cells."""
    text = written.BLOCK.text()
    words, *tables = text.split("\n\n")
    return words, [[cells(line) for line in table.splitlines()] for table in tables]


def test_the_results_on_the_page() -> None:
    words, (kinds, right, faults) = parts()
    assert "named first" in words.replace("\n", " ")
    assert [tuple(table[0]) for table in (kinds, right, faults)] == [
        written.KINDS_HEAD,
        written.RIGHT_HEAD,
        written.DICTIONARY_HEAD,
    ]
    assert {row[0] for row in kinds[2:]} >= {*written.SINGLE, written.PART, written.TWO}
    single = [row for row in kinds[2:] if row[0] in written.SINGLE]
    planted, first = sum(int(row[1]) for row in single), sum(int(row[2]) + int(row[3]) for row in single)
    assert first >= written.LEAST * planted
    assert f"Of {planted} single faults" in words
    assert [row[2] for row in right[2:]] == ["0"] * len(right[2:])


def test_every_fault_is_on_the_page() -> None:
    _, (_, _, faults) = parts()
    listed = [(row[0], row[1], row[2]) for row in faults[2:]]
    assert listed == [(f.name.replace("|", "\\|"), f.equation, f.words.replace("|", "\\|")) for f in DICTIONARY]
    assert sum(int(row[3]) > 0 for row in faults[2:]) >= 30


def test_the_summary() -> None:
    outcomes = [
        written.Outcome("K* missing", written.WHOLE, "alone"),
        written.Outcome("K* missing", written.ALONE, "equals"),
        written.Outcome("gravity, sign", written.WHOLE, "other"),
        written.Outcome("gravity, sign", written.WHOLE, "unseen"),
    ]
    text = written.summary(2, outcomes, [written.Outcome("C", "correct", "named")])
    assert text.startswith(
        "2 random stands. Of 3 single faults that the stand lets one see, 2 were named first (66.7%)"
    )
    assert f"| {written.WHOLE} | 2 | 1 | 0 | 1 | 50% |" in text
    assert "| C | 1 | 1 |" in text


def test_the_verdict() -> None:
    from mahovik.proof.diagnose.diagnosis import Cause, Diagnosis
    from mahovik.proof.diagnose.predict import Part

    first, second = DICTIONARY[:2]
    found = Diagnosis("named", (Cause((Part(first),), 1.0, 0.0), Cause((Part(second),), 1.0, 0.0)))
    assert written.verdict(found, [first.name]) == "equals"
    assert written.verdict(Diagnosis("named", found.causes[:1]), [first.name]) == "alone"
    assert written.verdict(found, [first.name, second.name]) == "other"
    assert written.verdict(Diagnosis("unknown"), [first.name]) == "none"
    assert written.verdict(Diagnosis("equal"), [first.name]) == "unseen"
