"""Files of a folder that `generate` writes: the C, a project around it, programmes, servos, an attitude loop."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from mahovik.core.emit.delivered import differences
from mahovik.core.emit.delivery import delivery
from mahovik.core.stand.model import Stand
from mahovik.core.toolchain.targets import TARGETS
from mahovik.errors import CheckError, UsageError
from mahovik.nearest import suggestion
from mahovik.out.export.target import exportable

if TYPE_CHECKING:
    from mahovik.core.motion.programme import Programme
    from mahovik.core.motion.required import RequiredMotion
    from mahovik.core.motion.servo import Servo
    from mahovik.use.control.attitude import LoopOptions

BLOCKS = ("simulink", "basilisk")
"""Simulators for which there is a plant block."""

PROJECTS = ("cmake", "fmu", "fuzz", *BLOCKS)
"""Projects that are for no board."""


@dataclass
class Contents:
    """What is to be written.

    files        text by name, the manifest among them
    replaceable  those of which a user's own stay
    programme    files of a programme, with a manifest of their own
    servo        likewise of its servos
    lines        messages, a line each
    """

    files: dict[str, str] = field(default_factory=dict)
    replaceable: tuple[str, ...] = ()
    programme: dict[str, str] = field(default_factory=dict)
    servo: dict[str, str] = field(default_factory=dict)
    lines: tuple[str, ...] = ()


def usual_real(project: str | None) -> str:
    """Element type where none is asked for: the widest of the FPU of a board, else double."""
    return (TARGETS[project].real if project in TARGETS else None) or "double"


def compiles_programmes(project: str | None) -> bool:
    """Whether a project compiles programmes and servos that lie in its folder."""
    return project == "cmake" or project in TARGETS


def refuse_unknown(project: str | None) -> None:
    """Raise UsageError for a project that there is not."""
    if project is not None and project not in (*PROJECTS, *TARGETS):
        raise UsageError(f'project: unknown "{project}"{suggestion(project, (*PROJECTS, *TARGETS))}')


def add_project(
    contents: Contents,
    stand: Stand,
    folder: Path,
    project: str | None,
    loop: LoopOptions | None,
    real: str,
    only: tuple[str, ...],
    additions: tuple[str, ...],
) -> None:
    """Add the C and the project around it, which compiles programmes of the contents and of the folder.

    `loop`: options of an attitude loop; without a project for this machine. Raises UsageError, StandError.
    """
    if loop is not None:
        _add_loop(contents, stand, project or "host", loop, real)
    elif project is None:
        contents.files = delivery(stand, real, only, additions)
    elif project == "cmake":
        from mahovik.out.export.cmake import cmake_project

        contents.files = cmake_project(stand, real, only, additions, _companions(contents, folder, stand))
    elif project == "fuzz":
        from mahovik.core.toolchain.checks import fuzz_project

        contents.files = fuzz_project(stand, real)
    elif project in BLOCKS:
        from mahovik.out.export.fmu import export_block

        contents.files = export_block(stand, project)
    else:
        from mahovik.out.export.target import board_project

        contents.files = board_project(stand, exportable(project), real, only, _companions(contents, folder, stand))
        contents.replaceable = ("main.c",)


def _add_loop(contents: Contents, stand: Stand, project: str, options: LoopOptions, real: str) -> None:
    from mahovik.out.export.attitude import attitude_project, attitude_sources

    if project == "cmake":
        from mahovik.out.export.cmake import cmake_project

        loop = attitude_sources(stand, options, real)
        contents.files = cmake_project(stand, real, loop=loop)
    else:
        loop = attitude_project(stand, exportable(project), options, real)
        contents.files = loop.files
    contents.lines = (*contents.lines, *loop.design.lines)


def _companions(contents: Contents, folder: Path, stand: Stand) -> Sequence[str]:
    """Names of the files of programmes and servos, those to be written and those that the folder has."""
    from mahovik.out.export.programme.files import files_in

    return sorted({*files_in(folder, stand), *contents.programme, *contents.servo})


def add_programme(
    contents: Contents,
    stand: Stand,
    programme: Programme,
    motion: RequiredMotion | None,
    servo: Servo | None,
    kind: str,
    real: str,
    sources: tuple[str, str],
    called: str,
) -> None:
    """Add the C of a programme, and of the servos that follow it.

    `kind` of its table; `sources`: files of programme and servo, in messages; `called`: its name in C.
    Raises CheckError, UsageError.
    """
    from mahovik.out.export.programme import export_programme

    if servo is None:
        tables = export_programme(stand, programme, motion, kind, None, real, None, sources[0], called)
        contents.lines = tables.lines
    else:
        from mahovik.out.export.servo import export_servo

        follower = export_servo(stand, programme, motion, servo, real, kind, sources, called)
        tables, contents.servo = follower.programme, follower.servo
        contents.lines = (*tables.lines, *follower.lines)
    contents.programme = tables.files


def refuse_overwriting(folder: Path, stand: Stand, contents: Contents, called: str) -> None:
    """Raise UsageError where the C of a programme or of servos would overwrite a file of others, or one edited."""
    from mahovik.out.export.programme.files import refuse_foreign

    if contents.servo:
        refuse_foreign(folder, stand, "servo", contents.servo, "" if called == "programme" else f"{called}_servo")
    if contents.programme:
        refuse_foreign(folder, stand, "programme", contents.programme, called)


def check_folder(folder: Path, stand: Stand, contents: Contents) -> None:
    """Raise CheckError where a folder is not what would be written; replaceable files are not compared."""
    files = {name: text for name, text in contents.files.items() if name not in contents.replaceable}
    lines = differences(folder, stand, files) if files else []
    for name, text in {**contents.programme, **contents.servo}.items():
        path = folder / name
        if not path.is_file() or path.read_bytes() != text.encode():
            what = "not what the generator makes of the stand file" if path.is_file() else "missing"
            lines.append(f"{path}: is {what}")
    if lines:
        raise CheckError("\n".join(lines))
