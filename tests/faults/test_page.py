"""docs/results/planted-faults.md says how each planted fault showed."""

from __future__ import annotations

import planted_faults as written

from emit.stands import generated
from faults.catalogue import FAULTS
from fuzz.test_harness import FAULTS as FUZZED
from toolchain.test_eva import FAULTS as EVA


def test_how_every_fault_showed_is_kept() -> None:
    """`make faults` plants those that are not there."""
    shown = written.CAMPAIGN.figures()["shown"]
    assert [fault.name for fault in FAULTS if len(shown.get(fault.name, ())) != len(fault.caught_by)] == []
    assert all(words for said in shown.values() for words in said)


def test_what_other_lists_replace_is_in_the_c() -> None:
    text = generated("demo3").files["demo3.c"]
    assert [name for name, (_, right, _) in EVA.items() if right not in text] == []
    assert [fault.name for fault in FUZZED if fault.old not in text] == []
