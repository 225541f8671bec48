"""`mahovik design`: a stand and a programme that make the carrier move as required."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from mahovik.out.cli.options import (
    MOTION,
    SEED_OF_STARTS,
    STAND_FILE,
    TIME_LIMIT,
    command,
    file_option,
    json_option,
    load_stand,
    option,
)
from mahovik.out.cli.output import (
    end_of_search,
    print_json,
    print_line,
    print_table,
    require_other_file,
    require_suffix,
)
from mahovik.out.cli.progress import progress

if TYPE_CHECKING:
    from mahovik.use.design import Outcome


@command()
def design(
    stand_file: str = STAND_FILE,
    motion_file: str = MOTION,
    free: str = option(
        "--free",
        "Free these numbers: position,angles,unbalance ...",
        metavar="KEYS|FREE.toml",
        required=True,
        reads="a file that names free numbers",
    ),
    output: str = file_option("-o", "OUT.toml", "Write the stand, and its programme to OUT.json.", required=True),
    seed: int = SEED_OF_STARTS,
    seconds: float | None = TIME_LIMIT,
    pareto: int | None = option(
        "--pareto",
        "Find a Pareto front, by K weights of unbalance against torque.",
        metavar="K",
        type=click.IntRange(2, 50),
    ),
    as_json: bool = json_option("Print the explanation as JSON."),
) -> None:
    """Design a stand together with its programme.

    Chooses the free numbers so that the carrier moves as required.

    FREE.toml names the free numbers, their bounds, groups, limits and the cost; KEYS frees numbers of all flywheels:
    position, angles, unbalance, unbalance_at, mass, inertia, phase, speed, number. Ctrl-C gives the best so far.

    Exit status: 0 a design; 1 none, or a bound is exceeded; 2 bad input; 130 Ctrl-C.
    """
    stand = load_stand(stand_file)
    from mahovik.out.functions.programmes import design as find
    from mahovik.out.functions.programmes import read_freedom

    in_file = free.endswith(".toml")
    freedom = read_freedom(free, stand)
    path = Path(output)
    require_suffix(output, [".toml"])
    programme_path = path.with_suffix(".json")
    for each in (path, programme_path):
        require_other_file(each, (stand_file, motion_file, *((free,) if in_file else ())), f"-o {output}", "design")
    with progress("searching") as stage:
        found = find(
            stand, motion_file, freedom, seconds=seconds, seed=seed, pareto=pareto or 0, progress=stage.show
        ).result
    if found.stand is not None and found.programme is not None:
        from mahovik.use.design.outcome import save_design

        save_design(found, path, programme_path, (Path(stand_file).name, Path(motion_file).name))
    if as_json:
        from mahovik.use.design.outcome import as_object

        print_json(as_object(found))
    else:
        _print(found, path, programme_path)
    _end(found)


def _print(found: Outcome, path: Path, programme_path: Path) -> None:
    """The table of changes, and the totals."""
    if found.programme is None or found.cost is None:
        return
    from mahovik.use.design.outcome import change_rows, front_rows, summary

    print_line(f"{click.format_filename(path)}, {click.format_filename(programme_path)}")
    columns = ("flywheel", "what", "unit", "before>", "after>", "margin>", "an error of", "gives>")
    print_table(columns, change_rows(found))
    for line in summary(found):
        print_line(line)
    if found.front:
        print_table(("total unbalance, g mm>", "largest torque, N m>", "residual>"), front_rows(found))


def _end(found: Outcome) -> None:
    """The status with its reasons; exit status."""
    click.echo(found.status, err=click.get_current_context().params["as_json"])
    for line in found.words:
        click.echo(line, err=True)
    end_of_search(found, ("OK", "APPROXIMATE"), found.stand is not None)
