"""`mahovik report`: everything about a stand on one page."""

from __future__ import annotations

from pathlib import Path

import click

from mahovik.errors import UsageError
from mahovik.out.cli.arguments import load_stand, stand_argument
from mahovik.out.cli.progress import progress


@click.command(short_help="A stand, its proof and its motion on one page.")
@stand_argument
@click.option("-o", "output", metavar="FILE.html", type=click.Path(), required=True, help="Output page.")
@click.option(
    "--run", "run_file", metavar="RUN.csv|RUN.parquet", type=click.Path(), help="A run of `mahovik simulate`."
)
@click.option(
    "--programme", "programme_file", metavar="P.json", type=click.Path(), help="A programme of `mahovik plan`."
)
@click.option("--motion", "motion_file", metavar="M.json", type=click.Path(), help="Motion file of --programme.")
@click.option(
    "--cost", "cost_folder", metavar="DIR", type=click.Path(), help="Generated C with figures of `mahovik cost`."
)
@click.option("--targets", metavar="NAME,...", help="Run the self-test on processors now: all, quick, m7,...; minutes.")
def report(
    stand_file: str,
    output: str,
    run_file: str | None,
    programme_file: str | None,
    motion_file: str | None,
    cost_folder: str | None,
    targets: str | None,
) -> None:
    """Report on a stand: one page that opens offline in any browser, and prints.

    Shows bodies, matrices, verification, cost, reach, and the motion of a run or programme. Exit status 1 if a
    comparison fails; the page is written and shows it.
    """
    if not output.endswith(".html"):
        raise UsageError(f"-o {output}: expected a name that ends in .html")
    from mahovik.out.report.plot.draw import require
    from mahovik.out.report.stand.gather import gather
    from mahovik.out.report.stand.page import ORDER, page
    from mahovik.proof.verify.files import probe, write

    require("report")
    probe(Path(output))
    material = gather(
        load_stand(stand_file),
        stand_file,
        run_file=run_file,
        programme_file=programme_file,
        motion_file=motion_file,
        cost_folder=cost_folder,
        targets=targets,
    )
    with progress("sections of the report", len(ORDER)) as stage:
        found = page(material, stage.at)
    write(Path(output), found.html)
    click.echo(click.format_filename(output))
    if found.failures:
        for line in found.failures:
            click.echo(f"error: {line}", err=True)
        raise SystemExit(1)
