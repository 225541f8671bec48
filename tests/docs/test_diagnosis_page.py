"""docs/results/diagnosis.md: nearly all planted faults are named, fault by fault."""

from __future__ import annotations

import explain_campaign as written

from mahovik.proof.diagnose.faults import DICTIONARY


def test_what_the_campaign_must_show() -> None:
    """Nearly all single faults are named first; no correct program is given a fault."""
    found = written.CAMPAIGN.figures()
    assert {row["planted"] for row in found["kinds"]} >= {*written.SINGLE, written.TWO}
    single = [row for row in found["kinds"] if row["planted"] in written.SINGLE]
    planted = sum(row["visible"] for row in single)
    assert sum(row["named first"] + row["with equals"] for row in single) >= written.LEAST * planted
    for row in found["kinds"]:
        assert row["named first"] + row["with equals"] + row["not"] == row["visible"]
    assert [row["given a fault"] for row in found["correct"]] == [0] * len(found["correct"])


def test_every_fault_was_planted_or_is_listed() -> None:
    found = written.CAMPAIGN.figures()
    names = {fault.name for fault in DICTIONARY}
    kept = {row["fault"]: row for row in found["faults"]}
    assert set(kept) <= names
    assert all(row["named first"] <= row["planted"] for row in kept.values())
    assert sum(row["planted"] > 0 for row in kept.values()) >= 30
    assert ("Not planted yet: " in written.page(found)) is bool(names - set(kept))


def test_the_summary() -> None:
    outcomes = [
        written.Outcome("K* missing", written.WHOLE, "alone"),
        written.Outcome("K* missing", written.ALONE, "equals"),
        written.Outcome("gravity, sign", written.WHOLE, "other"),
        written.Outcome("gravity, sign", written.WHOLE, "unseen"),
    ]
    text = written.page(written.figures(2, outcomes, [written.Outcome("C", "correct", "named")]))
    assert text.startswith(
        "2 random stands, 3 held ones. Of 3 single faults that are visible on the stand, 2 were named first (66.7%)"
    )
    assert f"| {written.WHOLE} | 2 | 1 | 0 | 1 | 50% |" in text
    assert "| C | 1 | 1 |" in text


def test_the_verdict() -> None:
    from mahovik.proof.diagnose.diagnosis import Cause, Diagnosis
    from mahovik.proof.diagnose.predict import Part

    first, second = DICTIONARY[:2]
    found = Diagnosis("named", (Cause((Part(first),), 0.0), Cause((Part(second),), 0.0)))
    assert written.verdict(found, [first.name]) == "equals"
    assert written.verdict(Diagnosis("named", found.causes[:1]), [first.name]) == "alone"
    assert written.verdict(found, [first.name, second.name]) == "other"
    assert written.verdict(Diagnosis("unknown"), [first.name]) == "none"
    assert written.verdict(Diagnosis("equal"), [first.name]) == "unseen"
