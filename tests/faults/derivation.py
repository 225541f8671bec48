"""Faults in the derivation and in the numbers of the table: those of tests/verify/test_mutations.py, as a catalogue."""

from __future__ import annotations

import pytest

from verify.build import everything, failing, generated
from verify.test_mutations import DERIVATION, NUMBERS

DERIVED = {**dict.fromkeys(DERIVATION, "derivation"), **dict.fromkeys(NUMBERS, "numbers of the stand")}
"""Faults by name: where they are planted."""


def shown(name: str) -> list[str]:
    """Quantities in which the comparison with the literal reference finds a fault."""
    stand = everything()
    if name in NUMBERS:
        return sorted(failing(stand, generated(stand, numbers_of=NUMBERS[name][0](stand))))
    with pytest.MonkeyPatch.context() as patches:
        DERIVATION[name][0](patches)
        return sorted(failing(stand, generated(stand)))
