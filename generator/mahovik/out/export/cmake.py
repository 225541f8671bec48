"""A CMake project around a stand's C: library target, package, self-test."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import PurePosixPath

from mahovik.core.emit.delivery import added_files
from mahovik.core.emit.generate import describe_bodies, generate_all
from mahovik.core.emit.manifest import with_manifest
from mahovik.core.emit.names import VERIFICATION
from mahovik.core.emit.templates import template
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import identities
from mahovik.out.export.attitude import ExportedAttitude
from mahovik.out.export.target import board_folder, exportable


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
