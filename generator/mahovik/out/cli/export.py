"""`mahovik export`: projects of other tools around the emitted C."""

from __future__ import annotations

from pathlib import Path

import click

from mahovik.out.cli.arguments import echo_delivery, load_stand, real_option, stand_argument
from mahovik.out.cli.export_cmake import cmake
from mahovik.out.cli.export_fmu import fmu
from mahovik.out.cli.group import Commands
from mahovik.out.cli.progress import progress


@click.group(cls=Commands, short_help="Projects around the C, for other tools.")
def export() -> None:
    """Projects around the C of a stand, for other tools and boards."""


export.add_command(fmu)


@export.command()
@click.argument("name", metavar="TARGET")
@stand_argument
@click.option("-o", "output", metavar="DIR", type=click.Path(), help="Folder; default ./NAME-TARGET of the stand.")
@click.option(
    "--real", type=click.Choice(["double", "float"]), help="Element type; default: the widest of the target's FPU."
)
def target(name: str, stand_file: str, output: str | None, real: str | None) -> None:
    """Write a project that runs the self-test on a board.

    C of the stand, self-test, startup, linker script, console, Makefile, README: `make run` there runs it on the
    emulator; the README says what to change for another board. Never overwrites files of others, nor a folder of
    `mahovik generate`.
    """
    from mahovik.out.export.target import exportable, project
    from mahovik.proof.verify.delivery import deliver

    found = exportable(name)
    stand = load_stand(stand_file)
    chosen = real or found.real or "double"
    folder = Path(output if output is not None else f"{stand.name}-{name}")
    with progress(f"generate {stand.name} for {name}"):
        files = project(stand, found, chosen)
    done = deliver(folder, stand, chosen, files, found.name)
    echo_delivery(done)


@export.command()
@stand_argument
@click.option("-o", "output", metavar="DIR", type=click.Path(), help="Folder; default ./NAME-fuzz of the stand.")
@real_option
def fuzz(stand_file: str, output: str | None, real: str) -> None:
    """Write a project that fuzzes every public function.

    The C of the stand, a harness for libFuzzer, Makefile, README: `make run` there needs clang.
    """
    from mahovik.core.toolchain.fuzz_project import fuzz_project
    from mahovik.proof.verify.delivery import deliver

    stand = load_stand(stand_file)
    with progress(f"generate {stand.name} for fuzzing"):
        files = fuzz_project(stand, real)
    done = deliver(Path(output or f"{stand.name}-fuzz"), stand, real, files, "fuzz")
    echo_delivery(done)


@export.command()
@stand_argument
@click.option(
    "--programme", "programme_file", metavar="P.json", type=click.Path(), required=True, help="Programme to follow."
)
@click.option("--servo", "servo_file", metavar="S.toml", type=click.Path(), required=True, help="The servo file.")
@click.option("--motion", "motion_file", metavar="MOTION.json", type=click.Path(), help="For feedforward and trim.")
@click.option("-o", "output", metavar="DIR", type=click.Path(), help="Folder; default ./NAME of the stand.")
@click.option(
    "--table", "kind", type=click.Choice(["quintic", "fourier"]), default="quintic", show_default=True, help="Method."
)
@click.option("--real", type=click.Choice(["double", "float"]), help="Element type; default: that of the C in DIR.")
def servo(
    stand_file: str,
    programme_file: str,
    servo_file: str,
    motion_file: str | None,
    output: str | None,
    kind: str,
    real: str | None,
) -> None:
    """Write a programme and the servos that follow it as C.

    The files of `export programme`, and NAME_servo.h and .c: gains for the wanted bandwidth, limits, trim; an example,
    a self-test, a page. Exit status 1 if the sampled, delayed loop is not stable with enough margin; the message names
    a bandwidth that is.
    """
    from mahovik.core.motion.programme import load_programme
    from mahovik.core.motion.required import load_motion
    from mahovik.core.motion.servo import load_servo
    from mahovik.out.export.programme.place import element_type, write_servo
    from mahovik.out.export.servo import export_servo

    stand = load_stand(stand_file)
    found = load_programme(programme_file)
    motion = load_motion(Path(motion_file), stand) if motion_file is not None else None
    wanted = load_servo(servo_file, stand)
    folder = Path(output if output is not None else stand.name)
    chosen = element_type(folder, stand, real)
    names = Path(programme_file).name, Path(servo_file).name
    with progress(f"servos of {stand.name}"):
        made = export_servo(stand, found, motion, wanted, chosen, kind, names)
    for path in write_servo(folder, stand, made.programme.files, made.servo):
        click.echo(click.format_filename(path))
    for line in (*made.programme.lines, *made.lines):
        click.echo(line)


@export.command()
@stand_argument
@click.argument("programme_file", metavar="PROGRAMME.json", type=click.Path())
@click.option("-o", "output", metavar="DIR", type=click.Path(), help="Folder; default ./NAME of the stand.")
@click.option("--motion", "motion_file", metavar="MOTION.json", type=click.Path(), help="Adds drive torques.")
@click.option(
    "--table", "kind", type=click.Choice(["quintic", "fourier"]), default="quintic", show_default=True, help="Method."
)
@click.option(
    "--nodes",
    type=click.Choice(["64", "128", "256", "512", "1024", "2048", "4096"]),
    callback=lambda _context, _option, value: value and int(value),
    help="Nodes per period of a quintic table; default 256, float 64.",
)
@click.option("--real", type=click.Choice(["double", "float"]), help="Element type; default: that of the C in DIR.")
@click.option("--limit", type=float, help="Largest relative residual that a table may add; default 1e-6, float 1e-3.")
def programme(
    stand_file: str,
    programme_file: str,
    output: str | None,
    motion_file: str | None,
    kind: str,
    nodes: int | None,
    real: str | None,
    limit: float | None,
) -> None:
    """Write a flywheel programme as const tables in C.

    NAME_programme.h and .c beside the C of the stand, with a clock that never drifts, a self-test, a page. With the
    motion file, the tables include drive torques, and the residual that they add is measured. Exit status 1 if that
    is above the limit, or if programme, stand and motion do not belong together.
    """
    from mahovik.core.motion.programme import load_programme
    from mahovik.core.motion.required import load_motion
    from mahovik.out.export.programme import export_programme
    from mahovik.out.export.programme.place import element_type, write_programme

    stand = load_stand(stand_file)
    found = load_programme(programme_file)
    motion = load_motion(Path(motion_file), stand) if motion_file is not None else None
    folder = Path(output if output is not None else stand.name)
    chosen = element_type(folder, stand, real)
    with progress(f"tables of {Path(programme_file).name}"):
        made = export_programme(stand, found, motion, kind, nodes, chosen, limit, Path(programme_file).name)
    for path in write_programme(folder, stand, made.files):
        click.echo(click.format_filename(path))
    for line in made.lines:
        click.echo(line)


export.add_command(cmake)
