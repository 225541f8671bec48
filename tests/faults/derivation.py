"""Faults in the derivation and in the numbers of the table: those of tests/verify/test_mutations.py, as a catalogue."""

from __future__ import annotations

from verify.test_mutations import DERIVATION, NUMBERS

DERIVED: dict[str, tuple[str, tuple[str, ...]]] = {
    **{name: ("derivation", tuple(sorted(found))) for name, (_, found) in DERIVATION.items()},
    **{name: ("numbers of the stand", tuple(sorted(found))) for name, (_, found) in NUMBERS.items()},
}
"""Where each fault is planted, and quantities in which the comparison must see it, by name of the fault."""
