"""A CMake project around a stand's C: library target, package, self-test, header for C++17."""

from __future__ import annotations

from mahovik.core.emit.batch import batch_files
from mahovik.core.emit.cpp import cpp_example, cpp_header
from mahovik.core.emit.delivery import selftest_files
from mahovik.core.emit.generate import describe_bodies, generate_all
from mahovik.core.emit.recorder import has_recorder, recorder_files
from mahovik.core.emit.templates import template
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand


def cmake_project(stand: Stand, real: str, batch: bool = False, only: tuple[str, ...] = ()) -> dict[str, str]:
    """The project's files, text by file name; `batch`: also the functions for many states; `only`: as of `generate`.

    Without `forward` there is no example, without a step no recorder.

    Raises StandError, UsageError.
    """
    generated = generate_all(stand, real, only)
    logs, example = has_recorder(generated), not only or "forward" in only
    name, found = stand.name, identities(stand)
    files = {
        **generated.files,
        **cpp_header(stand, generated),
        **(recorder_files(stand, generated) if logs else {}),
        **(batch_files(stand, generated) if batch else {}),
    }
    options = f"{'' if real == 'double' else f' --real {real}'}{' --batch' if batch else ''}"
    options += f" --only {','.join(only)}" if only else ""
    words = {
        "name": name,
        "NAME": name.upper(),
        "real": real,
        "batch": batch,
        "recorder": logs,
        "example": example,
        "bodies": describe_bodies(stand),
        "command": f"mahovik export cmake STAND.toml{options}",
        "structure": found.structure,
        "physics": found.physics,
        "headers": [file for file in files if file.endswith((".h", ".hpp"))],
    }
    return {
        **files,
        **selftest_files(stand, generated),
        **(cpp_example(stand, generated) if example else {}),
        "CMakeLists.txt": template("cmake/CMakeLists.txt.j2").render(**words),
        f"{name}Config.cmake.in": template("cmake/Config.cmake.in.j2").render(**words),
        "README.md": template("cmake/README.md.j2").render(**words),
    }
