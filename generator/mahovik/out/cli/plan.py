"""`mahovik plan`: flywheel motions that make the carrier move as required, of a stand whose numbers may move too."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from mahovik.errors import UsageError
from mahovik.out.cli.options import (
    MOTION,
    SEED_OF_STARTS,
    STAND_FILE,
    TIME_LIMIT,
    choice,
    command,
    file_option,
    json_option,
    option,
)
from mahovik.out.cli.output import end_of_search, print_json, print_line, print_table, require_other_file
from mahovik.out.progress import progress

if TYPE_CHECKING:
    from mahovik.out.functions.programmes import Method, Plan


@command(short_help="Find a programme that moves the carrier as required.")
def plan(
    stand_file: str = STAND_FILE,
    motion_file: str = MOTION,
    output: str | None = file_option("-o", "P.json", "Write the programme to this file."),
    free: tuple[str, ...] = option(
        "--free",
        "Move numbers of the stand too: paths, as w*.position; commas part several.",
        metavar="KEYS",
        multiple=True,
    ),
    new_stand: str | None = file_option("--stand", "NEW.toml", "Write the stand that results of --free."),
    seconds: float | None = TIME_LIMIT,
    seed: int = SEED_OF_STARTS,
    method: Method = choice(
        "--method",
        ["fourier", "ocp"],
        "Plan by fourier; or then by (13) with IPOPT, with (12) as constraints.",
        default="fourier",
    ),
    as_json: bool = json_option("Print figures and status as JSON."),
) -> None:
    """Plan a programme: flywheel motions that make the carrier move exactly as required.

    A motion out of reach is refused at once, with what is missing. Programmes are verified by the literal reference.
    Ctrl-C gives the best so far. --time limits the search; run-ups after it, if any, have half of the time.

    With --free numbers of the stand move too, inside `free` of the motion file, others by 10 % of their value.

    Exit status: 0 a programme inside the bounds; 1 none, or a bound is exceeded; 2 bad input; 130 Ctrl-C.
    """
    from mahovik.core.motion.programme import programme_text
    from mahovik.core.stand.write import dumps
    from mahovik.out.api.stands import load
    from mahovik.out.functions.programmes import plan as find
    from mahovik.writing import write

    if new_stand is not None and not free:
        raise UsageError("--stand: writes what --free changes; expected --free KEYS beside it")
    for path, name, what in ((output, "-o", "programme"), (new_stand, "--stand", "stand")):
        if path is not None:
            require_other_file(Path(path), (stand_file, motion_file), f"{name} {path}", what)
    stand, keys = load(stand_file), [key for text in free for key in text.split(",")]
    with progress("searching") as stage:
        found = find(stand, motion_file, free=keys, seconds=seconds, seed=seed, method=method, progress=stage.show)
    for line in found.warnings:
        click.echo(f"warning: {line}", err=True)
    if found.result.programmes:
        if output is not None:
            write(Path(output), programme_text(found.programme.programme))
        if new_stand is not None:
            write(Path(new_stand), dumps(found.stand))
    if as_json:
        print_json(_plain(found))
    else:
        _print(found)
    if found.status != "OK_LIMIT" or as_json:
        for line in found.words:
            click.echo(line, err=True)
    end_of_search(found.result, ("OK",), bool(found.result.programmes))


def _plain(found: Plan) -> dict[str, Any]:
    """For --json; SI."""
    keys = ("status", "reason", "words", "warnings", "interrupted", "effort")
    made = found.result.programmes
    programme = {"flywheels": made[0].flywheels, "winding": made[0].winding, **made[0].report} if made else None
    changes = [dict(zip(("path", "unit", "before", "after"), each, strict=True)) for each in found.changes]
    return {key: getattr(found, key) for key in keys} | {"changes": changes, "programme": programme}


def _print(found: Plan) -> None:
    """Numbers that moved, peaks of the flywheels, figures of the programme, the status."""
    if found.changes:
        moved = ((path, unit, f"{before:.6g}", f"{after:.6g}") for path, unit, before, after in found.changes)
        print_table(("number", "unit", "before>", "after>"), moved)
    if found.result.programmes:
        names = ("peak_speed", "peak_acceleration", "peak_torque")
        rows = zip(found["flywheel"], *(map("{:.4g}".format, found[name]) for name in names), strict=True)
        print_table(("flywheel", "peak speed, rad/s>", "peak acceleration, rad/s2>", "peak torque, N m>"), rows)
        for line in found.programme.figures:
            print_line(line)
    click.echo(found.status if found.reason is None else f"{found.status} {found.reason}")
    if found.status == "OK_LIMIT":
        for line in found.words:
            click.echo(line)
