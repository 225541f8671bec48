"""`mahovik import`: stand files from models of other programs."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import click

from mahovik.errors import UsageError
from mahovik.out.cli.group import Commands
from mahovik.out.cli.options import argument, command, file_option, flag, option
from mahovik.out.cli.output import new_file
from mahovik.out.progress import progress

if TYPE_CHECKING:
    from mahovik.out.foreign.agreement import Original
    from mahovik.out.foreign.merge import ImportedStand
    from mahovik.out.foreign.model import ForeignModel

MODEL_FILE = argument("FILE")
OUTPUT = file_option("-o", "FILE|DIR", "Write the stand file here; default ./NAME.toml.")
NAME = option("--name", "Name the stand; default: as the model.")
CARRIER = option("--carrier", "Choose the body whose frame is E1, fixed to the first one; default: the first.")
INSTRUMENTS = flag("--instruments", "Keep bodies fixed on the carrier as instruments; otherwise merge them.")


@click.group("import", cls=Commands, short_help="Make a stand file of a URDF or a MuJoCo model.")
def import_model() -> None:
    """Make stand files from models of other programs.

    Joints that turn without end become flywheels. Features that a stand cannot have are refused, all of them at once.
    """


@command(group=import_model)
def urdf(
    model_file: str = MODEL_FILE,
    output: str | None = OUTPUT,
    name: str | None = NAME,
    carrier: str | None = CARRIER,
    instruments: bool = INSTRUMENTS,
    gravity: tuple[float, float, float] | None = option(
        "--gravity",
        "Set the gravity in E0, m/s2, which a URDF does not have; default 0.",
        metavar="X Y Z",
        type=float,
        nargs=3,
    ),
) -> None:
    """Make a stand file of a URDF.

    The root link is the carrier, continuous joints on it are flywheels, fixed links are merged, links without mass
    become points. Nothing is ever overwritten.
    """
    from mahovik.out.foreign.urdf import read_urdf

    source = Path(model_file)

    def original(found: ImportedStand, model: ForeignModel) -> Original:
        from mahovik.out.foreign.agreement import PinocchioOriginal

        return PinocchioOriginal(source, found, model.free is True)

    _write(source, read_urdf(source), original, output, name, carrier, instruments, gravity)


@command(group=import_model)
def mjcf(
    model_file: str = MODEL_FILE,
    output: str | None = OUTPUT,
    name: str | None = NAME,
    carrier: str | None = CARRIER,
    instruments: bool = INSTRUMENTS,
) -> None:
    """Make a stand file of a MuJoCo model.

    MuJoCo's compiler reads the file. The free body is the carrier, hinges without range on it are flywheels, welded
    bodies are merged, sites are points. Nothing is ever overwritten.
    """
    from mahovik.out.foreign.mjcf import read_mjcf

    source = Path(model_file)

    def original(found: ImportedStand, model: ForeignModel) -> Original:
        from mahovik.out.foreign.agreement import MujocoOriginal
        from mahovik.out.foreign.mjcf import compile_model

        return MujocoOriginal(compile_model(source), found, model.free is not False)

    _write(source, read_mjcf(source), original, output, name, carrier, instruments)


def _write(
    source: Path,
    model: ForeignModel,
    original: Callable[[ImportedStand, ForeignModel], Original],
    output: str | None,
    name: str | None,
    carrier: str | None,
    instruments: bool,
    gravity: tuple[float, float, float] | None = None,
) -> None:
    """Merge a model, write the stand file, and print what became of each part."""
    import numpy as np

    from mahovik.core.stand.fields import stand_name_problem
    from mahovik.out.foreign.merge import make_stand
    from mahovik.out.foreign.naming import stand_name
    from mahovik.out.foreign.write import stand_file
    from mahovik.writing import write

    problem = stand_name_problem(name) if name is not None else None
    if problem is not None:
        raise UsageError(f"--name: {problem}")
    if gravity is not None and not np.isfinite(gravity).all():
        raise UsageError("--gravity: expected three finite numbers")
    own = name or stand_name(model.name or source.stem)
    target = new_file(output, own)
    field = None if gravity is None else np.array(gravity)
    found = make_stand(model, own, source.name, carrier=carrier, gravity=field, instruments=instruments)
    text = stand_file(found, source.name, f"mahovik import {click.get_current_context().info_name}")
    with progress(f"comparing with {source.name}"):
        comparison = _comparison_words(found, model, original, source)
    write(target, text)
    stand = found.stand
    made = [(len(stand.instruments), "instrument"), (len(stand.flywheels), "flywheel"), (len(stand.points), "point")]
    words = [f"{n} {noun}{'' if n == 1 else 's'}" for n, noun in made if n or noun == "flywheel"]
    click.echo(f"{click.format_filename(target)}   carrier {found.carrier}, {', '.join(words)}")
    for note in (*found.notes, comparison):
        click.echo(note)


def _comparison_words(
    found: ImportedStand, model: ForeignModel, original: Callable[[ImportedStand, ForeignModel], Original], source: Path
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
            f"{source.name}: the stand differs from the original in {theirs.name}, {wrong}: nothing was written"
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
