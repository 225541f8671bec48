"""`mahovik import`: stand files from models of other programs."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import click

from mahovik.errors import UsageError
from mahovik.out.cli.group import Commands
from mahovik.out.cli.progress import progress

if TYPE_CHECKING:
    from mahovik.out.foreign.agreement import Original
    from mahovik.out.foreign.merge import Imported
    from mahovik.out.foreign.model import ForeignModel

_file = click.argument("model_file", metavar="FILE", type=click.Path())
_output = click.option("-o", "output", metavar="FILE|DIR", type=click.Path(), help="Output; default ./NAME.toml.")
_name = click.option("--name", help="Name of the stand; default: that of the model.")
_carrier = click.option("--carrier", help="Body whose frame is E1, fixed to the first one; default: the first.")
_instruments = click.option(
    "--instruments", is_flag=True, help="Keep bodies fixed on the carrier as instruments; otherwise merge them."
)


@click.group("import", cls=Commands, short_help="Make a stand file of a URDF or a MuJoCo model.")
def import_model() -> None:
    """Stand files from models of other programs.

    Joints that turn without end become flywheels. Features that a stand cannot have are refused, all of them at once.
    """


@import_model.command()
@_file
@_output
@_name
@_carrier
@_instruments
@click.option("--gravity", nargs=3, type=float, metavar="X Y Z", help="m/s2, in E0: a URDF has none; default 0.")
def urdf(
    model_file: str,
    output: str | None,
    name: str | None,
    carrier: str | None,
    instruments: bool,
    gravity: tuple[float, float, float] | None,
) -> None:
    """Make a stand file of a URDF.

    The root link is the carrier, continuous joints on it are flywheels, fixed links are merged, links without mass
    become points. Nothing is ever overwritten.
    """
    from mahovik.out.foreign.urdf import read_urdf

    path = Path(model_file)

    def original(found: Imported, model: ForeignModel) -> Original:
        from mahovik.out.foreign.agreement import PinocchioOriginal

        return PinocchioOriginal(path, found, model.free is True)

    _write(path, read_urdf(path), original, output, name, carrier, instruments, gravity)


@import_model.command()
@_file
@_output
@_name
@_carrier
@_instruments
def mjcf(model_file: str, output: str | None, name: str | None, carrier: str | None, instruments: bool) -> None:
    """Make a stand file of a MuJoCo model.

    MuJoCo's compiler reads the file. The free body is the carrier, hinges without range on it are flywheels, welded
    bodies are merged, sites are points. Nothing is ever overwritten.
    """
    from mahovik.out.foreign.mjcf import read_mjcf

    path = Path(model_file)

    def original(found: Imported, model: ForeignModel) -> Original:
        from mahovik.out.foreign.agreement import MujocoOriginal
        from mahovik.out.foreign.mjcf import compiled

        return MujocoOriginal(compiled(path), found, model.free is not False)

    _write(path, read_mjcf(path), original, output, name, carrier, instruments)


def _write(
    path: Path,
    model: ForeignModel,
    original: Callable[[Imported, ForeignModel], Original],
    output: str | None,
    name: str | None,
    carrier: str | None,
    instruments: bool,
    gravity: tuple[float, float, float] | None = None,
) -> None:
    """Merge a model, write the stand file, and print what became of each part."""
    import numpy as np

    from mahovik.core.stand.names import stand_name_problem
    from mahovik.out.foreign.merge import stand_of
    from mahovik.out.foreign.naming import stand_name
    from mahovik.out.foreign.write import stand_file
    from mahovik.proof.verify.files import write

    problem = stand_name_problem(name) if name is not None else None
    if problem is not None:
        raise UsageError(f"--name: {problem}")
    if gravity is not None and not np.isfinite(gravity).all():
        raise UsageError("--gravity: expected three finite numbers")
    own = name or stand_name(model.name or path.stem)
    target = Path(output) if output is not None else Path(f"{own}.toml")
    if target.is_dir() or (output is not None and output.endswith("/")):
        target = target / f"{own}.toml"
    if target.exists():
        raise UsageError(f"{target}: exists already, nothing was written")
    found = stand_of(
        model,
        own,
        path.name,
        carrier=carrier,
        gravity=None if gravity is None else np.array(gravity),
        instruments=instruments,
    )
    text = stand_file(found, path.name, f"mahovik import {click.get_current_context().info_name}")
    with progress(f"comparing with {path.name}"):
        said = _compared(found, model, original, path)
    write(target, text)
    stand = found.stand
    made = [(len(stand.instruments), "instrument"), (len(stand.flywheels), "flywheel"), (len(stand.points), "point")]
    words = [f"{n} {noun}{'' if n == 1 else 's'}" for n, noun in made if n or noun == "flywheel"]
    click.echo(f"{click.format_filename(target)}   carrier {found.carrier}, {', '.join(words)}")
    for note in (*found.notes, said):
        click.echo(note)


def _compared(
    found: Imported, model: ForeignModel, original: Callable[[Imported, ForeignModel], Original], path: Path
) -> str:
    """Agreement of the stand with the original file, in words. Raises CheckError."""
    from mahovik.errors import CheckError
    from mahovik.out.foreign.agreement import LIMIT, agreement, disagreement

    try:
        theirs = original(found, model)
    except ImportError as error:
        return f"not compared with the original: {error.name or error} is not installed: pip install pin"
    except ValueError as error:
        return f"not compared with the original: {' '.join(str(error).split())}"
    errors = agreement(found, theirs)
    wrong = disagreement(errors)
    if wrong:
        raise CheckError(
            f"{path.name}: the stand differs from the original in {theirs.name}, {wrong}: nothing was written"
        )
    if not errors:
        return "not compared with the original: fixed on the world and without flywheels it has no motion"
    alone = "" if "K" in errors else f" in {', '.join(errors)} alone, since it is fixed on the world there"
    apart = max(errors, key=lambda name: errors[name], default="")
    loose = errors[apart] > LIMIT if apart else False  # an acceleration: the equations have passed
    decide = {name: error for name, error in errors.items() if error <= LIMIT}
    worst = max(decide, key=lambda name: decide[name], default="")
    most = f", largest relative difference {decide[worst]:.1g} ({worst})" if worst else ""
    but = f"; but {apart} by {errors[apart]:.1g}: the mass matrix is so uneven that rounding decides" if loose else ""
    return f"agrees with the original in {theirs.name} at 20 random states{alone}{most}{but}"
