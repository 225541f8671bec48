"""A small project that runs a stand's self-test on a board: C, startup, linker script, Makefile, README."""

from __future__ import annotations

import shlex
from collections.abc import Iterable, Sequence
from pathlib import PurePosixPath

from mahovik.core.emit.delivery import selftest_files
from mahovik.core.emit.generate import generate_all
from mahovik.core.emit.manifest import with_manifest
from mahovik.core.emit.names import VERIFICATION
from mahovik.core.emit.templates import template
from mahovik.core.stand.model import Stand
from mahovik.core.toolchain.compiler import BITS
from mahovik.core.toolchain.targets import TARGETS, Target, board_files, link_flags, selftest_main
from mahovik.errors import UsageError
from mahovik.nearest import suggestion

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
    stand: Stand, target: Target, real: str, only: tuple[str, ...] = (), beside: Sequence[str] = ()
) -> dict[str, str]:
    """The project's files, text by file name; `only`: as of `generate`. Raises StandError, UsageError.

    `beside`: names of the files of programmes and servos in the folder, which it compiles too.
    """
    made = generate_all(stand, real, only)
    files = {
        **made.files,
        **selftest_files(stand, made),
        **board_folder(target),
        "main.c": selftest_main(stand.name, SWEEP),
    }
    compiled = [name for name in beside if name.endswith((".h", ".c")) and not name.startswith(VERIFICATION)]
    words = {
        "name": stand.name,
        "NAME": stand.name.upper(),
        "real": real,
        "title": target.title,
        "compiler": target.compiler[0],
        "hosted": target.family == "hosted",
        "compiled": compiled,
    }
    files["Makefile"] = makefile(target, [*files, *compiled], f"Self-test of {stand.name} ({real})")
    files["README.md"] = template("board/project.md.j2").render(
        **words | {"emulator": " ".join(target.emulator[:3]) or "this machine"},
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
