"""Static checks: compilers and an analyser, which must be silent; cppcheck's MISRA addon, whose findings are listed."""

from __future__ import annotations

import json
import shlex

from mahovik.proof.evidence.piece import Outcome, Piece, Subject, Table, Tell, judged, program


def _silence(subject: Subject, tell: Tell) -> Outcome:
    from mahovik.core.toolchain.static_checks import COMPILERS, version, warned

    tell("gcc, clang, clang --analyze")
    files = [*subject.sources, f"{subject.stand.name}_selftest.c"]
    found = warned(subject.c, files)
    figure = f"{len(found)} complaints" if found else f"{len(files)} files, no complaint"
    text = "".join(f"{line}\n" for line in found) or "no complaint\n"
    return Outcome(
        judged(not found),
        figure,
        tuple(version(each) for each in COMPILERS),
        notes=tuple(found[:20]),
        files={"output.txt": text},
    )


def _silence_command(subject: Subject) -> str:
    from mahovik.core.toolchain.static_checks import ANALYSER, WARNINGS

    files = " ".join(f"c/{each}" for each in subject.sources)
    flags = shlex.join(WARNINGS)
    both = " && ".join(f"{compiler} {flags} -O2 -fsyntax-only {files}" for compiler in ("gcc", "clang"))
    return f"{both} && {shlex.join(ANALYSER)} {files}"


def _misra(subject: Subject, tell: Tell) -> Outcome:
    from mahovik.core.toolchain.static_checks import DEVIATIONS, KNOWN, counted, findings, version

    tell("cppcheck")
    found = findings(subject.c, subject.sources)
    reasons, counts = {**DEVIATIONS, **KNOWN}, counted(found)
    unlisted = sorted(rule for rule in counts if rule not in reasons)
    order = [*unlisted, *(rule for rule in reasons if rule in counts)]
    rows = tuple((rule, str(counts[rule]), reasons.get(rule, "NOT LISTED")) for rule in order)
    figure = f"{sum(counts.values())} findings under {len(counts)} rules, each listed with its reason"
    if unlisted:
        figure = f"findings that are not listed: {', '.join(unlisted)}"
    text = json.dumps([{"rule": f.rule, "file": f.file, "line": f.line} for f in found], indent=1) + "\n"
    table = Table(("rule", "times>", "why it stays"), rows)
    return Outcome(judged(not unlisted), figure, (version("cppcheck"),), table, files={"findings.json": text})


def _misra_command(subject: Subject) -> str:
    from mahovik.core.toolchain.static_checks import CPPCHECK

    return f"cd c && {shlex.join(CPPCHECK)} {' '.join(subject.sources)}"


WARNINGS = Piece(
    name="warnings",
    title="Compilers and an analyser are silent",
    shows="gcc and clang with strict warnings as errors, and clang's static analyser, have no complaint.",
    limits="What no warning is made for. Other compilers warn of other things.",
    command=_silence_command,
    run=_silence,
    needs=lambda _: (program("gcc"), program("clang")),
)

MISRA = Piece(
    name="misra",
    title="cppcheck and its MISRA C:2012 addon",
    shows="Everything that they find is listed, with the reason why it stays; one that is not listed is a failure.",
    limits=(
        "MISRA compliance, which is not claimed: the addon checks a part of the rules, some more strictly or more "
        "loosely than their text."
    ),
    command=_misra_command,
    run=_misra,
    needs=lambda _: (program("cppcheck"),),
)
