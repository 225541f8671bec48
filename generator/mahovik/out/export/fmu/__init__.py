"""An FMU of a stand: description, sources, binary for this machine, in one file that other tools load."""

from __future__ import annotations

from dataclasses import dataclass

from mahovik.core.emit.fmu import compiled_sources, fmu_sources
from mahovik.core.emit.fmu_description import fmu_build, fmu_description
from mahovik.core.emit.generate import Generated, generate_all
from mahovik.core.lower.fmu.variables import Inputs, Kind, form
from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.core.toolchain.module import build_module, module_suffix, platform_folder
from mahovik.errors import NoCompilerError, UsageError
from mahovik.out.export.fmu.archive import archive
from mahovik.out.export.fmu.start import start_of

VERSIONS = ("2.0", "3.0")
STEP = 1e-3
"""Proposed communication step in the description, s."""


@dataclass(frozen=True)
class Fmu:
    """An FMU: bytes of the file, its contents by name, and messages, one line each."""

    content: bytes
    files: dict[str, str | bytes]
    lines: tuple[str, ...]


def export_fmu(
    stand: Stand,
    version: str,
    kind: Kind,
    inputs: Inputs = "torque",
    dt: float = 1e-4,
    start: State | None = None,
    binary: bool = True,
    generated: Generated | None = None,
) -> Fmu:
    """The FMU of a stand. `start`: default the static equilibrium, as `simulate` begins; `dt`: longest step inside, s.

    `generated`: the C of the stand in double, for a caller that has it already.

    Raises UsageError; CheckError: no equilibrium to begin in; ToolchainError: the compiler failed. Without a compiler
    the FMU has only sources, and a message says so.
    """
    if not 1e-9 <= dt <= 10.0:
        raise UsageError(f"--dt {dt:g}: expected 1e-09 to 10 s, the longest step inside the FMU")
    generated = generated or generate_all(stand)
    found = form(stand, generated.layout, generated.values, kind, inputs, dt, start_of(stand, start, generated))
    description = fmu_description(stand, found, version, compiled_sources(stand, version), max(STEP, dt))
    sources = fmu_sources(stand, generated, found, version, description.token)
    files: dict[str, str | bytes] = {"modelDescription.xml": description.text}
    files |= {f"sources/{name}": text for name, text in sources.files.items()}
    if version == "3.0":
        files["sources/buildDescription.xml"] = fmu_build(stand, sources.compiled)
    lines = [f"FMI {version}, {'co-simulation' if kind == 'cs' else 'model exchange'}; {description.token}"]
    if binary:
        place = f"binaries/{platform_folder(version)}/{stand.name}{module_suffix()}"
        try:
            files[place] = build_module(sources.files, sources.compiled)
            lines.append(f"binary: {place}")
        except NoCompilerError as error:
            lines.append(f"no binary, only sources: {error}")
    else:
        lines.append("no binary, only sources")
    return Fmu(archive(files), files, tuple(lines))
