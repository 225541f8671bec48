"""`mahovik jitter`: what wheels at any constant speeds do to a point."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

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
    flag,
    is_given,
    load_stand,
    option,
    read_phases,
)
from mahovik.out.cli.output import INTERRUPTED, print_json_text, print_table, require_suffix
from mahovik.out.cli.sweep import PICTURES, SHOWN, STEPS, SUFFIXES, TimeLimit, check_place
from mahovik.out.progress import progress

if TYPE_CHECKING:
    from mahovik.out.functions.jitter import Jitter

SUMS = {
    "rms": "RMS",
    "rss": "RMS over all phases",
    "worst": "worst case over phases",
    "mean": "mean, with its sign",
}
"""Rows below the lines, by name."""

POSES = ("rad", "m", "1")
"""Units of what a pose has."""

SMALL_MEAN = 1e-6
"""Part of the worst case above which a mean is printed."""

NOTHING, NO_MEAN = 1e-20, 1e-13
"""SI: smaller values are rounding and printed as 0; so are means of an angle or a shift, as a pose of rest is found."""

FAR_OFF = 0.01
"""Difference of the RMS to first order from that of the full equations above which a sweep warns."""

LARGE_MARGIN = 1e4
"""Margin of a requirement from which its number says nothing more: what is left is rounding, or nothing."""


def _table(declaration: str, help: str) -> Any:
    return option(declaration, help, metavar="NAME=FILE.csv", multiple=True)


@command()
def jitter(
    stand_file: str = STAND_FILE,
    speeds: tuple[str, ...] = option(
        "--speed",
        'Turn flywheels: "all=3000rpm", then others by name, "w2=2987rpm"; one swept, "w1=0..6000rpm"; geared, '
        '"w3=-0.5*w1"; the rest stand still.',
        metavar="NAME=..",
        multiple=True,
        required=True,
    ),
    point: str | None = option(
        "--at",
        "Measure at a point or instrument; carrier stands for O1. Or a load: a flywheel for its mount, hold.reaction; "
        "or a freedom, hold.pitch.",
        metavar="POINT",
    ),
    quantity: str | None = choice(
        "--quantity",
        ["angle", "rate", "displacement", "velocity", "acceleration", "force", "moment"],
        "Find this quantity; default angle, of a load force.",
    ),
    steps: int = STEPS,
    phases: tuple[str, ...] = PHASES,
    harmonics: tuple[str, ...] = _table("--harmonics", "Add a maker's table of harmonics, all=FILE or by name."),
    noise: tuple[str, ...] = _table("--noise", "Add a maker's table of broadband noise."),
    inner_modes: tuple[str, ...] = _table("--inner-modes", "Add a wheel's radial, axial and rocking modes."),
    modes: str | None = file_option("--modes", "FILE.csv", "Add structural modes, one-way."),
    sight: str | None = file_option("--sight", "FILE.csv", "Find a line of sight by sensitivities, instead of --at."),
    require: tuple[str, ...] = option(
        "--require",
        'Judge by a limit, "rms 0.1 arcsec", "worst 1 um 10..200Hz", or by a mask in a CSV file.',
        metavar="LIMIT",
        multiple=True,
    ),
    order: int | None = option(
        "--order",
        "Keep combinations of this many turns in all; default: as many as the accuracy needs.",
        metavar="N",
        type=click.IntRange(1, 20),
    ),
    exact: bool = flag("--exact", "Use the full equations at every speed of a sweep."),
    seconds: float | None = option(
        "--time", "Limit the time of the exact solutions.", metavar="TIME", parse=quantities.time_limit
    ),
    output: str | None = file_option("-o", "FILE", f"Write numbers or a picture: {', '.join(SUFFIXES)}."),
    as_json: bool = JSON,
) -> None:
    """Find the jitter of a point.

    Flywheels turn at any constant speeds, without a common period: lines of every wheel and order and of their
    combinations, RMS, worst case over all phases.

    One set of speeds is solved by harmonic balance of the full equations; what it leaves out is measured. A sweep is
    solved to first order and compared with the full equations at some speeds; --exact solves them at all.

    Exit status: 0 all requirements met, or none given; 1 a requirement failed, or no steady motion; 2 bad input; 130
    Ctrl-C.
    """
    stand = load_stand(stand_file)
    suffix = "" if output is None else require_suffix(output, SUFFIXES)
    from mahovik.out.functions.jitter import jitter as run
    from mahovik.use.vibration.speeds import read_speeds

    swept = read_speeds(stand, speeds).sweep is not None
    for name, given in (("steps", is_given("steps")), ("exact", exact)):
        if given and not swept:
            raise UsageError(f"--{name}: no speed is swept; give a range, as w1=0..6000rpm")
    turned = read_phases(stand, phases)
    if output is not None:
        check_place(output, suffix)
    limit = TimeLimit(seconds)
    with progress(f"jitter of {stand.name}, speeds") as stage:
        found = run(
            stand, speeds, point, quantity=quantity, steps=steps, phases=turned,
            harmonics=_files("--harmonics", harmonics), noise=_files("--noise", noise),
            inner_modes=_files("--inner-modes", inner_modes), modes=modes, sight=sight, require=require,
            order=order, exact=exact, go_on=limit.go_on, progress=stage.show,
        )  # fmt: skip
    if output is not None:
        _write(found, Path(output), suffix)
    if as_json:
        from mahovik.use.vibration.tables import json_text

        print_json_text(json_text(found.study, found.verdicts))
    else:
        _print(found)
    if not found.met:
        raise SystemExit(1)
    if found.interrupted:
        cut = limit.is_over()
        words = "warning: --time cut the exact solutions" if cut else "error: interrupted"
        click.echo(f"{words}: {len(found)} speeds are done", err=True)
        if not cut:
            raise SystemExit(INTERRUPTED)


def _files(name: str, given: tuple[str, ...]) -> dict[str, str]:
    """Files by flywheel. Raises UsageError."""
    found: dict[str, str] = {}
    for each in given:
        wheel, separator, path = each.partition("=")
        if not separator or wheel in found:
            raise UsageError(f"{name} {each}: expected NAME=FILE.csv, each name once")
        found[wheel] = path
    return found


def _write(found: Jitter, path: Path, suffix: str) -> None:
    from mahovik.writing import write

    if suffix in PICTURES:
        from mahovik.out.report.plot.draw import draw
        from mahovik.out.report.plot.jitter import panels

        write(path, draw(f"{found.stand.name}: jitter", panels(found.study), suffix))
    else:
        from mahovik.use.vibration.tables import csv_text, json_text

        write(path, json_text(found.study, found.verdicts) if suffix == ".json" else csv_text(found.study))


def _print(found: Jitter) -> None:
    """Print lines, sums, and remarks on accuracy."""
    import numpy as np

    from mahovik.use.vibration.view import ARCSEC

    study = found.study
    scale, unit = (1.0, found.unit) if study.measure.arcsec is None else (ARCSEC, study.measure.arcsec)
    many = "one speed" if len(found) == 1 else f"{len(found)} speeds"
    largest = "largest " if study.swept else ""
    columns = ("line", "Hz>", *(f"{largest}amplitude {axis}, {unit}>" for axis in study.axes))
    rows = []
    lines = study.lines
    total = np.linalg.norm(lines.sizes, axis=2)
    for i in np.argsort(-np.nanmax(total, axis=0, initial=0.0), kind="stable")[:SHOWN]:
        at = int(np.nanargmax(total[:, i]))
        if total[at, i] > NOTHING:
            sizes = [f"{scale * x:.6g}" for x in lines.sizes[at, i, : len(study.axes)]]
            rows.append((f"{lines.names[i].text} {lines.names[i].part}", f"{lines.frequency[at, i]:.6g}", *sizes))
    sums = study.sums()
    for name, values in sums.items():
        small = max(NOTHING, NO_MEAN if name == "mean" and found.unit in POSES else 0.0)
        least = max(small, SMALL_MEAN * np.nanmax(sums["worst"])) if name == "mean" else -1.0
        if np.nanmax(np.abs(values)) > least:
            at = int(np.nanargmax(np.linalg.norm(values, axis=1)))
            words = SUMS[name]
            speed = f" at {RPM * study.value[at]:.6g} rpm" if study.swept else ""
            shown = values[at, : len(study.axes)]
            rows.append(
                (f"{words}{speed}", "", *(f"{scale * x:.6g}" for x in np.where(np.abs(shown) > small, shown, 0.0)))
            )
    print_table(
        columns, rows, title=f"{study.stand.name}: {study.quantity} of {study.point}, {many}; amplitudes 0 to peak"
    )
    if found.verdicts:
        _print_verdicts(found, scale, unit)
    _remarks(found, scale, unit)


def _print_verdicts(found: Jitter, scale: float, unit: str) -> None:
    """Print requirements: limit, value, margin, worst speed."""
    columns = ("requirement", f"limit, {unit}>", f"largest, {unit}>", "margin>", "axis", "speed, rpm>", "")
    rows: list[tuple[Any, ...]] = []
    for each in found.verdicts:
        margin = f"{100 * each.margin:.4g} %" if each.margin < LARGE_MARGIN else f"over {100 * LARGE_MARGIN:g} %"
        numbers = (f"{scale * each.requirement.limit:.6g}", f"{scale * each.value:.6g}", margin)
        speed = f"{RPM * found.study.value[each.step]:.6g}"
        said = ("met", "green") if each.met else ("failed", "red")
        rows.append((each.requirement.text, *numbers, found.study.axes[each.axis], speed, said))
    print_table(columns, rows, title="requirements, with the makers' tolerances")


def _remarks(found: Jitter, scale: float, unit: str) -> None:
    """Print what is left out, and speeds with a problem."""
    import numpy as np

    from mahovik.use.vibration.torus_motion import SAMPLES

    study = found.study
    if study.checks:
        worst = max(study.checks, key=lambda check: check.off)
        click.echo(
            f"first order; at {len(study.checks)} speeds the full equations give the same RMS within {worst.off:.1e}, "
            f"the most at {RPM * study.value[worst.step]:.6g} rpm"
        )
        if worst.off > FAR_OFF:
            click.echo("warning: first order is too coarse for these unbalances; use --exact", err=True)
    elif np.isfinite(study.left_out).any():
        what = "accelerations" if study.stand.hold is None else "accelerations and reaction"
        click.echo(
            f"harmonic balance of order {max(study.order)}; {what} left out, measured at {SAMPLES} random sets "
            f"of phases: {np.nanmax(study.left_out):.1e} of the largest"
        )
        if np.isfinite(study.remainder).any():
            left = float(np.nanmax(study.remainder))
            most = f"{scale * left:.1e} {unit}" if left > NOTHING else f"0 {unit}"
            click.echo(f"{study.quantity} left out at any phases, sum of its lines of two more orders: {most}")
        else:
            click.echo(f"what is left out of the {study.quantity} itself is not known: too many flywheels turn")
    structure = study.chain.makers.structure
    if structure is not None:
        mass, gyro = (float(each.max(initial=0.0)) for each in study.chain.ratios)
        click.echo(
            f"{len(structure.omega)} structural modes, one-way; the way back to the wheels would shift a frequency by "
            f"up to {50 * mass:.2g} % and couple modes by up to {100 * gyro:.2g} %"
        )
    if study.problems:
        count = f"; so at {len(study.problems)} speeds" if len(study.problems) > 1 else ""
        step, text = study.problems[0]
        where = f"at {RPM * study.value[step]:.6g} rpm: " if study.swept else ""
        click.echo(f"warning: {where}{text}{count}", err=True)
    if np.abs(study.hold).max() > 1e-12:
        force, moment = (float(np.linalg.norm(part)) for part in (study.hold[:3], study.hold[3:]))
        held = f"a constant wrench of up to {force:.3g} N and {moment:.3g} N m"
        click.echo(f"the stand is free to drift: {held} holds its mean place")
