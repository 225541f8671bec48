"""`mahovik response`: motion of a point under flywheels at constant speeds."""

from __future__ import annotations

import re
import time
from pathlib import Path
from typing import TYPE_CHECKING

import click

from mahovik.errors import UsageError
from mahovik.out.cli.arguments import console, given, load_stand, stand_argument, table
from mahovik.out.cli.group import INTERRUPTED
from mahovik.out.cli.json_output import json_option, print_json_text
from mahovik.out.cli.progress import progress
from mahovik.out.cli.rest import read_phases

if TYPE_CHECKING:
    from mahovik.core.stand.model import Stand
    from mahovik.use.study.response.speed_plan import SpeedPlan
    from mahovik.use.study.response.sweep import Sweep

PICTURES = (".svg", ".png")
SUFFIXES = (".json", ".csv", *PICTURES)

RPM = 9.549296585513721
"""1 rad/s in rpm."""

SHOWN = 12
"""Lines of orders in the table."""


@click.command()
@stand_argument
@click.option(
    "--speed", "speeds", multiple=True, required=True, metavar="NAME=..",
    help='One swept, "w1=0..6000rpm"; constant, "w2=1000 rpm"; geared, "w3=-0.5*w1"; all=...; others stand still.',
)  # fmt: skip
@click.option("--at", "point", metavar="POINT", required=True, help="A point or instrument; carrier: O1.")
@click.option("--steps", metavar="N", type=click.IntRange(2, 100_000), default=61, show_default=True, help="Speeds.")
@click.option(
    "--quantity",
    type=click.Choice(["acceleration", "velocity", "displacement"]),
    default="acceleration",
    show_default=True,
)
@click.option("--band", metavar="A..BHz", help="Also print the RMS of the harmonics within this band.")
@click.option("--phase", "phases", multiple=True, metavar="NAME=ANGLE", help='Phase at t = 0, "w1=90 deg"; default 0.')
@click.option(
    "--time", "seconds", metavar="S", type=click.FloatRange(min=0, min_open=True), help="Time limit of the sweep."
)
@click.option("-o", "output", metavar="FILE", type=click.Path(), help=f"{', '.join(SUFFIXES)}: numbers or a picture.")
@json_option()
def response(
    stand_file: str,
    speeds: tuple[str, ...],
    point: str,
    steps: int,
    quantity: str,
    band: str | None,
    phases: tuple[str, ...],
    seconds: float | None,
    output: str | None,
    as_json: bool,
) -> None:
    """Find the steady vibration at constant speeds.

    Periodic steady states under turning flywheels: orders, RMS, Campbell diagram, waterfall.

    The solutions are exact for the full equations, not linearised. Speeds must be in whole ratios: the motion has their
    common period. Ctrl-C keeps the speeds that are done.
    """
    stand = load_stand(stand_file)
    if output is not None and Path(output).suffix not in SUFFIXES:
        raise UsageError(f"-o {output}: expected a name that ends in {', '.join(SUFFIXES)}")
    from mahovik.use.study.linear.points import places
    from mahovik.use.study.response.speed_plan import read_speeds
    from mahovik.use.study.response.sweep import sweep

    places(stand, [point])
    asked = read_speeds(stand, speeds)
    if asked.sweep is None and given("steps"):
        raise UsageError("--steps: no speed is swept; give a range, as w1=0..6000rpm")
    limits, turned = None if band is None else read_band(band), read_phases(stand, phases)
    if output is not None:
        _check_place(Path(output))
    _warn(stand, asked)
    end = None if seconds is None else time.monotonic() + seconds

    count = 1 if asked.sweep is None else steps
    with progress(f"response of {stand.name}, speeds", count) as stage:

        def go_on(done: int) -> bool:
            stage.at(done)
            return end is None or done == 0 or time.monotonic() < end

        found = sweep(stand, asked, steps, point, quantity=quantity, band=limits, phases=turned, go_on=go_on)
    if not found.steps:
        raise KeyboardInterrupt
    if output is not None:
        _write(found, Path(output))
    if as_json:
        from mahovik.use.study.response.files import json_text

        print_json_text(json_text(found))
    else:
        _print(found)
    if found.interrupted:
        cut = "--time cut the sweep" if end is not None and time.monotonic() >= end else "interrupted"
        done = f"{len(found.steps)} of {steps} speeds are done"
        click.echo(f"{'warning' if cut[0] == '-' else 'error'}: {cut}: {done}", err=True)
        if cut == "interrupted":
            raise SystemExit(INTERRUPTED)


