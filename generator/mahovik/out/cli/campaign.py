"""`mahovik campaign`: many samples of a stand whose numbers vary, on one core or many machines."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import click

from mahovik.errors import UsageError
from mahovik.out.cli.group import Commands
from mahovik.out.cli.options import argument, command, file_option, flag, json_option, option
from mahovik.out.cli.output import INTERRUPTED, print_json, print_paths, require_suffix
from mahovik.out.progress import progress

if TYPE_CHECKING:
    from mahovik.out.campaign.engine import Outcome
    from mahovik.out.campaign.face import CampaignFolder

FOLDER = argument("DIR")
WORKERS = option(
    "--workers", "Start this number of processes here; default: one for each core.", type=click.IntRange(1, 1024)
)
SCHEDULER = option(
    "--scheduler", "Use the workers of this scheduler of dask instead, tcp://10.0.0.1:8786.", metavar="ADDRESS"
)
AS_JSON = json_option("Print the state as JSON.")


@click.group(cls=Commands, short_help="Compute many samples whose numbers vary.")
def campaign() -> None:
    """Compute many samples of a stand whose numbers vary: tolerances, sensitivities, quantiles."""


@command(group=campaign)
def run(
    campaign_file: str = argument("C.toml", reads="a campaign file"),
    output: str = file_option("-o", "DIR", "Keep the rows in this folder.", required=True),
    workers: int | None = WORKERS,
    scheduler: str | None = SCHEDULER,
    prepare: bool = flag("--prepare", "Begin the folder alone, for `campaign shard`; print the number of shards."),
    as_json: bool = AS_JSON,
) -> None:
    """Compute the samples of a campaign.

    Shards of samples go to processes of this machine, or to the workers of a scheduler of dask. What is computed is
    kept at once: after Ctrl-C, a crash or a full disk `mahovik campaign resume` goes on.

    Exit status: 0 all samples are there; 1 some are missing; 2 bad input; 130 Ctrl-C.
    """
    from mahovik.out.campaign.cluster import require_scheduler
    from mahovik.out.campaign.face import Campaign

    if scheduler is not None:
        require_scheduler(scheduler)  # before the campaign is read and its C compiled: that takes longer
    begun = Campaign(campaign_file).prepare(output)
    if prepare:
        click.echo(str(begun.manifest.shards))
        return
    _compute(begun, workers, scheduler, as_json)


@command(group=campaign)
def resume(
    folder: str = FOLDER,
    workers: int | None = WORKERS,
    scheduler: str | None = SCHEDULER,
    as_json: bool = AS_JSON,
) -> None:
    """Compute the shards that are missing or damaged.

    Exit status: 0 all samples are there; 1 some are missing; 2 bad input; 130 Ctrl-C.
    """
    _compute(_folder(folder), workers, scheduler, as_json)


@command(group=campaign)
def shard(folder: str = FOLDER, numbers: tuple[str, ...] = argument("NUMBER|A-B...", nargs=-1, required=True)) -> None:
    """Compute shards in this process alone.

    For Slurm arrays, HTCondor, Snakemake and the like, after `mahovik campaign run --prepare`. Shards are numbered
    from 0; numbers beyond the last one in a range A-B are left out. An existing, whole shard is not computed
    again.
    """
    found = _folder(folder)
    for number in _numbers(numbers, found.manifest.shards):
        record = found.shard(number)
        counts = f"{record.count} samples, {record.failed} without quantities"
        click.echo(f"shard {record.number}: {counts}, {record.hash[:16]}")


def _numbers(texts: tuple[str, ...], shards: int) -> Iterator[int]:
    """Numbers of shards, ranges cut at the last one. Raises UsageError."""
    for text in texts:
        low, dash, high = text.partition("-")
        if not low.isdecimal() or (dash and not high.isdecimal()):
            raise UsageError(f"{text}: expected the number of a shard, or a range as 10-19")
        yield from range(int(low), min(int(high), shards - 1) + 1) if dash else [int(low)]


@command(group=campaign)
def status(folder: str = FOLDER, as_json: bool = AS_JSON) -> None:
    """Read and check every shard; say what is there, missing and damaged.

    Exit status: 0 all samples are there; 1 some are missing or damaged; 2 bad input.
    """
    found = _folder(folder)
    with progress("reading shards") as stage:
        state = found.status(stage.show)
    if as_json:
        print_json(state.to_dict())
    else:
        for line in state.lines():
            click.echo(line)
    if not state.complete:
        raise SystemExit(1)


@command(group=campaign)
def merge(
    folder: str = FOLDER,
    output: str = file_option("-o", "FILE.parquet", "Write this file.", required=True),
) -> None:
    """Write all rows into one Parquet file, in the order of the samples.

    Exit status: 0 written; 1 some samples are missing, nothing is written; 2 bad input.
    """
    require_suffix(output, [".parquet"])
    found = _folder(folder)
    with progress("reading shards") as stage:
        found.merge(output, stage.show)
    click.echo(click.format_filename(output))


@command(group=campaign)
def report(
    folder: str = FOLDER,
    output: str = file_option("-o", "FILE.html", "Write the page to this file.", required=True),
    worst: int = option(
        "--worst", "Write this number of stand files for each quantity.", type=click.IntRange(0, 1000), default=3
    ),
) -> None:
    """Report on the rows: one page that opens offline in any browser.

    Histograms, quantiles with confidence intervals, convergence, influences of the drawn numbers, Sobol' indices or
    effects of Morris where the design has them. The samples with the largest quantities are written as stand files
    into DIR/worst.
    """
    require_suffix(output, [".html"])
    found = _folder(folder)
    with progress("sections of the report") as stage:
        written = found.report(output, worst=worst, progress=stage.show)
    print_paths([written.page, *written.stands])


def _folder(path: str) -> CampaignFolder:
    from mahovik.out.campaign.face import CampaignFolder

    return CampaignFolder(path)


def _compute(begun: CampaignFolder, workers: int | None, scheduler: str | None, as_json: bool) -> None:
    """Compute what is missing, and print the state."""
    try:
        with progress(begun.manifest.name, float(begun.manifest.end)) as stage:
            found = begun.resume(workers=workers, scheduler=scheduler, progress=stage.show)
    except KeyboardInterrupt:
        click.echo(f"interrupted: whole shards are kept; `mahovik campaign resume {begun.path}` goes on", err=True)
        raise SystemExit(INTERRUPTED) from None
    _print(found, as_json)


def _print(found: Outcome, as_json: bool) -> None:
    if as_json:
        print_json({**found.status.to_dict(), "seconds": found.seconds, "given_up": list(found.given_up)})
    else:
        for line in found.status.lines():
            click.echo(line)
    for line in found.given_up:
        click.echo(f"error: {line}", err=True)
    if not found.status.complete:
        raise SystemExit(1)
