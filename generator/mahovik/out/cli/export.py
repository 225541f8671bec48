"""`mahovik export`: projects of other tools around the emitted C."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

import click

from mahovik.errors import UsageError
from mahovik.out.cli import quantities
from mahovik.out.cli.group import Commands
from mahovik.out.cli.options import (
    ONLY,
    PREFIX,
    REAL,
    STAND_FILE,
    WITH,
    choice,
    command,
    file_option,
    flag,
    is_given,
    load_stand,
    option,
    whole_number,
)
from mahovik.out.cli.output import print_paths, require_suffix
from mahovik.out.cli.stand_first import FURTHER, STAND, needed_option, stand_first
from mahovik.out.progress import progress

FOLDER = file_option("-o", "DIR", "Write into this folder; default ./NAME of the stand.")
TABLE = choice("--table", ["quintic", "fourier"], "Choose the kind of table.", default="quintic")
NAME = option("--name", "Use this name in C, so that several lie in one image.", metavar="NAME", default="programme")
FORCE = flag("--force", "Write also a programme that exceeds its own bounds.")
REAL_OF_FOLDER = choice("--real", ["double", "float"], "Choose the element type; default: that of the C in the folder.")


@click.group(cls=Commands, short_help="Write projects around the C for other tools.")
def export() -> None:
    """Write projects around the C of a stand, for other tools and boards."""


def _made_by(stand_file: str) -> str:
    """Text of the provenance.json of what is made from a stand file."""
    from mahovik.core.stand.content import content
    from mahovik.proof.verify.delivery import provenance

    return provenance(content(Path(stand_file)))


@command(group=export)
def fmu(
    stand_file: str = STAND_FILE,
    version: str = choice("--version", ["2.0", "3.0"], "Choose the version of FMI.", default="2.0"),
    kind: Literal["cs", "me"] = choice(
        "--kind",
        ["cs", "me"],
        "Export cs, co-simulation that integrates itself, or me, model exchange that the tool integrates.",
        default="cs",
    ),
    inputs: Literal["torque", "acceleration"] = choice(
        "--inputs", ["torque", "acceleration"], "Drive the flywheels by these inputs.", default="torque"
    ),
    output: str | None = file_option("-o", "FILE.fmu", "Write this file; default ./NAME.fmu of the stand."),
    start: str | None = file_option("--start", "STATE.json", "Start from this state; default: the static equilibrium."),
    dt: float = option(
        "--dt", "Limit the internal step of cs.", metavar="TIME", default="0.1 ms", parse=quantities.time
    ),
    binary: bool = option(
        "--binary/--no-binary",
        "Compile for this machine, beside the sources.",
        default=True,
        show_default=False,
    ),
    prefix: str | None = PREFIX,
) -> None:
    """Write an FMU: the stand for other simulators.

    The same C behind the Functional Mock-up Interface: units, names, start values, tunable parameters, sources, and a
    binary for this machine if it has a C compiler. It is in double, as FMI is, and has all functions that it calls.
    """
    from mahovik.out.export.fmu import export_fmu
    from mahovik.out.notices import warn_of_turn
    from mahovik.proof.verify.delivery import with_prefix
    from mahovik.use.simulate.case import load_start
    from mahovik.writing import probe, write

    stand = with_prefix(load_stand(stand_file), prefix)
    target = Path(output if output is not None else f"{stand.name}.fmu")
    if kind == "me" and is_given("dt"):
        raise UsageError("--dt: model exchange has no internal step, the tool integrates; remove it, or use --kind cs")
    require_suffix(str(target), [".fmu"])
    state = load_start(Path(start), stand) if start is not None else None
    probe(target)
    with progress(f"FMU of {stand.name}"):
        made = export_fmu(stand, version, kind, inputs, dt, state, binary)
    if state is None:
        warn_of_turn(stand)
    write(target, made.content)
    print_paths([target], made.lines)


@command(group=export)
def target(
    stand_file: str = STAND_FILE,
    further: tuple[str, ...] = FURTHER,
    target_name: str | None = needed_option("--target", "NAME", "Choose the processor or board, such as m7."),
    output: str | None = file_option("-o", "DIR", "Write into this folder; default ./NAME-TARGET of the stand."),
    real: str | None = choice(
        "--real", ["double", "float"], "Choose the element type; default: the widest of the target's FPU."
    ),
    only: tuple[str, ...] | None = ONLY,
    prefix: str | None = PREFIX,
) -> None:
    """Write a project that runs the self-test on a board.

    C of the stand, self-test, startup, linker script, console, Makefile, README: `make run` there runs it on the
    emulator; the README says what to change for another board. Put your own program into main.c: it stays when the
    project is written again. Never overwrites other files of yours, nor a folder of `mahovik generate`.
    """
    from mahovik.out.export.target import exportable, project
    from mahovik.proof.verify.delivery import deliver, with_prefix

    stand_file, (name,) = stand_first(stand_file, further, {"--target": target_name}, former=("--target", STAND))
    found = exportable(name)
    stand = with_prefix(load_stand(stand_file), prefix)
    chosen = real or found.real or "double"
    folder = Path(output if output is not None else f"{stand.name}-{name}")
    with progress(f"generate {stand.name} for {name}"):
        files = project(stand, found, chosen, only or ())
    made_by = _made_by(stand_file)
    done = deliver(folder, stand, files, replaceable=("main.c",), made_by=made_by)
    print_paths(done.paths, done.notes)


@command(group=export)
def fuzz(
    stand_file: str = STAND_FILE,
    output: str | None = file_option("-o", "DIR", "Write into this folder; default ./NAME-fuzz of the stand."),
    real: str = REAL,
) -> None:
    """Write a project that fuzzes every public function.

    The C of the stand, a harness for libFuzzer, Makefile, README: `make run` there needs clang.
    """
    from mahovik.core.toolchain.fuzzing import fuzz_project
    from mahovik.proof.verify.delivery import deliver

    stand = load_stand(stand_file)
    with progress(f"generate {stand.name} for fuzzing"):
        files = fuzz_project(stand, real)
    made_by = _made_by(stand_file)
    done = deliver(Path(output or f"{stand.name}-fuzz"), stand, files, made_by=made_by)
    print_paths(done.paths, done.notes)


@command(group=export)
def servo(
    stand_file: str = STAND_FILE,
    programme_file: str = file_option(
        "--programme", "P.json", "Follow this programme of `mahovik plan`.", required=True
    ),
    servo_file: str = file_option(
        "--servo", "S.toml", "Read the servos from this file.", required=True, reads="a servo file"
    ),
    motion_file: str | None = file_option("--motion", "M.json", "Read the required motion, for feedforward and trim."),
    output: str | None = FOLDER,
    kind: str = TABLE,
    real: str | None = REAL_OF_FOLDER,
    name: str = NAME,
    force: bool = FORCE,
) -> None:
    """Write a programme and the servos that follow it as C.

    The files of `export programme`, and NAME_servo.h and .c: gains for the wanted bandwidth, limits, trim; an example,
    a self-test, a page. With --name lap the files, and all names in C, begin with NAME_lap and NAME_lap_servo. Exit
    status 1 if the sampled, delayed loop is not stable with enough margin; the message names a bandwidth that is.
    """
    from mahovik.core.motion.motion_file import load_motion
    from mahovik.core.motion.programme import load_programme
    from mahovik.core.motion.servo import load_servo
    from mahovik.out.export.programme.files import element_type, write_servo
    from mahovik.out.export.servo import export_servo

    stand = load_stand(stand_file)
    found = load_programme(programme_file)
    motion = load_motion(Path(motion_file), stand, found) if motion_file is not None else None
    wanted = load_servo(servo_file, stand)
    folder = Path(output if output is not None else stand.name)
    chosen = element_type(folder, stand, real)
    names = Path(programme_file).name, Path(servo_file).name
    with progress(f"servos of {stand.name}"):
        made = export_servo(stand, found, motion, wanted, chosen, kind, names, name, force)
    paths = write_servo(folder, stand, made.programme.files, made.servo, name)
    print_paths(paths, (*made.programme.lines, *made.lines))


@command(group=export)
def programme(
    stand_file: str = STAND_FILE,
    further: tuple[str, ...] = FURTHER,
    programme_file: str | None = needed_option("--programme", "P.json", "Write this programme of `mahovik plan`."),
    output: str | None = FOLDER,
    motion_file: str | None = file_option(
        "--motion", "M.json", "Add drive torques, of this required motion, to the tables."
    ),
    kind: str = TABLE,
    nodes: int | None = choice(
        "--nodes",
        ["64", "128", "256", "512", "1024", "2048", "4096"],
        "Set the nodes per period of a quintic table; default 256, float 64; of a finite programme as many as needed.",
        callback=whole_number,
    ),
    real: str | None = REAL_OF_FOLDER,
    limit: float | None = option(
        "--limit", "Accept this relative residual of a table; default 1e-6, float 1e-3.", type=float
    ),
    name: str = NAME,
    force: bool = FORCE,
) -> None:
    """Write a flywheel programme as const tables in C.

    NAME_programme.h and .c beside the C of the stand, with a clock that never drifts, a self-test, a page. With the
    motion file, the tables include drive torques, and the residual that they add is measured. Exit status 1 if that
    is above the limit, if the programme exceeds its own bounds, or if programme, stand and motion do not belong
    together.
    """
    from mahovik.core.motion.motion_file import load_motion
    from mahovik.core.motion.programme import load_programme
    from mahovik.out.export.programme import export_programme
    from mahovik.out.export.programme.files import element_type, write_programme

    given = {"--programme": programme_file}
    stand_file, (source,) = stand_first(stand_file, further, given, former=(STAND, "--programme"))
    stand = load_stand(stand_file)
    found = load_programme(source)
    motion = load_motion(Path(motion_file), stand, found) if motion_file is not None else None
    folder = Path(output if output is not None else stand.name)
    chosen = element_type(folder, stand, real)
    with progress(f"tables of {Path(source).name}"):
        made = export_programme(stand, found, motion, kind, nodes, chosen, limit, Path(source).name, name, force)
    print_paths(write_programme(folder, stand, made.files, name), made.lines)


@command(group=export)
def cmake(
    stand_file: str = STAND_FILE,
    output: str | None = file_option("-o", "DIR", "Write into this folder; default ./NAME-cmake of the stand."),
    real: str = REAL,
    batch: bool = flag("--batch", "Add a target for many states at once, with OpenMP if wanted."),
    only: tuple[str, ...] | None = ONLY,
    additions: tuple[str, ...] | None = WITH,
    prefix: str | None = PREFIX,
) -> None:
    """Write a CMake project with the target mahovik::NAME.

    For add_subdirectory, or installed for find_package: the C of the stand with the flags that keep its bits, a header
    for C++17, self-test and example for ctest, README. Never overwrites files of others, nor a folder of
    `mahovik generate`.
    """
    from mahovik.out.export.cmake import cmake_project
    from mahovik.proof.verify.delivery import deliver, with_prefix

    stand = with_prefix(load_stand(stand_file), prefix)
    added = (*(additions or ()), *(["batch"] if batch else []))
    files = cmake_project(stand, real, only or (), added)
    made_by = _made_by(stand_file)
    done = deliver(Path(output or f"{stand.name}-cmake"), stand, files, made_by=made_by)
    print_paths(done.paths, done.notes)


@command(group=export)
def attitude(
    stand_file: str = STAND_FILE,
    task: str | None = option("--task", "Turn by this task; default: the only one of the stand.", metavar="NAME"),
    target_name: str = option("--target", "Choose the processor or board, such as m7.", metavar="NAME", default="host"),
    output: str | None = file_option(
        "-o", "DIR", "Write into this folder; default ./NAME-attitude-TARGET of the stand."
    ),
    real: str | None = choice(
        "--real", ["double", "float"], "Choose the element type; default: the widest of the target's FPU."
    ),
    rate: float = option("--rate", "Run the loop at this rate, Hz.", metavar="HZ", type=float, default=50.0),
    bandwidth: float = option(
        "--bandwidth", "Set the bandwidth of the loop, Hz.", metavar="HZ", type=float, default=0.1
    ),
    damping: float = option("--damping", "Set its damping ratio.", metavar="ZETA", type=float, default=0.8),
    momentum: float = option(
        "--momentum", "Begin the example with this angular momentum, N m s.", metavar="NMS", type=float, default=1.0
    ),
    failure: Literal["coasts", "held", "none"] = choice(
        "--failure",
        ["coasts", "held", "none"],
        "Choose whether the first flywheel of the example coasts from half-way on, is held, or works.",
        default="coasts",
    ),
) -> None:
    """Write an attitude loop as a project that runs on a board.

    C of the stand and of the loop: quaternion feedback, drive torques within what the motors have, momentum management,
    failed flywheels. Its program closes the loop with the exact plant: a slew of 30 degrees, a flywheel that fails
    half-way, momentum that is dumped where the carrier has wrench_input. `make run` there runs it on the emulator,
    `make compare` there and here. Never overwrites files of others.
    """
    from mahovik.out.export.attitude import attitude_project
    from mahovik.out.export.target import exportable
    from mahovik.proof.verify.delivery import deliver
    from mahovik.use.control.attitude import LoopOptions

    found = exportable(target_name)
    stand = load_stand(stand_file)
    chosen = real or found.real or "double"
    options = LoopOptions(task, rate, bandwidth, damping, momentum, failure)
    folder = Path(output if output is not None else f"{stand.name}-attitude-{target_name}")
    with progress(f"attitude loop of {stand.name} for {target_name}"):
        made = attitude_project(stand, found, options, chosen)
    made_by = _made_by(stand_file)
    done = deliver(folder, stand, made.files, made_by=made_by)
    print_paths(done.paths, (*done.notes, *made.design.lines))
