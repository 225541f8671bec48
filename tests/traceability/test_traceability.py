"""Every equation has derivations, functions and tests; the page says what is there."""

from __future__ import annotations

import fnmatch
import inspect
import re

import pytest
import traceability_campaign as written

from emit.stands import generated
from traceability import page
from traceability.campaign import compared, without_mutant_all_agree
from traceability.equations import DERIVED, EQUATIONS, OTHERS, REFERENCE, ROLES, ROOT, SECOND, numbers, subjects
from traceability.lines import functions, spans
from traceability.mutants import chosen, mutant, planted, sites
from traceability.survivors import REASONS, reason
from traceability.test_later_laws import OF_LATER_LAWS


def test_the_equations_are_those_of_the_model() -> None:
    model = (ROOT / "docs" / "model.md").read_text(encoding="utf-8")
    assert set(EQUATIONS) <= set(numbers(model))
    assert list(EQUATIONS) == [f"({n})" for n in range(1, 14) if n != 3]
    assert set(DERIVED) == set(REFERENCE) == {*EQUATIONS, *OTHERS}
    assert set(SECOND) <= set(EQUATIONS)


def test_who_derives_an_equation_says_so() -> None:
    for equation in EQUATIONS:
        for things in (DERIVED[equation], REFERENCE[equation]):
            said = {n for thing in things for n in numbers(inspect.getsource(inspect.getmodule(thing) or thing))}
            assert not things or equation in said, equation
    assert [equation for equation in EQUATIONS if not DERIVED[equation]] == ["(12)", "(13)"]
    assert all(REFERENCE[equation] for equation in EQUATIONS)


def test_every_function_of_a_stand_has_an_equation_or_a_purpose() -> None:
    for name in ("bench8", "sat4"):
        for function in generated(name).program.functions:
            assert subjects(function)
            assert function.purpose


NOT_EXAMINED = {"balance", *OF_LATER_LAWS}
"""Names of ROLES that no function of the campaign's stands has; mutants of the later laws have tests of their own."""


@pytest.mark.slow
def test_every_function_of_every_stand_has_been_examined() -> None:
    names = set(functions())
    assert {name for of in functions().values() for name in subjects(of)} >= set(EQUATIONS) - {"(13)"}
    assert all(fnmatch.filter(names, name) for listed in ROLES.values() for name in set(listed) - NOT_EXAMINED)
    assert set(written.CAMPAIGN.figures()["functions"]) == names
    for name, found in written.CAMPAIGN.figures()["functions"].items():
        assert found["subjects"] == subjects(functions()[name])


def test_most_mutants_are_noticed_and_the_others_are_explained() -> None:
    found = written.CAMPAIGN.figures()["functions"]
    for name, f in found.items():
        assert page.noticed(f) + len(f["survivors"]) == f["mutants"], name
        assert f["mutants"] or not f["sites"], name
        assert all(reason(name, what) for what in f["survivors"]), (name, f["survivors"])
    told = {(name, what) for name, f in found.items() for what in f["survivors"]}
    assert all(any(n == name and w.startswith(begin) for n, w in told) for name, begin in REASONS)


def test_the_comparison_passes_without_a_mutant_and_fails_with_one() -> None:
    without_mutant_all_agree("momentum_screw")
    assert all(compared("momentum_screw", [0, 1]))
    with pytest.raises(AssertionError, match="without a mutant differs in"):
        without_mutant_all_agree("momentum_screw", planted("momentum_screw", 0))


def test_lines_are_those_of_the_definition() -> None:
    stand, first, last = spans()["forward"]
    lines = (ROOT / "generated" / stand / f"{stand}.c").read_text().splitlines()[first - 1 : last]
    assert re.match(rf"{stand}_status {stand}_forward\(", lines[0])
    assert lines[-1] == "}"
    assert "}" not in lines[:-1]


def test_mutants_differ_and_are_numbered() -> None:
    function = generated("bench8").program.function("factor3")
    kinds = [mutant(function, number)[1] for number in range(sites(function))]
    assert {"sign of a term", "term dropped", "comparison turned round", "minus dropped"} & set(kinds)
    assert kinds.count("sign of a term") == kinds.count("term dropped") == 4  # differences: d2, p32, two of d3
    with pytest.raises(IndexError, match="factor3 has"):
        mutant(function, sites(function))


def test_chosen_mutants_are_spread() -> None:
    assert chosen(3, 6) == [0, 1, 2]
    assert len(chosen(100, 6)) == 6
    assert chosen(100, 6)[0] < 20
    assert chosen(100, 6)[-1] > 80


def test_numbers_of_equations() -> None:
    assert numbers("(2), (6)-(9)") == ["(2)", "(6)", "(7)", "(8)", "(9)"]
    assert numbers("") == []