def read_band(text: str) -> tuple[float, float]:
    """Two frequencies, Hz. Raises UsageError."""
    found = re.fullmatch(r"\s*([\d.eE+]+)\s*(?:Hz)?\s*\.\.\s*([\d.eE+]+)\s*Hz\s*", text)
    try:
        low, high = (float(x) for x in (found[1], found[2])) if found else (1.0, 0.0)
    except ValueError:
        low, high = 1.0, 0.0
    if not 0.0 <= low < high < float("inf"):
        raise UsageError(f"--band {text}: expected two frequencies, the lower first, as 20..200Hz")
    return low, high


def _warn(stand: Stand, asked: SpeedPlan) -> None:
    """Warn of speeds beyond those of the motors."""
    for s, wheel in enumerate(stand.flywheels):
        fastest = max(abs(asked.speeds(value)[s]) for value in asked.sweep or (0.0,))
        most = None if wheel.motor is None else wheel.motor.speed
        if most is not None and fastest > most * (1 + 1e-9):
            text = f"{wheel.name} turns at up to {RPM * fastest:.6g} rpm, its motor at most at {RPM * most:.6g}"
            click.echo(f"warning: {text}", err=True)


def _check_place(path: Path) -> None:
    """Check, before anything is computed, that the file can be written. Raises UsageError."""
    from mahovik.proof.verify.files import probe

    if path.suffix in PICTURES:
        from mahovik.out.report.plot.draw import require

        require("plot")
    probe(path)


def _write(found: Sweep, path: Path) -> None:
    from mahovik.proof.verify.files import write

    if path.suffix in (".json", ".csv"):
        from mahovik.use.study.response.files import csv_text, json_text

        write(path, json_text(found) if path.suffix == ".json" else csv_text(found))
        return
    from mahovik.out.report.plot.draw import draw
    from mahovik.out.report.plot.response import panels

    write(path, draw(f"{found.stand.name}: response to unbalance", panels(found), path.suffix))


def _print(found: Sweep) -> None:
    """Print orders, RMS, and remarks on the steady states."""
    import numpy as np

    out, asked = console(), found.asked
    swept = "-" if asked.swept is None else asked.names[asked.swept]
    many = "one speed" if len(found.steps) == 1 else f"{len(found.steps)} speeds"
    title = f"{found.stand.name}: {found.quantity} of {found.point}, {many} of {swept}"
    rows = table("order", f"largest amplitude, {found.unit}>", "at, Hz>", f"speed of {swept}, rpm>", title=title)
    speeds = RPM * found.values
    for line in found.lines()[:SHOWN]:
        i = int(np.nanargmax(line.size))
        rows.add_row(line.name, f"{line.size[i]:.6g}", f"{line.frequency[i]:.6g}", f"{speeds[i]:.6g}")
    for band in (None, *([found.band] if found.band else [])):
        total = np.linalg.norm(found.rms(band), axis=1)
        name = "RMS, all" if band is None else f"RMS {band[0]:g}..{band[1]:g} Hz"
        i = int(np.nanargmax(total))
        rows.add_row(name, f"{total[i]:.6g}", "", f"{speeds[i]:.6g}")
    out.print(rows)
    _remarks(found)


def _remarks(found: Sweep) -> None:
    """Print remarks: free directions, instability, speeds without a steady state."""
    import numpy as np

    lost = [step for step in found.steps if step.problem is not None]
    if lost:
        click.echo(f"warning: {lost[0].problem}" + (f"; so at {len(lost)} speeds" if len(lost) > 1 else ""), err=True)
    growing = [RPM * step.value for step in found.steps if step.problem is None and not step.stable]
    if growing:
        many = f", {len(growing)} in all," if len(growing) > 1 else ""
        click.echo(f"warning: unstable at {growing[0]:.6g} rpm{many} deviations from the steady state grow", err=True)
    hold = max((step.hold for step in found.steps), key=lambda wrench: float(np.abs(wrench).max()))
    if np.abs(hold).max() > 1e-12:
        force, moment = (float(np.linalg.norm(part)) for part in (hold[:3], hold[3:]))
        held = f"a constant wrench of up to {force:.3g} N and {moment:.3g} N m"
        click.echo(f"the stand is free to drift: {held} holds its mean place")
