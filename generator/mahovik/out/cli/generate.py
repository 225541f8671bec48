"""`mahovik generate`: the folder of a stand's C, complete in itself."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from mahovik.out.cli.arguments import fast_option, lanes_option, load_stand, real_option, stand_argument
from mahovik.out.cli.progress import progress

if TYPE_CHECKING:
    from mahovik.core.stand.model import Stand


@click.command()
@stand_argument
@click.option(
    "-o", "output", metavar="DIR", type=click.Path(), help="Folder to write into; default ./NAME of the stand."
)
@click.option("--check", is_flag=True, help="Write nothing; exit status 1 if the folder differs.")
@click.option("--batch", is_flag=True, help="Also the functions for many states at once: NAME_batch.h, NAME_batch.c.")
@click.option("--no-cache", is_flag=True, help="Derive everything again, without the cache of formulas.")
@real_option
@lanes_option
@fast_option
def generate(
    stand_file: str,
    output: str | None,
    check: bool,
    batch: bool,
    no_cache: bool,
    real: str,
    lanes: int | None,
    fast: bool,
) -> None:
    """Write the C of a stand.

    A complete folder: header, source, self-test with golden vectors, README, and a manifest with the hash of every
    file. It writes all or nothing, never overwrites files of others, and needs no compiler. Warns if float would not
    resolve an unbalance. The formulas that all stands share are derived once and cached, in the folder MAHOVIK_CACHE
    if that is set.
    """
    if no_cache:
        from mahovik.core.formula.derived import without_cache

        without_cache()
    stand = load_stand(stand_file)
    from mahovik.core.emit.delivery import delivery
    from mahovik.core.emit.generate import host_lanes
    from mahovik.errors import CheckError, UsageError
    from mahovik.proof.verify.delivery import deliver, differences

    if lanes is None:
        lanes = host_lanes(len(stand.flywheels)) if fast else 1
    if lanes > 1 and not stand.flywheels:
        raise UsageError(f"--lanes {lanes}: {stand.name} has no flywheels: remove it")
    with progress(f"generate {stand.name}"):
        files = delivery(stand, real, lanes, fast, batch)
    folder = Path(output if output is not None else stand.name)
    if check:
        found = differences(folder, stand, real, files, lanes, fast)
        if found:
            raise CheckError("\n".join(found))
        click.echo(f"{click.format_filename(folder)}   as the stand file gives it")
        return
    if real == "float":
        _warn(stand)
    done = deliver(folder, stand, real, files, lanes=lanes, fast=fast)
    for path in done.paths:
        click.echo(f"{click.format_filename(path)}   {path.read_text(encoding='utf-8').count(chr(10))} lines")
    for note in done.notes:
        click.echo(note)


def _warn(stand: Stand) -> None:
    """Warn of unbalance that float does not resolve at the speeds of the motors, as `mahovik check` does."""
    from mahovik.core.stand.summary import summarize
    from mahovik.use.study.resolution import shortfalls

    for short in shortfalls(stand, [row.speed for row in summarize(stand, None).unbalance]):
        click.echo(f"warning: {short}", err=True)
