"""A project that fuzzes a stand's C: the delivered C, the harness, Makefile, README."""

from __future__ import annotations

import shlex

from mahovik.core.emit.fuzz import fuzz_harness
from mahovik.core.emit.generate import generate_all
from mahovik.core.emit.manifest import with_manifest
from mahovik.core.emit.names import VERIFICATION
from mahovik.core.emit.recorder import recorder_files
from mahovik.core.emit.templates import template
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand
from mahovik.core.toolchain.fuzzing import FLAGS, LIMITS


def sources(name: str) -> tuple[str, ...]:
    """Files that are compiled and linked."""
    return (f"{name}.c", f"{VERIFICATION}{name}_recorder.c", f"{name}_fuzz.c")


def fuzz_project(stand: Stand, real: str) -> dict[str, str]:
    """The project's files, text by file name. Raises StandError, UsageError."""
    generated = generate_all(stand, real)
    name = stand.name
    words = {
        "name": name,
        "NAME": name.upper(),
        "real": real,
        "flags": shlex.join(FLAGS),
        "limits": shlex.join(LIMITS),
        "sources": " ".join(sources(name)),
        "functions": sum(f.public for f in generated.program.functions),
    }
    files = {
        **generated.files,
        **recorder_files(stand, generated),
        f"{name}_fuzz.c": fuzz_harness(generated.program, identities(stand)),
        "Makefile": template("fuzz.mk.j2").render(**words),
        "README.md": template("fuzz.md.j2").render(**words),
    }
    return with_manifest(stand, generated, files, "fuzz")
