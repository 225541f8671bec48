"""`mahovik linearize`: A, B, C, D of a stand about a state."""

from __future__ import annotations

from pathlib import Path

import click

from mahovik.out.cli.arguments import load_stand, stand_argument
from mahovik.out.cli.nominal import at_option, nominal_state
from mahovik.out.cli.progress import progress


@click.command()
@stand_argument
@at_option
@click.option("--points", metavar="a,b", help="Points and instruments of the outputs; default: all, else the carrier.")
@click.option(
    "--flywheels",
    type=click.Choice(["free", "locked"]),
    default="free",
    show_default=True,
    help="free: driven by torques; locked: they keep their motion.",
)
@click.option("-o", "output", metavar="FILE.json|FILE.mat", type=click.Path(), required=True, help="The model.")
def linearize(stand_file: str, at: str, points: str | None, flywheels: str, output: str) -> None:
    """Linearise a stand: A, B, C, D.

    About rest or a state, by exact derivatives: x' = A x + B u, y = C x + D u.

    States: pose, V, angles and speeds of the flywheels. Inputs: drive torques, a wrench on the carrier. Outputs:
    displacement, velocity and acceleration of points. Names and units are in the file.
    """
    stand = load_stand(stand_file)
    from mahovik.proof.verify.files import probe, write
    from mahovik.use.study.linear import linear_model
    from mahovik.use.study.linear.files import check, rendered

    target = Path(output)
    check(target)
    probe(target)
    names = [name.strip() for name in points.split(",") if name.strip()] if points is not None else None
    if names is None and not (stand.points or stand.instruments):
        names = ["carrier"]
    with progress(f"linearize {stand.name}"):
        model = linear_model(stand, nominal_state(stand, at), names, locked=flywheels == "locked")
    write(target, rendered(model, target.suffix))
    sizes = ((len(model.states), "states"), (len(model.inputs), "inputs"), (len(model.outputs), "outputs"))
    click.echo(f"{click.format_filename(output)}   {', '.join(f'{number} {name}' for number, name in sizes)}")
