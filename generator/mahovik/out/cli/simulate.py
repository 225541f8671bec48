"""`mahovik simulate`: a stand under a regime, in time."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from mahovik.errors import CheckError, UsageError
from mahovik.out.cli.options import (
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
from mahovik.out.cli.progress import progress

if TYPE_CHECKING:
    from mahovik.core.motion.regime import Regime
    from mahovik.core.stand.model import Stand
    from mahovik.core.stand.state import State
    from mahovik.use.simulate import Case, Run


@command(short_help="Simulate a stand, or a programme on it.")
def simulate(
    stand_file: str = STAND_FILE,
    until: float | None = option("--until", "Simulate for this time, s.", metavar="S", type=float),
    output: str | None = file_option("-o", "FILE.csv|FILE.parquet", "Write the motion to this file, in columns."),
    regime: str | None = file_option(
        "--regime", "FILE", "Read speeds or torques of the flywheels from this file; default: none turns."
    ),
    start: str | None = file_option("--start", "STATE.json", "Start from this state; default: the static equilibrium."),
    dt: float = option("--dt", "Limit the step to this time, s.", metavar="S", type=float, default=0.0001),
    every: float = option("--every", "Write a row each time this passes, s.", metavar="S", type=float, default=0.001),
    order: str = choice("--order", ["4", "2"], "Choose the order of the step.", default="4"),
    backend: str = choice(
        "--backend",
        ["c", "scipy"],
        "Integrate by c, the generated C, or by scipy, the literal reference, adaptive, slow.",
        default="c",
    ),
    mounts: bool = flag("--mounts", "Write also the wrench of the mount on each flywheel."),
    programme: str | None = file_option(
        "--programme", "P.json", "Follow this programme by servos, instead of a regime."
    ),
    motion: str | None = file_option("--motion", "M.json", "Read the required motion of --programme from this file."),
    servo: str | None = file_option("--servo", "S.toml", "Read the servos that follow --programme from this file."),
    mismatch: str = option(
        "--mismatch", "Make the stand's numbers wrong by this, with --programme.", metavar="PERCENT", default="0%"
    ),
    seed: int = option("--seed", "Draw the errors of --mismatch from this seed.", type=click.IntRange(0), default=1),
    periods: int | None = option(
        "--periods",
        "Run --programme for this number of periods; default: until it has settled.",
        type=click.IntRange(1),
    ),
    begin: str = choice(
        "--begin",
        ["settled", "programme", "rest"],
        "Start --programme in the stand's own periodic motion, in the required state, or at rest with the run-up.",
        default="settled",
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
    from mahovik.use.simulate import Case
    from mahovik.use.simulate import simulate as run
    from mahovik.use.simulate.run import check_output, save_run

    check_output(Path(output))
    chosen, state = _beginning(stand, regime, start, until)
    case = Case(stand, chosen, state, until, every, dt, int(order))
    _warn(case)
    with progress(f"simulate {stand.name}", until, "s") as stage:
        found = run(case, backend, mounts, stage.at)
    save_run(found, Path(output))
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
        if is_given(name):
            raise UsageError(f"--{name}: {'not allowed with' if follows else 'needs'} --programme")


def _beginning(stand: Stand, regime: str | None, start: str | None, until: float) -> tuple[Regime, State]:
    """The regime, and the initial state. Raises RegimeError, UsageError, CheckError."""
    import math

    from mahovik.core import motion
    from mahovik.use.simulate.case import load_start
    from mahovik.use.study.rest import rest

    if not (math.isfinite(until) and until > 0.0):
        raise UsageError(f"--until {until:g}: expected a time above 0, in s")
    first = load_start(Path(start), stand) if start is not None else None
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

    from mahovik.contract.quantities import BOUNDS

    _, speeds, _ = case.motion(np.linspace(0.0, case.until, 200))
    fastest = float(np.abs([*speeds.ravel(), *case.phi_dot0]).max(initial=0.0))
    if fastest * case.dt > min(0.3, BOUNDS[f"MAX_TURN_{case.order}"].value):
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
