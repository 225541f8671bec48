"""The data file of formulas, which `generate` reads, is what SymPy derives now."""

from __future__ import annotations

from mahovik.core.formula.derived import FILE
from mahovik.core.formula.ordering import derive_all


def test_the_file_is_what_the_derivation_gives() -> None:
    assert derive_all() == FILE.read_text(encoding="ascii"), "run tools/formulas.py"
