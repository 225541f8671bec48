"""`mahovik generate`: the folder of a stand's C, complete in itself."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from mahovik.out.cli.options import (
    FAST,
    LANES,
    REAL,
    STAND_FILE,
    comma_list,
    command,
    file_option,
    flag,
    load_stand,
    option,
)
from mahovik.out.cli.output import print_paths
from mahovik.out.cli.progress import progress

if TYPE_CHECKING:
    from mahovik.core.stand.model import Stand


@command()
def generate(
    stand_file: str = STAND_FILE,
    output: str | None = file_option("-o", "DIR", "Write into this folder; default ./NAME of the stand."),
    check: bool = flag("--check", "Write nothing, and exit with status 1 if the folder differs."),
    batch: bool = flag("--batch", "Write also functions for many states at once: NAME_batch.h, NAME_batch.c."),
    no_cache: bool = flag("--no-cache", "Derive everything again, without the cache of formulas."),
    only: tuple[str, ...] | None = option(
        "--only", "Write these public functions alone, and what they need.", metavar="NAME,NAME", parse=comma_list
    ),
    prefix: str | None = option(
        "--prefix",
        "Use this name in C instead of the one of the stand: two element types in one image.",
        metavar="NAME",
    ),
    real: str = REAL,
    lanes: int | None = LANES,
    fast: bool = FAST,
) -> None:
    """Write the C of a stand.

    A complete folder: header, source, self-test with golden vectors, README, and a manifest with the hash of every
    file. It writes all or nothing, never overwrites files of others, and needs no compiler. Warns if float would not
    resolve an unbalance. The formulas that all stands share are derived once and cached, in the folder MAHOVIK_CACHE
    if that is set. With --prefix the C is that of a stand of that name, and so is its physics hash; commands that read
    the folder, or a log of its C, find the name there.
    """
    if no_cache:
        from mahovik.core.formula.derived import without_cache

        without_cache()
    stand = load_stand(stand_file)
    if prefix is not None:
        stand = _named(stand, prefix)
    from mahovik.core.emit.delivery import delivery
    from mahovik.core.emit.generate import host_lanes
    from mahovik.errors import CheckError, UsageError
    from mahovik.proof.verify.delivery import deliver, differences

    chosen = only or ()
    if lanes is None:
        lanes = host_lanes(len(stand.flywheels)) if fast else 1
    if lanes > 1 and not stand.flywheels:
        raise UsageError(f"--lanes {lanes}: {stand.name} has no flywheels: remove it")
    with progress(f"generate {stand.name}"):
        files = delivery(stand, real, lanes, fast, batch, chosen)
    folder = Path(output if output is not None else stand.name)
    if check:
        found = differences(folder, stand, real, files, lanes, fast, chosen)
        if found:
            raise CheckError("\n".join(found))
        click.echo(f"{click.format_filename(folder)}   as the stand file gives it")
        return
    if real == "float":
        _warn(stand)
    done = deliver(folder, stand, real, files, lanes=lanes, fast=fast, only=chosen)
    for path in done.paths:
        click.echo(f"{click.format_filename(path)}   {path.read_text(encoding='utf-8').count(chr(10))} lines")
    print_paths((), done.notes)


def _named(stand: Stand, prefix: str) -> Stand:
    """The stand by another name, which is that of its files and the first word of every name in C."""
    from dataclasses import replace

    from mahovik.core.stand.names import stand_name_problem
    from mahovik.errors import UsageError

    problem = stand_name_problem(prefix)
    if problem is not None:
        raise UsageError(f"--prefix {prefix}: {problem}")
    return replace(stand, name=prefix)


def _warn(stand: Stand) -> None:
    """Warn of unbalance that float does not resolve at the speeds of the motors, as `mahovik check` does."""
    from mahovik.core.stand.summary import summarize
    from mahovik.use.study.resolution import shortfalls

    for short in shortfalls(stand, [row.speed for row in summarize(stand, None).unbalance]):
        click.echo(f"warning: {short}", err=True)
