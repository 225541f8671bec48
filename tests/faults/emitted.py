"""Emitted C with or without a planted fault, and what the checks make of it: objects, programs, a loaded library."""

from __future__ import annotations

import subprocess
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path
from typing import Any
from unittest.mock import patch

from mahovik import stands as examples
from mahovik.core.emit.delivery import selftest_files
from mahovik.core.emit.generate import Generated, generate_all
from mahovik.core.stand import Stand, State, load
from mahovik.core.toolchain import library as library_module
from mahovik.core.toolchain.compiler import BITS, run_compiler
from mahovik.core.toolchain.library import Library
from mahovik.errors import ToolchainError
from mahovik.proof.verify.c_backend import InterpreterBackend
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.program_backend import ProgramBackend

STATES = 3
"""Random states on which the C is judged."""


@dataclass(frozen=True)
class Host:
    """Place of a planted fault: an example stand, the element type."""

    name: str
    real: str = "double"

    def __str__(self) -> str:
        return self.name if self.real == "double" else f"{self.name}, {self.real}"


@cache
def stand_of(host: Host) -> Stand:
    """The example stand."""
    return load(examples.path(host.name))


@cache
def generated_of(host: Host) -> Generated:
    """Program, numbers and C of a host."""
    return generate_all(stand_of(host), host.real)


@cache
def files_of(host: Host) -> Mapping[str, str]:
    """Header, source and self-test, by name."""
    return {**generated_of(host).files, **selftest_files(stand_of(host), generated_of(host))}


@cache
def interpreter_of(host: Host) -> InterpreterBackend:
    """The interpreter of the program without the fault."""
    return InterpreterBackend(generated_of(host))


@cache
def states_of(host: Host) -> tuple[tuple[str, State], ...]:
    """Random states, and an ordinary one first."""
    return tuple(draw(stand_of(host), 7, STATES + 1, host.real, wrenches=False)[1:])


class Emitted:
    """C of a host in a folder. `flags`: further compiler flags, where these are the fault."""

    def __init__(self, host: Host, folder: Path, files: Mapping[str, str] | None = None, *flags: str) -> None:
        self.host, self.folder, self.flags = host, folder, flags
        self.files = dict(files_of(host) if files is None else files)
        for name, text in self.files.items():
            (folder / name).parent.mkdir(exist_ok=True)
            (folder / name).write_text(text, encoding="ascii", newline="\n")

    @property
    def name(self) -> str:
        return self.host.name

    @property
    def source(self) -> Path:
        return self.folder / f"{self.name}.c"

    def program(self, main: str, *flags: str, compiler: str = "gcc") -> Path:
        """An executable of `main` and the source. Without warnings: those are a check of their own.

        Raises ToolchainError where it does not compile.
        """
        target = self.folder / f"{Path(main).stem}{len(list(self.folder.iterdir()))}"
        command = [compiler, "-std=c99", "-w", f"-D{self.name.upper()}_SELFTEST_MAIN", *BITS, *flags, *self.flags]
        sources = [self.folder / main] + ([] if main.endswith("_within.c") else [self.source])
        done = subprocess.run(
            [*command, *map(str, sources), "-o", str(target), "-lm"], capture_output=True, text=True, check=False
        )
        if done.returncode != 0:
            raise ToolchainError(first_error(done.stderr))
        return target

    @cached_property
    def backend(self) -> Planted:
        """The compiled C as a backend."""
        return Planted(self)


class Planted(ProgramBackend):
    """The C of `Emitted`, loaded, beside the interpreter of the program without the fault."""

    def __init__(self, made: Emitted) -> None:
        self.generated = generated_of(made.host)

        def build(source: Path, library: Path, plain: str) -> None:
            flags = ("-std=c99", "-w", *BITS, "-O1", "-shared", "-fPIC", plain, *made.flags)
            run_compiler([*flags, f"-I{source.parent}", str(source), "-o", str(library)], source.name)

        with patch.object(library_module, "build_shared", build):
            self.library = Library(made.source.with_suffix(".h"), made.source, made.folder, made.name)
        self.interpreter = interpreter_of(made.host)
        program = self.generated.program

        def run(function: str, inputs: Mapping[str, Any]) -> tuple[int, dict[str, Any]]:
            return self.library.run(program.function(function), inputs)

        table = self.library.default("default")
        given = {"parameters": self.library.default("default_parameters")}
        mounting = run("prepare_mounts", given)[1]["mounting"]
        super().__init__("c", self.generated.layout, program, table, mounting, run, self.generated.values.options)

    def interpreter_evaluate(self, state: State, want: Any) -> dict[str, Any]:
        """Results of the interpreter."""
        return self.interpreter.evaluate(state, want)


def first_error(text: str) -> str:
    """The first line of a compiler's or sanitizer's complaint that says what is wrong, without paths."""
    lines = text.strip().splitlines()
    words = ("error:", "runtime error", "ERROR: AddressSanitizer", "warning:")
    line = next((line for line in lines if any(word in line for word in words)), lines[0] if lines else "")
    return line.rpartition("error: ")[2].strip() or "no message"
