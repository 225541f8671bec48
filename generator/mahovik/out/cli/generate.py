"""`mahovik generate`: the folder of a stand's C, complete in itself."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from mahovik.out.cli.options import (
    ONLY,
    PREFIX,
    REAL,
    STAND_FILE,
    WITH,
    command,
    file_option,
    flag,
    is_given,
    load_stand,
)
from mahovik.out.cli.output import print_paths, print_table
from mahovik.out.progress import progress

if TYPE_CHECKING:
    from mahovik.core.stand.model import Stand


@command()
def generate(
    stand_file: str = STAND_FILE,
    output: str | None = file_option("-o", "DIR", "Write into this folder; default ./NAME of the stand."),
    check: bool = flag("--check", "Write nothing, and exit with status 1 if the folder differs."),
    batch: bool = flag("--batch", "Write also functions for many states at once: NAME_batch.h, NAME_batch.c."),
    only: tuple[str, ...] | None = ONLY,
    additions: tuple[str, ...] | None = WITH,
    prefix: str | None = PREFIX,
    real: str = REAL,
) -> None:
    """Write the C of a stand.

    A complete folder: header, source, README, what --with adds, and a manifest with the hash of every file; beside
    these provenance.json, which the manifest does not list: package, Python, NumPy and stand file. It writes all or
    nothing, never overwrites files of others, and needs no compiler. Warns if float would not resolve an unbalance or
    would lose what short steps add, and where (12) is singular in practice. With --prefix the C is that of a stand of
    that name, and so is its physics hash; commands that read the folder, or a log of its C, find the name there.
    --check compares with the options that the folder was made with, unless others are given. --only list prints the
    functions of the stand.
    """
    if only == ("list",):
        _print_functions(load_stand(stand_file))
        return
    folder = Path(output or prefix or load_stand(stand_file).name)
    from mahovik.errors import CheckError
    from mahovik.out.functions.evidence import generate as make
    from mahovik.proof.verify.delivery import delivered_options, differences, stand_in

    stand: Stand | str = stand_file
    chosen, added = only or (), additions or ()
    if check:  # as it was delivered, but for what is asked for here
        stand = load_stand(stand_file)
        if prefix is None:
            stand = stand_in(folder, stand)
        if (options := delivered_options(folder)) is not None:
            real = real if is_given("real") else options.real
            chosen, added = chosen or options.only, tuple(dict.fromkeys((*added, *options.additions)))
    with progress(f"generate {folder.name}") as stage:
        made = make(
            stand, None if check else folder, real=real, batch=batch, only=chosen,
            additions=added, prefix=prefix, progress=stage.show,
        )  # fmt: skip
    if check:
        found = differences(folder, made.stand, made.files)
        if found:
            raise CheckError("\n".join(found))
        click.echo(f"{click.format_filename(folder)}   as the stand file gives it")
        return
    for name, lines in zip(made["file"], made["lines"], strict=True):
        click.echo(f"{click.format_filename(folder / name)}   {lines} lines")
    print_paths((), made.notes)


def _print_functions(stand: Stand) -> None:
    """The public functions of a stand, what each gives, and with which options it is written."""
    from mahovik.contract.functions import ALL, is_default
    from mahovik.core.emit.generate import generate_all

    functions = [f for f in generate_all(stand, only=ALL).program.functions if f.public]
    written = {f.name: "default" if is_default(f.name) else "all" for f in functions}
    rows = [(f.name, written[f.name], f.purpose.partition(". ")[0].partition(": ")[0].rstrip(".")) for f in functions]
    rows.sort(key=lambda row: row[1] != "default")
    print_table(("function", "written by", "gives"), rows)
