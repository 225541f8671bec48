"""Tables of docs/results/traceability.md, from what the campaign found and from generated/ as it is."""

from __future__ import annotations

from typing import Any

from traceability.equations import DERIVED, EQUATIONS, OTHERS, REFERENCE, SECOND, called
from traceability.lines import spans
from traceability.mutants import MUTANTS, chosen


def text(found: dict[str, dict[str, Any]]) -> str:
    """The tables; `found`: findings by function."""
    places, planted, compared, tested = (
        sum(of(f) for f in found.values()) for of in (_places, mutants_of, _compared, tried)
    )
    caught = sum(noticed(f) for f in found.values()) - compared
    parts = [f"{len(found)} functions with {places} places to change: {planted} mutants. "]
    parts += [
        f"The comparison noticed {compared}. Of the {planted - compared} that it let through, {tested} were tried "
    ]
    never = planted - compared - tested
    parts += [f"by tests, which noticed {caught}; the other {never} have never been tried.\n\n"]
    parts += ["## Equations\n\n", equations(found), "\n## Functions\n\n", functions(found)]
    parts += ["\n## What nothing noticed\n\n", survivors(found)]
    return "".join(parts)


def mutants_of(found: dict[str, Any]) -> int:
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
    """One row per equation: derivations and program functions."""
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
    """One row per function: what it is for, lines of C, mutants, tests."""
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
        counts = [f["sites"], mutants_of(f), f["comparison"], tried(f), f["tests"]]
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
