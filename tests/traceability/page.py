"""docs/results/traceability.md, from what the campaign found and from generated/ as it is."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any

from mahovik.core.program.function import Function
from traceability.equations import DERIVED, EQUATIONS, OTHERS, REFERENCE, ROOT, SECOND, called, subjects
from traceability.lines import spans
from traceability.mutants import MUTANTS, chosen

FOUND = ROOT / "tests" / "traceability" / "found.json"
PAGE = ROOT / "docs" / "results" / "traceability.md"

HEAD = """# From equation to test

Written by `make traceability` (the lines of C alone: `make traceability-page`). For each equation of
[the model](../model.md): who derives it, three times without a shared formula; which functions of the program have it;
where these stand in the C of an example stand; how many mutants of each were made, and what noticed them.

A mutant is one operation changed: a sign, a term dropped, a number times 1.5, a comparison turned round, a loop one
turn short; of each function at most ten, spread over its places. `comparison` is that of `mahovik verify`, the program
against the literal reference, at two states; the quantities that differed are named, and `StandError` where the mutant
gives no answer at all. Of the mutants that it lets through, only the first is planted into every program that the
tests of such a function make: it is *tried*, and the tests that failed are named; the others have not been tried. What
was tried and nothing noticed is [listed](#what-nothing-noticed). (12) is (8) with other unknowns and needs no
derivation; (13) is not emitted.

"""


NOT_YET: tuple[str, ...] = ("center_of_mass_velocity",)
"""Functions whose mutants have not been run yet; `make traceability` examines them, and then they go from here."""


def keep(found: dict[str, Any], functions: Sequence[Function]) -> None:
    """Adds what was found of a function to FOUND, in the order of the program; functions that are gone are left out."""
    old = stored()
    about = {f.name: subjects(f) for f in functions}
    old[found["function"]] = found
    kept = {name: {**old[name], "subjects": about[name]} for name in about if name in old}
    FOUND.write_text(json.dumps(kept, indent=1) + "\n", encoding="utf-8")


def stored() -> dict[str, dict[str, Any]]:
    """What was found, by function."""
    return json.loads(FOUND.read_text(encoding="utf-8")) if FOUND.is_file() else {}


def write() -> None:
    """Writes the page."""
    PAGE.write_text(text(), encoding="utf-8")


def text() -> str:
    """The page."""
    found = stored()
    places, planted, compared, tested = (sum(of(f) for f in found.values()) for of in (_places, made, _compared, tried))
    caught = sum(noticed(f) for f in found.values()) - compared
    parts = [HEAD, f"{len(found)} functions with {places} places to change: {planted} mutants. "]
    parts += [
        f"The comparison noticed {compared}. Of the {planted - compared} that it let through, {tested} were tried "
    ]
    parts += [f"by tests, which noticed {caught}.\n\n"]
    parts += ["## Equations\n\n", equations(found), "\n## Functions\n\n", functions(found)]
    parts += ["\n## What nothing noticed\n\n", survivors(found)]
    if NOT_YET:
        parts += ["\n## Not examined yet\n\n", "Mutants of these have not been run: "]
        parts += [", ".join(f"`{name}`" for name in NOT_YET), ".\n"]
    return "".join(parts)


def made(found: dict[str, Any]) -> int:
    """How many mutants of a function were made."""
    return len(chosen(found["sites"], MUTANTS))


def tried(found: dict[str, Any]) -> int:
    """How many mutants of a function tests were run on."""
    return int(found["mutants"] - found["comparison"])


def _places(found: dict[str, Any]) -> int:
    return int(found["sites"])


def _compared(found: dict[str, Any]) -> int:
    return int(found["comparison"])


def noticed(found: dict[str, Any]) -> int:
    """How many mutants of a function were noticed."""
    return int(found["comparison"] + found["tests"])


def equations(found: dict[str, dict[str, Any]]) -> str:
    """One row an equation: derivations and program functions."""
    lines = [
        "| equation | says | derived in | literally in | by energies in | functions |",
        "|---|---|---|---|---|---|",
    ]
    for key, says in {**EQUATIONS, **OTHERS}.items():
        by = [f"[`{name}`](#functions)" for name, f in found.items() if key in f["subjects"]]
        cells = [", ".join(called(thing) for thing in of.get(key, ())) or "–" for of in (DERIVED, REFERENCE, SECOND)]
        lines.append(f"| {key} | {says.replace('|', '')} | {' | '.join(cells)} | {', '.join(by) or '–'} |")
    return "\n".join(lines) + "\n"


def functions(found: dict[str, dict[str, Any]]) -> str:
    """One row a function: what it is for, lines of C, mutants, tests."""
    where = spans()
    heads = ("function", "has", "lines of C", "places", "mutants", "by comparison", "tried", "noticed", "differed")
    lines = [f"| {' | '.join(heads)} | tests that failed |", "|---|---|---|---:|---:|---:|---:|---:|---|---|"]
    for name, f in found.items():
        place = "–"
        if name in where:
            stand, first, last = where[name]
            place = f"[{stand}.c {first}-{last}](../../generated/{stand}/{stand}.c)"
        quantities = f["quantities"][:5] + (["..."] if len(f["quantities"]) > 5 else [])
        tests = [f"`{t}`" if "::" in t else t for t in f["noticed"][:4]]
        tests += [f"{len(f['noticed']) - 4} more"] if len(f["noticed"]) > 4 else []
        counts = [f["sites"], made(f), f["comparison"], tried(f), f["tests"]]
        cells = [f"`{name}`", ", ".join(f["subjects"]), place, *map(str, counts)]
        lines.append(f"| {' | '.join([*cells, ', '.join(quantities) or '–', ', '.join(tests) or '–'])} |")
    return "\n".join(lines) + "\n"


def survivors(found: dict[str, dict[str, Any]]) -> str:
    """The mutants that nothing noticed, with the reason where there is one."""
    from traceability.survivors import reason

    lines = ["| function | mutant | why |", "|---|---|---|"]
    for name, f in found.items():
        for what in f["survivors"]:
            lines.append(f"| `{name}` | {what.replace('|', '&#124;')} | {reason(name, what)} |")
    return "\n".join(lines) + "\n" if len(lines) > 2 else "None.\n"
