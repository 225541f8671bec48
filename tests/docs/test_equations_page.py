"""docs/model.md names, of each equation, the code that has it: in each derivation, and in the C."""

from __future__ import annotations

import re

import pytest

from docs.pages import ROOT
from traceability.equations import EQUATIONS, REFERENCE, SECOND, called

PAGE = (ROOT / "docs" / "model.md").read_text(encoding="utf-8")
HEADER = (ROOT / "generated" / "bench8" / "bench8.h").read_text(encoding="ascii")


def section(equation: str) -> str:
    """The text under the heading of an equation."""
    found = re.search(rf"^### {re.escape(equation)} .*?(?=^##|\Z)", PAGE, re.DOTALL | re.MULTILINE)
    assert found is not None, equation
    return found.group()


def row(text: str) -> list[str]:
    """Derived, literal, by energies, function of the C."""
    head, _, line = (x for x in text.splitlines() if x.startswith("|"))
    assert head == "| derived for the C | literal | by energies | function of the C |"
    return [cell.strip() for cell in line.strip("|").split("|")]


@pytest.mark.parametrize("equation", EQUATIONS)
def test_each_equation_has_its_code(equation: str) -> None:
    """Formula, derivation, literal text; energies where the second derivation has something of its own."""
    text = section(equation)
    assert text.count("$$") == 2
    derived, literal, energies, _ = row(text)
    assert "`" in derived
    assert any(called(thing).split("`")[1] in literal for thing in REFERENCE[equation])
    assert energies == "-" or "`proof/second/" in energies
    assert energies != "-" or equation not in SECOND or equation in ("(6)", "(9)")


def test_functions_of_the_c_are_in_its_header() -> None:
    """Functions that name an equation in the header are named in the section of that equation."""
    for equation in EQUATIONS:
        for name in re.findall(r"`(\w+)`", row(section(equation))[3]):
            assert name == "K_dot" or f"bench8_{name}(" in HEADER, (equation, name)
    for equation, name in (("(8)", "forward"), ("(12)", "inverse"), ("(1)", "momentum"), ("(11)", "generalized")):
        assert f"`{name}`" in row(section(equation))[3]
