"""`mahovik check`: validate a stand and print its figures."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import click

from mahovik.errors import UsageError
from mahovik.out.cli.arguments import console, load_stand, stand_argument, table
from mahovik.out.cli.json_output import json_option, print_json

if TYPE_CHECKING:
    from rich.console import Console

    from mahovik.core.stand.identity import Identities
    from mahovik.core.stand.summary import Summary


@click.command()
@stand_argument
@click.option(
    "--speed",
    metavar="SPEED",
    help='Speed of all flywheels, "3000 rpm" or rad/s; default: each motor\'s no-load speed.',
)
@json_option("Print JSON instead of tables.")
def check(stand_file: str, speed: str | None, as_json: bool) -> None:
    """Validate a stand; print its figures.

    Shows masses, centres of mass, the unbalance of each flywheel and its force at a speed; warns of problems, also
    if float would not resolve an unbalance.
    """
    stand = load_stand(stand_file)
    asked = None if speed is None else read_speed(speed)
    from mahovik.core.stand import identities
    from mahovik.core.stand.summary import summarize
    from mahovik.use.study.resolution import shortfalls

    summary, names = summarize(stand, asked), identities(stand)
    short = shortfalls(stand, [row.speed for row in summary.unbalance])
    if as_json:
        from dataclasses import asdict

        found = {
            **summary.as_dict(),
            "structure": names.structure,
            "physics": names.physics,
            "float": [asdict(each) for each in short],
        }
        print_json(found)
        return
    _print(console(), summary, names, [str(each) for each in short])


def read_speed(text: str) -> float:
    """A speed in rad/s: a plain number, or one with a unit. Raises UsageError."""
    from mahovik.core.stand.units import SPEED, QuantityError, number

    try:
        found = float(text)
    except ValueError:
        try:
            found = number(text, SPEED)
        except QuantityError as error:
            raise UsageError(f"--speed: {error}") from None
    if not (math.isfinite(found) and abs(found) <= 1e9):
        raise UsageError(f"--speed: {text} is out of range")
    return abs(found)


def _print(out: Console, summary: Summary, names: Identities, short: list[str]) -> None:
    out.print(f"[bold]{summary.name}[/bold]   structure {names.structure}, physics {names.physics}")
    bodies = table("body", "kind", "mount", "mass, kg>", "centre of mass in E1, m>")
    for body in summary.bodies:
        bodies.add_row(body.name, body.kind, body.mount, f"{body.mass:.6g}", _vector(body.center_of_mass))
    bodies.add_section()
    bodies.add_row("all", "", "", f"{summary.mass:.6g}", _vector(summary.center_of_mass))
    out.print(bodies)
    if summary.unbalance:
        wheels = table(
            "flywheel",
            "spin inertia, kg m2>",
            "static, g mm>",
            "dynamic, g mm2>",
            "about its mass centre>",
            "J22 - J33, g mm2>",
            "J23, g mm2>",
            "at, rpm>",
            "force, N>",
            "moment, N m>",
        )
        for row in summary.unbalance:
            figures = (
                row.spin_inertia,
                row.static,
                row.dynamic,
                row.dynamic_center,
                row.asymmetry,
                row.product,
                row.speed * 30 / math.pi,
                row.force,
                row.moment,
            )
            wheels.add_row(row.name, *(f"{x:.5g}" for x in figures))
        out.print(wheels)
        out.print(f"reach of force: {summary.force:.5g} N, all unbalance in one line at these speeds")
    for warning in (*summary.warnings, *short):
        out.print("warning:", warning, style="yellow", markup=False)


def _vector(numbers: tuple[float, float, float]) -> str:
    return "  ".join(f"{x:9.6f}" for x in numbers)
