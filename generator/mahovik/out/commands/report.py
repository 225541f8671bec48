"""`report`: one page on a stand and its proof, or its derivation."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

from mahovik.errors import UsageError
from mahovik.nearest import names_in
from mahovik.out.arguments import FilePath, Names, Progressing, StandGiven
from mahovik.out.notices import Progress, tell
from mahovik.out.report.plots import require as require_drawing
from mahovik.out.result import Result
from mahovik.writing import format_of, probe, write


def report(
    stand: StandGiven,
    *,
    output: FilePath,
    at: Names | None = None,
    require: Annotated[str | Sequence[str], "LIMIT"] = (),
    derivation: bool = False,
    progress: Progressing = None,
) -> Result:
    """Write one page on a stand and its proof, or its derivation.

    The page opens offline in any browser, and prints: bodies and a drawing, modes, vibration, limits of the motors,
    requirements, verification, cost. The exit status is 1 if a comparison fails or a requirement is not met; the page
    is written and shows it.

    Args:
        stand: the stand file.
        output: write the page to this file, .html; of a derivation also .tex.
        at: points, instruments, carrier or hold.reaction whose vibration is shown; default the first points.
        require: limit of the angle of the first point over all common speeds, "rms 0.1 arcsec".
        derivation: write the matrices of (8)-(11) instead, in symbols, then with the numbers of the stand.

    Raises:
        UsageError: matplotlib is missing, an unknown point, a file that cannot be written.
    """
    from mahovik.out.api.stands import Stand
    from mahovik.out.report.derivation import article, derivation_parts
    from mahovik.out.report.page import Part, page
    from mahovik.out.report.sections import SECTIONS, Subject

    own = Stand.of(stand)
    suffixes = (".html", ".tex") if derivation else (".html",)
    suffix = format_of(Path(output), suffixes)
    if suffix is None:
        raise UsageError(f"output: {output}: expected a name that ends in {' or '.join(suffixes)}")
    if derivation and (at or require):
        raise UsageError("derivation: shows no vibration; remove at and require")
    require_drawing("report")
    probe(Path(output))
    source = Path(stand).name if isinstance(stand, str | Path) else f"{own.name}.toml"
    made: list[Part] = []
    if suffix == ".tex":
        text = article(own)
    elif derivation:
        text = page(f"{own.name}: equations of motion", derivation_parts(own), own, [("stand", source)])
    else:
        points = () if at is None else tuple(names_in("at", at))
        limits = (require,) if isinstance(require, str) else tuple(require)
        for done, section in enumerate(SECTIONS, start=1):
            part = section(Subject(own, points, limits, own.to_dict()))
            made += [] if part is None else [part]
            tell(progress, Progress("sections of the report", done, len(SECTIONS)))
        text = page(own.name, made, own, [("stand", source)])
    write(Path(output), text)
    failures = [f"error: {line}" for part in made for line in part.failures]
    return Result("", meta={"file": str(output)}, messages=failures, ok=not failures)
