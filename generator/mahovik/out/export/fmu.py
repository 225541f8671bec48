"""An FMU of a stand: description, sources, binary for this machine, in one file that other tools load."""

from __future__ import annotations

import io
import math
import zipfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from mahovik.core.emit.fmu import block_sources, compiled_sources, fmu_description, fmu_sources
from mahovik.core.emit.generate import Generated, generate_all
from mahovik.core.emit.manifest import with_manifest
from mahovik.core.lower.fmu_variables import Inputs, Kind, Start, form
from mahovik.core.program.interpret import Interpreter
from mahovik.core.stand.model import Stand, State
from mahovik.core.toolchain.compiler import build_module, module_suffix, platform_folder
from mahovik.errors import CheckError, NoCompilerError, UsageError
from mahovik.use.study.rest import rest

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
    kind: Kind,
    inputs: Inputs = "torque",
    dt: float = 1e-4,
    start: State | None = None,
    binary: bool = True,
    generated: Generated | None = None,
) -> Fmu:
    """The FMU of a stand. `start`: default the rest pose, as `simulate` begins; `dt`: longest step inside, s.

    `generated`: the C of the stand in double, for a caller that has it already.

    Raises UsageError; CheckError: no equilibrium to begin in; ToolchainError: the compiler failed. Without a compiler
    the FMU has only sources, and a message says so.
    """
    if not 1e-9 <= dt <= 10.0:
        raise UsageError(f"fmu dt {dt:g}: expected 1e-09 to 10 s, the longest step inside the FMU")
    stand = with_wrench(stand)
    generated = generated or generate_all(stand)
    variables = form(stand, generated.layout, generated.values, kind, inputs, dt, start_of(stand, start, generated))
    description = fmu_description(stand, variables, max(STEP, dt))
    sources = fmu_sources(stand, generated, variables, description.token)
    files: dict[str, str | bytes] = {"modelDescription.xml": description.text}
    files |= {f"sources/{name}": text for name, text in sources.items()}
    lines = [f"FMI 2.0, {'co-simulation' if kind == 'cs' else 'model exchange'}; {description.token}"]
    if binary:
        place = f"binaries/{platform_folder()}/{stand.name}{module_suffix()}"
        try:
            files[place] = build_module(sources, compiled_sources(stand))
            lines.append(f"binary: {place}")
        except NoCompilerError as error:
            lines.append(f"no binary, only sources: {error}")
    else:
        lines.append("no binary, only sources")
    return Fmu(archive(files), files, tuple(lines))


def with_wrench(stand: Stand) -> Stand:
    """The stand with a run-time wrench on its carrier: other simulators have forces of their own."""
    return replace(stand, carrier=replace(stand.carrier, wrench_input=True))


def export_block(stand: Stand, tool: str, dt: float = 1e-4, start: State | None = None) -> dict[str, str]:
    """A plant block of the simulator "simulink" or "basilisk", text by file name. Options, errors: as `export_fmu`."""
    stand = with_wrench(stand)
    generated = generate_all(stand)
    block = form(stand, generated.layout, generated.values, "cs", "torque", dt, start_of(stand, start, generated))
    return with_manifest(stand, generated, block_sources(stand, generated, block, tool), tool)


_DECIMALS = 12
"""Decimals kept of an equilibrium: its last bits depend on the machine's linear algebra."""


def start_of(stand: Stand, state: State | None, generated: Generated) -> Start:
    """Start of a state; without one, the rest pose with flywheels at rest. CheckError: there is none."""
    if state is not None:
        return Start(state.position, _unit(state, generated), state.V, state.phi, state.phi_dot)
    try:
        start = rest(stand).state
    except CheckError as error:
        raise CheckError(f"{error}; give an initial state by fmu=start=STATE.json") from None
    position, attitude = (
        [round(float(x), _DECIMALS) + 0.0 for x in values] for values in (start.position, _unit(start, generated))
    )
    return Start(position, attitude, start.V, start.phi, start.phi_dot)


def _unit(state: State, generated: Generated) -> list[float]:
    """The attitude as a quaternion, w first, of unit length."""
    quaternion: Sequence[float] | None = state.quaternion
    if quaternion is None:
        angles = state.angles or (0.0, 0.0, 0.0)
        quaternion = Interpreter(generated.program).run("quaternion", {"angles": angles})[1]["attitude"]
    length = math.hypot(*quaternion)
    return [float(c) / length for c in quaternion]


_BEGINNING = (1980, 1, 1, 0, 0, 0)
"""The earliest time of the format, used for all files."""


def archive(files: Mapping[str, str | bytes]) -> bytes:
    """The files by path, in that order, compressed; without dates."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as target:
        for name, content in files.items():
            entry = zipfile.ZipInfo(name, _BEGINNING)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.create_system = 3
            entry.external_attr = (0o755 if name.startswith("binaries/") else 0o644) << 16
            target.writestr(entry, content)
    return buffer.getvalue()
