"""`evidence`: all evidence for the C of a stand, in one folder."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import Literal

from mahovik.errors import CheckError, UsageError
from mahovik.out.arguments import Folder, Progressing, StandGiven, Text, command
from mahovik.out.notices import Progress, notify
from mahovik.out.result import Result, column


@command(excludes={"check": ("stand", "output", "full", "only", "real")})
def evidence(
    stand: StandGiven | None = None,
    *,
    output: Folder | None = None,
    full: bool = False,
    only: Text | None = None,
    real: Literal["double", "float"] = "double",
    check: Folder | None = None,
    progress: Progressing = None,
) -> Result:
    """Collect the evidence for the C of a stand.

    One folder to hand over: the C, every check that was run with its output and the command to repeat it, an index
    page to read offline, and the SHA-256 of every file.

    Exit status 1 if a piece failed, or none was run. A missing tool is listed with the command that installs it; it
    counts as a failure if the environment has CI=true.

    Args:
        stand: the stand file.
        output: write into this folder; default ./NAME-evidence of the stand.
        full: run everything, possibly for hours; else fewer states, drivers and processors, for minutes.
        only: run only these pieces, names between commas, and list the others as left out.
        real: element type.
        check: check the SHA-256 sums of this folder only.

    Raises:
        UsageError: options that contradict one another.
        CheckError: a piece failed, or none was run.
    """
    from mahovik.proof.evidence import PIECES, Verdict, as_dicts, collect, conclusion, failures, select_pieces
    from mahovik.proof.evidence import check as differences

    if check is not None:
        if changed := differences(Path(check)):
            raise CheckError("\n".join(changed))
        return Result(f"{check}: every file is as it was written", meta={"folder": str(check)}, details=("folder",))
    if not isinstance(stand, str | Path):
        raise UsageError("stand: expected the path of a stand file, or check=DIR")
    from mahovik.core.stand.files import content
    from mahovik.out.api.stands import load

    machine = load(stand)
    wanted = select_pieces(PIECES, only)
    folder = Path(output) if output is not None else Path(f"{machine.name}-evidence")
    order = [piece.name for piece in PIECES if piece.name in wanted]

    def say(name: str, what: str) -> None:
        """A line a piece where no terminal shows the progress."""
        now = f"{order.index(name) + 1} of {len(order)}: {name}"
        notify(progress, Progress(f"{now}, {what}" if what else now))
        if not what and progress is not None and not sys.stderr.isatty():
            print(now, file=sys.stderr)

    outcomes = collect(machine, content(Path(stand)), folder, PIECES, real, full=full, wanted=wanted, say=say)
    strict = os.environ.get("CI", "").lower() in ("true", "1")
    messages, bad = [conclusion(outcomes), str(folder / "index.html")], failures(outcomes, strict)
    none = not any(outcome.verdict in (Verdict.PASSED, Verdict.FAILED) for outcome in outcomes)
    if none:
        messages.append("no piece was run, so nothing is shown: install what the page names, or choose other pieces")
    elif bad:
        messages.append(f"{', '.join(bad)}: failed, or not run because a tool is missing")
    return Result(
        f"evidence for {machine.name}",
        (
            column("piece", "", [outcome.piece.name for outcome in outcomes]),
            column("verdict", "", [outcome.verdict.value for outcome in outcomes]),
            column("figure", "", [outcome.figure for outcome in outcomes]),
        ),
        rows="table",
        meta={"folder": str(folder), "conclusion": conclusion(outcomes), "pieces": as_dicts(outcomes)},
        messages=messages,
        ok=not (none or bad),
        details=("folder", "conclusion", "pieces"),
    )
