"""`mahovik simulate`: a stand under a regime, in time."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from mahovik.errors import CheckError, UsageError
from mahovik.out.cli.arguments import given, load_stand, stand_argument
from mahovik.out.cli.group import INTERRUPTED
from mahovik.out.cli.json_output import json_option, print_json
from mahovik.out.cli.progress import progress

if TYPE_CHECKING:
    from mahovik.core.motion.regime import Regime
    from mahovik.core.stand.model import Stand
    from mahovik.core.stand.state import State
    from mahovik.use.simulate import Case, Run


@click.command(short_help="Simulate a stand, or a programme on it.")
@stand_argument
@click.option("--until", metavar="S", type=float, help="Duration, s.")
@click.option("-o", "output", metavar="FILE.csv|FILE.parquet", type=click.Path(), help="Columns.")
@click.option(
    "--regime", metavar="FILE", type=click.Path(), help="Speeds or torques of the flywheels; default: none turns."
)
@click.option("--start", metavar="STATE.json", type=click.Path(), help="Default: the static equilibrium.")
@click.option("--dt", metavar="S", type=float, default=1e-4, show_default=True, help="Longest step, s.")
@click.option("--every", metavar="S", type=float, default=1e-3, show_default=True, help="Time between rows, s.")
@click.option("--order", type=click.Choice(["4", "2"]), default="4", show_default=True, help="Order of the step.")
@click.option(
    "--backend",
    type=click.Choice(["c", "scipy"]),
    default="c",
    show_default=True,
    help="c: the generated C; scipy: the literal reference, adaptive, slow.",
)
@click.option("--mounts", is_flag=True, help="Also write the wrench of the mount on each flywheel.")
@click.option(
    "--programme", metavar="P.json", type=click.Path(), help="Programme to follow by servos, instead of a regime."
)
@click.option("--motion", metavar="M.json", type=click.Path(), help="For --programme: the motion file.")
@click.option("--servo", metavar="S.toml", type=click.Path(), help="For --programme: the servos of the flywheels.")
@click.option(
    "--mismatch", metavar="PERCENT", default="0%", show_default=True, help="For --programme: errors of the stand."
)
@click.option("--seed", type=click.IntRange(0), default=1, show_default=True, help="Seed of --mismatch.")
@click.option("--periods", type=click.IntRange(1), help="For --programme; default: until it has settled.")
@click.option(
    "--begin",
    type=click.Choice(["settled", "programme", "rest"]),
    default="settled",
    show_default=True,
    help="For --programme: start in the stand's own periodic motion, the required state, or at rest with the run-up.",
)
@click.option(
    "--table",
    metavar="NODES|exact",
    default="128",
    show_default=True,
    help="For --programme: the table as in firmware.",
)
@click.option("--causes/--no-causes", default=True, help="For --programme: find what limits it, by further runs.")
@json_option("Print figures as JSON.")
def simulate(
    stand_file: str,
    until: float | None,
    output: str | None,
    regime: str | None,
    start: str | None,
    dt: float,
    every: float,
    order: str,
    backend: str,
    mounts: bool,
    programme: str | None,
    motion: str | None,
    servo: str | None,
    mismatch: str,
    seed: int,
    periods: int | None,
    begin: str,
    table: str,
    causes: bool,
    as_json: bool,
) -> None:
    """Simulate a stand under a regime, or following a programme.

    Writes the motion of the carrier and flywheels, torques, and readings of every point, in columns with units. Ctrl-C
    keeps the rows computed so far.

    With --programme, --motion and --servo the flywheels are driven by sampled servos, on a stand whose numbers are
    wrong by --mismatch; it prints how well the carrier follows, and what limits it.
    """
    _only(programme is not None)
    if programme is not None:
        from mahovik.out.cli.follow import follow

        follow(
            stand_file, programme, motion, servo, mismatch, seed, periods, begin, table, backend, output, as_json,
            causes,
        )  # fmt: skip
        return
    if until is None or output is None:
        raise click.UsageError(f"Missing option '{'--until' if until is None else '-o'}'.")
    stand = load_stand(stand_file)
    from mahovik.use.simulate import Case
    from mahovik.use.simulate import simulate as run
    from mahovik.use.simulate.output import check, save

    check(Path(output))
    chosen, state = _beginning(stand, regime, start, until)
    case = Case(stand, chosen, state, until, every, dt, int(order))
    _warn(case)
    with progress(f"simulate {stand.name}", until, "s") as stage:
        found = run(case, backend, mounts, stage.at)
    save(found, Path(output))
    if as_json:
        print_json(_plain(found, output))
    else:
        click.echo(f"{click.format_filename(output)}   {len(found.data)} rows, {len(found.names)} columns")
    _report(found, as_json)


def _only(follows: bool) -> None:
    """Raise UsageError if an option was given that belongs to the other way of running."""
    of_regime = ("until", "regime", "start", "dt", "every", "order", "mounts")
    of_programme = ("motion", "servo", "mismatch", "seed", "periods", "begin", "table", "causes")
    for name in of_regime if follows else of_programme:
        if given(name):
            raise UsageError(f"--{name}: {'not allowed with' if follows else 'needs'} --programme")


def _beginning(stand: Stand, regime: str | None, start: str | None, until: float) -> tuple[Regime, State]:
    """The regime, and the initial state. Raises RegimeError, UsageError, CheckError."""
    import math

    from mahovik.core import motion
    from mahovik.use.simulate.start import load
    from mahovik.use.study.rest import rest

    if not (math.isfinite(until) and until > 0.0):
        raise UsageError(f"--until {until:g}: expected a time above 0, in s")
    first = load(Path(start), stand) if start is not None else None
    chosen = motion.load(regime, stand, until) if regime is not None else None
    if first is not None:
        return chosen or motion.steady(stand, first.phi_dot), first
    chosen = chosen or motion.steady(stand, [0.0] * len(stand.flywheels))
    try:
        return chosen, rest(stand, [each.phase or 0.0 for each in chosen.flywheels]).state
    except CheckError as error:
        raise CheckError(f"{error}; give an initial state by --start") from None


def _warn(case: Case) -> None:
    """Warn of steps that are long for the initial speeds."""
    import numpy as np

    _, speeds, _ = case.motion(np.linspace(0.0, case.until, 200))
    fastest = float(np.abs([*speeds.ravel(), *case.phi_dot0]).max(initial=0.0))
    if fastest * case.dt > 0.3:
        click.echo(
            f"warning: a flywheel turns {fastest * case.dt:.2g} rad per step: --dt {case.dt:g} is long", err=True
        )


def _plain(found: Run, output: str) -> dict[str, Any]:
    return {
        "file": output,
        "rows": len(found.data),
        "columns": found.names,
        "t_end": float(found.data[-1, 0]) if len(found.data) else None,
        "motors_short": {name: {"t": t, "torque": missing} for name, (t, missing) in found.weak_motors.items()},
        "stopped": found.stopped,
    }


def _report(found: Run, as_json: bool) -> None:
    """Print weak motors, and why a run ended early. Exit status 1, or 130 for Ctrl-C."""
    for name, (t, missing) in found.weak_motors.items():
        click.echo(
            f"motor of {name}: cannot give the torque of its law; {missing:.4g} N m short at t = {t:.6g} s", err=as_json
        )
    if found.stopped is not None:
        click.echo(f"error: {found.stopped}; what was computed is kept", err=True)
        raise SystemExit(INTERRUPTED if found.interrupted else 1)
