"""`mahovik design`: a stand and a programme that make the carrier move as required."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from mahovik.errors import UsageError
from mahovik.out.cli.arguments import console, load_stand, stand_argument, table
from mahovik.out.cli.group import INTERRUPTED
from mahovik.out.cli.json_output import json_option, print_json
from mahovik.out.cli.progress import progress

if TYPE_CHECKING:
    from mahovik.use.design import Outcome


@click.command()
@stand_argument
@click.option("--motion", "motion_file", metavar="M.json", type=click.Path(), required=True, help="Required motion.")
@click.option("--free", metavar="KEYS|FREE.toml", required=True, help="Free numbers: position,angles,unbalance ...")
@click.option("-o", "output", metavar="OUT.toml", type=click.Path(), required=True, help="The stand; OUT.json with it.")
@click.option(
    "--seed", metavar="N", type=click.IntRange(min=0), default=0, show_default=True, help="Seed of the starts."
)
@click.option(
    "--time", "seconds", metavar="S", type=click.FloatRange(min=0, min_open=True), help="Time limit of the search."
)
@click.option(
    "--pareto", metavar="K", type=click.IntRange(2, 50), help="Pareto front: K weights of unbalance against torque."
)
@json_option("Print the explanation as JSON.")
def design(
    stand_file: str,
    motion_file: str,
    free: str,
    output: str,
    seed: int,
    seconds: float | None,
    pareto: int | None,
    as_json: bool,
) -> None:
    """Design a stand together with its programme.

    Chooses the free numbers so that the carrier moves as required.

    FREE.toml names the free numbers, their bounds, groups, limits and the cost; KEYS frees numbers of all flywheels:
    position, angles, unbalance, unbalance_at, mass, inertia, phase, speed, number. Ctrl-C gives the best so far.

    Exit status: 0 a design; 1 none, or a bound is exceeded; 2 bad input; 130 Ctrl-C.
    """
    stand = load_stand(stand_file)
    from mahovik.core.motion.required import load_motion
    from mahovik.proof.verify.files import probe
    from mahovik.use.design import DesignOptions, design_stand, freedom_of_keys, load_freedom

    in_file = free.endswith(".toml")
    freedom = load_freedom(free, stand) if in_file else freedom_of_keys(free, stand)
    path, programme_path = _paths(output, (stand_file, motion_file, *((free,) if in_file else ())))
    for each in (path, programme_path):
        probe(each)
    with progress("searching") as stage:
        found = design_stand(
            stand,
            lambda part: load_motion(Path(motion_file), part),
            freedom,
            DesignOptions(seed, seconds, pareto=pareto or 0),
            lambda state: stage.say(state.words),
        )
    if found.stand is not None and found.programme is not None:
        from mahovik.use.design.write import save_design

        save_design(found, path, programme_path, (Path(stand_file).name, Path(motion_file).name))
    if as_json:
        _print_json(found)
    else:
        _print(found, path, programme_path)
    _end(found)


def _paths(output: str, given: tuple[str, ...]) -> tuple[Path, Path]:
    """Paths of stand and programme. Raises UsageError."""
    path = Path(output)
    if path.suffix != ".toml":
        raise UsageError(f"-o {output}: expected a stand file, a name that ends in .toml")
    both = path, path.with_suffix(".json")
    for each in both:
        if any(each.exists() and each.samefile(name) for name in given):
            raise UsageError(f"-o {output}: {each} is read by this command; give another name for the design")
    return both


def _print(found: Outcome, path: Path, programme_path: Path) -> None:
    """The table of changes, and the totals."""
    from rich.text import Text

    if found.programme is None or found.cost is None:
        return
    from mahovik.use.design.show import change_rows, front, summary

    out = console()
    out.print(Text(f"{click.format_filename(path)}, {click.format_filename(programme_path)}"))
    rows = table("flywheel", "what", "unit", "before>", "after>", "margin>", "an error of", "gives>")
    for row in change_rows(found):
        rows.add_row(*map(Text, row))
    out.print(rows)
    for line in summary(found):
        out.print(Text(line))
    if found.front:
        rows = table("total unbalance, g mm>", "largest torque, N m>", "residual>")
        for row in front(found):
            rows.add_row(*map(Text, row))
        out.print(rows)


def _print_json(found: Outcome) -> None:
    from mahovik.use.design.show import as_object

    print_json(as_object(found))


def _end(found: Outcome) -> None:
    """The status with its reasons; exit status."""
    bad = found.status in ("NO_DESIGN", "OK_LIMIT")
    click.echo(found.status, err=click.get_current_context().params["as_json"])
    for line in found.words:
        click.echo(line, err=True)
    if found.effort.get("cut_by_time"):
        click.echo("warning: --time cut the search: another run may find more", err=True)
    if found.interrupted:
        best = "this is the best so far" if found.stand is not None else "nothing was found yet, nothing is written"
        click.echo(f"interrupted: {best}", err=True)
        raise SystemExit(INTERRUPTED)
    if bad:
        raise SystemExit(1)
