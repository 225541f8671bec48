"""`mahovik report`: everything about a stand on one page."""

from __future__ import annotations

from pathlib import Path

import click

from mahovik.errors import UsageError
from mahovik.out.cli.options import STAND_FILE, command, file_option, flag, option
from mahovik.out.cli.output import require_suffix
from mahovik.out.progress import progress


@command(short_help="Write one page on a stand and its proof, or its derivation.")
def report(
    stand_file: str = STAND_FILE,
    output: str = file_option("-o", "FILE.html", "Write the page to this file.", required=True),
    at: str | None = option(
        "--at", "Show the vibration of these points: names between commas, carrier, hold.reaction.", metavar="POINT,..."
    ),
    requirements: tuple[str, ...] = option(
        "--require",
        'Judge the angle of the first point by a limit, "rms 0.1 arcsec".',
        metavar="LIMIT",
        multiple=True,
    ),
    derivation: bool = flag("--derivation", "Write the matrices of (8)-(11) instead; FILE.tex: in LaTeX."),
) -> None:
    """Report on a stand: one page that opens offline in any browser, and prints.

    Shows bodies, modes, vibration, limits of the motors, requirements, verification and cost. With --derivation: one
    generic flywheel in symbols, then the numbers of the stand. Exit status 1 if a comparison fails or a requirement is
    not met; the page is written and shows it.
    """
    suffix = require_suffix(output, (".html", ".tex") if derivation else (".html",))
    if derivation and (at is not None or requirements):
        raise UsageError("--derivation: shows no vibration; remove --at and --require")
    from mahovik.out.functions.stand_report import report as make
    from mahovik.writing import probe, write

    probe(Path(output))
    if suffix == ".tex":
        from mahovik.out.api.stands import Stand
        from mahovik.out.report.derivation import article

        write(Path(output), article(Stand.of(stand_file)))
        click.echo(click.format_filename(output))
        return
    with progress("sections of the report") as stage:
        found = make(
            stand_file, at=[] if at is None else at.split(","), require=requirements, derivation=derivation,
            progress=stage.show,
        )  # fmt: skip
    found.save(output)
    click.echo(click.format_filename(output))
    for line in found.failures:
        click.echo(f"error: {line}", err=True)
    if found.failures:
        raise SystemExit(1)
