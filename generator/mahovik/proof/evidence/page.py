"""index.html of a folder of evidence: a table, then a section for each piece; no script, nothing is loaded."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from html import escape

from markupsafe import Markup

from mahovik import __version__
from mahovik.core.emit.generate import describe_bodies
from mahovik.core.emit.templates import template
from mahovik.core.stand.identity import identities
from mahovik.proof.evidence.piece import NO_VERDICT, PieceResult, Subject, Verdict

GENERAL = (
    ("Sine, cosine, square root, arc tangent: bounds of their errors, and how they are known", "docs/proofs.md"),
    ("Faults planted in the emitted C and in the derivations, each caught by a test", "docs/verification.md"),
    ("Millions of executions of the example stands' C; what Frama-C proves; MISRA C:2012", "docs/results.md"),
    ("Largest differences to other multibody programs over the example stands", "docs/results.md"),
)
"""Evidence for the generator as a whole, and its page in the repository."""

_STYLE = {Verdict.PASSED: "good", Verdict.FAILED: "bad"} | dict.fromkeys(NO_VERDICT, "open")


def html(subject: Subject, results: Sequence[PieceResult]) -> str:
    """The page."""
    names, all_good = identities(subject.stand), all(each.outcome.verdict is Verdict.PASSED for each in results)
    return template("evidence.html.j2").render(
        subject=subject,
        bodies=describe_bodies(subject.stand),
        structure=names.structure,
        physics=names.physics,
        version=__version__,
        conclusion=conclusion(results),
        style="bad" if failures(results) else "good" if all_good else "open",
        styles=_STYLE,
        general=GENERAL,
        results=results,
        text=_text,
        command=_command,
    )


def conclusion(results: Sequence[PieceResult]) -> str:
    """The verdict over all, in one line."""
    counts = Counter(each.outcome.verdict for each in results)
    ran = counts[Verdict.PASSED] + counts[Verdict.FAILED]
    words = f"{counts[Verdict.PASSED]} of {ran} pieces passed" if ran else "no piece was run"
    if bad := failures(results):
        words += f"; FAILED: {', '.join(bad)}"
    for verdict in NO_VERDICT:
        if names := [each.piece.name for each in results if each.outcome.verdict is verdict]:
            words += f"; {verdict.value}: {', '.join(names)}"
    return words


def failures(results: Sequence[PieceResult], strict: bool = False) -> list[str]:
    """Names of pieces that failed; `strict`: of those without their tools as well."""
    bad = {Verdict.FAILED, *((Verdict.MISSING,) if strict else ())}
    return [each.piece.name for each in results if each.outcome.verdict in bad]


def _command(text: str) -> Markup:
    """A command whose words are not broken at their hyphens."""
    return Markup(" ").join(Markup(f"<span>{escape(word)}</span>") for word in text.split(" "))


def _text(text: str) -> Markup:
    """A paragraph; code between backticks."""
    parts = enumerate(re.split(r"`([^`]*)`", text))
    return Markup("").join(Markup(f"<code>{escape(p)}</code>" if i % 2 else escape(p)) for i, p in parts)
