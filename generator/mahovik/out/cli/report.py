"""`mahovik report`: everything about a stand on one page."""

from __future__ import annotations

from pathlib import Path

import click

from mahovik.out.cli.options import STAND_FILE, command, file_option, option
from mahovik.out.cli.output import require_suffix
from mahovik.out.progress import progress


@command(short_help="Write one page on a stand, its proof and its motion.")
def report(
    stand_file: str = STAND_FILE,
    output: str = file_option("-o", "FILE.html", "Write the page to this file.", required=True),
    run_file: str | None = file_option("--run", "RUN.csv|RUN.parquet", "Show this run of `mahovik simulate`."),
    programme_file: str | None = file_option("--programme", "P.json", "Show this programme of `mahovik plan`."),
    motion_file: str | None = file_option(
        "--motion", "M.json", "Read the required motion of --programme from this file."
    ),
    at: str | None = option(
        "--at", "Show the vibration of these points: names between commas, carrier, hold.reaction.", metavar="POINT,..."
    ),
    requirements: tuple[str, ...] = option(
        "--require",
        'Judge the angle of the first point by a limit, "rms 0.1 arcsec".',
        metavar="LIMIT",
        multiple=True,
    ),
) -> None:
    """Report on a stand: one page that opens offline in any browser, and prints.

    Shows bodies, modes, vibration, limits of the motors, verification, cost, and the motion of a run or programme.
    Exit status 1 if a comparison fails or a requirement is not met; the page is written and shows it.
    """
    require_suffix(output, [".html"])
    from mahovik.out.functions.stand_report import report as make
    from mahovik.out.report.plot.draw import require
    from mahovik.writing import probe

    require("report")
    probe(Path(output))
    with progress("sections of the report") as stage:
        found = make(
            stand_file, at=[] if at is None else at.split(","), require=requirements, run=run_file,
            programme=programme_file, motion=motion_file, progress=stage.show,
        )  # fmt: skip
    found.save(output)
    click.echo(click.format_filename(output))
    for line in found.failures:
        click.echo(f"error: {line}", err=True)
    if found.failures:
        raise SystemExit(1)
