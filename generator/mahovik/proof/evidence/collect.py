"""Runs the pieces in order, keeps what they give, and puts the folder in its place: whole, or not at all."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Callable, Collection, Sequence
from dataclasses import replace
from html import escape
from pathlib import Path
from typing import Any

from markupsafe import Markup

import mahovik
from mahovik import __version__
from mahovik.core.emit.delivery import delivery
from mahovik.core.emit.generate import describe_bodies
from mahovik.core.emit.templates import template
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand
from mahovik.errors import MahovikError, UsageError
from mahovik.nearest import suggestion
from mahovik.proof.evidence.folder import FORMAT, require_place, seal
from mahovik.proof.evidence.pieces import Outcome, Piece, Subject, Verdict
from mahovik.proof.verify.delivery import Options, deliver, provenance
from mahovik.writing import write, write_folder

Say = Callable[[str, str], None]
"""Progress: name of the running piece, and what it does; "" when it is done."""

Results = Sequence[tuple[Piece, Outcome]]


def select_pieces(pieces: Sequence[Piece], only: str | None, without: str | None) -> frozenset[str]:
    """Names of the pieces to run. Raises UsageError for an unknown name."""
    known = [piece.name for piece in pieces]

    def names(option: str, text: str | None) -> list[str]:
        words = [] if text is None else [word.strip() for word in text.split(",")]
        for word in words:
            if word not in known:
                raise UsageError(f'{option}: unknown "{word}"{suggestion(word, known)}')
        return words

    chosen = frozenset(names("--only", only) or known) - frozenset(names("--without", without))
    if not chosen:
        raise UsageError("--only, --without: no piece is left to run")
    return chosen


def collect(
    stand: Stand,
    text: bytes,
    folder: Path,
    pieces: Sequence[Piece],
    options: Options,
    *,
    full: bool = False,
    seconds: int = 20,
    wanted: Collection[str] | None = None,
    say: Say = lambda name, what: None,
) -> list[tuple[Piece, Outcome]]:
    """Collects the evidence of a stand, whose file has the content `text`, into a folder; `options` of its C.

    Raises UsageError if the folder holds other files, before anything is run.
    """
    results: list[tuple[Piece, Outcome]] = []

    def fill(draft: Path) -> None:
        subject = Subject(stand, options.real, draft, Path(scratch), full, seconds, options.only)
        additions = tuple(dict.fromkeys((*options.additions, "selftest", "eva")))  # which the pieces run
        files = delivery(stand, options.real, options.only, additions)
        deliver(subject.c, stand, files, made_by=provenance(text))
        write(draft / subject.file, text)
        for piece in pieces:
            outcome = Outcome(Verdict.LEFT_OUT, "not run")
            if wanted is None or piece.name in wanted:
                say(piece.name, "runs")
                outcome = _run_piece(piece, subject)
                say(piece.name, "")
            results.append((piece, replace(outcome, command=piece.command(subject))))
        for piece, outcome in results:
            for name, content in outcome.files.items():
                write(draft / "raw" / piece.name / name, content)
        write(draft / "index.html", _html(subject, results))
        seal(draft, _record(subject, results))

    require_place(folder, stand)
    with tempfile.TemporaryDirectory(prefix="mahovik-") as scratch:
        write_folder(folder, fill)
    return results


def conclusion(results: Results) -> str:
    """The verdict over all, in one line."""
    names = {verdict: [piece.name for piece, outcome in results if outcome.verdict is verdict] for verdict in Verdict}
    passed = len(names.pop(Verdict.PASSED))
    ran = passed + len(names[Verdict.FAILED])
    words = [f"{passed} of {ran} pieces passed" if ran else "no piece was run"]
    return "; ".join([*words, *(f"{verdict.value}: {', '.join(of)}" for verdict, of in names.items() if of)])


def failures(results: Results, strict: bool = False) -> list[str]:
    """Names of pieces that failed; `strict`: of those without their tools as well."""
    bad = {Verdict.FAILED, *((Verdict.MISSING,) if strict else ())}
    return [piece.name for piece, outcome in results if outcome.verdict in bad]


def as_dicts(results: Results) -> list[dict[str, Any]]:
    """What JSON has of each piece."""
    return [
        {
            "name": piece.name,
            "verdict": outcome.verdict.value,
            "figure": outcome.figure,
            "command": outcome.command,
            "tools": list(outcome.tools),
            "files": [f"raw/{piece.name}/{name}" for name in outcome.files],
        }
        for piece, outcome in results
    ]


def _run_piece(piece: Piece, subject: Subject) -> Outcome:
    """Run a piece, unless there is nothing to judge or a tool is missing; an error is its failure."""
    if reason := piece.idle(subject):
        return Outcome(Verdict.NOTHING, reason)
    needs = piece.needs(subject)
    if absent := [need for need in needs if not need.is_present()]:
        notes = tuple(f"To install: `{install}`" for install in dict.fromkeys(need.install for need in absent))
        return Outcome(Verdict.MISSING, f"no {', '.join(need.name for need in absent)}", notes)
    try:
        outcome = _run_command(piece, subject) if piece.run is None else piece.run(subject)
        tools = tuple(dict.fromkeys(filter(None, (need.version() for need in needs))))
        return replace(outcome, tools=outcome.tools or tools)
    except MahovikError as error:
        text = _without_paths(str(error), subject)
        line, *more = text.splitlines()
        return Outcome(Verdict.FAILED, line, tuple(more), {"error.txt": f"{text}\n"})


def _run_command(piece: Piece, subject: Subject) -> Outcome:
    """Run the command of a piece in a copy of the folder, by the shell; its output is kept."""
    place, programs = subject.scratch / piece.name, subject.scratch / "bin"
    shutil.copytree(subject.folder, place)
    programs.mkdir(exist_ok=True)
    write(programs / "mahovik", f'#!/bin/sh\nexec "{sys.executable}" -m mahovik "$@"\n')
    (programs / "mahovik").chmod(0o755)
    package = str(Path(mahovik.__file__).resolve().parent.parent)
    more = {
        "PYTHONPATH": os.pathsep.join(filter(None, (package, os.environ.get("PYTHONPATH")))),
        "PYTHONHASHSEED": "20260",  # another seed of hashes: an order that depends on it would show
        "PATH": f"{programs}{os.pathsep}{os.environ.get('PATH', '')}",
    }
    done = subprocess.run(
        ["sh", "-c", piece.command(subject)],
        cwd=place,
        env=os.environ | more,
        capture_output=True,
        encoding="utf-8",
        errors="surrogateescape",
        check=False,
    )
    output, errors = (_without_paths(text, subject) for text in (done.stdout, done.stderr))
    files: dict[str, str | bytes] = {"output.txt": (output + errors).encode("utf-8", "surrogateescape")}
    for path in sorted(path for pattern in piece.kept for path in place.glob(pattern)):
        text = _without_paths(path.read_text(encoding="utf-8", errors="surrogateescape"), subject)
        files[path.name] = text.encode("utf-8", "surrogateescape")
    lines = [line.strip() for line in (output + errors).splitlines() if line.strip()]
    figures = [piece.words.format(said) for said in re.findall(piece.figure, output + errors, re.MULTILINE)]
    figure = (figures or lines or [""])[-1]
    if done.returncode != 0:
        return Outcome(Verdict.FAILED, figure, tuple(errors.splitlines()[-5:]), files)
    return Outcome(Verdict.NOTHING if figure.startswith("nothing was compared") else Verdict.PASSED, figure, (), files)


def _without_paths(text: str, subject: Subject) -> str:
    """A text without names of temporary folders, which differ from machine to machine."""
    for place in (subject.folder, subject.scratch):
        for name in (str(place.resolve()), str(place)):
            text = text.replace(f"{name}/", "").replace(name, ".")
    return text


def _record(subject: Subject, results: Results) -> dict[str, Any]:
    """The summary for JSON."""
    names = identities(subject.stand)
    return {
        "format": FORMAT,
        "generator": f"mahovik {__version__}",
        "stand": subject.stand.name,
        "structure": names.structure,
        "physics": names.physics,
        "real": subject.real,
        "extent": "full" if subject.full else "quick",
        "pieces": as_dicts(results),
    }


def _html(subject: Subject, results: Results) -> str:
    """The page: a table, then a section for each piece; no script, nothing is loaded."""
    styles = dict.fromkeys(Verdict, "open") | {Verdict.PASSED: "good", Verdict.FAILED: "bad"}
    counts = Counter(styles[outcome.verdict] for _, outcome in results)
    return template("evidence.html.j2").render(
        record=_record(subject, results),
        bodies=describe_bodies(subject.stand),
        stand_file=subject.file,
        conclusion=conclusion(results),
        style="bad" if counts["bad"] else "open" if counts["open"] else "good",
        styles=styles,
        results=results,
        text=_text,
        command=_command,
    )


def _command(text: str) -> Markup:
    """A command whose words are not broken at their hyphens."""
    return Markup(" ").join(Markup(f"<span>{escape(word)}</span>") for word in text.split(" "))


def _text(text: str) -> Markup:
    """A paragraph; code between backticks."""
    parts = enumerate(re.split(r"`([^`]*)`", text))
    return Markup("").join(Markup(f"<code>{escape(p)}</code>" if i % 2 else escape(p)) for i, p in parts)
