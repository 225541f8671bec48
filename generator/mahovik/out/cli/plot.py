"""`mahovik plot`: a picture of a programme or of a run."""

from __future__ import annotations

from pathlib import Path

import click

from mahovik.errors import CheckError, UsageError
from mahovik.out.cli.arguments import load_stand
from mahovik.out.cli.progress import progress


@click.command()
@click.argument("file", metavar="PROGRAMME.json|RUN.csv|RUN.parquet", type=click.Path())
@click.option("-o", "output", metavar="FILE.svg|FILE.png", type=click.Path(), required=True, help="The picture.")
@click.option("--stand", "stand_file", metavar="STAND.toml", type=click.Path(), help="For a programme: with --motion,")
@click.option("--motion", "motion_file", metavar="M.json", type=click.Path(), help="shows motion, torques, residual.")
def plot(file: str, output: str, stand_file: str | None, motion_file: str | None) -> None:
    """Draw a programme or a run.

    Of a programme it shows speeds and accelerations of the flywheels; with its stand and motion also the carrier's
    required and achieved motion, by (8), drive torques and the residual of (12). Of a run of `mahovik simulate` it
    shows the carrier's motion, speeds, torques.
    """
    from mahovik.out.report.plot import run
    from mahovik.out.report.plot.draw import SUFFIXES, draw
    from mahovik.proof.verify.files import probe, write

    source, target = Path(file), Path(output)
    if target.suffix not in SUFFIXES:
        raise UsageError(f"-o {output}: expected a name that ends in {' or '.join(SUFFIXES)}")
    if (stand_file is None) != (motion_file is None):
        raise UsageError("--stand and --motion: give both or neither")
    probe(target)
    if source.suffix in run.SUFFIXES:
        if stand_file is not None:
            raise UsageError("--stand, --motion: not used for a run; remove them")
        with progress(f"draw {source.name}"):
            picture = draw(source.stem, run.panels(run.read(source)), target.suffix)
        write(target, picture)
        return
    from mahovik.core.motion.programme import load_programme
    from mahovik.core.motion.required import load_motion
    from mahovik.out.report.plot.programme import panels

    programme = load_programme(file)
    stand = None if stand_file is None else load_stand(stand_file)
    motion = None if stand is None or motion_file is None else load_motion(motion_file, stand)
    if stand is not None and motion is not None:
        from mahovik.proof.verify.programme.identity import motion_finding, stand_finding

        for whose in (stand_finding(stand, programme), motion_finding(motion, programme)):
            if not whose.passed:
                raise CheckError(f"{file}: {whose.words}")
    title = f"{programme.stand}: {programme.motion}"
    with progress(f"draw {source.name}"):
        picture = draw(title, panels(programme, stand, motion), target.suffix)
    write(target, picture)
