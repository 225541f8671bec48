"""`mahovik modes`: natural frequencies, damping, shapes."""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING, Any

import click

from mahovik.out.cli.arguments import console, load_stand, stand_argument, table
from mahovik.out.cli.json_output import json_option, print_json_text
from mahovik.out.cli.nominal import at_option, nominal_state
from mahovik.out.cli.progress import progress

if TYPE_CHECKING:
    from mahovik.use.study.linear import Modes

SMALL = 5e-4
"""Part of the largest displacement of a shape: smaller ones are not printed."""

ALIGNED = 1.0
"""deg: a phase this near to 0 or 180 deg is printed as a sign."""


@click.command()
@stand_argument
@at_option
@click.option(
    "--flywheels",
    type=click.Choice(["locked", "free"]),
    default="locked",
    show_default=True,
    help="locked: they keep their motion, as a stiff servo makes them; free: under constant torques.",
)
@json_option()
def modes(stand_file: str, at: str, flywheels: str, as_json: bool) -> None:
    """Find natural frequencies, damping and shapes.

    Modes of small motions about rest or a state.

    A shape is a motion of the carrier (O1 along the axes of E1, rotations about them) and of free flywheels; its
    largest number is 1, in m or rad. Free directions come first.
    """
    stand = load_stand(stand_file)
    from mahovik.use.study.linear import linear_model
    from mahovik.use.study.linear import modes as modes_of

    with progress(f"modes of {stand.name}"):
        model = linear_model(stand, nominal_state(stand, at), [], locked=flywheels == "locked")
        found = modes_of(model)
    if as_json:
        from mahovik.use.study.linear.files import encode_lines

        print_json_text(encode_lines(_values(found, stand.name, at, flywheels) | {"steady": model.steady}))
        return
    title = f"{stand.name} at {'rest' if at == 'rest' else click.format_filename(at)}, flywheels {flywheels}"
    _print(found, title, model.steady)


def _values(found: Modes, name: str, at: str, flywheels: str) -> dict[str, Any]:
    """SI; shapes as real and imaginary parts."""
    each = [
        {
            "kind": mode.kind,
            "frequency": mode.frequency,
            "damped_frequency": mode.damped_frequency,
            "damping": mode.damping,
            "eigenvalue": [mode.eigenvalue.real, mode.eigenvalue.imag],
            "shape": [mode.shape.real, mode.shape.imag],
        }
        for mode in found.modes
    ]
    return {
        "stand": name,
        "at": at,
        "flywheels": flywheels,
        "coordinates": [str(each) for each in found.coordinates],
        "zero_eigenvalues": found.zeros,
        "unstable": found.unstable,
        "modes": each,
    }


def _print(found: Modes, title: str, steady: bool) -> None:
    out = console()
    rows = table("mode", "frequency, Hz>", "damping ratio>", "shape", title=title)
    for number, mode in enumerate(found.modes, start=1):
        free = mode.kind == "free"
        frequency = "-" if free else f"{mode.frequency:.6g}"
        kind = "" if mode.kind in ("free", "oscillation") else f"{mode.kind}, "
        rows.add_row(str(number), frequency, "-" if free else f"{mode.damping:.4g}", kind + _shape(found, mode.shape))
    out.print(rows)
    if any(mode.kind == "free" for mode in found.modes):
        out.print("without a frequency: a free direction, no restoring force")
    if not steady:
        out.print("valid for one moment: the carrier or a flywheel accelerates here, so growth does not show stability")
    elif found.unstable:
        out.print("warning: unstable, a mode with negative damping grows", style="yellow")


def _shape(found: Modes, shape: Any) -> str:
    """Displacements of a shape, largest first, with their phases unless these are signs."""
    given = sorted(zip(found.coordinates, shape.tolist(), strict=True), key=lambda each: -abs(each[1]))
    return "  ".join(f"{channel.name} {_number(x)}" for channel, x in given if abs(x) > SMALL)


def _number(x: complex) -> str:
    degrees = math.degrees(cmath.phase(x))
    if abs(degrees) <= ALIGNED:
        return f"{abs(x):.3g}"
    if abs(degrees) >= 180.0 - ALIGNED:
        return f"{-abs(x):.3g}"
    return f"{abs(x):.3g} at {degrees:.0f} deg"
