"""`mahovik response`: motion of a point under flywheels at constant speeds."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from mahovik.contract.quantities import RPM
from mahovik.errors import UsageError
from mahovik.out.cli import quantities
from mahovik.out.cli.options import (
    JSON,
    PHASES,
    STAND_FILE,
    choice,
    command,
    file_option,
    is_given,
    load_stand,
    option,
    read_phases,
)
from mahovik.out.cli.output import INTERRUPTED, print_json_text, print_table, require_suffix
from mahovik.out.cli.sweep import SHOWN, STEPS, SUFFIXES, TimeLimit, check_place
from mahovik.out.progress import progress

if TYPE_CHECKING:
    from mahovik.use.vibration.sweep import Sweep


@command()
def response(
    stand_file: str = STAND_FILE,
    speeds: tuple[str, ...] = option(
        "--speed",
        'Turn flywheels: one swept, "w1=0..6000rpm"; constant, "w2=1000 rpm"; geared, "w3=-0.5*w1"; all=...; '
        "others stand still.",
        metavar="NAME=..",
        multiple=True,
        required=True,
    ),
    point: str = option(
        "--at",
        "Measure at a point or instrument; carrier stands for O1. Of a held carrier also hold.reaction, or a freedom "
        "as hold.pitch.",
        metavar="POINT",
        required=True,
    ),
    steps: int = STEPS,
    quantity: str | None = choice(
        "--quantity",
        ["acceleration", "velocity", "displacement", "rate", "angle", "force", "moment"],
        "Find this quantity; default acceleration, of the reaction force.",
    ),
    band: tuple[float, float] | None = option(
        "--band", "Print also the RMS of the harmonics within this band.", metavar="A..BHz", parse=quantities.band
    ),
    phases: tuple[str, ...] = PHASES,
    seconds: float | None = option(
        "--time", "Limit the time of the sweep.", metavar="TIME", parse=quantities.time_limit
    ),
    output: str | None = file_option("-o", "FILE", f"Write numbers or a picture: {', '.join(SUFFIXES)}."),
    as_json: bool = JSON,
) -> None:
    """Find the steady vibration at constant speeds.

    Periodic steady states under turning flywheels: orders, RMS, Campbell diagram, waterfall.

    The solutions are exact for the full equations, not linearised. Speeds must be in whole ratios: the motion has their
    common period. Ctrl-C keeps the speeds that are done.
    """
    stand = load_stand(stand_file)
    suffix = "" if output is None else require_suffix(output, SUFFIXES)
    from mahovik.core.stand.hold import numbers_in_words
    from mahovik.out.functions.vibration import response as run
    from mahovik.use.vibration.speeds import read_speeds
    from mahovik.use.vibration.view import find_view

    find_view(stand, point, quantity)
    if read_speeds(stand, speeds).sweep is None and is_given("steps"):
        raise UsageError("--steps: no speed is swept; give a range, as w1=0..6000rpm")
    turned = read_phases(stand, phases)
    if output is not None:
        check_place(output, suffix)
    limit = TimeLimit(seconds)
    with progress(f"response of {stand.name}, speeds") as stage:
        found = run(
            stand, speeds, point, steps=steps, quantity=quantity, band=band, phases=turned, go_on=limit.go_on,
            progress=stage.show,
        ).sweep  # fmt: skip
    if output is not None:
        _write(found, Path(output), suffix)
    if as_json:
        from mahovik.use.vibration.sweep import json_text

        print_json_text(json_text(found))
    else:
        _print(found)
        if found.point.startswith("hold.") and (numbers := numbers_in_words(stand.hold, "hold.")):
            click.echo(numbers)
    if found.interrupted:
        cut = "--time cut the sweep" if limit.is_over() else "interrupted"
        done = f"{len(found.steps)} of {found.planned} speeds are done"
        click.echo(f"{'warning' if cut[0] == '-' else 'error'}: {cut}: {done}", err=True)
        if cut == "interrupted":
            raise SystemExit(INTERRUPTED)


def _write(found: Sweep, path: Path, suffix: str) -> None:
    from mahovik.writing import write

    if suffix in (".json", ".csv"):
        from mahovik.use.vibration.sweep import csv_text, json_text

        write(path, json_text(found) if suffix == ".json" else csv_text(found))
        return
    from mahovik.out.report.plot.draw import draw
    from mahovik.out.report.plot.response import panels

    write(path, draw(f"{found.stand.name}: response to unbalance", panels(found), suffix))


def _print(found: Sweep) -> None:
    """Print orders, RMS, and remarks on the steady states."""
    import numpy as np

    asked = found.plan
    swept = "-" if asked.swept is None else asked.names[asked.swept]
    many = "one speed" if len(found.steps) == 1 else f"{len(found.steps)} speeds"
    title = f"{found.stand.name}: {found.quantity} of {found.point}, {many} of {swept}; amplitudes 0 to peak"
    if len(found.axes) > 1:
        title += f"; root of the sum of squares over {', '.join(found.axes)}"
    columns = ("order", f"largest amplitude, {found.unit}>", "at, Hz>", f"speed of {swept}, rpm>")
    rows = []
    speeds = RPM * found.values
    for line in found.lines()[:SHOWN]:
        i = int(np.nanargmax(line.size))
        rows.append((line.name, f"{line.size[i]:.6g}", f"{line.frequency[i]:.6g}", f"{speeds[i]:.6g}"))
    for band in (None, *([found.band] if found.band else [])):
        total = np.linalg.norm(found.rms(band), axis=1)
        name = "RMS, all" if band is None else f"RMS {band[0]:g}..{band[1]:g} Hz"
        i = int(np.nanargmax(total))
        rows.append((name, f"{total[i]:.6g}", "", f"{speeds[i]:.6g}"))
    print_table(columns, rows, title=title)
    _remarks(found)


def _remarks(found: Sweep) -> None:
    """Print remarks: free directions, instability, speeds without a steady state."""
    import numpy as np

    lost = [step for step in found.steps if step.problem is not None]
    if lost:
        click.echo(f"warning: {lost[0].problem}" + (f"; so at {len(lost)} speeds" if len(lost) > 1 else ""), err=True)
    if found.coarse is not None:
        click.echo(f"warning: coarse near {RPM * found.coarse:.6g} rpm: the largest amplitude may be above", err=True)
    growing = [RPM * step.value for step in found.steps if step.problem is None and not step.stable]
    if growing:
        many = f", {len(growing)} in all," if len(growing) > 1 else ""
        click.echo(f"warning: unstable at {growing[0]:.6g} rpm{many} deviations from the steady state grow", err=True)
    hold = max((step.hold for step in found.steps), key=lambda wrench: float(np.abs(wrench).max()))
    if np.abs(hold).max() > 1e-12:
        force, moment = (float(np.linalg.norm(part)) for part in (hold[:3], hold[3:]))
        held = f"a constant wrench of up to {force:.3g} N and {moment:.3g} N m"
        click.echo(f"the stand is free to drift: {held} holds its mean place")
