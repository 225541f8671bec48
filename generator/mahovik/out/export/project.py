"""Projects around a stand's C: its self-test on a board, CMake, an attitude loop that closes with the exact plant."""

from __future__ import annotations

import shlex
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import PurePosixPath

from mahovik.core.emit.attitude import AttitudePrinter, AttitudeTables, needed_functions
from mahovik.core.emit.delivery import added_files, selftest_files
from mahovik.core.emit.generate import Generated, describe_bodies, generate_all
from mahovik.core.emit.manifest import with_manifest
from mahovik.core.emit.names import VERIFICATION
from mahovik.core.emit.templates import source_text, template
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import identities
from mahovik.core.toolchain.compiler import BITS
from mahovik.core.toolchain.targets import TARGETS, Target, board_files, link_flags, selftest_main
from mahovik.errors import UsageError
from mahovik.nearest import suggestion
from mahovik.use.control.attitude import AttitudeDesign, LoopOptions, design_attitude

SWEEP = 20
"""States of the self-test's sweep."""


def exportable(name: str) -> Target:
    """The target with this name. Raises UsageError for an unknown one, and for one with two compilers."""
    target = TARGETS.get(name)
    if target is None:
        raise UsageError(f'unknown target "{name}"{suggestion(name, TARGETS)}')
    if target.linker:
        raise UsageError(f"{name} is compiled and linked by two compilers: choose {name.partition('-')[0]} instead")
    return target


def board_project(
    stand: Stand, name: str, real: str, only: tuple[str, ...] = (), beside: Sequence[str] = ()
) -> dict[str, str]:
    """Project that runs the self-test on the target of a name: text by file name. Raises StandError, UsageError.

    `only`: as of `generate`; `beside`: files of programmes and servos in the folder, which it compiles too.
    """
    target = exportable(name)
    made = generate_all(stand, real, only)
    files = {
        **made.files,
        **selftest_files(stand, made),
        **board_folder(target),
        "main.c": selftest_main(stand.name, SWEEP),
    }
    compiled = [name for name in beside if name.endswith((".h", ".c")) and not name.startswith(VERIFICATION)]
    files["Makefile"] = makefile(target, [*files, *compiled], f"Self-test of {stand.name} ({real})")
    files["README.md"] = template("board/project.md.j2").render(
        name=stand.name,
        NAME=stand.name.upper(),
        real=real,
        title=target.title,
        compiler=target.compiler[0],
        hosted=target.family == "hosted",
        compiled=compiled,
        emulator=" ".join(target.emulator[:3]) or "this machine",
        command=f"mahovik generate STAND.toml --project {target.name} --real {real}"
        + (f" --only {','.join(made.chosen)}" if made.chosen else ""),
        packages=f"; Debian: apt-get install {' '.join(target.packages)}",
        startup="startup.S" if f"{VERIFICATION}startup.S" in files else "startup.c",
        fpu=bool(target.real),
        vector="-fno-tree-vectorize" in target.compiler[1:] and target.family != "hosted",
        ticks="ticks of the processor's clock; compile with -DBOARD_MHZ=1000u"
        if target.mhz
        else "retired instructions",
    )
    return with_manifest(stand, made, files, target.name)


def board_folder(target: Target) -> dict[str, str]:
    """The board's own files, beside the self-test."""
    return {f"{VERIFICATION}{name}": text for name, text in board_files(target).items()}


def makefile(target: Target, files: Iterable[str], subject: str, defines: str = "", host: str = "") -> str:
    """Makefile of a project: it builds and runs all sources of `files` on a target.

    `subject`: what the program is; `defines`: macros that all sources have; `host`: name of the console of this
    machine, with which the same sources that are not the board's are built and run here as well.
    """
    files = sorted(files)
    sources = [name for name in files if name.endswith((".c", ".S"))]
    board = board_folder(target)
    return template("board/Makefile.j2").render(
        subject=subject,
        title=target.title,
        compiler=target.compiler[0],
        hosted=target.family == "hosted",
        machine=shlex.join(target.compiler[1:]),
        emulator=shlex.join(target.emulator),
        optimisation=target.optimisation,
        bits=shlex.join(BITS),
        defines=f" {defines}" if defines else "",
        mhz=f" -DBOARD_MHZ={target.mhz}u" if target.mhz else "",
        link=shlex.join(link_flags(target)),
        objects=[str(PurePosixPath(name).with_suffix(".o")) for name in sources],
        headers=[name for name in files if name.endswith(".h")],
        startup_in_assembler=f"{VERIFICATION}startup.S" in files,
        host=host,
        host_sources=[*(name for name in sources if name not in board), host],
    )


