"""A project of an attitude loop: the stand's C, the loop, and a `main` that closes it with the exact plant."""

from __future__ import annotations

from dataclasses import dataclass

from mahovik.core.emit.attitude import AttitudePrinter, AttitudeTables, needed_functions
from mahovik.core.emit.generate import Generated, generate_all
from mahovik.core.emit.manifest import with_manifest
from mahovik.core.emit.names import VERIFICATION
from mahovik.core.emit.templates import source_text, template
from mahovik.core.stand.model import Stand
from mahovik.core.toolchain.targets import Target
from mahovik.out.export.target import board_folder, makefile
from mahovik.use.control.attitude import AttitudeDesign, LoopOptions, design_attitude

HOST = f"{VERIFICATION}board_host.c"
"""Console of this machine, for the same program without an emulator."""


@dataclass(frozen=True)
class ExportedAttitude:
    """Files of the project by name; the C of the stand in it; settings, with their messages."""

    files: dict[str, str]
    generated: Generated
    design: AttitudeDesign


def attitude_sources(stand: Stand, options: LoopOptions, real: str) -> ExportedAttitude:
    """C of the stand, of the loop and of its example. UsageError: as `design_attitude`."""
    design = design_attitude(stand, options)
    tables = AttitudeTables(design.task, design.dumps, design.settings)
    generated = generate_all(stand, real, needed_functions(tables))
    printer = AttitudePrinter(stand, generated, tables)
    main = printer.render(
        "attitude_main.c.j2",
        slew="30",
        momentum=f"{design.momentum:g}",
        fails=stand.flywheels[0].name,
        number=0,
        points=generated.layout.motor_points,
        last_point=generated.layout.motor_points - 1,
        failure={"none": "WORKS"}.get(design.failure, design.failure.upper()),
        parts=design.parts,
        speeds=printer.list_literals(design.speeds),
        goal=printer.list_literals(design.goal),
        names=", ".join(f'"{wheel.name}"' for wheel in stand.flywheels),
        **design.samples,
    )
    return ExportedAttitude({**generated.files, **printer.files(), "main.c": main}, generated, design)


def attitude_project(stand: Stand, target: Target, options: LoopOptions, real: str) -> ExportedAttitude:
    """The whole project. UsageError: as `design_attitude`. Raises StandError."""
    made = attitude_sources(stand, options, real)
    hosted = target.family == "hosted"
    files = {**made.files, **board_folder(target)}
    host = "" if hosted else HOST
    name, task = stand.name, made.design.task.name
    page = template("board/attitude.md.j2").render(
        name=name,
        real=real,
        task=task,
        dumps=made.design.dumps,
        title=target.title,
        compiler=target.compiler[0],
        emulator=" ".join(target.emulator[:3]) or "this machine",
        hosted=hosted,
        command=_command(options, task, target.name, real),
        packages=", ".join(target.packages),
        lines=made.design.lines,
        wheel=stand.flywheels[0].name,
        settings=list(made.design.settings),
        files=sorted(
            {*files, host} - {"", f"{name}.h", f"{name}.c", f"{name}_attitude.h", f"{name}_attitude.c", "main.c"}
        ),
    )
    files |= {
        "Makefile": makefile(target, files, f"Attitude loop of {name} ({real})", "$(SCENARIO)", host),
        "README.md": page,
    }
    if host:
        files[HOST] = source_text("board/hosted/board.c")
    files = with_manifest(stand, made.generated, files, f"attitude-{target.name}")
    return ExportedAttitude(files, made.generated, made.design)


def _command(options: LoopOptions, task: str, target: str, real: str) -> str:
    """The command that writes the project again: options that are the default are left out."""
    words = ["mahovik generate STAND.toml", f"--attitude task={task}"]
    for name in ("rate", "bandwidth", "damping", "momentum", "failure"):
        value = getattr(options, name)
        if value != getattr(LoopOptions(), name):
            words.append(f"--attitude {name}={value if isinstance(value, str) else f'{value:.17g}'}")
    return " ".join([*words, f"--project {target}", f"--real {real}"])
