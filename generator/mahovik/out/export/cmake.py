"""A CMake project around a stand's C: library target, package, self-test, header for C++17."""

from __future__ import annotations

from mahovik.core.emit.cpp import cpp_example, cpp_header
from mahovik.core.emit.delivery import added_files
from mahovik.core.emit.generate import describe_bodies, generate_all
from mahovik.core.emit.manifest import with_manifest
from mahovik.core.emit.names import VERIFICATION
from mahovik.core.emit.templates import template
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand


def cmake_project(
    stand: Stand, real: str, only: tuple[str, ...] = (), additions: tuple[str, ...] = ()
) -> dict[str, str]:
    """The project's files, text by file name; `only`, `additions`: as of `generate`, and the self-test always.

    Without `forward` there is no example.

    Raises StandError, UsageError.
    """
    generated = generate_all(stand, real, only)
    additions = (*(name for name in dict.fromkeys(additions) if name != "selftest"), "selftest")
    name, hashes, example = stand.name, identities(stand), any(f.name == "forward" for f in generated.program.functions)
    files = {
        **generated.files,
        **cpp_header(stand, generated),
        **added_files(stand, generated, additions),
    }
    listed = (("--only", only), ("--with", additions[:-1]))
    options = "" if real == "double" else f" --real {real}"
    options += "".join(f" {option} {','.join(names)}" for option, names in listed if names)
    words = {
        "name": name,
        "NAME": name.upper(),
        "real": real,
        "batch": "batch" in additions,
        "recorder": f"{VERIFICATION}{name}_recorder" if "recorder" in additions else "",
        "encoder": "encoder" in additions,
        "example": example,
        "bodies": describe_bodies(stand),
        "command": f"mahovik generate STAND.toml --project cmake{options}",
        "structure": hashes.structure,
        "physics": hashes.physics,
        "headers": [file for file in files if file.endswith((".h", ".hpp")) and "/" not in file],
    }
    files |= {
        **(cpp_example(stand, generated) if example else {}),
        "CMakeLists.txt": template("cmake/CMakeLists.txt.j2").render(**words),
        f"{name}Config.cmake.in": template("cmake/Config.cmake.in.j2").render(**words),
        "README.md": template("cmake/README.md.j2").render(**words),
    }
    return with_manifest(stand, generated, files, "cmake")
