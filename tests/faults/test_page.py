"""docs/results/planted-faults.md lists the faults that are planted, with their checks."""

from __future__ import annotations

from docs.pages import cells, tables
from emit.stands import generated
from faults.catalogue import FAULTS
from faults.checks import CHECKS
from faults.derivation import DERIVED
from faults.page import PAGE, cell, kept
from fuzz.test_harness import FAULTS as FUZZED
from second.test_mutations import MUTATIONS
from toolchain.test_eva import FAULTS as EVA


def test_the_page_is_what_was_shown() -> None:
    assert kept() == PAGE.read_text(encoding="utf-8"), "tools/planted_faults.py --page"


def test_the_page_has_every_fault_and_how_it_showed() -> None:
    found = [[cells(line) for line in table] for table in tables(PAGE)]
    planted = [row for table in found if table[0][0] == "fault" and len(table[0]) == 4 for row in table[2:]]
    assert [(row[0], row[1], row[2]) for row in planted] == [
        (f.name, f"{f.place}, {f.host}", ", ".join(f.caught_by))
        for kind in dict.fromkeys(f.kind for f in FAULTS)
        for f in FAULTS
        if f.kind == kind
    ]
    assert all(row[3] for row in planted)
    *_, derivation, second, eva, fuzzed, checks = found
    assert [row[0] for row in eva[2:]] == list(EVA)
    assert [row[0] for row in fuzzed[2:]] == [fault.name for fault in FUZZED]
    assert [row[0] for row in derivation[2:]] == [cell(name) for name in DERIVED]
    assert all(row[2] for row in derivation[2:])
    assert [row[0] for row in second[2:]] == list(MUTATIONS)
    assert [row[0] for row in checks[2:]] == list(CHECKS)


def test_what_other_lists_replace_is_in_the_c() -> None:
    text = generated("demo3").files["demo3.c"]
    assert [name for name, (_, right, _) in EVA.items() if right not in text] == []
    assert [fault.name for fault in FUZZED if fault.old not in text] == []
