"""`mahovik simulate`: a stand under a regime, in time."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from mahovik.errors import UsageError
from mahovik.out.cli import quantities
from mahovik.out.cli.options import (
    REAL,
    STAND_FILE,
    choice,
    command,
    file_option,
    flag,
    is_given,
    json_option,
    load_stand,
    option,
)
from mahovik.out.cli.output import INTERRUPTED, print_json
from mahovik.out.progress import progress

if TYPE_CHECKING:
    from mahovik.out.functions.simulation import Simulation


@command(short_help="Simulate a stand, or a programme on it.")
def simulate(
    stand_file: str = STAND_FILE,
    until: float | None = option(
        "--until", 'Simulate for this time, "500 ms" or s.', metavar="TIME", parse=quantities.time
    ),
    output: str | None = file_option("-o", "FILE", "Write the motion: .csv, .parquet; a picture: .svg, .png."),
    regime: str | None = file_option(
        "--regime",
        "FILE",
        "Read speeds or torques of the flywheels from this file; default: none turns.",
        reads="a regime file",
    ),
    start: str | None = file_option("--start", "STATE.json", "Start from this state; default: the static equilibrium."),
    dt: float = option("--dt", "Limit the step to this time.", metavar="TIME", default="0.1 ms", parse=quantities.time),
    every: float = option(
        "--every", "Write a row each time this passes.", metavar="TIME", default="1 ms", parse=quantities.time
    ),
    order: str = choice("--order", ["4", "2"], "Choose the order of the step.", default="4"),
    backend: str = choice(
        "--backend",
        ["c", "scipy"],
        "Integrate by c, the generated C, or by scipy, the literal reference, adaptive, slow.",
        default="c",
    ),
    mounts: bool = flag("--mounts", "Write also the wrench of the mount on each flywheel."),
    real: str = REAL,
    carried: bool = flag("--carried", "Keep what rounding takes, by a carry; without it step as firmware without one."),
    programme: str | None = file_option(
        "--programme", "P.json", "Follow this programme by servos, instead of a regime."
    ),
    motion: str | None = file_option("--motion", "M.json", "Read the required motion of --programme from this file."),
    servo: str | None = file_option(
        "--servo", "S.toml", "Read the servos that follow --programme from this file.", reads="a servo file"
    ),
    mismatch: str = option(
        "--mismatch", "Make the stand's numbers wrong by this, with --programme.", metavar="PERCENT", default="0%"
    ),
    seed: int = option("--seed", "Draw the errors of --mismatch from this seed.", type=click.IntRange(0), default=1),
    periods: int | None = option(
        "--periods",
        "Run --programme for this number of periods; default: until it has settled.",
        type=click.IntRange(1),
    ),
    begin: str | None = choice(
        "--begin",
        ["settled", "programme", "rest"],
        "Start --programme in the stand's own periodic motion, in the required state, or at rest with the run-up; "
        "default: settled, and of a finite programme, such as that of a slew, programme.",
    ),
    table: str = option(
        "--table", "Set the nodes of the table in firmware, with --programme.", metavar="NODES|exact", default="128"
    ),
    causes: bool = option(
        "--causes/--no-causes",
        "Find what limits --programme, by further runs.",
        default=True,
        show_default=False,
    ),
    as_json: bool = json_option("Print figures as JSON."),
) -> None:
    """Simulate a stand under a regime, or following a programme.

    Writes the motion of the carrier and flywheels, torques, and readings of every point, in columns with units. Ctrl-C
    keeps the rows computed so far.

    With --programme, --motion and --servo the flywheels are driven by sampled servos, on a stand whose numbers are
    wrong by --mismatch; it prints how well the carrier follows, and what limits it.
    """
    _only(programme is not None)
    if programme is not None:
        from mahovik.out.cli.follow import FollowOptions, follow

        options = FollowOptions(programme, motion, servo, mismatch, seed, periods, begin, table, backend)
        follow(stand_file, options, output, as_json, causes)
        return
    if until is None or output is None:
        raise click.UsageError(f"Missing option '{'--until' if until is None else '-o'}'.")
    stand = load_stand(stand_file)
    from mahovik.core.stand.hold import numbers_in_words
    from mahovik.out.functions.simulation import simulate as run
    from mahovik.use.simulate.run import check_output, coordinate_columns

    check_output(Path(output))
    with progress(f"simulate {stand.name}", until, "s") as stage:
        found = run(
            stand, until, regime=regime, start=start, dt=dt, every=every, order=int(order), backend=backend,
            mounts=mounts, real=real, carried=carried, progress=stage.show,
        )  # fmt: skip
    found.save(output)
    if as_json:
        print_json(_plain(found, output))
    else:
        click.echo(f"{click.format_filename(output)}   {len(found)} rows, {len(found.names)} columns")
        if (numbers := numbers_in_words(stand.hold, "q ")) and coordinate_columns(stand):
            click.echo(numbers)
    _report(found, as_json)


def _only(follows: bool) -> None:
    """Raise UsageError if an option was given that belongs to the other way of running."""
    of_regime = ("until", "regime", "start", "dt", "every", "order", "mounts", "real", "carried")
    of_programme = ("motion", "servo", "mismatch", "seed", "periods", "begin", "table", "causes")
    for name in of_regime if follows else of_programme:
        if is_given(name):
            raise UsageError(f"--{name}: {'not allowed with' if follows else 'needs'} --programme")


def _plain(found: Simulation, output: str) -> dict[str, Any]:
    return {
        "file": output,
        "rows": len(found),
        "columns": found.run.names,
        "t_end": float(found.t[-1]) if len(found) else None,
        "motors_short": {name: {"t": t, "torque": missing} for name, (t, missing) in found.weak_motors.items()},
        "stopped": found.stopped,
    }


def _report(found: Simulation, as_json: bool) -> None:
    """Print weak motors, and why a run ended early. Exit status 1, or 130 for Ctrl-C."""
    for name, (t, missing) in found.weak_motors.items():
        click.echo(
            f"motor of {name}: cannot give the torque of its law; {missing:.4g} N m short at t = {t:.6g} s", err=as_json
        )
    if found.stopped is not None:
        click.echo(f"error: {found.stopped}; what was computed is kept", err=True)
        raise SystemExit(INTERRUPTED if found.interrupted else 1)
