"""index.html of a folder of evidence: a table, then a section for each piece; no script, nothing is loaded."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from html import escape
from typing import Any

from markupsafe import Markup

from mahovik import __version__
from mahovik.core.emit.generate import describe_bodies
from mahovik.core.emit.templates import template
from mahovik.core.stand.identity import identities
from mahovik.proof.evidence.collect import NO_VERDICT, PieceResult, Subject, Table, Verdict

LONG = 14
"""Least number of rows of a table that is folded at first."""

GENERAL = (
    ("Sine, cosine, square root, arc tangent: bounds of their errors, and how they are known", "docs/proofs.md"),
    ("Faults planted in the emitted C and in the derivations, each caught by a test", "docs/verification.md"),
    ("Millions of executions of the example stands' C; what Frama-C proves; MISRA C:2012", "docs/results.md"),
    ("Largest differences to other multibody programs over the example stands", "docs/results.md"),
)
"""Evidence for the generator as a whole, and its page in the repository."""

_STYLE = {Verdict.PASSED: "good", Verdict.FAILED: "bad"} | dict.fromkeys(NO_VERDICT, "open")


def html(subject: Subject, found: Sequence[PieceResult]) -> str:
    """The page."""
    names, failed = identities(subject.stand), failures(found)
    return template("evidence.html.j2").render(
        name=subject.stand.name,
        bodies=describe_bodies(subject.stand),
        real=subject.real,
        structure=names.structure,
        physics=names.physics,
        version=__version__,
        extent="full" if subject.full else "quick",
        stand_file=subject.stand_file,
        conclusion=conclusion(found),
        style="bad" if failed else "good" if all(each.outcome.verdict is Verdict.PASSED for each in found) else "open",
        general=GENERAL,
        pieces=[_piece(each) for each in found],
    )


def conclusion(found: Sequence[PieceResult]) -> str:
    """The verdict over all, in one line."""
    counts = Counter(each.outcome.verdict for each in found)
    ran = counts[Verdict.PASSED] + counts[Verdict.FAILED]
    words = f"{counts[Verdict.PASSED]} of {ran} pieces passed" if ran else "no piece was run"
    if bad := failures(found):
        words += f"; FAILED: {', '.join(bad)}"
    for verdict in NO_VERDICT:
        if names := [each.piece.name for each in found if each.outcome.verdict is verdict]:
            words += f"; {verdict.value}: {', '.join(names)}"
    return words


def failures(found: Sequence[PieceResult], strict: bool = False) -> list[str]:
    """Names of pieces that failed; `strict`: of those without their tools as well."""
    bad = {Verdict.FAILED, *((Verdict.MISSING,) if strict else ())}
    return [each.piece.name for each in found if each.outcome.verdict in bad]


def _piece(each: PieceResult) -> dict[str, Any]:
    piece, outcome = each.piece, each.outcome
    return {
        "name": piece.name,
        "title": piece.title,
        "verdict": outcome.verdict.value,
        "style": _STYLE[outcome.verdict],
        "figure": outcome.figure,
        "shows": _text(piece.shows),
        "limits": _text(piece.limits),
        "command": _command(each.command),
        "tools": ", ".join(outcome.tools),
        "notes": [_text(note) for note in outcome.notes],
        "table": _table(outcome.table),
        "files": [f"raw/{piece.name}/{name}" for name in outcome.files],
    }


def _table(table: Table | None) -> dict[str, Any] | None:
    if table is None:
        return None
    right = [name.endswith(">") for name in table.head]
    return {
        "head": [
            (name.removesuffix(">"), "number" if is_right else "")
            for name, is_right in zip(table.head, right, strict=True)
        ],
        "rows": [
            [(cell, "number" if is_right else "") for cell, is_right in zip(row, right, strict=True)]
            for row in table.rows
        ],
        "closed": len(table.rows) >= LONG,
        "count": len(table.rows),
    }


def _command(text: str) -> Markup:
    """A command whose words are not broken at their hyphens."""
    return Markup(" ").join(Markup(f"<span>{escape(word)}</span>") for word in text.split(" "))


def _text(text: str) -> Markup:
    """A paragraph; code between backticks."""
    pieces = enumerate(re.split(r"`([^`]*)`", text))
    return Markup("").join(Markup(f"<code>{escape(p)}</code>" if i % 2 else escape(p)) for i, p in pieces)
