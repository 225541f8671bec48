"""`mahovik quiet`: speeds and phases of redundant flywheels that make a point quiet."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from mahovik.errors import UsageError
from mahovik.out.cli.arguments import console, load_stand, stand_argument, table
from mahovik.out.cli.group import INTERRUPTED
from mahovik.out.cli.json_output import json_option, print_json
from mahovik.out.cli.progress import progress
from mahovik.out.cli.quantities import axes_of, fraction, frequency, interval, numbers, orders_of, speed, vector

if TYPE_CHECKING:
    from mahovik.use.study.quiet import QuietResult
    from mahovik.use.study.quiet.result import Jitter


@click.command()
@stand_argument
@click.option("--point", metavar="NAME", required=True, help="Point or instrument to be quiet.")
@click.option("--band", metavar="LOW..HIGH", required=True, help='"20..200Hz".')
@click.option(
    "--momentum", metavar='"X Y Z"', help="Momentum of the flywheels to hold, in E1, N m s; default: that of --speeds."
)
@click.option(
    "--speeds",
    metavar='"1 2 .. rpm"',
    help="Present speeds, rad/s or with a unit; default: the smallest for the momentum.",
)
@click.option("--axis", "axes", metavar="LETTERS|X,Y,Z", default="xyz", show_default=True, help="Axes of the point.")
@click.option(
    "--measure",
    type=click.Choice(["acceleration", "velocity", "displacement", "rate", "angle"]),
    default="acceleration",
    show_default=True,
    help="Kind of jitter.",
)
@click.option(
    "--limit", metavar="SPEED", help='Limit of every speed, "5000 rpm"; default: no-load speeds of the motors.'
)
@click.option("--least", metavar="SPEED", default="0", help="Least speed of every flywheel.")
@click.option("--change", metavar="SPEED", help="Largest change of a speed.")
@click.option(
    "--reduction", metavar="X", type=float, help="Find the least change of speeds that makes it X times lower."
)
@click.option(
    "--avoid",
    multiple=True,
    metavar="F|LOW..HIGH|modes",
    help='Frequencies to avoid: "35Hz", "30..40Hz", or modes of the stand.',
)
@click.option(
    "--margin", metavar="PART", default="10%", show_default=True, help="Margin around a single avoided frequency."
)
@click.option("--orders", metavar="1,2", default="1,2", show_default=True, help="Orders of a speed that avoid them.")
@click.option(
    "--guard", metavar="PART", default="2%", show_default=True, help="Distance of lines from the band's ends."
)
@click.option("--seed", metavar="N", type=click.IntRange(min=0), default=0, show_default=True)
@click.option(
    "--time", "seconds", metavar="S", type=click.FloatRange(min=0, min_open=True), help="Time limit of the search."
)
@click.option(
    "--backend",
    type=click.Choice(["c", "scipy", "none"]),
    default="c",
    show_default=True,
    help="Backend of the simulation.",
)
@click.option("-o", "output", metavar="REGIME.toml", type=click.Path(), help="Output for `simulate --regime`.")
@click.option("--state", "state_file", metavar="S.json", type=click.Path(), help="Output for `simulate --start`.")
@json_option()
def quiet(stand_file: str, output: str | None, state_file: str | None, as_json: bool, **options: Any) -> None:
    """Quiet a point by speeds and phases of flywheels.

    The unbalance of redundant flywheels cancels at the point. Their momentum is kept exactly: only combinations of
    speeds without momentum change, and phases of flywheels that turn together. A simulation of the whole stand checks
    the jitter before and after.

    Exit status: 0 lower, and confirmed by simulation; 1 no allowed speeds, not lower or not as low as wanted, or the
    simulation disagrees; 2 bad input; 130 Ctrl-C.
    """
    import json

    from mahovik.proof.verify.files import probe, write

    stand = load_stand(stand_file)
    for name in (output, state_file):
        if name is not None:
            if Path(name).exists() and Path(name).samefile(stand_file):
                raise UsageError(f"{name} is read by this command; give another name")
            probe(Path(name))
    if None not in (output, state_file) and Path(str(output)).resolve() == Path(str(state_file)).resolve():
        raise UsageError(f"-o and --state {state_file}: one file for both; give the state another name")
    backend, seconds = options.pop("backend"), options.pop("seconds")
    chosen = _quiet_options(options, len(stand.flywheels))
    from mahovik.use.study.quiet import quiet as find
    from mahovik.use.study.quiet.files import regime_text, result

    with progress("searching") as stage:
        found = find(stand, chosen, seconds, None if backend == "none" else backend, stage.say)
    said = result(found)
    if output is not None:
        write(Path(output), regime_text(found))
    if state_file is not None:
        write(Path(state_file), json.dumps(said["after"]["start"], indent=1, allow_nan=False) + "\n")
    if as_json:
        print_json(said)
    else:
        _report(found)
    _end(found)


def _quiet_options(options: dict[str, Any], N: int) -> Any:
    """The options as QuietOptions. Raises UsageError."""
    from mahovik.use.study.quiet import QuietOptions

    margin = fraction("--margin", options["margin"])
    avoid = []
    for each in options["avoid"]:
        if ".." in each:
            avoid.append(interval("--avoid", each))
        elif each != "modes":
            f = frequency("--avoid", each)
            avoid.append((f * (1.0 - margin), f * (1.0 + margin)))
    speeds = None if options["speeds"] is None else numbers("--speeds", options["speeds"], "speeds", N)
    momentum = None if options["momentum"] is None else vector("--momentum", options["momentum"])
    return QuietOptions(
        options["point"],
        interval("--band", options["band"]),
        momentum,
        speeds,
        axes_of(options["axes"]),
        options["measure"],
        None if options["limit"] is None else speed("--limit", options["limit"]),
        speed("--least", options["least"], zero=True),
        None if options["change"] is None else speed("--change", options["change"]),
        options["reduction"],
        tuple(avoid),
        orders_of(options["orders"]),
        "modes" in options["avoid"],
        margin,
        fraction("--guard", options["guard"]),
        options["seed"],
    )


def _report(found: QuietResult) -> None:
    """Two tables: flywheels, lines; and the figures."""
    from rich.text import Text

    from mahovik.use.study.quiet.wheels import rpm

    out = console()
    band = f"{found.options.band[0]:g} to {found.options.band[1]:g} Hz"
    if found.wheels.moved > 1e-9:
        out.print(f"the given speeds do not hold the momentum: before is {rpm(found.wheels.moved):.4g} rpm off them")
    rows = table("flywheel", "before, rpm>", "after, rpm>", "change, rpm>", "phase, deg>")
    for s, name in enumerate(found.wheels.names):
        now, then = found.before.speeds[s], found.after.speeds[s]
        phase = float(found.after.phases[s]) * 180.0 / 3.141592653589793
        rows.add_row(Text(name), *(f"{rpm(x):.3f}" for x in (now, then, then - now)), f"{phase:.3f}")
    out.print(rows)
    out.print(_lines(found))
    for name, jitter in (("before, phases not held", found.before), ("after", found.after)):
        simulated = (
            "" if jitter.simulated is None else f", simulated {jitter.simulated:.4g} (expected {jitter.expected:.4g})"
        )
        rms = jitter.free if jitter is found.before else jitter.rms
        out.print(
            f"{name}: {found.options.measure} of {found.options.point}, {band}: RMS {rms:.4g} {found.unit}{simulated}"
        )
    ratio = found.reduction
    words = f"{ratio:.4g} times lower" if ratio >= 1.0 else f"{1.0 / ratio:.4g} times higher"
    out.print(f"{words}; momentum within {found.momentum_error:.1g} N m s")
    if found.hold is not None:
        out.print(f"phases off by {found.hold * 180.0 / 3.141592653589793:.3g} deg rms double the remaining jitter")


def _lines(found: QuietResult) -> Any:
    """Order 1 of all flywheels, before and after."""
    from rich.text import Text

    from mahovik.use.study.quiet.lines import in_band

    rows = table("", "line, Hz>", "flywheels", f"apart, {found.unit}>", f"together, {found.unit}>", "simulated>", "")

    def add(name: str, jitter: Jitter) -> None:
        heard = jitter.heard or (None,) * len(jitter.lines)
        for line, simulated in zip(jitter.lines, heard, strict=True):
            sizes = (2.0 * line.apart) ** 0.5, (2.0 * line.mean_square) ** 0.5
            names = " ".join(found.wheels.names[s] for s in line.flywheels)
            last = "-" if simulated is None else f"{simulated:.4g}"
            where = "" if in_band(line.frequency, found.options.band) else "outside the band"
            rows.add_row(name, f"{line.frequency:.4f}", Text(names), *(f"{x:.4g}" for x in sizes), last, where)

    add("before", found.before)
    add("after", found.after)
    return rows


def _end(found: QuietResult) -> None:
    """Warnings; exit status."""
    if found.interrupted:
        click.echo("interrupted: this is the best so far, not simulated", err=True)
        raise SystemExit(INTERRUPTED)
    if found.broken:
        click.echo(f"warning: the present speeds break their own limits: {', '.join(found.broken)}", err=True)
    if found.cut:
        click.echo("warning: --time cut the search: another run may find more", err=True)
    if not found.agrees:
        click.echo("error: the simulation differs from first order by more than 1 % of the RMS before", err=True)
        raise SystemExit(1)
    if found.reduction < 1.0:
        click.echo("error: no allowed speeds are lower than before; these are the lowest", err=True)
        raise SystemExit(1)
    wanted = found.options.reduction
    if wanted is not None and found.reduction < wanted:
        click.echo(f"error: not {wanted:g} times lower within the limits; this is the lowest found", err=True)
        raise SystemExit(1)