def cmake_project(
    stand: Stand,
    real: str,
    only: tuple[str, ...] = (),
    additions: tuple[str, ...] = (),
    beside: Sequence[str] = (),
    loop: ExportedAttitude | None = None,
) -> dict[str, str]:
    """The project's files, text by file name; `only`, `additions`: as of `generate`, and the self-test always.

    beside  names of the files of programmes and servos in the folder, which the target has too
    loop    an attitude loop, which the target has too, with its own functions of the C; its run is an example

    Raises StandError, UsageError.
    """
    generated = generate_all(stand, real, only) if loop is None else loop.generated
    additions = (*(name for name in dict.fromkeys(additions) if name != "selftest"), "selftest")
    name, hashes = stand.name, identities(stand)
    files = generated.files | added_files(stand, generated, additions)
    parts = [name for name in beside if name.endswith((".h", ".c"))]
    if loop is not None:
        files |= loop.files | board_folder(exportable("host"))
        parts += [f"{name}_attitude.h", f"{name}_attitude.c"]
    listed = (("--only", () if loop else generated.chosen), ("--with", additions[:-1]))
    options = "" if real == "double" else f" --real {real}"
    options += "".join(f" {option} {','.join(names)}" for option, names in listed if names)
    words = {
        "name": name,
        "NAME": name.upper(),
        "real": real,
        "batch": "batch" in additions,
        "recorder": f"{VERIFICATION}{name}_recorder" if "recorder" in additions else "",
        "encoder": "encoder" in additions,
        "bodies": describe_bodies(stand),
        "command": f"mahovik generate STAND.toml --project cmake{options}",
        "structure": hashes.structure,
        "physics": hashes.physics,
        "sources": [file for file in parts if file.endswith(".c") and "/" not in file],
        "tests": [PurePosixPath(file).stem for file in parts if file.endswith("_test.c")],
        "parts": parts,
        "loop": loop is not None,
        "headers": [file for file in dict.fromkeys((*files, *parts)) if file.endswith(".h") and "/" not in file],
    }
    files |= {
        "CMakeLists.txt": template("cmake/CMakeLists.txt.j2").render(**words),
        f"{name}Config.cmake.in": template("cmake/Config.cmake.in.j2").render(**words),
        "README.md": template("cmake/README.md.j2").render(**words),
    }
    return with_manifest(stand, generated, files, "cmake" if loop is None else "attitude-cmake")


HOST = f"{VERIFICATION}board_host.c"
"""Console of this machine, for the same program without an emulator."""


@dataclass(frozen=True)
class ExportedAttitude:
    """Files of C by name; the C of the stand among them; settings, with their messages."""

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


def attitude_project(
    stand: Stand, target_name: str, options: LoopOptions, made: ExportedAttitude, real: str
) -> dict[str, str]:
    """Project that runs a loop on the target of a name. Raises StandError, UsageError."""
    target, design = exportable(target_name), made.design
    host = "" if target.family == "hosted" else HOST
    files, name = {**made.files, **board_folder(target)}, stand.name
    usual = {f"{name}.h", f"{name}.c", f"{name}_attitude.h", f"{name}_attitude.c", "main.c"}
    page = template("board/attitude.md.j2").render(
        name=name,
        real=real,
        task=design.task.name,
        dumps=design.dumps,
        title=target.title,
        compiler=target.compiler[0],
        emulator=" ".join(target.emulator[:3]) or "this machine",
        hosted=not host,
        command=_command(options, design.task.name, target.name, real),
        packages=", ".join(target.packages),
        lines=design.lines,
        wheel=stand.flywheels[0].name,
        settings=list(design.settings),
        files=sorted({*files, host} - {"", *usual}),
    )
    text = makefile(target, files, f"Attitude loop of {name} ({real})", "$(SCENARIO)", host)
    files |= {"Makefile": text, "README.md": page} | ({HOST: source_text("board/hosted/board.c")} if host else {})
    return with_manifest(stand, made.generated, files, f"attitude-{target.name}")


def _command(options: LoopOptions, task: str, target: str, real: str) -> str:
    """The command that writes the project again: options that are the default are left out."""
    words = ["mahovik generate STAND.toml", f"--attitude task={task}"]
    for name in ("rate", "bandwidth", "damping", "momentum", "failure"):
        value = getattr(options, name)
        if value != getattr(LoopOptions(), name):
            words.append(f"--attitude {name}={value if isinstance(value, str) else f'{value:.17g}'}")
    return " ".join([*words, f"--project {target}", f"--real {real}"])
