"""`mahovik modes`, `mahovik linearize`: small motions of a stand about rest or a state."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from mahovik.out.cli.options import JSON, STAND_FILE, choice, command, file_option, load_stand, option
from mahovik.out.cli.output import print_json_text, print_line, print_table
from mahovik.out.cli.progress import progress

if TYPE_CHECKING:
    from mahovik.core.stand.model import Hold
    from mahovik.use.study.linear import Modes

AT = option("--at", "Linearise about this state, as `eval` reads it.", metavar="rest|STATE.json", default="rest")


@command()
def modes(
    stand_file: str = STAND_FILE,
    at: str = AT,
    flywheels: str = choice(
        "--flywheels",
        ["locked", "free"],
        "Keep flywheels locked to their motion, as a stiff servo does, or free under constant torques.",
        default="locked",
    ),
    as_json: bool = JSON,
) -> None:
    """Find natural frequencies, damping and shapes.

    Modes of small motions about rest or a state.

    A shape is a motion of the carrier (O1 along the axes of E1, rotations about them) and of free flywheels; its
    largest number is 1, in m or rad. Free directions come first.
    """
    stand = load_stand(stand_file)
    from mahovik.out.functions.linear import modes as find

    with progress(f"modes of {stand.name}"):
        found = find(stand, None if at == "rest" else at, locked=flywheels == "locked")
    if as_json:
        from mahovik.use.study.linear.model import encode_lines

        print_json_text(encode_lines(_values(found.result, stand.name, at, flywheels) | {"steady": found.steady}))
        return
    title = f"{stand.name} at {'rest' if at == 'rest' else click.format_filename(at)}, flywheels {flywheels}"
    _print(found.result, title, found.steady)
    _print_numbers(stand.hold)


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
    from mahovik.use.study.linear.words import shape_words

    rows = []
    for number, mode in enumerate(found.modes, start=1):
        free = mode.kind == "free"
        frequency = "-" if free else f"{mode.frequency:.6g}"
        kind = "" if mode.kind in ("free", "oscillation") else f"{mode.kind}, "
        damping = "-" if free else f"{mode.damping:.4g}"
        rows.append((str(number), frequency, damping, kind + shape_words(found, mode.shape)))
    print_table(("mode", "frequency, Hz>", "damping ratio>", "shape"), rows, title=title)
    if any(mode.kind == "free" for mode in found.modes):
        print_line("without a frequency: a free direction, no restoring force")
    if not steady:
        print_line(
            "valid for one moment: the carrier or a flywheel accelerates here, so growth does not show stability"
        )
    elif found.unstable:
        print_line("warning: unstable, a mode with negative damping grows", "yellow")


@command()
def linearize(
    stand_file: str = STAND_FILE,
    at: str = AT,
    points: str | None = option(
        "--points", "Choose points and instruments of the outputs; default: all, else the carrier.", metavar="a,b"
    ),
    flywheels: str = choice(
        "--flywheels",
        ["free", "locked"],
        "Leave flywheels free, driven by torques, or locked to their motion.",
        default="free",
    ),
    output: str = file_option("-o", "FILE.json|FILE.mat", "Write the model to this file.", required=True),
) -> None:
    """Linearise a stand: A, B, C, D.

    About rest or a state, by exact derivatives: x' = A x + B u, y = C x + D u.

    States: pose, V, angles and speeds of the flywheels. Inputs: drive torques, a wrench on the carrier. Outputs:
    displacement, velocity and acceleration of points. Names and units are in the file.
    """
    stand = load_stand(stand_file)
    from mahovik.out.functions.linear import linearize as find
    from mahovik.use.study.linear.model import check_model_file
    from mahovik.writing import probe

    target = Path(output)
    check_model_file(target)
    probe(target)
    names = [name.strip() for name in points.split(",") if name.strip()] if points is not None else None
    with progress(f"linearize {stand.name}"):
        model = find(stand, None if at == "rest" else at, points=names, locked=flywheels == "locked")
    model.save(target)
    sizes = ((len(model.states), "states"), (len(model.inputs), "inputs"), (len(model.outputs), "outputs"))
    click.echo(f"{click.format_filename(output)}   {', '.join(f'{number} {name}' for number, name in sizes)}")
    _print_numbers(stand.hold)


def _print_numbers(hold: Hold | None) -> None:
    """Print what freedoms are that have numbers in place of names."""
    from mahovik.core.stand.hold import numbers_in_words

    if found := numbers_in_words(hold, "q_"):
        print_line(found)
