"""`mahovik plan`: flywheel motions that make the carrier move as required."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from mahovik.out.cli.options import (
    MOTION,
    SEED_OF_STARTS,
    STAND_FILE,
    TIME_LIMIT,
    choice,
    command,
    file_option,
    json_option,
    load_stand,
    option,
)
from mahovik.out.cli.output import end_of_search, print_json, print_line, print_table, require_other_file
from mahovik.out.cli.progress import progress

if TYPE_CHECKING:
    from mahovik.core.motion.programme import Programme
    from mahovik.use.plan import Plan
    from mahovik.use.plan.outcome import Method


@command(short_help="Find a programme that moves the carrier as required.")
def plan(
    stand_file: str = STAND_FILE,
    motion_file: str = MOTION,
    output: str = file_option("-o", "P.json", "Write the programme to this file.", required=True),
    seconds: float | None = TIME_LIMIT,
    seed: int = SEED_OF_STARTS,
    winding: str | None = option(
        "--winding", "Set the turns per period, in place of the motion file's.", metavar="any|spin|rock|N,N,.."
    ),
    keep: int = option(
        "--keep",
        "Keep the best K programmes, as P.2.json and so on.",
        metavar="K",
        type=click.IntRange(1, 99),
        default=1,
    ),
    method: Method = choice(
        "--method",
        ["fourier", "ocp"],
        "Plan by fourier; or then by (13) with IPOPT, with (12) as constraints.",
        default="fourier",
    ),
    as_json: bool = json_option("Print figures and status as JSON."),
) -> None:
    """Plan a programme: flywheel motions that make the carrier move exactly as required.

    A motion out of reach is refused at once, with what is missing. Programmes are verified by the literal reference.
    Ctrl-C gives the best so far. --time limits the search; run-ups after it, if any, have half of the time. The
    verification always runs completely.

    Exit status: 0 a programme inside the bounds; 1 none, or a bound is exceeded; 2 bad input; 130 Ctrl-C.
    """
    stand = load_stand(stand_file)
    from mahovik.core.motion.programme import programme_text
    from mahovik.out.functions.given import required_of
    from mahovik.out.functions.programmes import plan as find
    from mahovik.out.functions.programmes import read_winding
    from mahovik.writing import write_all

    motion = required_of(motion_file, stand)
    chosen = read_winding(winding, len(stand.flywheels), motion.periodic)
    paths = [
        Path(output).with_suffix(f".{k}{Path(output).suffix}") if k > 1 else Path(output) for k in range(1, keep + 1)
    ]
    for path in paths:
        require_other_file(path, (stand_file, motion_file), f"-o {output}", "programme")
    with progress("searching") as stage:
        found = find(
            stand, motion, seconds=seconds, seed=seed, winding=chosen, keep=keep, method=method,
            progress=stage.show,
        ).result  # fmt: skip
    for line in found.warnings:
        click.echo(f"warning: {line}", err=True)
    texts = {path.name: programme_text(each) for path, each in zip(paths, found.programmes, strict=False)}
    write_all(paths[0].parent, texts)  # all or none
    if as_json:
        print_json(_plain(found, paths))
    else:
        for path, programme in zip(paths, found.programmes, strict=False):
            _report(programme, path)
        _say(found)
    if found.programmes and len(found.programmes) < keep:
        _leftover(paths[len(found.programmes) :], f"{len(found.programmes)} of {keep} programmes found")
    _end(found)


def _report(programme: Programme, path: Path) -> None:
    """Print figures of a written programme."""
    report: Any = programme.report
    is_slew = report["kind"] == "slew"
    words = f"{report['goal']} slew, {report['duration']:.6g} s" if is_slew else _kind_of(programme)
    print_line(f"{click.format_filename(path)}   {words}")
    torque, of = ("peak_motor_torque", "motor torque") if is_slew else ("peak_torque", "torque")
    peaks = zip(report["peak_speed"], report["peak_acceleration"], report[torque], strict=True)
    print_table(
        ("flywheel", "peak speed, rad/s>", "peak acceleration, rad/s2>", f"peak {of}, N m>"),
        ((name, *(f"{x:.4g}" for x in row)) for name, row in zip(programme.flywheels, peaks, strict=True)),
    )
    if is_slew:
        _report_slew(report)
        return
    figures = {
        "residual": report["residual"],
        "simulation error": report.get("simulation_error"),
        "objective": report["objective"],
        "least singular value": report["least_singular_value"],
        "sign changes of det I": report["det_I_sign_changes"],
    }
    print_line(", ".join(f"{name} {value:.3g}" for name, value in figures.items() if value is not None))
    if "ocp" in report:
        _report_ocp(report["method"], report["ocp"])
    for key, name in (("runup", "run-up"), ("rundown", "run-down")):
        if "deviation" in report.get(key, {}):
            strayed = [report[key]["deviation"][kind] for kind in ("linear", "angular")]
            largest = (
                f"{1e3 * x['largest']:.3g} {unit} at {x['t']:.3g} s"
                for x, unit in zip(strayed, ("mm", "mrad"), strict=True)
            )
            print_line(f"{name}: terminal error {report[key]['terminal_error']:.2g}, deviation {', '.join(largest)}")


def _kind_of(programme: Programme) -> str:
    """Kind and winding."""
    return f"{programme.report['kind']}, winding {list(programme.winding)}"


def _report_slew(report: Any) -> None:
    """Print what a slew takes of the limits, and how exact it is."""
    for line in report["hardest"]:
        click.echo(line)
    if report["least_duration"] is not None:
        click.echo(f"the least duration by the mean model, with jumps of the torque: {report['least_duration']:.6g} s")
    if report["through_zero"]:
        click.echo(f"passes zero speed: {', '.join(report['through_zero'])}")
    error = report.get("simulation_error")
    more = "" if error is None else f", simulation error {error:.3g}"
    click.echo(f"residual {report['residual']:.3g}{more}; O1 moves by up to {1e3 * report['strayed']:.3g} mm")
    if "unbalance" in report:
        _report_unbalance(report["unbalance"])


def _report_unbalance(found: Any) -> None:
    """Print what unbalance adds to a slew of the mean stand."""
    if found is None:
        click.echo("what unbalance adds is not simulated: the flywheels turn too often; see `mahovik jitter`")
        return
    angle, shift = ({key: float(value) for key, value in found[name].items()} for name in ("angle", "shift"))
    arcsec = {key: math.degrees(value) * 3600.0 for key, value in angle.items()}
    click.echo(
        f"unbalance adds up to {arcsec['largest']:.3g} arcsec (RMS {arcsec['rms']:.3g}, at the end "
        f"{arcsec['end']:.3g}) and {1e6 * shift['largest']:.3g} um of O1"
    )


def _report_ocp(method: str, ocp: Any) -> None:
    """Print how (13) was solved."""
    raw = ocp["raw_residual"]
    then = "" if raw is None else f", then refined; residual between the nodes {raw:.2g} before that"
    click.echo(f"{method}: {ocp['ipopt']}, {ocp['iterations']} iterations{then}")
    click.echo(f"objective {ocp['objective_of_start']:.5g} of the start, {ocp['objective']:.5g} now")


def _leftover(paths: list[Path], found: str) -> None:
    """Remove programmes of an earlier run under the remaining names, so that nobody mistakes them for new ones."""
    click.echo(f"warning: {found}", err=True)
    for path in paths:
        if path.is_file():
            path.unlink()
            click.echo(f"warning: {click.format_filename(path)} was removed: it was from an earlier run", err=True)


def _plain(found: Plan, paths: list[Path]) -> dict[str, Any]:
    """For --json; SI."""
    return {
        "status": found.status,
        "reason": found.reason,
        "words": found.words,
        "warnings": found.warnings,
        "interrupted": found.interrupted,
        "effort": found.effort,
        "programmes": [
            {"file": str(path), "flywheels": each.flywheels, "winding": each.winding, **each.report}
            for path, each in zip(paths, found.programmes, strict=False)
        ],
    }


def _say(found: Plan) -> None:
    """Print the status with its reason, and the effort."""
    click.echo(found.status if found.reason is None else f"{found.status} {found.reason}")
    if found.status == "OK_LIMIT":
        for line in found.words:
            click.echo(line)
    if found.effort:
        spread = found.effort["objective_spread"]
        tried = ", ".join(f"{number} {kind}" for kind, number in found.effort["windings_tried"].items())
        many = found.effort["found"]
        within = f"{many} programme{'s' * (many != 1)} found inside the bounds"
        click.echo(f"{found.effort['starts']} starts ({tried or 'none'}), {within}", nl=False)
        click.echo(f", objective {min(spread):.4g} to {max(spread):.4g}" if spread else "")


def _end(found: Plan) -> None:
    """Print the problems; exit status."""
    if found.status != "OK_LIMIT":
        for line in found.words:
            click.echo(line, err=True)
    end_of_search(found, ("OK",), bool(found.programmes))
