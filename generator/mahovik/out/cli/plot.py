"""`mahovik plot`: a picture of a programme or of a run."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from mahovik.errors import CheckError, UsageError
from mahovik.out.cli.options import STAND_FILE_OR_NONE, command, file_option, load_stand, option
from mahovik.out.cli.output import require_suffix
from mahovik.out.cli.stand_first import note_order
from mahovik.out.progress import progress

if TYPE_CHECKING:
    from mahovik.out.report.plot.panel import Panel


@command()
def plot(
    stand_file: str | None = STAND_FILE_OR_NONE,
    programme_file: str | None = file_option("--programme", "P.json", "Draw this programme of `mahovik plan`."),
    motion_file: str | None = file_option("--motion", "M.json", "Compare with this required motion; needs STAND.toml."),
    run_file: str | None = file_option("--run", "RUN.csv|RUN.parquet", "Draw this run of `mahovik simulate`."),
    waterfall: str | None = option(
        "--waterfall", "Draw spectra of this column of the run over time.", metavar="COLUMN"
    ),
    output: str = file_option("-o", "FILE.svg|FILE.png", "Write the picture to this file.", required=True),
    former_stand: str | None = file_option("--stand", "STAND.toml", "Read the stand of the programme.", hidden=True),
) -> None:
    """Draw a programme or a run.

    Of a programme it shows speeds and accelerations of the flywheels; with its stand and motion also the carrier's
    required and achieved motion, by (8), drive torques and the residual of (12). Of a run of `mahovik simulate` it
    shows the carrier's motion, speeds, torques, and of a held carrier the reaction. COLUMN is a name in its first line,
    without the unit, such as hold.reaction.x.
    """
    from mahovik.out.report.plot import run
    from mahovik.out.report.plot import waterfall as spectra
    from mahovik.out.report.plot.draw import SUFFIXES, draw
    from mahovik.writing import probe, write

    suffix = require_suffix(output, SUFFIXES)
    if programme_file is None and run_file is None and stand_file is not None and not stand_file.endswith(".toml"):
        if stand_file.endswith(run.SUFFIXES):
            run_file = stand_file
        else:
            programme_file = stand_file
        stand_file = former_stand
        note_order(stand_file, {"--programme": programme_file, "--motion": motion_file, "--run": run_file})
    source = programme_file or run_file
    if source is None or (programme_file is not None and run_file is not None):
        raise UsageError("expected --programme P.json or --run RUN.csv, one of them")
    target = Path(output)
    with_stand = stand_file is not None or motion_file is not None
    if waterfall is not None and run_file is None:
        raise UsageError("--waterfall: only of a run; give --run RUN.csv, or remove it")
    if run_file is not None and with_stand:
        raise UsageError("STAND.toml, --motion: not used for a run; remove them")
    if with_stand and (stand_file is None or motion_file is None):
        raise UsageError("STAND.toml and --motion: give both or neither")
    probe(target)
    with progress(f"draw {Path(source).name}"):
        if run_file is None:
            title, shown = _programme_panels(source, stand_file, motion_file)
        else:
            columns = run.read(Path(source))
            title = Path(source).stem
            shown = run.panels(columns) if waterfall is None else spectra.panels(columns, waterfall)
        picture = draw(title, shown, suffix)
    write(target, picture)


def _programme_panels(file: str, stand_file: str | None, motion_file: str | None) -> tuple[str, list[Panel]]:
    """Title and panels of a programme. Raises CheckError if stand or motion are others, and what the files raise."""
    from mahovik.core.motion.motion_file import load_motion
    from mahovik.core.motion.programme import load_programme
    from mahovik.out.report.plot.programme import panels
    from mahovik.proof.verify.programme.verification import motion_check, stand_check

    programme = load_programme(file)
    title = f"{programme.stand}: {programme.motion}"
    if stand_file is None or motion_file is None:
        return title, panels(programme)
    stand = load_stand(stand_file)
    motion = load_motion(motion_file, stand, programme)
    for whose in (stand_check(stand, programme), motion_check(motion, programme)):
        if whose.failed:
            raise CheckError(f"{file}: {whose.words}")
    return title, panels(programme, stand, motion)
