"""`mahovik quiet`: speeds and phases of redundant flywheels that make a point quiet."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import click

from mahovik.errors import UsageError
from mahovik.out.cli import quantities
from mahovik.out.cli.options import (
    JSON,
    SEED_OF_STARTS,
    STAND_FILE,
    TIME_LIMIT,
    choice,
    command,
    file_option,
    load_stand,
    option,
)
from mahovik.out.cli.output import INTERRUPTED, print_json, print_line, print_table, require_other_file
from mahovik.out.progress import progress

if TYPE_CHECKING:
    from mahovik.use.vibration.quiet import QuietResult
    from mahovik.use.vibration.quiet.result import Jitter


@command()
def quiet(
    stand_file: str = STAND_FILE,
    point: str = option("--point", "Quiet this point or instrument, or hold.reaction.", metavar="NAME", required=True),
    band: tuple[float, float] = option(
        "--band",
        'Quiet it within these frequencies, "20..200Hz".',
        metavar="LOW..HIGH",
        required=True,
        parse=quantities.band,
    ),
    momentum: tuple[float, float, float] | None = option(
        "--momentum",
        "Hold this momentum of the flywheels, in E1, N m s; default: that of --speeds.",
        metavar='"X Y Z"',
        parse=quantities.vector,
    ),
    speeds: tuple[float, ...] | None = option(
        "--speeds",
        "Begin at these speeds, rad/s or with a unit; default: the smallest for the momentum.",
        metavar='"1 2 .. rpm"',
        parse=quantities.speeds,
    ),
    axes: tuple[tuple[float, float, float], ...] = option(
        "--axis",
        "Measure along these axes of the point.",
        metavar="LETTERS|X,Y,Z",
        default="xyz",
        parse=quantities.axes,
    ),
    measure: str | None = choice(
        "--measure",
        ["acceleration", "velocity", "displacement", "rate", "angle", "force", "moment"],
        "Measure this kind of jitter; default acceleration, of the reaction force.",
    ),
    limit: float | None = option(
        "--limit",
        'Limit every speed, "5000 rpm"; default: no-load speeds of the motors.',
        metavar="SPEED",
        parse=quantities.speed_above_zero,
    ),
    least: float = option(
        "--least",
        "Keep every flywheel above this speed.",
        metavar="SPEED",
        default="0",
        show_default=False,
        parse=quantities.speed,
    ),
    change: float | None = option(
        "--change", "Change no speed by more than this.", metavar="SPEED", parse=quantities.speed_above_zero
    ),
    reduction: float | None = option(
        "--reduction", "Find the least change of speeds that makes it X times lower.", metavar="X", type=float
    ),
    avoid: tuple[str, ...] = option(
        "--avoid",
        'Avoid frequencies: "35Hz", "30..40Hz", or modes of the stand.',
        metavar="F|LOW..HIGH|modes",
        multiple=True,
    ),
    margin: float = option(
        "--margin",
        "Keep this margin around a single avoided frequency.",
        metavar="PART",
        default="10%",
        parse=quantities.fraction,
    ),
    orders: tuple[int, ...] = option(
        "--orders",
        "Avoid them by these orders of a speed.",
        metavar="1,2",
        default="1,2",
        parse=quantities.whole_numbers,
    ),
    guard: float = option(
        "--guard",
        "Keep lines at this distance from the band's ends.",
        metavar="PART",
        default="2%",
        parse=quantities.fraction,
    ),
    seed: int = SEED_OF_STARTS,
    seconds: float | None = TIME_LIMIT,
    output: str | None = file_option("-o", "REGIME.toml", "Write the speeds, for `simulate --regime`."),
    state_file: str | None = file_option("--state", "S.json", "Write the state, for `simulate --start`."),
    as_json: bool = JSON,
) -> None:
    """Quiet a point by speeds and phases of flywheels.

    The unbalance of redundant flywheels cancels at the point. Their momentum is kept exactly: only combinations of
    speeds without momentum change, and phases of flywheels that turn together. The full equations check the jitter
    before and after.

    Exit status: 0 lower, and confirmed by the full equations; 1 no allowed speeds, not lower or not as low as wanted,
    or the full equations disagree; 2 bad input; 130 Ctrl-C.
    """
    from mahovik.writing import write

    stand = load_stand(stand_file)
    for option_name, name in (("-o", output), ("--state", state_file)):
        if name is not None:
            require_other_file(Path(name), [stand_file], f"{option_name} {name}", "result")
    if None not in (output, state_file) and Path(str(output)).resolve() == Path(str(state_file)).resolve():
        raise UsageError(f"-o and --state {state_file}: one file for both; give the state another name")
    from mahovik.out.functions.vibration import quiet as find

    if speeds is not None and len(speeds) != len(stand.flywheels):
        raise UsageError(f"--speeds: {len(speeds)} speeds, but the stand has {len(stand.flywheels)} flywheels")
    with progress("searching") as stage:
        found = find(
            stand, point, band, momentum=momentum, speeds=speeds, axes=axes, measure=measure, limit=limit, least=least,
            change=change, reduction=reduction, avoid=_intervals(avoid, margin), modes="modes" in avoid, margin=margin,
            orders=orders, guard=guard, seed=seed, seconds=seconds, progress=stage.show,
        )  # fmt: skip
    if output is not None:
        found.save(output)
    if state_file is not None:
        write(Path(state_file), found.start + "\n")
    if as_json:
        print_json(found.to_dict())
    else:
        _print(found.result)
    _end(found.result)


def _intervals(avoid: tuple[str, ...], margin: float) -> tuple[tuple[float, float], ...]:
    """The frequencies of `--avoid` with a margin around single ones, Hz. Raises UsageError."""
    found = []
    for each in avoid:
        if ".." in each:
            found.append(quantities.band("--avoid", each))
        elif each != "modes":
            f = quantities.frequency("--avoid", each)
            found.append((f * (1.0 - margin), f * (1.0 + margin)))
    return tuple(found)


def _print(found: QuietResult) -> None:
    """Two tables: flywheels, lines; and the figures."""
    from mahovik.use.vibration.quiet.options import rpm

    band = f"{found.options.band[0]:g} to {found.options.band[1]:g} Hz"
    if found.wheels.distance > 1e-9:
        print_line(
            f"the given speeds do not hold the momentum: before is {rpm(found.wheels.distance):.4g} rpm off them"
        )
    rows = []
    for name, now, then, phase in zip(
        found.wheels.names, found.before.speeds, found.after.speeds, found.after.phases, strict=True
    ):
        rows.append((name, *(f"{rpm(x):.3f}" for x in (now, then, then - now)), f"{math.degrees(phase):.3f}"))
    print_table(("flywheel", "before, rpm>", "after, rpm>", "change, rpm>", "phase, deg>"), rows)
    columns = (
        "amplitude, 0 to peak",
        "line, Hz>",
        "flywheels",
        f"apart, {found.unit}>",
        f"together, {found.unit}>",
        "in full>",
        "",
    )
    rows = [*_lines(found, "before", found.before), *_lines(found, "after", found.after)]
    print_table(columns, rows, title="amplitudes, 0 to peak")
    for name, jitter in (("before, phases not held", found.before), ("after", found.after)):
        full = "" if jitter.full is None else f"; at these phases {jitter.rms:.4g}, in full {jitter.full:.4g}"
        rms = jitter.free if jitter is found.before else jitter.rms
        what = f"{found.options.measure} of {found.options.point}, {band}"
        print_line(f"{name}: {what}: RMS {rms:.4g} {found.unit}{full}")
    ratio = found.reduction
    words = f"{ratio:.4g} times lower" if ratio >= 1.0 else f"{1.0 / ratio:.4g} times higher"
    along = "" if found.stand.hold is None else " along the freedoms"
    kept = f"; momentum{along} within {found.momentum_error:.1g} N m s" if len(found.wheels.axes) else ""
    print_line(f"{words}{kept}")
    if found.hold is not None:
        print_line(f"phases off by {math.degrees(found.hold):.3g} deg rms double the remaining jitter")


def _lines(found: QuietResult, when: str, jitter: Jitter) -> Iterator[tuple[str, ...]]:
    """Rows for order 1 of all flywheels."""
    from mahovik.use.vibration.band import in_band

    in_full = jitter.full_lines or (None,) * len(jitter.lines)
    for line, full in zip(jitter.lines, in_full, strict=True):
        sizes = (f"{(2.0 * x) ** 0.5:.4g}" for x in (line.apart, line.mean_square))
        names = " ".join(found.wheels.names[s] for s in line.flywheels)
        where = "" if in_band(line.frequency, found.options.band) else "outside the band"
        yield when, f"{line.frequency:.4f}", names, *sizes, "-" if full is None else f"{full:.4g}", where


def _end(found: QuietResult) -> None:
    """Warnings; exit status."""
    if found.interrupted:
        click.echo("interrupted: this is the best so far, not checked by the full equations", err=True)
        raise SystemExit(INTERRUPTED)
    if found.broken_options:
        click.echo(f"warning: the present speeds break their own limits: {', '.join(found.broken_options)}", err=True)
    if found.cut:
        click.echo("warning: --time cut the search: another run may find more", err=True)
    for jitter in (found.before, found.after):
        if jitter.unchecked:
            click.echo(f"warning: not checked by the full equations: {jitter.unchecked}", err=True)
    if not found.agrees:
        click.echo("error: the full equations differ from first order by more than 1 % of the RMS before", err=True)
        raise SystemExit(1)
    if found.reduction < 1.0:
        click.echo("error: no allowed speeds are lower than before; these are the lowest", err=True)
        raise SystemExit(1)
    wanted = found.options.reduction
    if wanted is not None and found.reduction < wanted:
        click.echo(f"error: not {wanted:g} times lower within the limits; this is the lowest found", err=True)
        raise SystemExit(1)
